"""The numbers in the answers of book/bekal.md, computed here from their questions.

{idea: {number as the answer prints it, with a decimal point: the computed value}}
"""

import math

import numpy as np
from scipy import stats

F = np.array([
    [1, 2],
    [0, 1],
])
MANY = 100_000  # readings
METRES = 1000  # in a kilometre
BRAKE = np.diag([1, 0.5])


def entries(matrix):
    """The entries of a matrix as an answer prints them."""
    return {f"{value:g}": value for value in np.ravel(matrix)}


def scatter():
    weights = np.array([204, 198, 200, 202, 201])  # g
    more = np.append(weights, 207)
    doubled = 2 * weights
    velocity, distance = np.array([4, 4, 6, 6]), np.array([43, 49, 51, 57]) / METRES
    load, speed = np.array([-1, -1, 1, 1]), np.array([3, 1, -1, -3])
    correlation = np.corrcoef(velocity, distance)[0, 1]
    return {
        "mean": {
            "1005": weights.sum(),
            "1212": more.sum(),
            "202": more.mean(),
            "1": more.mean() - weights.mean(),
            "6": 207 - weights.mean(),
        },
        "variance": {"16": doubled.var(), "4": doubled.std()},
        "rmse": {"25": 3**2 + 4**2, "5": math.hypot(3, 4)},
        "covariance": {
            "-3": (load * speed)[0],
            "-8": (load * speed).sum(),
            "-2": np.cov(load, speed, bias=True)[0, 1],
        },
        "correlation": {
            "0.004": np.cov(velocity, distance, bias=True)[0, 1],
            "0.8": correlation,
            "1000": METRES,
        },
        "white-noise": {"0.2": 2 / math.sqrt(100)},
    }


def chance():
    sigma = math.sqrt(0.25)
    rain, thunder = np.array([0.5, 0.5]), np.array([0.9, 0.3])
    product = rain * thunder
    times = 1 / stats.chi2.sf(6.25, 1)
    return {
        "normal": {
            "197": 201 - 2 * 2,
            "205": 201 + 2 * 2,
            "8": 209 - 201,
            "4": (209 - 201) / 2,
            "6": MANY * 2 * stats.norm.sf(4),
            "100000": MANY,
        },
        "noise": {"0.5": sigma, "1": 2 * sigma, "2": 1 / sigma},
        "chi-square": {"9": 1 + 4 + 4, "3": 100 * stats.chi2.sf(9, 3)},
        "nees": {"6.25": 0.5**2 / 0.04, "80": round(times, -1)},
        "conditional": {"0.8": 16 / 20},
        "bayes": {
            "0.9": 90 / 100,
            "0.3": 30 / 100,
            "0.45": product[0],
            "0.15": product[1],
            "0.6": product.sum(),
            "0.75": product[0] / product.sum(),
        },
        "likelihood": {
            "0.1": 1 - 0.9,
            "0.0729": 0.9**3 * 0.1,
            "0.0625": 0.5**3 * 0.5,
            "-2.62": math.log(0.9**3 * 0.1),
            "-2.77": math.log(0.5**3 * 0.5),
        },
    }


def matrices():
    end = np.array([3, 4]) + [2, -1]
    moved = F @ [16, 3]
    e = np.array([1, -2])
    P, step = np.diag([4, 1]), np.array([[1, 1], [0, 1]])
    bills = np.array([[2, 1], [4, 2]])
    stretch = np.array([[2, 1], [1, 2]])
    fourth = np.linalg.matrix_power(stretch, 4)
    return {
        "vector": {
            "5": end[0],
            "3": end[1],
            "34": end @ end,
            "5.83": np.linalg.norm(end),
        },
        "matrix": {"22": moved[0], "3": moved[1]},
        "product": entries(F @ BRAKE) | entries(BRAKE @ F),
        "transpose": {"5": e @ e, **entries(np.outer(e, e))},
        "covariance-matrix": entries(step @ P) | entries(step @ P @ step.T),
        "inverse": {
            **entries(bills),
            "0": np.linalg.det(bills),
            "1": np.linalg.matrix_rank(bills),
        },
        "eigenvalue": {"81": (fourth @ [1, 1])[0], "1": (fourth @ [1, -1])[0]},
    }


def slopes():
    exact = 60 * math.exp(-0.5)
    return {
        "derivative": {
            "9.61": 3.1**2,
            "8.41": 2.9**2,
            "0.2": 3.1 - 2.9,
            "6": (3.1**2 - 2.9**2) / 0.2,
            "6.1": (3.1**2 - 3**2) / 0.1,
        },
        "taylor": {
            "2.5": 5 * 0.5,
            "-0.25": -2 * 0.5**2 / 2,
            "2.25": 5 * 0.5 - 2 * 0.5**2 / 2,
        },
        "discretisation": {
            "0.5": 0.1 * 5,
            "36.4": exact,
            "30": 60 * (1 - 0.1 * 5),
            "6.4": exact - 30,
        },
        "jacobian": {
            "-0.1": 3 / 5 * 0.1 - 4 / 5 * 0.2,
            "3.1": 3 + 0.1,
            "3.8": 4 - 0.2,
            "-0.096": math.hypot(3.1, 3.8) - 5,
        },
    }


def curves():
    p = 0.5 + 0.5j
    curvature = 30 / 0.75**2 + 10 / 0.25**2
    return {
        "hessian": {
            "-213": -curvature,
            "0.0685": 1 / math.sqrt(curvature),
            "10": 40 / 4,
            "3.2": math.sqrt(40 / 4),
        },
        "complex": {
            "0.5": (p**2).imag,
            "0.25": abs(p**4),
            "360": math.degrees(2 * math.pi),
            "8": 2 * math.pi / math.atan2(p.imag, p.real),
            "0.0625": abs(p**8),
        },
    }


def answers():
    return scatter() | chance() | matrices() | slopes() | curves()
