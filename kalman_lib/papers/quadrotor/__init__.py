"""Chapter 6: roll, pitch and yaw of a quadrotor from gyroscope, accelerometer and magnetometer.

Source: Rafiq, Kurniawan and Purnami, equations (1)-(26).

Frames: earth north-east-down (NED), body forward-right-down (FRD). The accelerometer shows specific
force: at rest and level it reads (0, 0, -g). Roll, pitch and yaw are the aerospace Euler angles
(turn by yaw first, then pitch, then roll); yaw is 0 towards magnetic north and grows to the right.
Angles in rad, rates in rad/s unless a name says otherwise.

    params.py       what the reader may vary, and what the paper prints
    model.py        the paper's model; what each sensor says alone
    method.py       how the attitude filter can be set
    attitude.py     the attitude filter: the paper's, an axis each
    vectors.py      its adaptive method: quaternion and bias
    blocks.py       what that takes for one measurement
    quaternion.py   attitudes as quaternions
    sensors.py      a recording, checked; measured angles, their noise, when the craft is dynamic
    rest.py         does a recording begin at rest?
    flight.py       synthetic flights
    hand.py         one axis alone, tilted and pushed by hand
    route.py        where they lead, and noise that changes slowly
    statistics.py   means and variances of angles, measures of error

The explorer's files of the same names (book/explorers/papers/quadrotor) do the same in JavaScript.
"""

# `attitude` and `model` are functions here, as in every paper; their files have the same names.
from .attitude import Attitude, attitude, estimate
from .flight import Flight, body_rates, simulate, swing, to_body
from .hand import hand_times, hold, one_angle
from .method import CORRECTIONS, METHODS, Method, process_noise
from .model import (
    AXES,
    DEG,
    FIELD,
    GRAVITY,
    PI,
    STEEPEST,
    axis,
    euler_rates,
    heading,
    model,
    printed_tilt,
    tilt,
    wrap,
    wrapped_difference,
)
from .params import PRINTED, Params
from .route import REST, ROUTE
from .sensors import is_dynamic
from .statistics import galat, rmse_deg, tilt_error

__all__ = [
    "AXES",
    "Attitude",
    "CORRECTIONS",
    "DEG",
    "FIELD",
    "Flight",
    "GRAVITY",
    "METHODS",
    "Method",
    "PI",
    "PRINTED",
    "Params",
    "REST",
    "ROUTE",
    "STEEPEST",
    "attitude",
    "axis",
    "body_rates",
    "estimate",
    "euler_rates",
    "galat",
    "hand_times",
    "heading",
    "hold",
    "is_dynamic",
    "model",
    "one_angle",
    "printed_tilt",
    "process_noise",
    "rmse_deg",
    "simulate",
    "swing",
    "tilt",
    "tilt_error",
    "to_body",
    "wrap",
    "wrapped_difference",
]
