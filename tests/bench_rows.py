"""The rows of the bench: what is filtered, by us, by a C loop, by the other libraries."""

import numpy as np
from bench_peers import (
    beetle_dynamax,
    beetle_filterpy,
    one_by_one,
    peers,
    with_dynamax,
    with_filterpy,
    with_pykalman,
    with_simdkalman,
    with_statsmodels,
)
from bench_work import Work, first_runs, first_steps, plus, smoothed, with_P

from kalman_lib import LinearModel, fast, filters
from kalman_lib.papers import beetle, gyro


def works(C):
    """The rows, one after the other: each makes its data only when its turn comes."""
    rng = np.random.default_rng(0)
    yield gyro_run(C, rng)
    yield from scalar_series(C, rng)
    yield gyro_runs(C, rng)
    for smooth in (False, True):
        yield two_states(C, rng, smooth)
        yield two_states_runs(C, rng, smooth)
    yield attitude(C, rng)
    yield beetle_runs(C, rng)


# --- one state ----------------------------------------------------------------------------------


def gyro_drift(p):
    """What the known input adds up to, (200, 1): not all of the peers take an input."""
    return p.T * p.u * np.arange(1, 201)[:, np.newaxis]


def gyro_run(C, rng):
    """One move of a slider."""
    p = gyro.Params()
    flight = gyro.simulate(p, rng)
    model, drift = gyro.model(p), gyro_drift(p)
    z = flight.z - drift
    x, P = np.empty((200, 1)), np.empty(200)
    Q, R = model.Q[0, 0], model.R[0, 0]
    loop = C.prepared("number", 200, flight.z, float(p.T * p.u), Q, R, 0.0, 0.0, x, P)

    def c():
        loop()
        return x

    assert np.abs(c() - drift - filters.kalman_filter(model, z).x).max() < 1e-9
    contenders = peers(
        filterpy=lambda: with_filterpy(model, z),
        pykalman=lambda: with_pykalman(model, z),
        simdkalman=lambda: with_simdkalman(model, z),
        statsmodels=lambda: with_statsmodels(model, z),
        dynamax=lambda: with_dynamax(model, z),
    )
    return Work(
        "gyro, 1 run x 200 steps",
        200,
        lambda: filters.kalman_filter(model, flight.z, flight.u).x,
        lambda: with_P(fast.kalman_filter(model, flight.z, flight.u)),
        c,
        plus(drift, contenders),
    )


def scalar_series(C, rng):
    T = 1_000_000
    z = np.cumsum(0.1 * rng.normal(size=(T, 1)), axis=0) + rng.normal(size=(T, 1))
    for smooth in (False, True):
        yield scalar_row(C, z, smooth)


def scalar_row(C, z, smooth):
    model, T = LinearModel(F=1, H=1, Q=0.01, R=1, x0=0, P0=1), len(z)

    def c():
        x, P = np.empty((T, 1)), np.empty(T)
        C.call("number", T, z, 0.0, 0.01, 1.0, 0.0, 1.0, x, P)
        if smooth:
            C.call("number_rts", T, 0.0, 0.01, x, P)
        return x

    return Work(
        "scalar series, 1,000,000 steps, " + ("filter + RTS" if smooth else "filter"),
        T,
        lambda: first_steps(model, z, smooth),
        lambda: with_P(smoothed(fast.kalman_filter(model, z), smooth)),
        c,
        peers(
            filterpy=lambda: with_filterpy(model, z, 0.003, smooth),
            pykalman=lambda: with_pykalman(model, z, 0.003, smooth),
            simdkalman=lambda: with_simdkalman(model, z, 0.003, smooth),
            statsmodels=lambda: with_statsmodels(model, z, smooth),
            dynamax=lambda: with_dynamax(model, z, 0.2, smooth),
        ),
    )


def gyro_runs(C, rng):
    p = gyro.Params()
    model = gyro.model(p)
    z = gyro.simulate(p, rng, runs=10_000).z
    u, drift = np.full((200, 1), p.u), gyro_drift(p)[:, :, np.newaxis]
    without = np.ascontiguousarray(z - drift)
    Q, R = model.Q[0, 0], model.R[0, 0]

    def c():
        x = np.empty(z.shape)
        C.call("number_runs", 200, 10_000, z, float(p.T * p.u), Q, R, 0.0, x)
        return x

    contenders = peers(
        filterpy=lambda: one_by_one(with_filterpy, model, without, 10),
        pykalman=lambda: one_by_one(with_pykalman, model, without, 10),
        simdkalman=lambda: with_simdkalman(model, without),
        statsmodels=lambda: one_by_one(with_statsmodels, model, without, 50),
        dynamax=lambda: with_dynamax(model, without),
    )
    return Work(
        "gyro Monte Carlo, 10,000 x 200",
        z.size,
        lambda: first_runs(model, z, u, runs=5),
        lambda: fast.kalman_filter(model, z, u).x,
        c,
        plus(drift, contenders),
    )


# --- two states ---------------------------------------------------------------------------------

DT, Q0, Q1 = 0.1, 1e-3, 1e-2


def two_state_model():
    return LinearModel(
        F=[[1, DT], [0, 1]],
        H=[[1, 0]],
        Q=np.diag([Q0, Q1]),
        R=1,
        x0=[0, 0],
        P0=np.eye(2),
    )


def two_states(C, rng, smooth):
    model, T = two_state_model(), 100_000
    z = rng.normal(size=(T, 1))
    R = np.ones(1)

    def c():
        x, P = np.empty((T, 2)), np.empty((T, 3))
        C.call("two", T, 1, z, R, 0, None, DT, Q0, Q1, 1.0, 1.0, x, P)
        if smooth:
            C.call("two_rts", T, 1, DT, Q0, Q1, x, P)
        return x

    return Work(
        "2-state RTS, 100,000 steps" if smooth else "2-state, 100,000 steps",
        T,
        lambda: first_steps(model, z, smooth),
        lambda: with_P(smoothed(fast.kalman_filter(model, z), smooth)),
        c,
        peers(
            filterpy=lambda: with_filterpy(model, z, 0.03, smooth),
            pykalman=lambda: with_pykalman(model, z, 0.03, smooth),
            simdkalman=lambda: with_simdkalman(model, z, 0.03, smooth),
            statsmodels=lambda: with_statsmodels(model, z, smooth),
            dynamax=lambda: with_dynamax(model, z, 1, smooth),
        ),
    )


def two_states_runs(C, rng, smooth):
    model, T, runs = two_state_model(), 1000, 1000
    z = rng.normal(size=(T, 1, runs))

    def ours():
        result = fast.kalman_filter(model, z)
        return (fast.smooth_runs(result) if smooth else result).x

    def c():
        x, P = np.empty((T, 2, runs)), np.empty((T, 3))
        C.call("two_runs", T, runs, z, 1.0, DT, Q0, Q1, 1.0, 1.0, x, P)
        if smooth:
            C.call("two_rts", T, runs, DT, Q0, Q1, x, P)
        return x

    return Work(
        "2-state RTS, 1,000 x 1,000" if smooth else "2-state, 1,000 x 1,000",
        z.size,
        lambda: first_runs(model, z, smooth=smooth),
        ours,
        c,
        peers(
            filterpy=lambda: one_by_one(with_filterpy, model, z, 3, smooth=smooth),
            pykalman=lambda: one_by_one(with_pykalman, model, z, 3, smooth=smooth),
            simdkalman=lambda: with_simdkalman(model, z, 1, smooth),
            statsmodels=lambda: one_by_one(with_statsmodels, model, z, 20, smooth=smooth),
            dynamax=lambda: with_dynamax(model, z, 1, smooth),
        ),
    )


# --- R in time, a nonlinear model ---------------------------------------------------------------


def attitude_model(R, dt):
    """Three axes of angle and gyroscope bias, with the variance R (T,) of all sensors."""
    return LinearModel(
        F=np.kron(np.eye(3), [[1, -dt], [0, 1]]),
        H=np.kron(np.eye(3), [[1, 0]]),
        Q=np.diag([1e-5, 1e-8] * 3),
        R=R[:, np.newaxis, np.newaxis] * np.eye(3),
        x0=np.zeros(6),
        P0=0.01 * np.eye(6),
    )


def attitude(C, rng):
    T, dt = 60_000, 0.01
    R = np.ascontiguousarray(1e-2 * rng.uniform(0.5, 5, size=T))
    model = attitude_model(R, dt)
    z = np.cumsum(3e-3 * rng.normal(size=(T, 3)), axis=0) + 0.1 * rng.normal(size=(T, 3))

    def c():
        x, P = np.empty((T, 6)), np.empty((T, 9))
        for axis in range(3):
            data, states, variances = z[:, axis:], x[:, 2 * axis :], P[:, 3 * axis :]
            numbers = (-dt, 1e-5, 1e-8, 0.01, 0.01)
            C.call("two", T, 3, data, R, 1, None, *numbers, states, variances)
        return x

    return Work(
        "6-state attitude, 60,000, R in time",
        T,
        lambda: filters.kalman_filter(attitude_model(R[:2000], dt), z[:2000]).x,
        lambda: fast.kalman_filter(model, z).x,
        c,
        peers(
            filterpy=lambda: with_filterpy(model, z, 0.05),
            statsmodels=lambda: with_statsmodels(model, z),
            dynamax=lambda: with_dynamax(model, z),
        ),
    )


def beetle_runs(C, rng):
    p = beetle.Params(Q_theta=1e-3, Q_v=1e-3)
    model = beetle.model(p)
    z = np.stack([beetle.simulate(p, rng, steps=500).z for _ in range(10)] * 100, axis=-1)
    z += 0.1 * rng.normal(size=z.shape)
    x0, P0, Q = model.x0.copy(), np.diag(model.P0).copy(), np.diag(model.Q).copy()

    def c():
        x = np.empty((500, 3, 1000))
        C.call("beetle", 500, 1000, z, float(p.dt), x0, P0, Q, float(p.R), x)
        return x

    return Work(
        "beetle EKF, 1,000 x 500",
        z.size,
        lambda: first_runs(model, z),
        lambda: fast.kalman_filter(model, z).x,
        c,
        peers(
            filterpy=lambda: beetle_filterpy(model, p, z, 5),
            dynamax=lambda: beetle_dynamax(model, p, z),
        ),
    )
