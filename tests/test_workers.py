"""A study that is stopped, at whatever moment and by whatever, keeps what is done and goes on."""

import signal
import warnings
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor
from dataclasses import replace

import accident
import numpy as np
import pytest
from accident import (
    MANY,
    PARAMS,
    RUNS,
    both_languages,
    chart,
    press,
    quiet,
    same,
    study,
    with_accident,
)

from kalman_lib import mismatch_map, monte_carlo, montecarlo
from kalman_lib.papers import gyro

pytestmark = pytest.mark.usefixtures("usual_ctrl_c")


class Scripted(Executor):
    """Does every second task at once, lets the others wait; at `trouble` something happens."""

    def __init__(self, trouble, happens):
        self.futures, self.trouble, self.happens = [], trouble, happens

    def submit(self, function, *arguments):
        if len(self.futures) == self.trouble:
            self.happens()
        self.futures.append(future := Future())
        if len(self.futures) % 2:
            future.set_result(function(*arguments))
        return future


def break_down():
    raise BrokenExecutor("it broke")


# --- stopped, and what remains -------------------------------------------------------------------


@pytest.mark.parametrize("threads", [False, True])
def test_an_interrupted_study_keeps_what_is_done_and_goes_on(threads, flag, capsys):
    if threads:
        with ThreadPoolExecutor(1) as pool:
            part = with_accident("Ctrl+C in a worker", flag, pool)
    else:
        part = with_accident("Ctrl+C", flag)
        assert sorted(part.blocks) == [0, 1]
    assert not part.complete and {0, 1} <= set(part.blocks) and 2 not in part.blocks
    assert f"{len(part.blocks)} / 8 (resume=" in capsys.readouterr().out
    assert part.runs == part.rmse.shape[1] == len(part.blocks) * montecarlo.BLOCK
    flag.unlink()
    whole = with_accident("Ctrl+C in a worker" if threads else "Ctrl+C", flag, resume=part)
    assert whole.complete and same(whole, quiet())
    assert all(whole.blocks[i] is part.blocks[i] for i in part.blocks)


def test_an_interrupted_study_may_grow_too(flag):
    part = with_accident("Ctrl+C", flag)
    flag.unlink()
    grown = monte_carlo(accident, part.params, MANY + 100, resume=part)
    fresh = monte_carlo(accident, accident.Params(), MANY + 100, np.random.default_rng(1))
    assert grown.complete and same(grown, fresh)


@pytest.mark.parametrize("trouble", range(8))
def test_ctrl_c_while_tasks_are_handed_out(trouble, capsys):
    pool = Scripted(trouble, press)
    part = monte_carlo(accident, accident.Params(), MANY, np.random.default_rng(1), pool)
    assert not part.complete and sorted(part.blocks) == list(range(0, trouble, 2))
    assert len(pool.futures) == trouble  # nothing more was handed out
    assert all(future.cancelled() for future in pool.futures[1::2])
    assert f"{len(part.blocks)} / 8 (resume=" in capsys.readouterr().out
    assert same(monte_carlo(accident, accident.Params(), MANY, resume=part), quiet())


@pytest.mark.parametrize("trouble", range(1, 8))
def test_a_pool_that_breaks_while_tasks_are_handed_out(trouble):
    pool = Scripted(trouble, break_down)
    with pytest.warns(UserWarning, match=r"resume=.* / .* eksekutor mati"):
        part = monte_carlo(accident, accident.Params(), MANY, np.random.default_rng(1), pool)
    assert not part.complete and sorted(part.blocks) == list(range(0, trouble, 2))
    assert all(future.cancelled() for future in pool.futures[1::2])
    assert same(monte_carlo(accident, accident.Params(), MANY, resume=part), quiet())


def test_a_pool_that_breaks_before_anything_is_done_says_so():
    with pytest.raises(BrokenExecutor, match="it broke"):
        study(Scripted(0, break_down))
    part = replace(study(), blocks={})
    with pytest.raises(BrokenExecutor, match="it broke"):
        monte_carlo(gyro, PARAMS, RUNS, executor=Scripted(0, break_down), resume=part)


def test_a_broken_pool_takes_nothing_from_a_study_that_is_resumed():
    whole = study()
    part = replace(whole, blocks={1: whole.blocks[1]})
    with pytest.warns(UserWarning, match="1 of 3"):
        still = monte_carlo(gyro, PARAMS, RUNS, executor=Scripted(0, break_down), resume=part)
    assert list(still.blocks) == [1]


def test_ctrl_c_twice_loses_nothing(capsys):
    """An impatient reader presses again while the finished blocks are gathered."""

    class Impatient(Scripted):
        def submit(self, function, *arguments):
            future = super().submit(function, *arguments)
            cancel = future.cancel

            def slowly():
                press()
                press()
                return cancel()

            future.cancel = slowly
            return future

    before = signal.getsignal(signal.SIGINT)
    part = monte_carlo(gyro, PARAMS, 6 * 500, np.random.default_rng(1), Impatient(4, press))
    assert sorted(part.blocks) == [0, 2] and "2 / 6" in capsys.readouterr().out
    assert signal.getsignal(signal.SIGINT) is before
    with pytest.raises(KeyboardInterrupt):
        press()


def test_ctrl_c_when_the_last_block_has_come_back(capsys):
    class Late(Future):
        def result(self):
            if not late.pop("pressed", True):
                press()
            return super().result()

    class Prompt(Executor):
        def submit(self, function, *arguments):
            future = Late()
            future.set_result(function(*arguments))
            return future

    late = {"pressed": False}
    whole = study(Prompt())
    assert not late and "3 / 3" in capsys.readouterr().out
    assert whole.complete and same(whole, study())  # all had finished, so all count


def test_a_meaning_that_a_reader_gave_to_ctrl_c_stays(flag):
    pressed = []
    before = signal.signal(signal.SIGINT, lambda *signal: pressed.append(signal))
    try:
        assert with_accident("Ctrl+C", flag, block=-1).complete and len(pressed) == 8
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_interrupted_map_is_NaN_where_nothing_is_finished():
    table = chart(100, np.random.default_rng(1))
    part = replace(table, blocks={1: table.blocks[1]})
    assert np.isnan(part.rmse[0, 0]).all() and np.array_equal(part.nees[1], table.nees[1])
    assert same(chart(100, resume=part), table)
    empty = replace(table, blocks={})
    assert empty.rmse.shape == (1, 2, 3) and empty.nees.shape == (2, 3)
    assert np.isnan(empty.rmse).all() and np.isnan(empty.nees).all()
    assert same(chart(100, resume=empty), table)


@pytest.mark.parametrize("name", ["rmse", "nees", "error", "P"])
def test_a_study_with_nothing_finished_says_so(name):
    empty = replace(study(), blocks={})
    assert empty.runs == 0 and not empty.complete
    with pytest.raises(ValueError, match="resume=") as error:
        getattr(empty, name)
    assert both_languages(error)


# --- blocks that fail ----------------------------------------------------------------------------


@pytest.mark.parametrize("threads", [False, True])
def test_one_block_that_fails_costs_no_other(threads, flag):
    with ThreadPoolExecutor(2) as pool:
        with pytest.warns(UserWarning, match=r": 2 \(.*MemoryError: no room.* / .*: 2 \(") as told:
            part = with_accident("fail", flag, pool if threads else None)
        assert told[0].filename == accident.__file__ and len(told) == 1
        assert not part.complete and sorted(part.blocks) == [0, 1, 3, 4, 5, 6, 7]
        with pytest.warns(UserWarning, match="MemoryError"):  # still the same trouble
            part = with_accident("fail", flag, pool if threads else None, resume=part)
        assert len(part.blocks) == 7
    flag.unlink()
    assert same(with_accident("fail", flag, resume=part), quiet())


def test_a_failure_is_told_in_the_language_of_the_sentence(flag, monkeypatch):
    def fail(p):
        raise ValueError("wrong. / salah.")

    monkeypatch.setitem(accident.ACCIDENTS, "fail", fail)
    with pytest.warns(UserWarning) as told:
        with_accident("fail", flag)
    english, indonesian = str(told[0].message).split(" / ")
    assert "wrong." in english and "salah." in indonesian


@pytest.mark.parametrize("threads", [False, True])
def test_if_every_block_fails_the_error_is_raised(threads, flag):
    with ThreadPoolExecutor(2) as pool, pytest.raises(MemoryError, match="no room"):
        with_accident("fail", flag, pool if threads else None, block=-1)


def test_a_block_that_fails_is_done_again_with_an_executor(flag):
    with ThreadPoolExecutor(1) as pool, warnings.catch_warnings():
        warnings.simplefilter("error")
        assert same(with_accident("fail once", flag, pool), quiet()) and not flag.exists()
        with pytest.raises(ValueError, match="sigma_w = 0"):
            study(pool, assumed=replace(PARAMS, sigma_w=0))


def test_an_executor_that_was_shut_down_says_so():
    pool = ThreadPoolExecutor(1)
    pool.shutdown()
    with pytest.raises(RuntimeError, match="after shutdown"):
        study(pool)


def test_an_assumption_that_the_model_refuses_is_told_before_anything_is_done():
    rng = np.random.default_rng(1)
    wrong = {"sigma_w": [5], "sigma_v": [1, 0]}
    with pytest.raises(ValueError, match="sigma_v = 0"):
        mismatch_map(gyro, PARAMS, wrong, 100, rng, Scripted(0, press))
    assert rng.bit_generator.seed_seq.n_children_spawned == 0
