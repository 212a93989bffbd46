"""What monte_carlo and mismatch_map refuse, each in one sentence in both languages."""

from concurrent.futures import ThreadPoolExecutor
from types import ModuleType

import numpy as np
import pytest
from accident import ASSUMED, PARAMS, both_languages, study

from kalman_lib import mismatch_map, monte_carlo
from kalman_lib.papers import gyro, theory


class Unfinished(ModuleType):
    Params = gyro.Params
    model = staticmethod(gyro.model)


@pytest.mark.parametrize(
    "wrong, told",
    [
        (dict(runs=0), "runs = 0:"),
        (dict(runs=-5), "runs = -5:"),
        (dict(runs=2.5), "runs = 2.5:"),
        (dict(runs=True), "runs = True:"),
        (dict(runs="10"), "runs = '10':"),
        (dict(runs=None), "runs = None:"),
        (dict(runs=np.array([3])), "runs = array"),
        (dict(rng=1), "rng = 1:"),
        (dict(rng=None), "rng = None:"),
        (dict(rng=np.random.RandomState(1)), "rng = RandomState"),
        (dict(rng=np.random.default_rng), "rng = <"),
        (dict(rng=np.random.Generator(np.random.RandomState(1)._bit_generator)), "rng = Generator"),
        (dict(executor=2), "executor = 2:"),
        (dict(executor=ThreadPoolExecutor), "executor = <class"),
        (dict(params=theory.Params()), "params = Params"),
        (dict(params=None), "params = None:"),
        (dict(params=gyro.Params), "params = <class"),
        (dict(paper="gyro"), "paper = 'gyro':"),
        (dict(paper=Unfinished("unfinished")), "without simulate"),
        (dict(paper=np), "without Params, model, simulate"),
    ],
)
def test_bad_arguments_are_refused_in_a_sentence(wrong, told):
    for function, assumed in ((monte_carlo, None), (mismatch_map, ASSUMED)):
        good = dict(paper=gyro, params=PARAMS, runs=10, rng=np.random.default_rng(1))
        with pytest.raises(ValueError, match=told) as error:
            function(**good | wrong, assumed=assumed)
        assert both_languages(error)


@pytest.mark.parametrize("wrong", [ASSUMED, 3, theory.Params(), gyro.Params])
def test_a_study_refuses_other_assumptions(wrong):
    with pytest.raises(ValueError, match="assumed = ") as error:
        study(assumed=wrong)
    assert both_languages(error)


@pytest.mark.parametrize(
    "wrong, told",
    [
        (None, "assumed = None:"),
        (PARAMS, "assumed = Params"),
        ([("sigma_w", [1])], "assumed = "),
        ({}, "assumed = {}:"),
        ({"sigma_w": [1]}, "two"),
        (ASSUMED | {"u": [1]}, "two"),
        ({"sigma_w": [1], "sigma_q": [1]}, "sigma_q"),
        ({"sigma_w": [1], 3: [1]}, "two of duration"),
        ({"sigma_w": [1], "sigma_v": []}, "assumed.sigma_v = "),
        ({"sigma_w": 1, "sigma_v": [1]}, "assumed.sigma_w = 1:"),
        ({"sigma_w": [[1]], "sigma_v": [1]}, "assumed.sigma_w = "),
        ({"sigma_w": ["1"], "sigma_v": [1]}, "assumed.sigma_w = "),
        ({"sigma_w": [[1], [1, 2]], "sigma_v": [1]}, "assumed.sigma_w = "),
        ({"sigma_w": "12", "sigma_v": [1]}, "assumed.sigma_w = "),
    ],
)
def test_a_map_refuses_other_axes(wrong, told):
    with pytest.raises(ValueError, match=told) as error:
        mismatch_map(gyro, PARAMS, wrong, 10, np.random.default_rng(1))
    assert both_languages(error)


def test_numpy_integers_are_whole_numbers():
    assert monte_carlo(gyro, PARAMS, np.int64(10), np.random.default_rng(1)).runs == 10


def test_the_client_of_dask_is_no_executor_and_the_sentence_says_what_is():
    class Client:
        submit = get_executor = print

    with pytest.raises(ValueError, match="get_executor") as error:
        study(Client())
    assert both_languages(error)
