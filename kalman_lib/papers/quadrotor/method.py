"""How the attitude filter can be set: three methods, from the paper to the letter to one that
works."""

from dataclasses import dataclass

from .model import DEG

# What the corrected filter does and the paper's does not, or does not say; Method.without leaves
# some out
CORRECTIONS = (
    "formulas",
    "Euler rates",
    "midpoint",
    "wrapping",
    "estimated tilt",
    "rest mean",
    "rest variance",
)
VARIANCE_3_DEG = (3 * DEG) ** 2
VARIANCE_15_DEG = (15 * DEG) ** 2


@dataclass(frozen=True)
class Method:
    """How `attitude` filters: one set of numbers for every recording. Angles in rad.

    kept      is the error of the gyroscope's rate a bias that is kept? False, as in the paper's Q:
              it is new in every step (white noise), and each angle has its filter; True: it hardly
              changes, and one filter compares vectors (vectors.py), whose R follows its innovations
    q         strength of the process noise: of the rate (rad^2/s^3), or of the attitude (rad^2/s)
              where the bias is kept
    R_min     (3,) R of roll, pitch and yaw is their variance at rest, but at least this: rest
              shows neither the accelerations nor the magnetic disturbances of a flight
    without   which of CORRECTIONS are left out: the formulas are then (1) and (2); the gyroscope's
              rates serve as those of the angles, or those at the start of a step instead of its
              middle; innovations and angles are not wrapped; the yaw is turned back by the
              accelerometer's tilt; the gyroscope's mean at rest is not taken off its rates; R is
              the variance of the angles over the whole recording
    m, window, threshold    the paper's rule: where the variance of the magnetometer over the window
              (s) exceeds the threshold times its variance at rest, R becomes m R
    q_bias    strength of the noise that moves the bias, rad^2/s^3

    q and m may be arrays of one shape (cells,): then `attitude` runs all cells at once, unless the
    bias is kept. Where it is kept, only q, q_bias and "rest mean" of without count.
    """

    q: float
    kept: bool = False
    R_min: tuple = (VARIANCE_3_DEG, VARIANCE_3_DEG, VARIANCE_15_DEG)
    without: tuple = ()
    m: float = 1.0
    window: float = 1.0
    threshold: float = 4.0
    q_bias: float = 1e-9


METHODS = {
    "literal": Method(
        q=1 * DEG**2,
        R_min=(0, 0, 0),
        m=0.16,
        without=("formulas", "Euler rates", "wrapping", "estimated tilt", "rest variance"),
    ),
    "paper": Method(q=30 * DEG**2),
    "adaptive": Method(q=(0.1 * DEG) ** 2, kept=True),
}


def process_noise(how, dt):
    """Q00, Q01 and Q11 of one step: the paper's equation (18)."""
    return how.q * dt**3 / 3, -how.q * dt**2 / 2, how.q * dt
