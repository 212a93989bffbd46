"""For tests/ and for notebooks/: notebooks that pytest runs again draw no progress bars, which are no part of their outputs."""
import os

os.environ.setdefault("TQDM_DISABLE", "1")
