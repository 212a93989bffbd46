"""Chapter 6 in the page: the attitude filter, which is not the general one."""

import dataclasses
import functools
import json

import numpy as np
import pytest
from explorer_helpers import SCALE, close, listed, value_in

from kalman_lib import kalman_filter, nis
from kalman_lib.papers import describe, quadrotor
from kalman_lib.papers.quadrotor.rest import at_rest

ATTITUDE = """text => {
  const { quadrotor } = KalmanExplorers.papers, { flights, questions } = JSON.parse(text),
    list = values => Array.from(values, value => value === value ? value : null);
  const numbers = values => Float64Array.from(values, value => value ?? NaN), memos = {};
  const recordings = flights.map(({ rest_s, ...parts }) => ({ rest_s,
    ...Object.fromEntries(Object.entries(parts).map(([name, values]) => [name,
    numbers(values)])) }));
  return JSON.stringify(questions.map(({ flight, how, method }) => {
    const base = method ? quadrotor.METHODS[method] : {}, recording = recordings[flight];
    const { angles, z, u, s, y, P, R, dynamic } = quadrotor.attitude(recording, { ...base,
      ...how }, memos[flight + method] ??= {});
    return { angles: list(angles), z: list(z), u: list(u), s: list(s), y: list(y), P: list(P),
      R: list(R), dynamic: list(dynamic),
             galat: list(quadrotor.galat(recording.truth, angles)),
               rmse_deg: list(quadrotor.rmse_deg(recording.truth, angles)) };
  }));
}"""


@functools.cache
def recordings():
    """Name -> (sensors as `attitude` takes them, truth): a flight, its first 50 s with one
    sensor after the other switched off, or with gaps, and a fast swing."""
    flight = quadrotor.simulate(quadrotor.Params(), np.random.default_rng(6))
    t, gyr, acc, mag, truth = (
        part[:2500] for part in (flight.t, flight.gyr, flight.acc, flight.mag, flight.truth)
    )
    nothing, holes = np.full_like(acc, np.nan), (acc.copy(), mag.copy())
    holes[0][2000:2100], holes[1][1000:1500] = np.nan, np.nan
    swing = quadrotor.swing(quadrotor.Params(dt=0.04), np.random.default_rng(1))
    return (
        {"flight": (flight.sensors, flight.truth), "swing": (swing.sensors, swing.truth)}
        | {
            name: ((t, *sensors, quadrotor.REST), truth)
            for name, sensors in {
                "start": (gyr, acc, mag),
                "no gyr": (0 * gyr, acc, mag),
                "no acc": (gyr, nothing, mag),
                "no mag": (gyr, acc, nothing),
                "nothing": (gyr, nothing, nothing),
                "gaps": (gyr, *holes),
            }.items()
        }
        | recordings_of_readers()
    )


def recordings_of_readers():
    """Begun in motion, with a rest that is none, and with a pause after a rest."""
    flight = quadrotor.simulate(quadrotor.Params(), np.random.default_rng(7))
    parts = flight.t, flight.gyr, flight.acc, flight.mag
    moving = (flight.t > 40) & (flight.t < 70)
    paused = (flight.t < 30) | ((flight.t > 55) & (flight.t < 75))
    return {
        name: ((*(part[keep] for part in parts), rest_s), flight.truth[keep])
        for name, keep, rest_s in (
            ("moving", moving, 0),
            ("no rest", moving, 3),
            ("paused", paused, quadrotor.REST),
        )
    }


def methods():
    """(recording, method, changes): the three methods on every recording, the ends of every
    slider, random settings, one correction left out."""
    table, rng = describe(quadrotor.Params), np.random.default_rng(7)
    sliders = ("m", "q", "window", "threshold")
    ends = [{slider: table[slider][end]} for slider in sliders for end in ("min", "max")]
    some = [
        {slider: value_in(table[slider], rng.uniform()) for slider in sliders} for _ in range(12)
    ]
    yield from (
        (name, method, {}) for name in recordings() for method in ("literal", "paper", "adaptive")
    )
    yield from (
        ("start", method, change) for change in ends + some for method in ("literal", "paper")
    )
    yield (
        "start",
        "paper",
        {"m": 0.16, "threshold": 1, "window": 0.13},
    )  # 6.5 steps: the half goes to the even number
    yield from (
        ("start", "paper", {"without": [name]})
        for name in ("midpoint", "rest mean", "rest variance", "wrapping")
    )


@pytest.mark.filterwarnings("ignore:The pitch reaches", "ignore:The first 3 s")
def test_the_attitude_filter_of_the_page_is_pythons(bundle):
    names, asked, theirs = list(recordings()), list(methods()), []
    questions = [
        {
            "flight": names.index(name),
            "method": method,
            "how": change | ({"q": change["q"] * quadrotor.DEG**2} if "q" in change else {}),
        }
        for name, method, change in asked
    ]
    for (name, *_), question in zip(asked, questions):
        how = dataclasses.replace(quadrotor.METHODS[question["method"]], **question["how"])
        theirs.append(by_python(name, how))
    found = []
    for (name, method, change), expected, answer in zip(
        asked, theirs, ask_in_parts(bundle, all_flights(), questions)
    ):
        for key, values in expected.items():
            got = np.array(
                [np.nan if value is None else value for value in answer[key]], dtype=float
            ).reshape(values.shape)
            angle = key in ("angles", "z", "y")
            if angle:  # +180 and -180 degrees are the same, and Python's wrap rounds as pi does
                got = values + quadrotor.wrap(got - values)
            scale = SCALE if angle or key == "s" else 0  # s is moved by y, and rounds with it
            if trouble := close(got.ravel(), values, values.shape[1], scale):
                found.append(f"{name}, {method}, {change}, {key}: {trouble}")
    assert found[:5] == [] and len(asked) > 65


def by_python(name, how):
    """What the filter and its measures give on a recording, (T, 3) or (1, 3)."""
    (t, gyr, acc, mag, rest_s), truth = recordings()[name]
    result = quadrotor.attitude(t, gyr, acc, mag, rest_s, how)
    rest = at_rest(t, gyr, acc, rest_s)
    dynamic = quadrotor.is_dynamic(t, mag, rest, how.window, how.threshold)
    return {
        **{key: getattr(result, key) for key in ("angles", "z", "u", "s", "y", "P", "R")},
        "dynamic": dynamic[:, np.newaxis],
        "galat": quadrotor.galat(truth, result.angles)[np.newaxis],
        "rmse_deg": quadrotor.rmse_deg(truth, result.angles)[np.newaxis],
    }


def all_flights():
    """The recordings as the page gets them."""
    found = []
    for (t, gyr, acc, mag, rest_s), truth in recordings().values():
        parts = {"t": t, "gyr": gyr, "acc": acc, "mag": mag, "truth": truth}
        found.append({name: listed(values) for name, values in parts.items()})
        found[-1]["rest_s"] = rest_s
    return found


def ask_in_parts(page, flights, questions):
    """The answers of the page, a few at a time: one text of all would hold a hundred megabytes."""
    for start in range(0, len(questions), 6):
        some = questions[start : start + 6]
        used = sorted({question["flight"] for question in some})
        text = json.dumps({
            "flights": [flights[i] for i in used],
            "questions": [
                question | {"flight": used.index(question["flight"])} for question in some
            ],
        })
        yield from json.loads(page.evaluate(ATTITUDE, text))


def test_the_sensors_alone_say_what_they_say_in_python(bundle):
    """tilt, printed_tilt, heading, euler_rates and wrap, at random vectors and angles beyond a
    whole turn."""
    rng = np.random.default_rng(3)
    v, angles = rng.normal(size=(200, 3)), rng.uniform(-8, 8, size=(200, 2))
    ours = bundle.evaluate(
        """([v, angles]) => {
      const { tilt, printed_tilt, heading, euler_rates, wrap } = KalmanExplorers.papers.quadrotor;
      return v.map((row, k) => [...tilt(...row), ...printed_tilt(...row), heading(...row,
        ...angles[k]), ...euler_rates(row, ...angles[k]), ...angles[k].map(wrap)]);
    }""",
        [v.tolist(), angles.tolist()],
    )
    rates = [quadrotor.euler_rates(row, *angle) for row, angle in zip(v, angles)]
    theirs = np.column_stack([
        quadrotor.tilt(v),
        quadrotor.printed_tilt(v),
        quadrotor.heading(v, *angles.T),
        rates,
        quadrotor.wrap(angles),
    ])
    assert close(np.ravel(ours), theirs, theirs.shape[1]) is None


def test_one_axis_in_the_hand_is_pythons(bundle):
    """Without noise the same motion; then the same filter on Python's noisy one."""
    calm = dict(held=25, push=-2, bias=0.7, sigma_gyr=0, sigma_acc=0)
    theirs = quadrotor.hold(np.random.default_rng(0), **calm)
    ours = bundle.evaluate(
        """p => {
      const { quadrotor } = KalmanExplorers.papers;
      const held = quadrotor.hold(KalmanExplorers.random.generator(1), p);
      return [held.x, held.z, held.u, quadrotor.addUp(held.u)].map(values => Array.from(values));
    }""",
        calm,
    )
    expected = (theirs.x, theirs.z, theirs.u, 0.1 * np.cumsum(theirs.u))
    for values, same in zip(ours, expected):
        assert close(values, np.ravel(same), 1, SCALE) is None
    noisy = quadrotor.hold(np.random.default_rng(2))
    x, K = bundle.evaluate(
        """([z, u]) => {
      const { x, K } = KalmanExplorers.papers.quadrotor.filterHeld({ sigma_gyr: 1, R_acc: 8 },
        { z: Float64Array.from(z), u: Float64Array.from(u) });
      return [Array.from(x), Array.from(K)];
    }""",
        [noisy.z[:, 0].tolist(), noisy.u[:, 0].tolist()],
    )
    result = kalman_filter(quadrotor.one_angle(R=8), noisy.z, noisy.u)
    assert close(x, result.x[:, 0], 1) is None and close(K, result.K[:, 0, 0], 1) is None


def test_the_flight_of_the_page_is_flown_as_pythons(bundle):
    """Without noise both fly the same; with noise, sensors, NIS and the errors of the three
    methods agree over some flights."""
    calm = quadrotor.Params(sigma_gyr=0.01, sigma_acc=0.01, sigma_mag=0.01, bias=0, sway=0)
    ours = bundle.evaluate(
        """p => {
      const { simulate } = KalmanExplorers.papers.quadrotor, flight = simulate(p,
        KalmanExplorers.random.generator(1));
      return Object.fromEntries(["t", "truth", "x", "gyr", "acc", "z"].map(name => [name,
        Array.from(flight[name])]));
    }""",
        dataclasses.asdict(calm),
    )
    flight = quadrotor.simulate(calm, np.random.default_rng(1))
    for name, values, tolerance in (
        ("t", flight.t, 1e-9),
        ("truth", flight.truth, 1e-6),
        ("x", flight.x, 1e-6),
        ("gyr", flight.gyr, 2e-3),
        ("acc", flight.acc, 0.12),
    ):
        off = np.reshape(ours[name], values.shape) - values
        assert np.abs(quadrotor.wrap(off) if name in ("truth", "x") else off).max() < tolerance, (
            name
        )
    numbers = bundle.evaluate(
        """p => Array.from({ length: 6 }, (_, seed) => {
      const { simulate, attitude, rmse_deg, run, METHODS } = KalmanExplorers.papers.quadrotor, {
        random, metrics } = KalmanExplorers;
      const flight = simulate(p, random.generator(seed)), result = run(p, flight);
      return [...["literal", "paper", "adaptive"].flatMap(name => rmse_deg(flight.truth,
        attitude(flight, METHODS[name]).angles).slice(0, 2)),
              ...rmse_deg(flight.truth, flight.z), metrics.mean(metrics.nis(result.y, result.S,
                3))];
    })""",
        dataclasses.asdict(quadrotor.Params()),
    )
    theirs = [errors_by_python(seed) for seed in range(6)]
    assert np.mean(numbers, axis=0) == pytest.approx(np.mean(theirs, axis=0), rel=0.25)


def errors_by_python(seed):
    """RMSE of roll and pitch by the three methods and by the sensors alone, degrees; mean NIS."""
    p = quadrotor.Params()
    flight = quadrotor.simulate(p, np.random.default_rng(seed))
    result = kalman_filter(quadrotor.model(p), flight.z, flight.u)
    methods = ("literal", "paper", "adaptive")
    estimates = [quadrotor.estimate(*flight.sensors, name) for name in methods]
    errors = [quadrotor.rmse_deg(flight.truth, angles)[:2] for angles in estimates]
    alone = quadrotor.rmse_deg(flight.truth, flight.z)
    return [*np.ravel(errors), *alone, nis(result.y, result.S).mean()]


def test_a_finger_that_leaves_the_figure_to_the_left_stays_at_the_start(site, opened):
    page, trouble = opened(site / "id" / "notebooks" / "06_quadrotor.html")
    element = page.locator("kalman-explorer:not([view])").first
    element.evaluate("""e => {
      e.explorer.change({ moment: -3 });
      e.explorer.renderNow(false);
      e.explorer.draw(true);
    }""")
    assert element.evaluate("e => e.explorer.r.k") == 0 and trouble == []
    element.evaluate("e => e.explorer.reset()")
