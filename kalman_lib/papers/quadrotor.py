"""Chapter 6: roll, pitch and yaw of a quadrotor from gyroscope, accelerometer and magnetometer.

Source: Rafiq, Kurniawan and Purnami, equations (1)-(26).

Frames: earth north-east-down (NED), body forward-right-down (FRD). The accelerometer shows specific force: at rest and
level it reads (0, 0, -g). Roll, pitch and yaw are the aerospace Euler angles (turn by yaw first, then pitch, then roll);
yaw is 0 towards magnetic north and grows to the right. Angles in rad, rates in rad/s unless a name says otherwise.
"""
import math
import warnings
from collections import deque
from dataclasses import dataclass

import numpy as np

from ..checks import shape_message
from ..models import LinearModel
from ..simulate import Trajectory
from . import check, param

AXES = ("roll", "pitch", "yaw")
PI, DEG = math.pi, math.pi / 180
GRAVITY = 9.81                                      # m/s2
FIELD = np.array([38.13, 0.54, -23.79])             # uT, NED: the earth's field in Yogyakarta, 2022 (IGRF-13)

# What the paper prints: mean of the reference (deg), mean of the filter (deg), galat (%), after its equation (25)
PRINTED = {"R": {"roll": "0.1612 0.1762 9.31", "pitch": "5.5674 5.5559 0.21", "yaw": "-29.1408 -36.8405 26.42"},
           "0.16 R": {"roll": "0.161193760262723 0.161200452517002 0", "pitch": "5.5674 5.5738 0.11",
                      "yaw": "29.1408 36.8296 26.39"}}

# The paper's route: seconds of straight flight, after a turn by so many degrees (to the left is negative)
ROUTE = ((30, 0), (20, -65), (15, -115), (20, -80), (15, -100))
STEEPEST = 85 * DEG
REST = 6.0                                          # s before take-off


@dataclass(frozen=True)
class Params:
    """What the paper varies is m. Its data, its Q's scale, its window and its threshold are not printed: our choice."""
    m: float = param(1, min=0.01, max=1000, step=0.1, unit="", log=True, id="pengali R saat dinamis",
                     en="factor of R when dynamic")
    q: float = param(30, min=0.01, max=100, step=0.1, unit="deg²/s³", log=True, id="kekuatan derau proses",
                     en="strength of the process noise")
    window: float = param(1, min=0.1, max=5, step=0.1, unit="s", id="jendela varians", en="window of the variance")
    threshold: float = param(4, min=1, max=100, step=0.1, unit="", log=True,
                             id="ambang, kelipatan varians saat diam", en="threshold, times the variance at rest")
    sigma_gyr: float = param(0.5, min=0.01, max=10, step=0.1, unit="deg/s", log=True,
                             id="simpangan baku derau giroskop", en="standard deviation of the gyroscope's noise")
    sigma_acc: float = param(0.3, min=0.01, max=3, step=0.1, unit="m/s²", log=True,
                             id="simpangan baku derau akselerometer", en="standard deviation of the accelerometer's noise")
    sigma_mag: float = param(0.8, min=0.01, max=10, step=0.1, unit="µT", log=True,
                             id="simpangan baku derau magnetometer", en="standard deviation of the magnetometer's noise")
    bias: float = param(0.3, min=0, max=5, step=0.1, unit="deg/s", id="bias giroskop", en="bias of the gyroscope")
    sway: float = param(0.1, min=0, max=2, step=0.05, unit="m/s²", id="percepatan goyangan",
                        en="acceleration of the swaying")
    dt: float = param(0.02, min=0.01, max=0.1, step=0.01, unit="s", id="langkah waktu", en="time step")


def model(p):
    """The paper's model, equations (10)-(24): state [roll, its rate, pitch, its rate, yaw, its rate], rad and rad/s.

    Measured: the three angles; input u: the three rates (the rate of the state is the latest input). Innovations are
    wrapped at +-pi. R: variances of the angles of the simulated sensors at rest, rad^2.
    """
    check(p)
    F, B, H, Q = axis(p.dt, p.q * DEG ** 2)
    three = np.eye(3)
    tilt, heading = p.sigma_acc / GRAVITY, p.sigma_mag / np.hypot(*FIELD[:2])
    R = np.diag([tilt, tilt, heading]) ** 2
    return LinearModel(F=np.kron(three, F), B=np.kron(three, B), H=np.kron(three, H), Q=np.kron(three, Q), R=R,
                       x0=[0, 0, 0, 0, np.pi, 0], P0=np.kron(R, [[1, 0], [0, 0]]), residual=wrapped_difference)


def axis(dt, q):
    """F, B, H and Q of one axis with state [angle, rate], equations (12), (15), (18) and (20); q scales Q, rad^2/s^3."""
    return (np.array([[1, dt], [0, 0]]), np.array([[0], [1]]), np.array([[1, 0]]),
            q * np.array([[dt ** 3 / 3, dt ** 2 / 2], [dt ** 2 / 2, dt]]))


def wrap(angle):
    """The same angle between -pi and pi."""
    return (angle + PI) % (2 * PI) - PI


def wrapped_difference(z, z_pred):
    """The innovation of an angle: from +179 to -179 degrees it is 2 degrees, not 358."""
    return wrap(z - z_pred)


# --- what each sensor says alone ---------------------------------------------------------------------------------------

def tilt(acc):
    """Roll and pitch (N, 2) of the accelerometer alone, from acc (N, 3): right only without acceleration."""
    x, y, z = np.moveaxis(np.asarray(acc), 1, 0)
    return np.stack([np.arctan2(-y, -z), np.arctan2(x, np.hypot(y, z))], axis=1)


def printed_tilt(acc):
    """Roll and pitch (N, 2) as equations (2) and (1) print them, both with the root of ax^2 + az^2."""
    x, y, z = np.moveaxis(np.asarray(acc), 1, 0)
    return np.stack([np.arctan(-y / np.hypot(x, z)), np.arctan(x / np.hypot(x, z))], axis=1)


def heading(mag, roll, pitch):
    """Yaw (N,) of the magnetometer mag (N, 3), its vector turned back to the horizontal by roll and pitch (N,)."""
    return _heading(*np.moveaxis(np.asarray(mag), 1, 0), roll, pitch, np)


def _heading(x, y, z, roll, pitch, lib):
    sin_r, cos_r, sin_p, cos_p = lib.sin(roll), lib.cos(roll), lib.sin(pitch), lib.cos(pitch)
    x_h = x * cos_p + (y * sin_r + z * cos_r) * sin_p
    y_h = y * cos_r - z * sin_r
    return lib.atan2(-y_h, x_h)


def euler_rates(gyr, roll, pitch, lib=np):
    """Rates of roll, pitch and yaw from the body's rates gyr = (p, q, r).

    At pitch +-90 deg they have no bound; beyond 85 deg they are those at 85, wrong but finite.
    """
    p, q, r = gyr
    if lib is np or not -STEEPEST < pitch < STEEPEST:
        pitch = np.clip(pitch, -STEEPEST, STEEPEST)
    sin, cos = lib.sin(roll), lib.cos(roll)
    turn = q * sin + r * cos
    return p + turn * lib.tan(pitch), q * cos - r * sin, turn / lib.cos(pitch)


# --- the filter --------------------------------------------------------------------------------------------------------

# What the corrected filter does and the paper's does not, or does not say; Method.without leaves some of it out
CORRECTIONS = ("formulas", "Euler rates", "midpoint", "wrapping", "estimated tilt", "rest mean", "rest variance")


@dataclass(frozen=True)
class Method:
    """How `attitude` filters: one set of numbers for every recording. Angles in rad.

    kept      does the second state, the error s of the gyroscope's rate, last? False, as in the paper's Q: it is new
              in every step (white noise); True: it is a bias that hardly changes
    q         strength of the process noise: of the rate (rad^2/s^3), or of the angle (rad^2/s) where the bias is kept
    R_min     (3,) R of roll, pitch and yaw is their variance at rest, but at least this: rest shows neither the
              accelerations nor the magnetic disturbances of a flight
    without   which of CORRECTIONS are left out: the formulas are then (1) and (2); the gyroscope's rates serve as those
              of the angles, or those at the start of a step instead of its middle; innovations and angles are not
              wrapped; the yaw is turned back by the accelerometer's tilt; the gyroscope's mean at rest is not taken off
              its rates; R is the variance of the angles over the whole recording
    m, window, threshold    the paper's rule: where the variance of the magnetometer over the window (s) exceeds the
              threshold times its variance at rest, R becomes m R
    gain, largest    the better rule, used where the bias is kept: R of roll and pitch is gain times the mean of y^2
              over 0.5 s minus P_pred, that difference kept between R and largest R
    q_bias    strength of the noise that moves the bias, rad^2/s^3

    q and m may be arrays of one shape (cells,): then `attitude` runs all cells at once.
    """
    q: float
    kept: bool = False
    R_min: tuple = ((3 * DEG) ** 2, (3 * DEG) ** 2, (15 * DEG) ** 2)
    without: tuple = ()
    m: float = 1.0
    window: float = 1.0
    threshold: float = 4.0
    gain: float = 30.0
    largest: float = 1e4
    q_bias: float = 1e-9


METHODS = {"literal": Method(q=1 * DEG ** 2, R_min=(0, 0, 0), m=0.16,
                             without=("formulas", "Euler rates", "wrapping", "estimated tilt", "rest variance")),
           "paper": Method(q=30 * DEG ** 2),
           "adaptive": Method(q=(0.1 * DEG) ** 2, kept=True, R_min=(0, 0, (15 * DEG) ** 2))}


@dataclass(frozen=True, eq=False)
class Attitude:
    """What `attitude` found, all (N, 3), of roll, pitch and yaw; with cells (N, 3, cells).

    angles rad; z measured angles rad; u rates that moved the angles, rad/s; s error of the gyroscope's rate, rad/s;
    y innovations rad; P variances of the angles and R of their measurements, rad^2.
    """
    angles: np.ndarray
    z: np.ndarray
    u: np.ndarray
    s: np.ndarray
    y: np.ndarray
    P: np.ndarray
    R: np.ndarray


def estimate(t, gyr, acc, mag, rest_s, method="adaptive"):
    """Roll, pitch and yaw (N, 3) in rad of a recording.

    t (N,) s, increasing; gyr (N, 3) rad/s; acc (N, 3) m/s2, specific force (-g on z at rest and level); mag (N, 3) in
    any unit, or None: then yaw starts at 0 and only the gyroscope turns it. All in forward-right-down axes. rest_s: the
    craft is at rest for so many seconds at the start. NaN in acc or mag: that sensor is silent at that moment.
    method: "literal", "paper" or "adaptive", see METHODS.

    ValueError: unknown method, wrong shapes, NaN in t or gyr, t does not increase, no rest of at least 10 samples.
    UserWarning: the pitch comes beyond 75 degrees, where Euler angles fail.
    """
    if method not in METHODS:
        raise ValueError(f"method is {method!r}; accepted are {', '.join(METHODS)}. / "
                         f"method berisi {method!r}; yang diterima {', '.join(METHODS)}.")
    return attitude(t, gyr, acc, mag, rest_s, METHODS[method]).angles


def attitude(t, gyr, acc, mag, rest_s, how):
    """Like `estimate`, with a Method `how`, and returns an Attitude: everything on the way.

    Each axis is a small Kalman filter with state [angle, s], s the error of the gyroscope's rate u:
    F = [[1, -dt], [0, 1 or 0]], B = [dt, 0], H = [1, 0]. With 0 (not kept) it is the paper's filter: its second state,
    the rate, is u - s. kalman_filter gives the same numbers (a test compares); written out it is ten times as quick.
    """
    t, gyr, acc, mag, rest = _recording(t, gyr, acc, mag, rest_s)
    z, x = _measured(acc, mag, rest, how)
    R = _measurement_noise(t, z, mag, rest, how)
    at_rest = 0 if "rest mean" in how.without else gyr[rest].mean(axis=0)
    turn = (gyr[1:] + gyr[:-1]) / 2 - at_rest               # the rate in the middle of a step
    P_s = gyr[rest].var(axis=0).mean() / rest_s if how.kept else 0.0    # of at_rest: one independent value a second
    cells = np.broadcast_shapes(np.shape(how.q), np.shape(how.m))
    wrapping, own_tilt, keep = "wrapping" not in how.without, "estimated tilt" not in how.without, float(how.kept)
    lib = np if cells else math                             # one array of all cells, or plain numbers
    rates = _rates(how, lib)
    dt, turn, z, mag, R = np.diff(t).tolist(), turn.tolist(), z.tolist(), mag.tolist(), R.tolist() if lib is math else R
    recent = [deque(maxlen=max(1, round(0.5 / np.median(dt)))) for _ in AXES]       # y^2 of the last 0.5 s
    Q = {h: process_noise(how, h) for h in set(dt)}         # of a step of h seconds
    s, P = [0.0] * 3, [(R[0][i], 0.0, P_s) for i in range(3)]
    columns = [list(row) for row in (x, z[0], s, s, s, R[0], R[0])]         # of an Attitude, one number after another
    for k in range(1, len(t)):
        h, z_k, R_k, y, P_k = dt[k - 1], list(z[k]), list(R[k]), [math.nan] * 3, [0.0] * 3
        u = rates(turn[k - 1], x, s, h)
        Q00, Q01, Q11 = Q[h]
        x = [x[0] + h * (u[0] - s[0]), x[1] + h * (u[1] - s[1]), x[2] + h * (u[2] - s[2])]
        s = list(s) if how.kept else [0.0] * 3
        if own_tilt and z_k[2] == z_k[2]:                   # turn the magnetometer back by the estimated tilt
            z_k[2] = _heading(*mag[k], x[0], x[1], lib)
        for i in range(3):
            P00, P01, P11 = P[i]                            # P_pred = F P F' + Q
            P00, P01 = P00 - 2 * h * P01 + h * h * P11 + Q00, keep * (P01 - h * P11) + Q01
            P11 = keep * P11 + Q11
            if z[k][i] == z[k][i]:                          # else NaN: the sensor is silent
                y_i = y[i] = wrap(z_k[i] - x[i]) if wrapping else z_k[i] - x[i]
                if how.kept and i < 2:
                    recent[i].append(y_i * y_i)
                    excess = sum(recent[i]) / len(recent[i]) - P00
                    R_k[i] = how.gain * min(max(excess, R_k[i]), how.largest * R_k[i])
                S = P00 + R_k[i]
                K0, K1 = P00 / S, P01 / S
                x[i] += K0 * y_i
                s[i] += K1 * y_i
                P00, P01, P11 = K0 * R_k[i], K1 * R_k[i], P11 - K1 * P01
            P[i], P_k[i] = (P00, P01, P11), P00
        if wrapping:
            x[0], x[2] = wrap(x[0]), wrap(x[2])
        for column, row in zip(columns, (x, z_k, u, s, y, P_k, R_k)):
            column.extend(row)
    result = Attitude(*(np.array([np.broadcast_to(value, cells) for value in column] if cells else column).reshape(-1, 3, *cells)
                        for column in columns))
    steepest = np.degrees(np.abs(result.angles[:, 1]).max())
    if steepest > 75:
        warnings.warn(f"The pitch reaches {steepest:.0f} degrees: beyond 75 degrees Euler angles fail, use quaternions. / "
                      f"Pitch mencapai {steepest:.0f} derajat: di atas 75 derajat sudut Euler gagal, pakailah kuaternion.",
                      stacklevel=2)
    return result


def process_noise(how, dt):
    """Q00, Q01 and Q11 of one step: the paper's equation (18), or the noises of angle and bias."""
    if how.kept:
        return how.q * dt, 0.0, how.q_bias * dt
    return how.q * dt ** 3 / 3, -how.q * dt ** 2 / 2, how.q * dt


def _rates(how, lib):
    """The function (turn, x, s, dt) -> rates of the three angles during a step, taken at the angles in its middle."""
    def at_start(turn, x, s, dt):
        return euler_rates(turn, x[0], x[1], lib)

    def in_the_middle(turn, x, s, dt):
        u = euler_rates(turn, x[0], x[1], lib)
        return euler_rates(turn, x[0] + dt / 2 * (u[0] - s[0]), x[1] + dt / 2 * (u[1] - s[1]), lib)

    if "Euler rates" in how.without:
        return lambda turn, x, s, dt: turn
    return at_start if "midpoint" in how.without else in_the_middle


def _measured(acc, mag, rest, how):
    """The measured angles (N, 3) and the mean angles at rest, where the filter starts.

    The yaw is the one for the tilt at rest, as the filter computes it again from its own tilt; or, without the estimated
    tilt, the one for the accelerometer's.
    """
    z = printed_tilt(acc) if "formulas" in how.without else tilt(acc)
    start = [_mean(z[rest, 0]), _mean(z[rest, 1])]
    yaw = heading(mag, *(z.T if "estimated tilt" in how.without else start))
    return np.column_stack([z, yaw]), [*start, _mean(yaw[rest])]


def _measurement_noise(t, z, mag, rest, how):
    """R (N, 3), or (N, 3, cells) where m holds many: the variance of the angles, times m where the craft is dynamic."""
    seen = z if "rest variance" in how.without else z[rest]
    R = [max(_variance(column), low, 1e-12) for column, low in zip(seen.T, how.R_min)]
    dynamic = is_dynamic(t, mag, rest, how.window, how.threshold)
    factor = np.where(dynamic[:, np.newaxis], np.atleast_1d(how.m), 1.0)
    R = factor[:, np.newaxis, :] * np.array(R)[:, np.newaxis]
    return R if np.ndim(how.m) else R[..., 0]


def is_dynamic(t, mag, rest, window, threshold):
    """Where (N,) the variance of the magnetometer over the last window (s), all axes together, exceeds the threshold
    times its variance at rest: the paper's test."""
    known = np.isfinite(mag).all(axis=1)
    if not known[rest].any():
        return np.zeros(len(t), dtype=bool)
    values = np.where(known[:, np.newaxis], mag - np.nanmean(mag[rest], axis=0), 0)
    sums = np.cumsum(np.column_stack([known, values, values ** 2]), axis=0)
    n = min(len(t), max(2, round(window / np.median(np.diff(t)))))
    sums[n:] = sums[n:] - sums[:-n]
    count = np.maximum(sums[:, :1], 1)
    variance = (sums[:, 4:] / count - (sums[:, 1:4] / count) ** 2).sum(axis=1)
    return variance > threshold * np.nanvar(mag[rest], axis=0).sum()


def _mean(angles):
    """The mean direction, which +179 and -179 degrees have at 180; 0 where the sensor is silent."""
    return float(np.angle(np.nansum(np.exp(1j * angles))))


def _variance(angles):
    """Variance of angles around their mean direction; 0 without any."""
    return 0.0 if np.isnan(angles).all() else float(np.nanmean(wrap(angles - _mean(angles)) ** 2))


def _recording(t, gyr, acc, mag, rest_s):
    """The recording as arrays of float, checked, and which samples (N,) are at rest."""
    t = np.asarray(t, dtype=float)
    gyr, acc, mag = (np.full((len(t), 3), np.nan) if values is None else np.asarray(values, dtype=float)
                     for values in (gyr, acc, mag))
    for name, values, expected in (("t", t, (len(t),)), ("gyr", gyr, (len(t), 3)), ("acc", acc, (len(t), 3)),
                                   ("mag", mag, (len(t), 3))):
        if values.shape != expected:
            raise ValueError(shape_message(name, values.shape, expected))
    for name, values in (("t", t), ("gyr", gyr)):
        bad = ~np.isfinite(values.reshape(len(t), -1)).all(axis=1)
        if bad.any():
            raise ValueError(f"{name}[{bad.argmax()}] is not a finite number. / {name}[{bad.argmax()}] bukan bilangan berhingga.")
    if not (np.diff(t) > 0).all():
        k = int((np.diff(t) <= 0).argmax()) + 1
        raise ValueError(f"t does not increase at t[{k}] = {t[k]:g} s. / t tidak bertambah di t[{k}] = {t[k]:g} s.")
    rest = t - t[0] <= rest_s if len(t) else np.zeros(0, dtype=bool)
    if rest.sum() < 10:
        raise ValueError(f"rest_s = {rest_s} s holds {rest.sum()} samples; at least 10 samples of rest at the start are "
                         f"needed. / rest_s = {rest_s} s memuat {rest.sum()} sampel; diperlukan sedikitnya 10 sampel diam "
                         "di awal.")
    return t, gyr, acc, mag, rest


# --- the flight --------------------------------------------------------------------------------------------------------

@dataclass(frozen=True, eq=False)
class Flight(Trajectory):
    """A Trajectory with its sensors: x (N, 6) true state of `model`, z (N, 3) what the sensors alone say of the angles,
    u (N, 3) = gyr rad/s; t (N,) s, acc (N, 3) m/s2, mag (N, 3) uT; rest_s: still for so many seconds at the start."""
    t: np.ndarray = None
    acc: np.ndarray = None
    mag: np.ndarray = None
    rest_s: float = REST

    @property
    def gyr(self):
        return self.u

    @property
    def truth(self):
        """Roll, pitch and yaw (N, 3) rad."""
        return self.x[:, ::2]

    @property
    def sensors(self):
        """The arguments of `estimate`."""
        return self.t, self.gyr, self.acc, self.mag, self.rest_s


def simulate(p, rng):
    """A SYNTHETIC flight along the paper's route -> Flight.

    The attitude follows from the motion: rotors push only along the body's downward axis and the air drags against the
    motion, so thrust = acceleration - gravity + drag; its direction gives roll and pitch. In the air the craft sways
    with random accelerations of p.sway (correlated over 0.5 s) and the motors disturb the magnetometer (1 uT,
    correlated over 2 s). Sensors: white noise, and a gyroscope bias drawn once with standard deviation p.bias.
    """
    check(p)
    t, yaw, speed, aloft = _route(p.dt)
    ahead = np.column_stack([np.cos(yaw), np.sin(yaw), np.zeros(len(t))])       # NED
    velocity = speed[:, np.newaxis] * ahead
    sway = p.sway * aloft[:, np.newaxis] * _coloured(rng, t, 0.5) * [1, 1, 0.5]
    force = np.gradient(velocity, p.dt, axis=0) + sway - [0, 0, GRAVITY]        # specific force, m/s2
    push = -(force + 0.35 * velocity)                                           # thrust turned round: the body's down
    x, y = push[:, 0] * np.cos(yaw) + push[:, 1] * np.sin(yaw), push[:, 1] * np.cos(yaw) - push[:, 0] * np.sin(yaw)
    truth = np.column_stack([-np.arctan2(y, np.hypot(x, push[:, 2])), np.arctan2(x, push[:, 2]), yaw])
    return _sensors(p, rng, t, truth, force, 1.0 * aloft[:, np.newaxis] * _coloured(rng, t, 2.0))


def swing(p, rng):
    """A SYNTHETIC fast motion by hand, 60 s -> Flight: roll and pitch swing by 45 and 35 degrees while it turns.

    Accelerations of 1 m/s2 (correlated over 0.5 s); noise and bias of the sensors as in `simulate`, no disturbance.
    """
    check(p)
    t = np.arange(0, REST + 60, p.dt)
    moves = np.clip((t - REST) / 3, 0, 1)
    moves = moves ** 2 * (3 - 2 * moves)
    s = np.clip(t - REST, 0, None)
    truth = np.column_stack([45 * DEG * moves * np.sin(3.1 * s), 35 * DEG * moves * np.sin(2.3 * s),
                             np.pi + 120 * DEG * moves * np.sin(0.7 * s)])
    force = moves[:, np.newaxis] * _coloured(rng, t, 0.5) - [0, 0, GRAVITY]
    return _sensors(p, rng, t, truth, force, np.zeros(3))


def _sensors(p, rng, t, truth, force, disturbance):
    """A Flight along the true angles (N, 3), with the specific force (N, 3) m/s2 NED and a magnetic disturbance, uT."""
    rates = np.gradient(truth, p.dt, axis=0)
    gyr = body_rates(rates, truth) + p.bias * DEG * rng.normal(size=3) + p.sigma_gyr * DEG * rng.normal(size=truth.shape)
    acc = to_body(force, truth) + p.sigma_acc * rng.normal(size=truth.shape)
    mag = to_body(FIELD, truth) + disturbance + p.sigma_mag * rng.normal(size=truth.shape)
    state = np.stack([wrap(truth), rates], axis=2).reshape(-1, 6)
    z = tilt(acc)
    return Flight(state, np.column_stack([z, heading(mag, *z.T)]), gyr, t, acc, mag)


def _route(dt):
    """Times t (N,) s, yaw (N,) rad, speed (N,) m/s, and how much the craft is aloft (N,), 0 to 1."""
    corners, yaw = [(0, 180, 0), (REST + 2, 180, 0)], 180                   # time, degrees, speed; it faces south
    for seconds, turn in ROUTE:
        yaw, now = yaw + turn, corners[-1][0]
        corners += [(now, corners[-1][1], 0.5), (now + abs(turn) / 25, yaw, 0.5)] if turn else []     # 25 deg/s
        corners += [(corners[-1][0], yaw, 2.0), (corners[-1][0] + seconds, yaw, 2.0)]
    corners += [(corners[-1][0], yaw, 0), (corners[-1][0] + 4, yaw, 0)]
    at, yaws, speeds = np.array(corners).T
    at = at + 1e-9 * np.arange(len(at))                                     # two corners at one moment: in this order
    t = np.arange(0, at[-1], dt)
    climb = np.clip((t - REST) / 2, 0, 1)
    aloft = climb ** 2 * (3 - 2 * climb)
    return t, DEG * _smooth(np.interp(t, at, yaws), dt, 0.3), aloft * _smooth(np.interp(t, at, speeds), dt, 0.8), aloft


def _bell(dt, tau):
    n = int(4 * tau / dt)
    return np.exp(-0.5 * (np.arange(-n, n + 1) * dt / tau) ** 2)


def _smooth(values, dt, tau):
    """values (N,) smoothed by a bell of width tau (s)."""
    bell = _bell(dt, tau)
    return np.convolve(np.pad(values, len(bell) // 2, mode="edge"), bell / bell.sum(), "valid")


def _coloured(rng, t, tau):
    """Three (N, 3) random signals of standard deviation 1 that change within tau (s)."""
    bell = _bell(t[1] - t[0], tau)
    bell /= np.sqrt((bell ** 2).sum())
    return np.column_stack([np.convolve(rng.normal(size=len(t) + len(bell) - 1), bell, "valid") for _ in AXES])


def body_rates(rates, angles):
    """The gyroscope's rates (N, 3) for rates (N, 3) of roll, pitch, yaw at these angles (N, 3): euler_rates undone."""
    (roll, pitch, yaw), (r, p, _) = rates.T, angles.T
    return np.column_stack([roll - yaw * np.sin(p), pitch * np.cos(r) + yaw * np.sin(r) * np.cos(p),
                            yaw * np.cos(r) * np.cos(p) - pitch * np.sin(r)])


def to_body(v, angles):
    """A vector v (N, 3) or (3,), NED, seen in the body's axes at the angles (N, 3): turned by yaw, pitch, roll."""
    x, y, z = np.broadcast_to(v, angles.shape).T
    roll, pitch, yaw = angles.T
    x, y = x * np.cos(yaw) + y * np.sin(yaw), y * np.cos(yaw) - x * np.sin(yaw)
    x, z = x * np.cos(pitch) - z * np.sin(pitch), x * np.sin(pitch) + z * np.cos(pitch)
    return np.column_stack([x, y * np.cos(roll) + z * np.sin(roll), z * np.cos(roll) - y * np.sin(roll)])


# --- the paper's measure of error --------------------------------------------------------------------------------------

def galat(reference, estimate):
    """Equation (25): |mean of reference - mean of estimate| / |mean of reference|, in percent."""
    reference = np.mean(reference, axis=0)
    return 100 * np.abs(reference - np.mean(estimate, axis=0)) / np.abs(reference)


def rmse_deg(truth, angles):
    """Root mean square over time of the wrapped errors of the angles (N, ...), in degrees; NaN is left out."""
    error = wrap(angles - truth)
    known = np.isfinite(error)
    return np.degrees(np.sqrt(np.sum(np.where(known, error, 0) ** 2, axis=0) / np.where(known.any(axis=0), known.sum(axis=0), np.nan)))


def tilt_error(truth, angles):
    """The angle (N,) rad between the two vertical directions that truth and angles (N, 3) claim; yaw does not matter,
    and it keeps its meaning where the pitch is near 90 degrees."""
    dot = (to_body([0, 0, 1], truth) * to_body([0, 0, 1], angles)).sum(axis=1)
    return np.arccos(np.clip(dot, -1, 1))
