"""Recordings of a phone's motion sensors in the page: kept, replayed, saved for Python; and what is
said where there are no sensors."""

import re

import numpy as np
import pytest
from explorer_helpers import set_state, shown
from sensors_helpers import (
    START,
    STOP,
    UP,
    Phone,
    explorer,
    feed,
    motion_of,
    readings,
    record,
    result_of,
    tap,
)

from kalman_lib.data import read_recording
from kalman_lib.papers.quadrotor import tilt

TINY = 1e-9


# --- recorded, kept, replayed, taken along ------------------------------------------------------


def swinging(**more):
    """Ten seconds that begin at rest: a tilt about y, and small noise on everything."""
    rng = np.random.default_rng(1)
    t = np.arange(600) / 60
    angle = 30 * np.sin(np.clip(t - 4, 0, None))
    rate = np.gradient(angle, t)[:, np.newaxis] * [0, 1, 0] + rng.normal(0, 0.2, (600, 3))
    radians = np.radians(angle)
    force = np.column_stack([-np.sin(radians), 0 * t, np.cos(radians)])
    return readings(
        t, rate.round(1), (9.8 * force + rng.normal(0, 0.05, (600, 3))).round(1), **more
    )


def test_a_recording_is_kept_replayed_in_another_chapter_with_other_settings_and_forgotten(
    phone_page,
):
    element = explorer(phone_page, "gyro")
    record(element, swinging(angles=[20, 0, 0]))
    before = motion_of(element)
    tap(element, "Keep on this phone")
    phone_page.reload()
    other = explorer(phone_page, "quadrotor")
    box = other.locator(".explorer-control.sensor select")
    box.select_option(index=1)
    after = motion_of(other)
    shown(other)
    for name in ("t", "gyr", "acc", "heading"):
        assert np.allclose(after[name], before[name], rtol=1e-8, atol=1e-8), name
    assert not after["live"] and other.evaluate("e => e.explorer.s.when") == 10
    (one,) = result_of(other, "seen.up.filter")
    set_state(other, R_acc=1)
    (two,) = result_of(other, "seen.up.filter")
    assert not np.allclose(one, two)
    tap(other, "Forget what is kept")
    assert not box.is_visible() and phone_page.evaluate("localStorage.length") == 0
    tap(other, "Close the recording")
    shown(other)
    assert other.evaluate("e => e.explorer.s.motion === null && e.explorer.r.x.length === 200")


def test_only_the_latest_recordings_are_kept(phone_page):
    element = explorer(phone_page, "gyro")
    for seconds in range(1, 8):
        record(element, readings(np.linspace(0, seconds, 20), 0, UP))
        tap(element, "Keep on this phone")
        phone_page.wait_for_function(
            "e => e.querySelector('.explorer-control.sensor select').options.length === "
            f"{min(seconds, 5) + 1}",
            arg=element.element_handle(),
        )
    options = element.locator(".explorer-control.sensor option").all_inner_texts()
    assert [text.split(", ")[1] for text in options[1:]] == [f"{s} s" for s in (7, 6, 5, 4, 3)]
    assert phone_page.evaluate("localStorage.length") == 6


@pytest.mark.parametrize("language, first", [("en", "Time (s),Gyro"), ("id", "Time (s);Gyro")])
def test_the_csv_is_a_recording_for_python(language, first, laboratory, phone_page, tmp_path):
    phone_page.goto(f"{laboratory}/{language}.html")
    element = explorer(phone_page, "quadrotor")
    record(element, swinging(angles=[20, 0, 0]), language)
    with phone_page.expect_download() as download:
        tap(element, {"en": "Download CSV", "id": "Unduh CSV"}[language])
    path = tmp_path / "sensors.csv"
    download.value.save_as(path)
    assert path.read_text(encoding="utf-8").startswith(first)
    motion = motion_of(element)
    read = read_recording(path)
    x, y, z = motion["gyr"].T
    assert np.allclose(read.gyr, np.radians(np.column_stack([y, x, -z])), atol=TINY)
    x, y, z = motion["acc"].T
    assert np.allclose(read.acc, np.column_stack([y, x, -z]), atol=TINY)
    assert np.allclose(read.t, motion["t"], atol=1e-6) and read.rate == pytest.approx(60, rel=1e-3)
    assert read.mag is None
    acc = result_of(element, "lines.acc")  # the roll that the page draws
    (k,) = result_of(element, "lines.t")
    rolls = np.degrees(tilt(read.acc)[:, 0])
    assert np.allclose(np.interp(k, read.t, rolls), *acc, atol=1e-6)


def test_a_magnetometer_that_a_page_may_read_is_recorded_kept_and_saved(phone_page, tmp_path):
    phone_page.evaluate("""() => {
      window.Magnetometer = class {
        start() {
          Object.assign(this, { x: 1.5, y: 20.25, z: -38 });
          this.onreading();
        }
        stop() {
          window.stopped = true;
        }
      };
    }""")
    element = explorer(phone_page, "gyro")
    record(element, swinging())
    assert phone_page.evaluate("stopped")
    tap(element, "Keep on this phone")
    element.locator(".explorer-control.sensor select").select_option(index=1)
    with phone_page.expect_download() as download:
        tap(element, "Download CSV")
    path = tmp_path / "sensors.csv"
    download.value.save_as(path)
    read = read_recording(path)
    assert np.allclose(read.mag, [20.25, 1.5, 38]) and len(read.mag) == 600


def test_nothing_is_sent_while_sensors_are_read_kept_and_saved(phone_page):
    sent = []
    phone_page.on("request", lambda request: sent.append(request.url))
    element, phone = explorer(phone_page, "quadrotor"), Phone(phone_page)
    phone.set((0, 0.1, 0), UP)
    tap(element, START["en"])
    phone_page.wait_for_function("e => e.explorer.s.motion?.T > 30", arg=element.element_handle())
    assert (
        "nothing is sent" in element.locator(".explorer-control.sensor .explorer-hint").inner_text()
    )
    tap(element, STOP["en"])
    tap(element, "Keep on this phone")
    with phone_page.expect_download():
        tap(element, "Download CSV")
    ours = re.compile(r"^blob:|/fonts/|/en/sensors\.js\?v=[0-9a-f]{8}$")  # the last is fetched once
    assert [url for url in sent if not ours.search(url)] == []
    assert "motion" not in phone_page.url


# --- where there is no sensor, and when it ends -------------------------------------------------

REFUSED = {
    "none": {"en": "This device has no gyroscope", "id": "Alat ini tidak punya giroskop"},
    "denied": {"en": "Reading the sensors was not allowed", "id": "Izin membaca sensor ditolak"},
    "insecure": {"en": "to https pages only", "id": "hanya kepada halaman https"},
}
KEEP = {"en": "Keep on this phone", "id": "Simpan di ponsel ini"}
BACK = {"en": "Close the recording", "id": "Tutup rekaman"}
SYNTHETIC = {"en": "A synthetic recording: 30 s", "id": "Rekaman sintetis: 30 s"}


@pytest.mark.parametrize("language", ["id", "en"])
@pytest.mark.parametrize("why", ["none", "denied", "insecure"])
def test_without_a_sensor_a_sentence_says_so_and_a_synthetic_recording_is_shown(
    why, language, laboratory, phone_page
):
    if why == "insecure":
        host = "http://phone.test"
        phone_page.route(
            f"{host}/**",
            lambda route: route.continue_(url=route.request.url.replace(host, laboratory)),
        )
        phone_page.goto(f"{host}/{language}.html")
        assert not phone_page.evaluate("isSecureContext")
    else:
        phone_page.goto(f"{laboratory}/{language}.html")
    if why == "denied":
        phone_page.evaluate("DeviceMotionEvent.requestPermission = async () => 'denied'")
    element = explorer(phone_page, "gyro")
    tap(element, START[language])
    message = element.locator(".explorer-message")
    message.wait_for()
    assert REFUSED[why][language] in message.inner_text()
    assert (
        SYNTHETIC[language]
        in element.locator(".explorer-control.sensor .explorer-hint").inner_text()
    )
    said = element.locator(".explorer-outcome").inner_text()
    assert {"en": "This recording is synthetic", "id": "Rekaman ini sintetis"}[language] in said
    assert element.get_by_role("button", name=START[language], exact=True).is_visible()
    assert element.get_by_role("button", name=KEEP[language], exact=True).is_hidden()
    tap(element, BACK[language])
    assert element.evaluate("e => e.explorer.s.motion === null && e.explorer.r.walks.length > 5")


def test_the_synthetic_recording_is_a_phone_that_turns_and_comes_back(phone_page):
    """Its rates without their bias add up to what its force and its compass say."""
    phone_page.evaluate("DeviceMotionEvent.requestPermission = async () => 'denied'")
    element = explorer(phone_page, "gyro")
    tap(element, START["en"])
    element.locator(".explorer-message").wait_for()
    motion = motion_of(element)
    t, rest = motion["t"], motion["t"] <= 5
    angles = np.cumsum(np.diff(t, prepend=0)[:, np.newaxis] * motion["gyr"], axis=0)
    bias = motion["gyr"][rest].mean(axis=0)
    about_x, about_y, about_z = (angles - t[:, np.newaxis] * bias).T
    x, y, z = motion["acc"].T
    quiet = (t < 17.5) | (t > 20.5)
    assert np.abs(about_y + np.degrees(np.arctan2(x, np.hypot(y, z))))[quiet].max() < 4
    assert np.abs(about_x - np.degrees(np.arctan2(y, np.hypot(x, z))))[quiet].max() < 4
    turned = motion["heading"] - motion["heading"][rest].mean()
    assert np.abs(about_z + turned).max() < 15
    assert max(map(np.ptp, (about_x, about_y, about_z))) == pytest.approx(90, abs=5)
    alone = next(result_of(element, "alone"))
    assert abs(alone[-1]) > 5
    set_state(element, sensor=True)
    assert abs(next(result_of(element, "x"))[-1]) < abs(alone[-1]) / 2


def test_permission_is_asked_in_the_tap_for_both_events(phone_page):
    phone_page.evaluate("""() => {
      window.asked = [];
      for (const one of [DeviceMotionEvent, DeviceOrientationEvent]) {
        one.requestPermission = async () => {
          asked.push([one.name, navigator.userActivation.isActive]);
          return 'granted';
        };
      }
    }""")
    phone = Phone(phone_page)
    phone.set((0, 0, 0), UP)
    element = explorer(phone_page, "gyro")
    tap(element, START["en"])
    phone_page.wait_for_function("e => e.explorer.s.motion", arg=element.element_handle())
    names = ["DeviceMotionEvent", "DeviceOrientationEvent"]
    assert phone_page.evaluate("asked") == [[name, True] for name in names]


@pytest.mark.parametrize(
    "t, last", [(np.arange(150), 120), ([0, 1, 2, 6, 7], 2)], ids=["two minutes", "a pause"]
)
def test_a_recording_ends_after_two_minutes_and_at_a_pause(t, last, phone_page):
    element = explorer(phone_page, "gyro")
    feed(element, readings(t, 0, UP))
    motion = motion_of(element)
    assert motion["t"][-1] == last and not motion["live"]
    assert element.get_by_role("button", name=START["en"], exact=True).is_visible()


def test_start_again_ends_a_recording_and_nothing_of_it_comes_back(phone_page):
    element = explorer(phone_page, "gyro")
    feed(element, readings(np.arange(20) / 60, 0, UP))
    assert motion_of(element)["live"]
    element.evaluate("e => e.explorer.reset()")
    element.evaluate("""e => {
      const rotationRate = { alpha: 1, beta: 1, gamma: 1 };
      const accelerationIncludingGravity = { x: 0, y: 0, z: 9.8 };
      dispatchEvent(new DeviceMotionEvent('devicemotion',
        { rotationRate, accelerationIncludingGravity }));
    }""")
    shown(element)
    assert element.evaluate("e => e.explorer.s.motion === null")
    assert element.get_by_role("button", name=START["en"], exact=True).is_visible()


def test_a_recording_ends_when_the_page_is_hidden(phone_page):
    element = explorer(phone_page, "gyro")
    feed(element, readings(np.arange(20) / 60, 0, UP))
    phone_page.evaluate("""() => {
      Object.defineProperty(document, 'hidden', { value: true });
      document.dispatchEvent(new Event('visibilitychange'));
    }""")
    motion = motion_of(element)
    assert len(motion["t"]) == 20 and not motion["live"]
