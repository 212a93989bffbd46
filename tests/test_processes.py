"""Processes that die or are interrupted: a pool of Python, a cluster of Dask, Ctrl+C."""

import multiprocessing
import os
import signal
import threading
import time
from concurrent.futures import Executor, ProcessPoolExecutor

import pytest
from accident import press, quiet, same, wait, with_accident

pytestmark = pytest.mark.usefixtures("usual_ctrl_c")


def test_a_pool_that_loses_a_process_keeps_what_is_done(flag):
    """The process that has the sixth block kills itself; five have been begun before, by two."""
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        with pytest.warns(UserWarning, match="resume=.* / Satu proses eksekutor mati"):
            part = with_accident("die", flag, pool, block=5)
    assert not part.complete and 4 <= len(part.blocks) < 8 and 5 not in part.blocks
    assert not flag.exists()
    whole = with_accident("die", flag, block=5, resume=part)
    assert whole.complete and same(quiet(), whole)


def test_ctrl_c_in_a_terminal_ends_no_process_that_waits(flag):
    """It reaches the processes of a pool, too: there it may end a block, but nothing else."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        part = with_accident("Ctrl+C in a worker", flag, pool)
        assert not part.complete and 2 not in part.blocks
        flag.unlink()
        os.kill(pool.submit(os.getpid).result(), signal.SIGINT)
        whole = with_accident("Ctrl+C in a worker", flag, pool, resume=part)
    assert whole.complete and same(quiet(), whole)


def test_a_pool_that_breaks_after_ctrl_c_still_ends(flag, monkeypatch):
    """In Python 3.11 its thread stumbled over the cancelled tasks, and the program never ended."""

    class Pressed(Executor):
        futures = []

        def submit(self, *task):
            if len(self.futures) == 7:
                while not self.futures[1].running():  # then the queue to the process is full
                    time.sleep(0.01)
                press()
            self.futures.append(pool.submit(*task))
            return self.futures[-1]

    stumbled = []
    monkeypatch.setattr(threading, "excepthook", stumbled.append)
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        process = pool.submit(os.getpid).result()
        pool.submit(wait, flag)
        while not flag.with_name("flag.begun").exists():
            time.sleep(0.01)
        part = with_accident("nothing", flag, executor := Pressed())
        assert not part.blocks and all(future.cancelled() for future in executor.futures[2:])
        os.kill(process, signal.SIGKILL)
        pool._executor_manager_thread.join()
    assert not stumbled


def test_a_dask_cluster_that_loses_a_worker_gives_the_same_bits(flag):
    """Of two worker processes, the one that has the sixth block kills itself."""
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        workers = set(client.run(os.getpid).values())
        together = with_accident("die", flag, client.get_executor(), block=5)
        client.wait_for_workers(2)  # the dead one is replaced before all are closed
    died = int(flag.with_name("flag.died").read_text())
    assert len(workers) == 2 and died in workers
    assert together.complete and same(quiet(), together)
