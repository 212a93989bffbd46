"""Notebooks that pytest runs again draw no progress bars, so none is kept."""

import os

os.environ.setdefault("TQDM_DISABLE", "1")
