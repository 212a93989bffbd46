"""The still picture of every explorer: for paper, the stored notebook, a page without a script."""

import importlib
from dataclasses import replace

import numpy as np

from .. import plots
from ..fast import kalman_filter
from ..filters import predict, update
from ..papers import beetle, gyro, quadrotor, ship, smoother, theory

SEED = 2  # of every synthetic measurement, as in book/explorers/element/settings.js
BELIEVED = np.linspace(-1, 1, 31)  # powers of ten between what the filter believes and the truth
LEVELS = (1.1, 1.3, 1.6, 2, 2.5, 3)  # of RMSE divided by the best


def picture(paper, view, p):
    """The figure of one view for the Params p."""
    draw = PICTURES.get((paper, view)) or of_any_paper(paper)
    return draw(p, np.random.default_rng(SEED))


def of_any_paper(paper):
    """What is drawn for a view without a picture of its own: the first sensor, filtered."""
    room = importlib.import_module(f"..papers.{paper}", __package__)

    def draw(p, rng):
        made = room.simulate(p, rng)
        result = kalman_filter(room.model(p), made.z, made.u)
        steps = np.arange(1, len(made.z) + 1)
        H = result.H[:, 0]  # of the first sensor
        x = np.sum(H * result.x, axis=1)
        sigma = np.sqrt(np.einsum("ti,tij,tj->t", H, result.P, H))
        return plots.series(steps, made.z[:, 0], x, sigma, np.sum(H * made.x, axis=1))

    return draw


def theory_steps(p, rng):
    """Prediction and update of the first step."""
    model = theory.model(p)
    before = predict(model, model.x0, model.P0, np.array([p.u]))
    after = update(model, before.x_pred, before.P_pred, np.array([p.z]))
    beliefs = {
        r"$x_{\mathrm{pred},1}$": (before.x_pred, before.P_pred, plots.PREDICTION),
        "$x_{1}$": (after.x, after.P, plots.ESTIMATE),
    }
    return plots.ellipses(beliefs, z=p.z, R=p.R)


def theory_bells(p, rng):
    """Two rulers of one length (cm) and what they say together."""
    x, P, _ = theory.fuse(20, 4, 23, 1)
    bells = {
        "$a$": (20, 4, plots.PREDICTION),
        "$b$": (23, 1, plots.MEASUREMENT),
        "$x$": (x, P, plots.ESTIMATE),
    }
    return plots.gaussians(bells, xlabel="cm")


def smoother_form(p, rng):
    """The paper's 16 values, filtered, beside a moving average."""
    z = smoother.MEASURED
    x = kalman_filter(smoother.model(p), z).x[:, 0]
    average = smoother.moving_average(z, p.window)
    return plots.series(np.arange(1, len(z) + 1), z, x, rivals={f"MA({p.window})": average})


def smoother_draw(p, rng):
    """A drawn path with noisy dots; the filter and a moving average run after it."""
    truth = smoother.ready_path()
    z = truth + rng.normal(0, 0.8, len(truth))
    believed = replace(p, Q=0.1 * 0.64, R=0.64, x0=5, P0=1000)
    return plots.series(
        np.arange(1, len(z) + 1),
        z,
        kalman_filter(smoother.model(believed), z).x[:, 0],
        truth=truth,
        rivals={"MA(12)": smoother.moving_average(z, 12)},
    )


def smoother_online(p, rng):
    """The first hour of a synthetic stream."""
    z = smoother.silkworm_room(rng).z[:60, 0]
    result = kalman_filter(smoother.model(p), z)
    return plots.series(np.arange(1, len(z) + 1), z, result.x[:, 0], np.sqrt(result.P[:, 0, 0]))


def gyro_flight(p, rng):
    """Angle and errors of the paper's simulation."""
    flight = gyro.simulate(p, rng)
    result = kalman_filter(gyro.model(p), flight.z, flight.u)
    return plots.panels(gyro.layout(p, flight, result), xlabel="$t$ (s)", height=1.9)


def gyro_drift(p, rng):
    """A gyroscope at rest, its rate added up over a minute, in degrees (noise 1 °/s)."""
    p = replace(p, duration=60, T=0.1, sigma_w=1)
    t = gyro.times(p)
    walk = gyro.drift(p, rng, runs=1)[:, 0]
    figure = plots.series(t, x=walk, truth=0 * t, xlabel="$t$ (s)", ylabel="°")
    fan = 2 * p.sigma_w * np.sqrt(p.T * t)
    figure.axes[0].fill_between(t, -fan, fan, **plots.BAND)
    return figure


def gyro_mismatch(p, rng):
    """RMSE of every pair of sigmas that the filter may believe, over that of the true ones."""
    times = 10**BELIEVED
    table, _ = gyro.expected(p, times * p.sigma_w, times[:, np.newaxis] * p.sigma_v)
    truth = np.log10([p.sigma_w, p.sigma_v])
    return plots.contours(
        BELIEVED + truth[0],
        BELIEVED + truth[1],
        table / table[15, 15],
        r"$\log_{10} \sigma_w$",
        r"$\log_{10} \sigma_v$",
        LEVELS,
        {r"$\sigma$": truth},
        height=3.4,
    )


def ship_run(p, rng):
    """The synthetic towing run with the model that was fitted to it."""
    t, run = ship.towing_run(rng)
    z = run.z[:, 0]
    fitted = ship.fitted(z, replace(p, Q_copy=p.Q))
    result = kalman_filter(ship.model(fitted), z, u=np.ones(len(z)))
    return plots.series(
        t,
        z,
        result.x[:, 0],
        np.sqrt(result.P[:, 0, 0]),
        truth=run.x[:, 0],
        xlabel="$t$ (s)",
        ylabel="m/s",
    )


def ship_poles(p, rng):
    """The poles of the model that the reader holds."""
    return plots.poles({r"$\lambda$": ship.poles(p.a1, p.a2)})


def ship_noise(p, rng):
    """The poles fitted to a noisy run, beside those of the run without noise."""
    _, run = ship.towing_run(rng, p.sigma)
    fits = {"$z$": run.z[:, 0], r"$x_{\mathrm{true}}$": run.x[:, 0]}
    return plots.poles({name: ship.poles(*ship.fit(speed)[1:]) for name, speed in fits.items()})


def beetle_walk(p, rng):
    """The distance over 20 s."""
    walk = beetle.simulate(p, rng, round(20 / p.dt))
    result = kalman_filter(beetle.model(p), walk.z)
    t = p.dt * np.arange(1, len(walk.z) + 1)
    return plots.series(
        t,
        walk.z[:, 0],
        result.x[:, 0],
        np.sqrt(result.P[:, 0, 0]),
        walk.x[:, 0],
        xlabel="$t$ (s)",
        ylabel="cm",
        names={"x": "$d$", "truth": r"$d_{\mathrm{true}}$"},
    )


def beetle_banana(p, rng):
    """All directions and speeds that fit one record, and the filter's ellipse."""
    v = 2 / np.cos(p.theta)
    walk = beetle.simulate(replace(p, v=v), rng, 20)
    result = kalman_filter(beetle.model(p), walk.z)
    theta = np.linspace(-0.9, 0.9, 100)
    return plots.plane(
        {"$x$": (result.x[-1, 1:], result.P[-1, 1:, 1:], plots.ESTIMATE)},
        {r"$v\cos\theta = s$": (theta, 2 / np.cos(theta))},
        {r"$x_{\mathrm{true}}$": (p.theta, v)},
        r"$\theta$ (rad)",
        "$v$ (cm/s)",
    )


def quadrotor_flight(p, rng):
    """Roll, pitch and yaw of the synthetic flight, in degrees; few samples make a quick picture."""
    flight = quadrotor.simulate(replace(p, dt=0.1), rng)
    result = quadrotor.attitude(*flight.sensors, quadrotor.METHODS["paper"])
    rows = []
    for i, axis in enumerate(quadrotor.AXES):
        x = np.unwrap(result.angles[:, i])  # no jumps of the yaw
        z, truth = (
            np.degrees(x + quadrotor.wrap(part[:, i] - x)) for part in (result.z, flight.truth)
        )
        names = {"x": axis, "truth": f"{axis} (ref.)"}
        rows.append(dict(t=flight.t, z=z, x=np.degrees(x), truth=truth, ylabel="°", names=names))
    return plots.panels(rows, xlabel="$t$ (s)", height=1.5)


def quadrotor_tilt(p, rng):
    """One axis in the hand: gyroscope alone, accelerometer alone, filter."""
    held = quadrotor.hold(rng)
    t = quadrotor.hand_times()
    result = kalman_filter(quadrotor.one_angle(R=100), held.z, held.u)
    return plots.series(
        t,
        held.z[:, 0],
        result.x[:, 0],
        truth=held.x[:, 0],
        rivals={r"$\sum u\,\Delta t$": t[0] * np.cumsum(held.u)},
        xlabel="$t$ (s)",
        ylabel=r"$\phi$ (°)",
    )


PICTURES = {
    ("theory", "steps"): theory_steps,
    ("theory", "bells"): theory_bells,
    ("smoother", "form"): smoother_form,
    ("smoother", "draw"): smoother_draw,
    ("smoother", "online"): smoother_online,
    ("gyro", "flight"): gyro_flight,
    ("gyro", "drift"): gyro_drift,
    ("gyro", "mismatch"): gyro_mismatch,
    ("ship", "run"): ship_run,
    ("ship", "poles"): ship_poles,
    ("ship", "noise"): ship_noise,
    ("beetle", "walk"): beetle_walk,
    ("beetle", "banana"): beetle_banana,
    ("quadrotor", "flight"): quadrotor_flight,
    ("quadrotor", "tilt"): quadrotor_tilt,
}
