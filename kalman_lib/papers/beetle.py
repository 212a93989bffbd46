"""Chapter 5: a beetle walks away from a sink, the extended Kalman filter.

Source: the lecture notes, part e.

State [d, theta, v]: distance from the sink's edge (cm), direction of the walk (rad, 0 = straight
away), speed (cm/s). With the bearing there is a fourth, l (cm), how far the beetle has walked along
the edge.
"""

from dataclasses import dataclass, replace

import numpy as np

from ..models import LinearModel, NonlinearModel
from ..simulate import simulate as simulate_model
from . import check, param

# The only numbers that the source prints: R of its Figures 3, 4, 5 and 6
PRINTED = {"R": "0.05 0.001 0.1 0.08"}
PRINTED_R = tuple(float(word) for word in PRINTED["R"].split())


@dataclass(frozen=True)
class Params:
    """Only R is the source's; everything else is our choice, for the source prints nothing else."""

    # fmt: off
    R: float = param(
        0.05, min=1e-4, max=10, step=0.05, unit="cm²", log=True,
        id="varians derau pengukuran menurut filter",
        en="measurement-noise variance the filter believes in",
    )
    R_true: float = param(
        0.05, min=1e-4, max=10, step=0.05, unit="cm²", log=True,
        id="varians derau sensor yang sebenarnya", en="true variance of the sensor's noise",
    )
    dt: float = param(
        0.5, min=0.05, max=2, step=0.05, unit="s",
        id="langkah waktu", en="time step",
    )
    theta: float = param(
        0.64, min=-1.5, max=1.5, step=0.02, unit="rad",
        id="arah sebenarnya", en="true direction",
    )
    v: float = param(
        2.5, min=0.1, max=5, step=0.1, unit="cm/s",
        id="laju sebenarnya", en="true speed",
    )
    theta0: float = param(
        0.64, min=-1.5, max=1.5, step=0.02, unit="rad",
        id="arah menurut tebakan awal", en="direction, initial guess",
    )
    v0: float = param(
        2.5, min=0.1, max=5, step=0.1, unit="cm/s",
        id="laju menurut tebakan awal", en="speed, initial guess",
    )
    d0: float = param(
        10, min=1, max=100, step=1, unit="cm",
        id="jarak awal", en="initial distance",
    )
    sigma_d: float = param(
        1, min=0.01, max=10, step=0.01, unit="cm",
        id="simpangan baku jarak awal", en="standard deviation of the initial distance",
    )
    sigma_theta: float = param(
        0.2, min=0.01, max=1, step=0.01, unit="rad",
        id="simpangan baku arah awal", en="standard deviation of the initial direction",
    )
    sigma_v: float = param(
        0.3, min=0.01, max=2, step=0.01, unit="cm/s",
        id="simpangan baku laju awal", en="standard deviation of the initial speed",
    )
    Q_theta: float = param(
        0, min=0, max=0.1, step=0.001, unit="rad²",
        id="varians derau proses arah, per langkah",
        en="process-noise variance of the direction, per step",
    )
    Q_v: float = param(
        0, min=0, max=0.1, step=0.001, unit="cm²/s²",
        id="varians derau proses laju, per langkah",
        en="process-noise variance of the speed, per step",
    )
    R_bearing: float = param(
        4e-4, min=1e-6, max=0.1, step=0.05, unit="rad²", log=True,
        id="varians derau sudut pandang", en="variance of the noise of the bearing",
    )
    # fmt: on


def f(x, dt):
    """The beetle one step later: d + dt v cos(theta); direction and speed stay."""
    d, theta, v = x
    return np.array([d + dt * v * np.cos(theta), theta, v])


def F(x, dt):
    """The Jacobian of f by x."""
    d, theta, v = x
    rows = [
        [1, -dt * v * np.sin(theta), dt * np.cos(theta)],
        [0, 1, 0],
        [0, 0, 1],
    ]
    has_many_runs = np.ndim(theta) > 0  # then each entry is a number or (runs,)
    return rows if has_many_runs else np.array(rows)


def model(p):
    """The source's model: state [d, theta, v], measured: d."""
    check(p)
    H = np.array([[1.0, 0, 0]])
    return NonlinearModel(
        f=lambda x, u: f(x, p.dt),
        F=lambda x, u: F(x, p.dt),
        h=lambda x, u=None: H @ x,
        H=lambda x, u=None: H,
        Q=np.diag([0, p.Q_theta, p.Q_v]),
        R=p.R,
        x0=[p.d0, p.theta0, p.v0],
        P0=np.diag([p.sigma_d, p.sigma_theta, p.sigma_v]) ** 2,
        many_runs=True,
    )


def linear_model(p):
    """The exactly linear model of what d can tell: state [d, s], measured: d.

    s = v cos(theta) in cm/s; its mean and variance are those for Gaussian v and theta, in closed
    form. Q is 0: only for Q_theta = Q_v = 0 is s constant.
    """
    check(p)
    if p.Q_theta or p.Q_v:
        raise ValueError(
            "linear_model needs Q_theta = Q_v = 0: s = v cos(theta) must be constant. / "
            "linear_model memerlukan Q_theta = Q_v = 0: s = v cos(theta) harus tetap."
        )
    mean = p.v0 * np.cos(p.theta0) * np.exp(-(p.sigma_theta**2) / 2)
    mean_v_square = p.v0**2 + p.sigma_v**2
    mean_cos_square = (1 + np.cos(2 * p.theta0) * np.exp(-2 * p.sigma_theta**2)) / 2
    square = mean_v_square * mean_cos_square
    return LinearModel(
        F=[[1, p.dt], [0, 1]],
        H=[[1, 0]],
        Q=np.zeros((2, 2)),
        R=p.R,
        x0=[p.d0, mean],
        P0=np.diag([p.sigma_d**2, square - mean**2]),
    )


def exact_posterior(p, z):
    """Mean (2,) and covariance (2, 2) of theta and v after the distances z (T,), not linearised.

    The record tells s with some variance, and nothing else of theta and v. For a given theta the
    rest is linear in v; theta itself runs over a grid. Q_theta = Q_v = 0.
    """
    s, R_s = _slope(p, np.ravel(z))
    theta = np.linspace(p.theta0 - 7 * p.sigma_theta, p.theta0 + 7 * p.sigma_theta, 20_001)
    c = np.cos(theta)
    S = c**2 * p.sigma_v**2 + R_s
    K = c * p.sigma_v**2 / S
    y = s - p.v0 * c
    v = p.v0 + K * y
    log_weight = -(((theta - p.theta0) / p.sigma_theta) ** 2 + y**2 / S + np.log(S)) / 2
    weight = np.exp(log_weight - log_weight.max())
    points = np.array([theta, v])
    covariance = np.cov(points, aweights=weight, bias=True)
    covariance[1, 1] += np.average(p.sigma_v**2 * (1 - K * c), weights=weight)
    return np.average(points, axis=1, weights=weight), covariance


def _slope(p, z):
    """s and its variance from the distances z (T,) alone: weighted least squares, d0 uncertain."""
    t = p.dt * np.arange(1, len(z) + 1)
    common = p.sigma_d**2 / (p.R + len(z) * p.sigma_d**2)  # what all of z share
    weight = (t - common * t.sum()) / p.R
    return weight @ (z - p.d0) / (weight @ t), 1 / (weight @ t)


def bearing_model(p):
    """A second sensor: state [d, theta, v, l], measured: d and the bearing atan2(l, d), rad.

    The sensor stands at the edge where l = 0. For d > 0 the bearing stays within +-pi/2 and need
    not be wrapped.
    """
    check(p)

    def walk(x, u):
        return np.append(f(x[:3], p.dt), x[3] + p.dt * x[2] * np.sin(x[1]))

    def walk_jacobian(x, u):
        J = np.eye(4)
        J[:3, :3] = F(x[:3], p.dt)
        J[3, 1:3] = p.dt * x[2] * np.cos(x[1]), p.dt * np.sin(x[1])
        return J

    def h(x, u=None):
        return np.array([x[0], np.arctan2(x[3], x[0])])

    def H(x, u=None):
        d, l = x[0], x[3]
        r2 = d**2 + l**2
        return np.array([
            [1, 0, 0, 0],
            [-l / r2, 0, 0, d / r2],
        ])

    return NonlinearModel(
        f=walk,
        F=walk_jacobian,
        h=h,
        H=H,
        Q=np.diag([0, p.Q_theta, p.Q_v, 0]),
        R=np.diag([p.R, p.R_bearing]),
        x0=[p.d0, p.theta0, p.v0, 0],
        P0=np.diag([p.sigma_d, p.sigma_theta, p.sigma_v, p.sigma_d]) ** 2,
    )


def simulate(p, rng, steps=40, bearing=False):
    """A SYNTHETIC walk as it really is, from d0, and its noisy distances (and bearings)."""
    really = replace(p, R=p.R_true)
    if bearing:
        return simulate_model(bearing_model(really), steps, rng, x0=[p.d0, p.theta, p.v, 0])
    return simulate_model(model(really), steps, rng, x0=[p.d0, p.theta, p.v])


# --- what the distance can tell, and what it cannot ---------------------------------------------


def away(x):
    """s = v cos(theta), the speed away from the edge: all that d shows of the states (..., 3)."""
    return x[..., 2] * np.cos(x[..., 1])


def away_sigma(x, P):
    """Standard deviation of s = v cos(theta) to first order, for x (..., 3), P (..., 3, 3)."""
    theta, v = x[..., 1], x[..., 2]
    a = np.stack([np.zeros_like(v), -v * np.sin(theta), np.cos(theta)], axis=-1)  # ds/dx
    return np.sqrt(np.einsum("...i,...ij,...j->...", a, P, a))


def blind_direction(x):
    """The change of [d, theta, v] that no later d can show, to first order."""
    _, theta, v = x
    return np.array([0, np.cos(theta), v * np.sin(theta)])


def observability(model, x):
    """The rows H, H F, H F^2, ... up to F^(n-1), F and H at the state x (n,): (n m, n)."""
    _, F = model.transition(x, None)
    _, H = model.measure(x)
    return np.vstack([H @ np.linalg.matrix_power(F, i) for i in range(len(x))])


def least_known(P, P0):
    """Of the initial variance of theta and v, the share left in the direction known least.

    P (..., 3, 3) or more states; P0 diagonal. The largest eigenvalue of the (theta, v) block of P,
    each state in units of its initial standard deviation: 1 means that there is a direction about
    which nothing was learnt.
    """
    unit = np.sqrt(np.diag(P0)[1:3])
    shares = np.linalg.eigvalsh(P[..., 1:3, 1:3] / np.outer(unit, unit))
    return shares[..., -1]


def central_difference(function, x, step=1e-5):
    """The Jacobian of function(x) (m,) at x (n,) by central differences: (m, n)."""
    steps = step * np.eye(len(x))
    columns = [(function(x + e) - function(x - e)) / (2 * step) for e in steps]
    return np.column_stack(columns)


def second_order(p, seconds):
    """What the EKF leaves out of the mean of d after a blind walk, cm.

    It is -1/2 seconds v cos(theta) sigma_theta^2, the second order in theta.
    """
    return -seconds * p.v0 * np.cos(p.theta0) * p.sigma_theta**2 / 2
