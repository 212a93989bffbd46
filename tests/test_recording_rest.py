"""The rest at the start of a recording, and the real recording of the x-IMU."""

import gzip
from pathlib import Path

import numpy as np
import pytest
from recording_files import TILTED, G, phyphox, said, times

from kalman_lib.data import Recording, read_recording, read_ximu, rest_seconds

XIMU = Path(__file__).resolve().parent.parent / "notebooks" / "data" / "ximu.csv.gz"


# --- rest ---------------------------------------------------------------------------------------


def still_then_moving(rest, rate=100.0, bias=0.05):
    rng = np.random.default_rng(1)
    t = times(rate, 8.0)
    moving = (t >= rest)[:, None]
    gyr = bias + 0.01 * rng.normal(size=(len(t), 3)) + moving * np.sin(6 * t)[:, None]
    acc = [0, 0, -G] + 0.05 * rng.normal(size=(len(t), 3)) + moving * 3 * np.cos(7 * t)[:, None]
    return Recording(t, gyr, acc, None, rate, [])


@pytest.mark.parametrize("rest", [1.0, 3.0, 5.5])
def test_the_length_of_the_rest(rest):
    assert rest - 0.26 < rest_seconds(still_then_moving(rest)) <= rest + 0.01


def test_no_rest_and_nothing_but_rest():
    assert rest_seconds(still_then_moving(0.0)) == 0
    assert rest_seconds(still_then_moving(100.0)) == pytest.approx(8.0, abs=0.26)
    assert said(read_recording(phyphox({})), "lies still for its first 4.00 s")
    assert said(read_recording(phyphox(TILTED)), "does not begin at rest")  # it turns at 0.4 rad/s


# --- the real recording -------------------------------------------------------------------------


@pytest.fixture(scope="module")
def ximu():
    return read_ximu(XIMU)


def tilts(recording, rows, signs=(1, 1, 1)):
    """Degrees between "up" by the accelerometer (mean of each quarter second in rows) and by the
    device's angles."""
    up = recording.acc.reshape(-1, 64, 3)[rows].mean(axis=1) * signs
    roll, pitch, _ = recording.reference[32::64][rows].T
    device = np.column_stack([
        np.sin(pitch),
        -np.sin(roll) * np.cos(pitch),
        -np.cos(roll) * np.cos(pitch),
    ])
    return np.degrees(np.arccos((up * device).sum(axis=1) / np.linalg.norm(up, axis=1)))


def test_the_ximu_file_is_the_published_one(ximu):
    assert len(ximu.t) == 12_626 and ximu.rate == 256 and XIMU.stat().st_size < 1_200_000
    assert ximu.t[-1] == pytest.approx(49.3, abs=0.05)
    with gzip.open(XIMU, "rt") as file:
        rows = file.read().splitlines()
    assert (
        len(rows) == 12_627 and sum(row.endswith(",,,") for row in rows) == 6313
    )  # 6,313 with the device's angles
    # the first row as the device wrote it: deg/s, g, gauss, degrees; forward-left-up
    np.testing.assert_allclose(np.degrees(ximu.gyr[0]), [2.1875, 2, -10.125])
    np.testing.assert_allclose(ximu.acc[0] / G, [-0.009277344, -0.01171875, -1.050293])
    np.testing.assert_allclose(ximu.mag[0], [0.3051758, -0.01708984, 0.2055664])
    np.testing.assert_allclose(
        np.degrees(ximu.reference[0]), [-1.707944, -0.6089312, 150.0818], rtol=1e-6
    )


def test_the_ximu_tells_what_was_converted(ximu):
    assert said(ximu, "axes were converted") and said(ximu, "128 Hz")


def test_the_ximu_lies_still_first(ximu):
    rest = int(rest_seconds(ximu) * 256)
    assert rest >= 2 * 256
    f = ximu.acc[:rest].mean(axis=0)
    assert np.linalg.norm(f) == pytest.approx(G, rel=0.02) and f[2] < -9.5
    roll, pitch = np.degrees([np.arctan2(-f[1], -f[2]), np.arctan2(f[0], np.hypot(f[1], f[2]))])
    device = np.degrees(ximu.reference[:rest].mean(axis=0))
    assert abs(roll - device[0]) < 2 and abs(pitch - device[1]) < 2


def test_the_ximu_angles_are_those_of_gravity_in_every_quiet_quarter_second(ximu):
    """Also tilted by more than 60 degrees, where any other signs are off by more than 30."""
    whole = len(ximu.t) // 64 * 64
    cut = Recording(
        ximu.t[:whole], ximu.gyr[:whole], ximu.acc[:whole], None, 256, [], ximu.reference[:whole]
    )
    acc, gyr = cut.acc.reshape(-1, 64, 3), cut.gyr.reshape(-1, 64, 3)
    quiet = ((acc.std(axis=1) < 0.5) & (np.abs(gyr).max(axis=1) < 0.2)).all(axis=1)
    assert quiet.sum() >= 20 and np.degrees(np.abs(cut.reference[32::64][quiet, 1])).max() > 60

    def rms(x):
        return np.sqrt(np.mean(x**2))

    assert rms(tilts(cut, quiet)) < 2.5
    for signs in (
        (1, -1, 1),
        (-1, 1, 1),
        (-1, -1, 1),
        (1, 1, -1),
        (1, -1, -1),
        (-1, 1, -1),
        (-1, -1, -1),
    ):
        assert rms(tilts(cut, quiet, signs)) > 30


def test_the_ximu_gyroscope_is_the_rate_of_the_devices_angles(ximu):
    roll, pitch, yaw = np.unwrap(ximu.reference[::2], axis=0).T
    roll_rate, pitch_rate, yaw_rate = (np.gradient(angle) * 128 for angle in (roll, pitch, yaw))
    rates = np.array([
        roll_rate - yaw_rate * np.sin(pitch),
        pitch_rate * np.cos(roll) + yaw_rate * np.cos(pitch) * np.sin(roll),
        -pitch_rate * np.sin(roll) + yaw_rate * np.cos(pitch) * np.cos(roll),
    ])
    fine = np.abs(pitch) < 1.2
    for k in range(3):
        slope = np.polyfit(rates[k][fine], ximu.gyr[::2][fine, k], 1)[0]
        assert (
            np.corrcoef(rates[k][fine], ximu.gyr[::2][fine, k])[0, 1] > 0.98 and 0.9 < slope < 1.1
        )


def test_the_ximu_reaches_the_limits_of_Euler_angles(ximu):
    assert (
        np.degrees(np.abs(ximu.reference[:, 1])).max() > 89
        and np.degrees(np.abs(ximu.reference[:, 0])).max() > 170
    )
