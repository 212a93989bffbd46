"""Two small models, and what an error must look like."""

import numpy as np

from kalman_lib import (
    LinearModel,
)

ONE = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1, B=1)


TWO = LinearModel(F=1, H=[[1], [2]], Q=0.01, R=np.eye(2), x0=0, P0=1)


NAN = float("nan")


def one_sentence_in_each_language(error):
    english, slash, indonesian = str(error.value).partition(" / ")
    assert slash and english.endswith(".") and indonesian.endswith(".")
    words = set(indonesian.replace(",", " ").replace(";", " ").split())
    assert not words & {"or", "and", "is", "has", "must", "expected", "the", "holds", "shape"}, (
        indonesian
    )
