"""Notebooks that pytest runs again draw no progress bars: no output to keep."""

import os

os.environ.setdefault("TQDM_DISABLE", "1")
