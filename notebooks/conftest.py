"""Notebooks that pytest runs again draw no progress bars."""

import os

os.environ.setdefault("TQDM_DISABLE", "1")
