"""A model with two sensors, and what an error must look like."""

from kalman_lib import (
    LinearModel,
)


def bilingual(error):
    """One sentence in each language, separated by a slash."""
    english, indonesian = str(error.value).split(" / ")
    return english.endswith(".") and indonesian.endswith(".") and english != indonesian


def two_sensors(**changes):
    values = dict(
        F=[[1, 0.1], [0, 0.95]],
        H=[[1, 0], [1, 1]],
        Q=[[0.02, 0.01], [0.01, 0.05]],
        R=[[0.5, 0.2], [0.2, 0.8]],
        x0=[1, 0],
        P0=[[2, 0.3], [0.3, 1]],
    )
    return LinearModel(**(values | changes))
