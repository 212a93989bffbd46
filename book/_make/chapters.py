"""Runs the notebooks, as many at once as there are processors; what has run before is kept."""

import multiprocessing
import os
import sys
import time
from concurrent.futures import ProcessPoolExecutor

import nbformat
from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from nbclient.exceptions import CellExecutionError
from places import CACHE, ROOT
from running import run


def execute_notebooks():
    """Fill the cache with the notebooks that it does not hold yet."""
    os.environ.setdefault("TQDM_DISABLE", "1")  # no progress bars in the pages
    cache = get_cache(str(CACHE))
    notebooks = sorted((ROOT / "notebooks").glob("*.ipynb"))
    missing = [path for path in notebooks if not is_cached(path, cache)]
    missing.sort(key=lambda path: -path.stat().st_size)  # the long ones first
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(max_workers=os.cpu_count(), mp_context=context) as pool:
        for path, (notebook, seconds, error) in zip(missing, pool.map(execute, missing)):
            if error:
                sys.exit(f"{error}\n{path.name} stopped at this cell.")
            bundle = CacheBundleIn(notebook, str(path), data={"execution_seconds": seconds})
            cache.cache_notebook_bundle(bundle, check_validity=False, overwrite=True)
            print(f"Ran {path.name} in {seconds:.0f} s", flush=True)


def is_cached(path, cache):
    try:
        return bool(cache.match_cache_notebook(code_of(path)))
    except KeyError:
        return False


def execute(path):
    """Run one notebook -> (the notebook with its outputs, seconds, None), or (None, 0, error)."""
    notebook = code_of(path)
    started = time.monotonic()
    try:
        run(notebook, path.parent)
    except CellExecutionError as error:
        return None, 0, str(error)
    return notebook, time.monotonic() - started, None


def code_of(path):
    """The notebook without the words of its figures.

    So book/_ext/figures.py leaves it, and so the cache compares it.
    """
    notebook = nbformat.read(path, as_version=4)
    for cell in notebook.cells:
        cell.metadata.pop("book", None)
    return notebook
