"""What the reader may vary, and what the paper prints."""

from dataclasses import dataclass

from .. import param

# Mean of the reference (deg), mean of the filter (deg), galat (%), after the paper's equation (25)
PRINTED = {
    "R": {
        "roll": "0.1612 0.1762 9.31",
        "pitch": "5.5674 5.5559 0.21",
        "yaw": "-29.1408 -36.8405 26.42",
    },
    "0.16 R": {
        "roll": "0.161193760262723 0.161200452517002 0",
        "pitch": "5.5674 5.5738 0.11",
        "yaw": "29.1408 36.8296 26.39",
    },
}


@dataclass(frozen=True)
class Params:
    """What the paper varies is m.

    Its data, its Q's scale, its window and its threshold are not printed: our choice.
    """

    # fmt: off
    m: float = param(
        1, min=0.01, max=1000, step=0.1, unit="", log=True,
        id="pengali R saat dinamis", en="factor of R when dynamic",
    )
    q: float = param(
        30, min=0.01, max=100, step=0.1, unit="deg²/s³", log=True,
        id="kekuatan derau proses", en="strength of the process noise",
    )
    window: float = param(
        1, min=0.1, max=5, step=0.1, unit="s",
        id="jendela varians", en="window of the variance",
    )
    threshold: float = param(
        4, min=1, max=100, step=0.1, unit="", log=True,
        id="ambang, kelipatan varians saat diam", en="threshold, times the variance at rest",
    )
    sigma_gyr: float = param(
        0.5, min=0.01, max=10, step=0.1, unit="deg/s", log=True,
        id="simpangan baku derau giroskop", en="standard deviation of the gyroscope's noise",
    )
    sigma_acc: float = param(
        0.3, min=0.01, max=3, step=0.1, unit="m/s²", log=True,
        id="simpangan baku derau akselerometer",
        en="standard deviation of the accelerometer's noise",
    )
    sigma_mag: float = param(
        0.8, min=0.01, max=10, step=0.1, unit="µT", log=True,
        id="simpangan baku derau magnetometer", en="standard deviation of the magnetometer's noise",
    )
    bias: float = param(
        0.3, min=0, max=5, step=0.1, unit="deg/s",
        id="bias giroskop", en="bias of the gyroscope",
    )
    sway: float = param(
        0.1, min=0, max=2, step=0.05, unit="m/s²",
        id="percepatan goyangan", en="acceleration of the swaying",
    )
    dt: float = param(
        0.02, min=0.01, max=0.1, step=0.01, unit="s",
        id="langkah waktu", en="time step",
    )
    # fmt: on
