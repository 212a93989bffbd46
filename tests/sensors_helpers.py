"""What the tests of a phone's sensors share: a page over http (a secure context, for it is this
machine), sensors that DevTools overrides, and readings that are handed to the page one by one."""

import functools
import http.server
import json
import math
import threading

import explorers
import numpy as np
from explorer_helpers import SOURCES, shown

ORIENTATIONS = ("absolute-orientation", "relative-orientation")
START = {"id": "Pakai sensor ponsel ini", "en": "Use this phone's sensors"}
STOP = {"id": "Berhenti", "en": "Stop"}
UP = [0, 0, 9.8]  # m/s2: lying face up
KINDS = ("gyroscope", "accelerometer", "linear-acceleration", *ORIENTATIONS)


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *args):
        pass


def serve(folder):
    handler = functools.partial(Quiet, directory=str(folder))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    return server


def laboratory(folder):
    """A folder with every explorer that reads sensors, in both languages: id.html, en.html; and the
    sources, from which a test may import."""
    for language in ("id", "en"):
        papers = explorers.bundle(folder / language, language)
        names = explorers.scripts(papers)
        scripts = "".join(f'<script defer src="{language}/{name}.js"></script>' for name in names)
        (folder / f"{language}.html").write_text(
            f'<!doctype html><html lang="{language}"><meta charset="utf-8"><title>-</title>'
            '<link rel="icon" href="data:,">'
            '<meta name="viewport" content="width=device-width">'
            f'<link rel="stylesheet" href="{language}/core.css">{scripts}<body class="bd-article">'
            '<kalman-explorer paper="gyro" view="drift"></kalman-explorer>'
            '<kalman-explorer paper="quadrotor" view="tilt"></kalman-explorer></body></html>',
            encoding="utf-8",
        )
    (folder / "sensors").symlink_to(SOURCES / "sensors")
    (folder / "language").symlink_to(SOURCES / "language")
    return folder


class Phone:
    """The overridden sensors of one browser page."""

    def __init__(self, page):
        self.session = page.context.new_cdp_session(page)
        for kind in KINDS:
            self.send("Enabled", kind, enabled=True, metadata={"available": True})

    def send(self, what, kind, **more):
        self.session.send(f"Emulation.setSensorOverride{what}", {"type": kind, **more})

    def set(self, rates, force, heading=0.0):
        """Rates (3) rad/s and force (3) m/s2 in the phone's axes; heading: degrees from north."""
        half = math.radians(-heading) / 2  # a turn about z is counterclockwise
        turned = {"x": 0, "y": 0, "z": math.sin(half), "w": math.cos(half)}
        for kind in ORIENTATIONS:
            self.send("Readings", kind, reading={"quaternion": turned})
        for kind, values in (("accelerometer", force), ("linear-acceleration", (0, 0, 0))):
            self.send("Readings", kind, reading=xyz(values))
        self.send("Readings", "gyroscope", reading=xyz(rates))


def xyz(values):
    return {"xyz": dict(zip("xyz", map(float, values)))}


def explorer(page, paper):
    return page.locator(f"kalman-explorer[paper={paper}]")


def tap(element, name):
    element.get_by_role("button", name=name, exact=True).click()


FEED = """async (e, readings) => {
  const xyz = ([x, y, z]) => ({ x, y, z });
  const send = ({ t, gyr: [alpha, beta, gamma], acc, angles }) => {
    if (angles) {
      const [a, b, c] = angles;
      const about = { alpha: a, beta: b, gamma: c, absolute: true };
      dispatchEvent(new DeviceOrientationEvent('deviceorientationabsolute', about));
    }
    const rotationRate = { alpha, beta, gamma };
    const accelerationIncludingGravity = xyz(acc);
    const event = new DeviceMotionEvent('devicemotion',
      { rotationRate, accelerationIncludingGravity, interval: 16 });
    Object.defineProperty(event, 'timeStamp', { value: t });
    dispatchEvent(event);
  };
  e.querySelector('.explorer-control.sensor button').click();
  while (!e.explorer.s.motion) {  // it listens when the browser has given its permission
    send(readings[0]);
    await new Promise(done => setTimeout(done, 5));
  }
  readings.slice(1).forEach(send);
}"""


def feed(element, readings):
    """Start, and hand readings {t ms, gyr (3) deg/s, acc (3), angles (3, optional)} to the page."""
    element.evaluate(FEED, readings)
    shown(element)


def readings(t, gyr, acc, **more):
    """Readings at times t (s) as `feed` takes them."""
    gyr = np.broadcast_to(gyr, (len(t), 3)).tolist()
    acc = np.broadcast_to(acc, (len(t), 3)).tolist()
    every = zip(t, gyr, acc)
    return [{"t": 5000 + 1000 * float(k), "gyr": g, "acc": a, **more} for k, g, a in every]


def record(element, data, language="en"):
    """A whole recording, from the tap that starts it to the one that ends it."""
    feed(element, data)
    tap(element, STOP[language])
    shown(element)


def result_of(element, *names):
    """Arrays of r, such as "alone" or "filter.x"."""
    script = """(e, names) => names.map(name => {
      const values = name.split('.').reduce((part, key) => part[key], e.explorer.r);
      return Array.from(values);
    })"""
    return map(np.array, element.evaluate(script, list(names)))


def motion_of(element):
    """The motion in the state, as arrays: {t, gyr (T, 3), acc (T, 3), heading}; it may come late,
    when what reads it must be fetched first."""
    handle = element.element_handle()
    element.page.wait_for_function("e => e.explorer.s.motion", arg=handle)
    told = element.evaluate("""e => {
      const { t, gyr, acc, heading, live } = e.explorer.s.motion;
      const list = values => Array.from(values, value => Number.isNaN(value) ? null : value);
      return JSON.stringify({ t: list(t), gyr: list(gyr), acc: list(acc), heading: list(heading),
        live });
    }""")
    parts = json.loads(told)
    made = {name: np.array(parts[name], dtype=float) for name in ("t", "gyr", "acc", "heading")}
    made["gyr"] = made["gyr"].reshape(-1, 3)
    made["acc"] = made["acc"].reshape(-1, 3)
    return made | {"live": parts["live"]}
