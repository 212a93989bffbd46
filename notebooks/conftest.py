"""Notebooks that pytest runs again draw no progress bars, which are no part of their stored
outputs."""

import os

os.environ.setdefault("TQDM_DISABLE", "1")
