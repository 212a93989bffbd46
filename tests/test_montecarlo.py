"""Monte Carlo: right, the same to the last bit wherever it runs; a study knows what it is."""

import multiprocessing
import pickle
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from dataclasses import replace

import numpy as np
import pytest
from accident import ASSUMED, PARAMS, RUNS, both_languages, chart, same, study

from kalman_lib import kalman_filter, mismatch_map, monte_carlo, montecarlo, nees, rmse
from kalman_lib.papers import beetle, gyro, theory


@pytest.fixture(autouse=True)
def one_thread(monkeypatch):
    monkeypatch.setenv("OPENBLAS_NUM_THREADS", "1")


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


# --- the numbers ---------------------------------------------------------------------------------


def test_the_numbers_are_those_of_run_by_run():
    result = study()
    assert result.complete and result.runs == RUNS and result.rmse.shape == (1, RUNS)
    seed = np.random.default_rng(1).bit_generator.seed_seq.spawn(3)[0]
    flight = gyro.simulate(PARAMS, np.random.default_rng(seed), runs=montecarlo.BLOCK)
    alone = [
        kalman_filter(gyro.model(PARAMS), flight.z[..., run], flight.u)
        for run in range(montecarlo.BLOCK)
    ]
    for run in (0, 7):
        expected = rmse(flight.x[..., run], alone[run].x)
        assert result.rmse[:, run] == pytest.approx(expected, rel=1e-12)
    expected = np.mean([nees(flight.x[..., run], r.x, r.P) for run, r in enumerate(alone)], axis=0)
    first = replace(result, blocks={0: result.blocks[0]})
    assert first.nees == pytest.approx(expected, rel=1e-12)
    # an honest filter: e e' is P on average, and the NEES is n; both within 5 standard deviations
    assert np.abs(result.error / result.P - 1).max() < 5 * np.sqrt(2 / RUNS)
    assert np.abs(result.nees - 1).max() < 5 * np.sqrt(2 / RUNS)


def test_other_papers_and_other_assumptions():
    truth = theory.Params(u=0)
    result = monte_carlo(theory, truth, 100, np.random.default_rng(0))
    assert result.nees.shape == (10,) and abs(result.nees.mean() - 2) < 0.5
    assumed = theory.Params(u=0, R=1e-3)
    wrong = monte_carlo(theory, truth, 100, np.random.default_rng(0), assumed=assumed)
    assert wrong.nees.mean() > 5
    result = monte_carlo(beetle, beetle.Params(), 20, np.random.default_rng(0))
    assert result.P.shape == (40, 3, 3)


def test_a_mismatch_map_is_a_monte_carlo_in_every_cell():
    table = chart(rng=np.random.default_rng(1))
    assert table.complete and table.rmse.shape == (1, 2, 3) and table.nees.shape == (2, 3)
    for i, sigma_w in enumerate(ASSUMED["sigma_w"]):
        for j, sigma_v in enumerate(ASSUMED["sigma_v"]):
            cell = study(assumed=replace(PARAMS, sigma_w=sigma_w, sigma_v=sigma_v))
            expected = np.sqrt(np.mean(cell.rmse**2))
            assert table.rmse[0, i, j] == pytest.approx(expected, rel=1e-12)
            assert table.nees[i, j] == pytest.approx(cell.nees.mean(), rel=1e-12)
    # the truth is the best assumption
    assert table.rmse[0].argmin() == 4 and abs(table.nees[1, 1] - 1) < 0.05


def test_the_same_bits_with_any_executor_in_any_order():
    alone, table = study(), chart(rng=np.random.default_rng(1))
    assert same(alone, study()) and same(alone, study(Shuffled()))
    other = monte_carlo(gyro, PARAMS, RUNS, np.random.default_rng(2))
    assert not np.array_equal(alone.rmse, other.rmse)
    with ThreadPoolExecutor(2) as threads:
        assert same(alone, study(threads))
    for processes in (1, 2):
        with ProcessPoolExecutor(processes, multiprocessing.get_context("spawn")) as pool:
            assert same(alone, study(pool))
            assert same(table, chart(rng=np.random.default_rng(1), executor=pool))


def test_drawing_numbers_leaves_the_seeds_as_they_are_and_spawning_does_not():
    rng = np.random.default_rng(1)
    rng.normal(size=1000)
    assert same(study(), monte_carlo(gyro, PARAMS, RUNS, rng))
    assert not np.array_equal(study().rmse, monte_carlo(gyro, PARAMS, RUNS, rng).rmse)


# --- a study knows what it is, resumes only itself, and grows ------------------------------------


def test_a_study_knows_what_it_is_and_can_be_stored():
    rng = np.random.default_rng(1)
    assumed = replace(PARAMS, sigma_v=5)
    result = pickle.loads(pickle.dumps(monte_carlo(gyro, PARAMS, RUNS, rng, assumed=assumed)))
    assert (result.paper, result.params, result.assumed) == (gyro.__name__, PARAMS, assumed)
    assert (result.planned, result.seed.entropy, result.seed.spawn_key) == (RUNS, 1, ())
    assert study().assumed == PARAMS
    table = pickle.loads(pickle.dumps(chart(100, np.random.default_rng(1))))
    assert table.planned == 100 and list(table.assumed) == list(ASSUMED)
    assert "array" not in repr(study())


def test_a_study_does_not_change_when_what_it_was_given_does():
    values = np.array([5.0, 10.0])
    assumed = {"sigma_w": values, "sigma_v": [10]}
    table = mismatch_map(gyro, PARAMS, assumed, 100, np.random.default_rng(1))
    values[:] = 0
    assumed.clear()
    assert table.assumed["sigma_w"].tolist() == [5, 10] and table.nees.shape == (2, 1)


@pytest.mark.parametrize("before", [300, 500, 1000, 1200])
@pytest.mark.parametrize("after", [1200, 1500, 2300])
def test_more_runs_extend_a_study_to_the_bits_of_a_larger_one(before, after):
    fresh = monte_carlo(gyro, PARAMS, after, np.random.default_rng(1))
    small = monte_carlo(gyro, PARAMS, before, np.random.default_rng(1))
    grown = monte_carlo(gyro, PARAMS, after, resume=pickle.loads(pickle.dumps(small)))
    assert grown.complete and grown.runs == grown.planned == after and same(grown, fresh)
    assert small.planned == before and small.complete  # it stays what it was


def test_an_extended_study_computes_only_what_is_new(monkeypatch):
    small, sizes, simulate = study(), [], gyro.simulate

    def counted(p, rng, runs=None):
        sizes.append(runs)
        return simulate(p, rng, runs=runs)

    monkeypatch.setattr(gyro, "simulate", counted)
    monte_carlo(gyro, PARAMS, 1800, resume=small)
    assert sizes == [500, 300]  # the third block had 200 runs; the first two are kept


def test_a_map_grows_too():
    fresh = chart(1300, np.random.default_rng(1))
    for before in (600, 1000, 1300):
        small = chart(before, np.random.default_rng(1))
        assert same(chart(1300, resume=small), fresh)


def test_a_study_from_a_used_generator_grows_as_a_fresh_one_would():
    rng, twin = np.random.default_rng(1).spawn(1)[0], np.random.default_rng(1).spawn(1)[0]
    for generator in (rng, twin):
        generator.spawn(2)
    fresh = monte_carlo(gyro, PARAMS, 2000, twin)
    small = monte_carlo(gyro, PARAMS, 700, rng)
    assert rng.bit_generator.seed_seq.n_children_spawned == 2 + 2
    assert same(monte_carlo(gyro, PARAMS, 2000, rng, resume=small), fresh)
    assert rng.bit_generator.seed_seq.n_children_spawned == 2 + 2  # not used


@pytest.mark.parametrize(
    "changed, told",
    [
        (dict(params=replace(PARAMS, sigma_v=100)), "params.sigma_v"),
        (dict(assumed=replace(PARAMS, sigma_w=3)), "assumed.sigma_w"),
        (dict(paper=theory, params=theory.Params()), "paper"),
        (dict(runs=500), "runs = 500"),
    ],
)
def test_a_study_resumes_only_itself(changed, told):
    call = dict(paper=gyro, params=PARAMS, runs=RUNS, resume=study()) | changed
    with pytest.raises(ValueError, match=told) as error:
        monte_carlo(**call)
    assert both_languages(error)


@pytest.mark.parametrize(
    "changed, told",
    [
        (dict(params=replace(PARAMS, sigma_v=100)), "params.sigma_v"),
        (dict(assumed={"sigma_w": [5, 11], "sigma_v": [1, 10, 100]}), "assumed.sigma_w"),
        (dict(assumed={"sigma_w": [5, 10], "sigma_v": [1, 10]}), "assumed.sigma_v"),
        (dict(assumed=dict(reversed(ASSUMED.items()))), "assumed is"),
        (dict(assumed={"sigma_w": [5, 10], "u": [1, 10, 100]}), "assumed is"),
        (dict(runs=99), "runs = 99"),
    ],
)
def test_a_map_resumes_only_itself(changed, told):
    table = chart(100, np.random.default_rng(1))
    call = dict(paper=gyro, params=PARAMS, assumed=ASSUMED, runs=100, resume=table) | changed
    with pytest.raises(ValueError, match=told) as error:
        mismatch_map(**call)
    assert both_languages(error)


def test_a_map_is_no_study_and_a_study_no_map():
    with pytest.raises(ValueError, match="a MismatchMap") as error:
        chart(resume=study())
    assert both_languages(error)
    for wrong in (chart(100, np.random.default_rng(1)), {"blocks": {}}):
        with pytest.raises(ValueError, match="a MonteCarlo") as error:
            monte_carlo(gyro, PARAMS, RUNS, resume=wrong)
        assert both_languages(error)
