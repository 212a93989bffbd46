"""Monte Carlo: right, the same to the last bit wherever it runs, and nothing lost when it is interrupted."""
import multiprocessing
import os
import signal
import threading
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest

from kalman_lib import kalman_filter, mismatch_map, monte_carlo, montecarlo, nees, rmse
from kalman_lib.papers import beetle, gyro, theory

PARAMS = gyro.Params(duration=5)
ASSUMED = {"sigma_w": [5, 10], "sigma_v": [1, 10, 100]}
RUNS = 1200             # three blocks


@pytest.fixture(autouse=True)
def small_blocks(monkeypatch):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")


def study(executor=None, **options):
    return monte_carlo(gyro, PARAMS, RUNS, np.random.default_rng(1), executor, **options)


def same(a, b):
    return all(np.array_equal(getattr(a, name), getattr(b, name)) for name in ("rmse", "error", "P", "nees"))


class Shuffled(Executor):
    """Runs everything at once, but the last task first."""

    def __init__(self):
        self.waiting = []

    def submit(self, function, *arguments):
        self.waiting.insert(0, (future := Future(), function, arguments))
        if len(self.waiting) == 3:
            for future_, function, arguments in self.waiting:
                future_.set_result(function(*arguments))
        return future


def test_the_numbers_are_those_of_run_by_run():
    result = study()
    assert result.complete and result.runs == RUNS and result.rmse.shape == (1, RUNS)
    seed = np.random.default_rng(1).bit_generator.seed_seq.spawn(3)[0]
    flight = gyro.simulate(PARAMS, np.random.default_rng(seed), runs=montecarlo.BLOCK)
    for run in (0, 7):
        alone = kalman_filter(gyro.model(PARAMS), flight.z[..., run], flight.u)
        assert result.rmse[:, run] == pytest.approx(rmse(flight.x[..., run], alone.x), rel=1e-12)
    alone = [kalman_filter(gyro.model(PARAMS), flight.z[..., run], flight.u) for run in range(montecarlo.BLOCK)]
    expected = np.mean([nees(flight.x[..., run], r.x, r.P) for run, r in enumerate(alone)], axis=0)
    assert montecarlo.MonteCarlo(result.seeds, {0: result.blocks[0]}, 1).nees == pytest.approx(expected, rel=1e-12)
    # an honest filter: e e' is P on average, and the NEES is n; both within 5 standard deviations of the mean
    assert np.abs(result.error / result.P - 1).max() < 5 * np.sqrt(2 / RUNS)
    assert np.abs(result.nees - 1).max() < 5 * np.sqrt(2 / RUNS)


def test_other_papers_and_other_assumptions():
    result = monte_carlo(theory, theory.Params(u=0), 100, np.random.default_rng(0))
    assert result.nees.shape == (10,) and abs(result.nees.mean() - 2) < 0.5
    wrong = monte_carlo(theory, theory.Params(u=0), 100, np.random.default_rng(0), assumed=theory.Params(u=0, R=1e-3))
    assert wrong.nees.mean() > 5
    assert monte_carlo(beetle, beetle.Params(), 20, np.random.default_rng(0)).P.shape == (40, 3, 3)


def test_a_mismatch_map_is_a_monte_carlo_in_every_cell():
    table = mismatch_map(gyro, PARAMS, ASSUMED, RUNS, np.random.default_rng(1))
    assert table.complete and table.rmse.shape == (1, 2, 3) and table.nees.shape == (2, 3)
    for i, sigma_w in enumerate(ASSUMED["sigma_w"]):
        for j, sigma_v in enumerate(ASSUMED["sigma_v"]):
            cell = study(assumed=replace(PARAMS, sigma_w=sigma_w, sigma_v=sigma_v))
            assert table.rmse[0, i, j] == pytest.approx(np.sqrt(np.mean(cell.rmse ** 2)), rel=1e-12)
            assert table.nees[i, j] == pytest.approx(cell.nees.mean(), rel=1e-12)
    assert table.rmse[0].argmin() == 4 and abs(table.nees[1, 1] - 1) < 0.05       # the truth is the best assumption


def test_the_same_bits_with_any_executor_in_any_order():
    alone = study()
    assert same(alone, study()) and same(alone, study(Shuffled()))
    assert not np.array_equal(alone.rmse, monte_carlo(gyro, PARAMS, RUNS, np.random.default_rng(2)).rmse)
    with ThreadPoolExecutor(2) as threads:
        assert same(alone, study(threads))
    for processes in (1, 2):
        with ProcessPoolExecutor(processes, multiprocessing.get_context("spawn")) as pool:
            assert same(alone, study(pool))
            table = mismatch_map(gyro, PARAMS, ASSUMED, RUNS, np.random.default_rng(1), pool)
    assert np.array_equal(table.rmse, mismatch_map(gyro, PARAMS, ASSUMED, RUNS, np.random.default_rng(1)).rmse)


@pytest.mark.parametrize("threads", [False, True])
def test_an_interrupted_study_keeps_what_is_done_and_goes_on(threads, monkeypatch, capsys):
    calls, block = [], montecarlo._block

    def interrupted(*arguments):
        calls.append(arguments)
        if len(calls) == 2:
            raise KeyboardInterrupt
        return block(*arguments)

    monkeypatch.setattr(montecarlo, "_block", interrupted)
    if threads:
        with ThreadPoolExecutor(1) as pool:
            part = study(pool)
    else:
        part = study()
    assert not part.complete and 1 <= len(part.blocks) < 3 and 0 < part.runs < RUNS and "/ 3" in capsys.readouterr().out
    assert np.isfinite(part.rmse).all() and np.isfinite(part.nees).all()
    before = len(calls)
    whole = monte_carlo(gyro, PARAMS, RUNS, None, resume=part)
    assert whole.complete and len(calls) - before == 3 - len(part.blocks) and same(whole, study())


def test_a_block_that_fails_is_done_again_and_a_real_error_is_told(monkeypatch):
    calls, block = [], montecarlo._block

    def unlucky(*arguments):
        calls.append(arguments)
        if len(calls) == 2:
            raise OSError("the worker died")
        return block(*arguments)

    monkeypatch.setattr(montecarlo, "_block", unlucky)
    with ThreadPoolExecutor(1) as pool:
        assert same(study(pool), study()) and len(calls) == 4 + 3
        with pytest.raises(ValueError, match="sigma_w = 0"):
            study(pool, assumed=replace(PARAMS, sigma_w=0))


def test_an_interrupted_map_is_NaN_where_nothing_is_finished():
    table = mismatch_map(gyro, PARAMS, ASSUMED, 100, np.random.default_rng(1))
    part = replace(table, blocks={1: table.blocks[1]})
    assert np.isnan(part.rmse[0, 0]).all() and np.array_equal(part.nees[1], table.nees[1])
    assert np.array_equal(mismatch_map(gyro, PARAMS, ASSUMED, 100, None, resume=part).rmse, table.rmse)


def test_a_pool_that_loses_a_process_keeps_what_is_done():
    alone, finished = monte_carlo(gyro, PARAMS, 40 * montecarlo.BLOCK, np.random.default_rng(1)), []
    with ProcessPoolExecutor(2, multiprocessing.get_context("spawn")) as pool:
        submit, processes = pool.submit, pool._processes

        def watched(*arguments):
            future = submit(*arguments)
            future.add_done_callback(kill)
            return future

        def kill(future):
            finished.append(future)
            if len(finished) == 3:
                os.kill(next(iter(processes)), signal.SIGKILL)

        pool.submit = watched
        with pytest.warns(UserWarning, match="resume=.* / Satu proses eksekutor mati"):
            part = monte_carlo(gyro, PARAMS, 40 * montecarlo.BLOCK, np.random.default_rng(1), pool)
    assert not part.complete and 3 <= len(part.blocks) < 40
    whole = monte_carlo(gyro, PARAMS, 40 * montecarlo.BLOCK, None, resume=part)
    assert whole.complete and same(alone, whole)


def test_a_dask_cluster_that_loses_a_worker_gives_the_same_bits():
    """Two worker processes, of which one is killed while the study runs."""
    distributed = pytest.importorskip("distributed")
    alone = monte_carlo(gyro, PARAMS, 60 * montecarlo.BLOCK, np.random.default_rng(1))
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster, \
            distributed.Client(cluster) as client:
        workers = client.run(os.getpid)
        assert len(set(workers.values())) == 2
        executor, finished = client.get_executor(), []
        submit = executor.submit

        def watched(*arguments):
            future = submit(*arguments)
            future.add_done_callback(finished.append)
            return future

        def kill():
            while len(finished) < 5:
                time.sleep(0.001)
            killed.append(len(finished))
            os.kill(next(iter(workers.values())), signal.SIGKILL)

        executor.submit, killed = watched, []
        threading.Thread(target=kill, daemon=True).start()
        together = monte_carlo(gyro, PARAMS, 60 * montecarlo.BLOCK, np.random.default_rng(1), executor)
        assert killed and killed[0] < 60 and together.complete and same(alone, together)
        with pytest.raises(ProcessLookupError):
            for _ in range(500):                # until its parent has noticed
                os.kill(next(iter(workers.values())), 0)
                time.sleep(0.01)
