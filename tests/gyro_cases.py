"""Chapter 3: the four cases of the paper, and a flight with its filter."""

from dataclasses import replace

import numpy as np

from kalman_lib import kalman_filter
from kalman_lib.papers import gyro

RUNS = 20_000

# figure: (sigma_w, sigma_v, largest error of the measurements, of the filter), as printed
PAPER = {4: (10, 10, 28, 6), 5: (10, 1, 3.2, 2.3), 6: (1, 10, 23, 2), 7: (1, 1, 3, 0.8)}


def case(figure, **changes):
    sigma_w, sigma_v, *_ = PAPER[figure]
    return replace(gyro.Params(), sigma_w=sigma_w, sigma_v=sigma_v, **changes)


def fly(p, seed=0, runs=None):
    flight = gyro.simulate(p, np.random.default_rng(seed), runs)
    return flight, kalman_filter(gyro.model(p), flight.z, flight.u)
