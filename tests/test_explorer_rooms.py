"""What only some readers need is fetched when they need it, and nothing they did before is lost."""

import functools
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import explorers
import pytest
from conftest import listen
from explorer_helpers import shown
from workbook_helpers import xlsx

PAGE = """<!doctype html><html lang="{language}"><meta charset="utf-8"><title>.</title>
<link rel="icon" href="data:,"><link rel="stylesheet" href="core.css">
<script defer src="core.js"></script><script defer src="{paper}.js"></script>
<kalman-explorer paper="{paper}"{view}></kalman-explorer>"""
TABLE = "time (s)\tlevel (cm)\n" + "\n".join(f"{k}\t{20 + k % 3}" for k in range(12))
PHONE = {"workshop": "", "gyro": ' view="drift"', "quadrotor": ' view="tilt"'}
SAID = {"id": "sambungkan jaringan", "en": "connect to the network"}
FRAMES = "() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
OWN_ROWS = "e => e.explorer.r?.data.note && !e.explorer.r.data.truth && e.explorer.r.T"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("rooms")
    for language in ("id", "en"):
        papers = explorers.bundle(made / language, language)
        for paper in papers:
            text = PAGE.format(language=language, paper=paper, view=PHONE.get(paper, ""))
            (made / language / f"{paper}.html").write_text(text, encoding="utf-8")
    return made


@pytest.fixture(scope="module")
def address(folder):
    class Quiet(SimpleHTTPRequestHandler):
        def log_message(self, *args):
            pass

    handler = functools.partial(Quiet, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


class Opened:
    """A page, what it has asked for, and a gate before the rooms, which a test opens."""

    def __init__(self, chromium, address, paper, language="en"):
        self.context = chromium.new_context(reduced_motion="reduce")
        self.page = self.context.new_page()
        self.trouble = listen(self.page)
        self.held, self.fails, self.holds, self.asked = [], False, False, []
        for room in explorers.rooms():
            self.page.route(f"**/{room}.js*", self.answer)
        self.page.goto(f"{address}/{language}/{paper}.html")
        self.element = self.page.locator("kalman-explorer")
        shown(self.element)

    def answer(self, route):
        self.asked.append(route.request.url.rpartition("/")[2].partition(".js")[0])
        if self.fails:
            route.abort()
        elif self.holds:
            self.held.append(route)
        else:
            route.continue_()

    def release(self):
        self.holds = False
        for route in self.held:
            route.continue_()

    def wait(self, script):
        return self.page.wait_for_function(script, arg=self.element.element_handle()).json_value()

    def message(self):
        return self.element.locator(".explorer-message")


@pytest.fixture
def opened(chromium, address):
    pages = []

    def open_page(paper, language="en", base=address):
        pages.append(Opened(chromium, base, paper, language))
        return pages[-1]

    yield open_page
    for one in pages:
        one.context.close()
        expected = [text for text in one.trouble if "ERR_FAILED" not in text]
        assert expected == []


@pytest.mark.parametrize("paper", ["workshop", "smoother", "ship", "gyro", "quadrotor"])
def test_nobody_fetches_what_nobody_needs(paper, opened):
    one = opened(paper)
    if paper == "workshop":
        for number in range(1, 6):
            one.element.get_by_role("button", name=f"{number} ").first.click()
            shown(one.element)
    wanted = ["workshop_later"] if paper == "workshop" else []  # with the buttons of "5 Save"
    assert one.asked == wanted and one.message().is_hidden()


def test_the_first_tap_copies_the_program(opened):
    one = opened("workshop")
    one.context.grant_permissions(["clipboard-read", "clipboard-write"])
    one.element.get_by_role("button", name="5 Save").click()
    one.element.get_by_role("button", name="Copy the code").click()
    one.message().get_by_text("Copied.").wait_for()
    assert "LinearModel" in one.page.evaluate("navigator.clipboard.readText()")
    assert one.asked == ["workshop_later"]


def test_a_pasted_table_is_read_when_its_reader_is_there(opened):
    one = opened("workshop")
    one.holds = True
    before = one.element.evaluate("e => Array.from(e.explorer.r.result.x)")
    one.element.get_by_role("button", name="1 Data").click()
    one.element.locator("textarea[id$='-text']").fill(TABLE)
    one.message().get_by_text("One moment").wait_for()
    one.element.locator("textarea[id$='-text']").fill(TABLE + "\n12\t21")
    one.page.evaluate(FRAMES)
    assert one.element.evaluate("e => Array.from(e.explorer.r.result.x)") == before
    one.release()
    assert one.wait(OWN_ROWS) == 13
    one.message().wait_for(state="hidden")
    assert one.asked == ["files"]


@pytest.mark.parametrize("way", ["choose", "drop"])
def test_a_file_that_comes_before_its_reader_is_read(way, opened, tmp_path):
    one = opened("workshop")
    one.holds = True
    content = xlsx([["time (s)", "level (cm)"], *([k, 20 + k % 3] for k in range(15))])
    one.element.get_by_role("button", name="1 Data").click()
    if way == "choose":
        (tmp_path / "tank.xlsx").write_bytes(content)
        one.element.locator("input[type=file]").set_input_files(tmp_path / "tank.xlsx")
    else:
        one.element.locator(".explorer-control.file").evaluate(
            """(e, bytes) => {
              const carried = new DataTransfer();
              carried.items.add(new File([Uint8Array.from(bytes)], "tank.xlsx"));
              e.dispatchEvent(new DragEvent("drop", { dataTransfer: carried, bubbles: true }));
            }""",
            list(content),
        )
    one.page.wait_for_timeout(100)
    one.release()
    assert one.wait(OWN_ROWS) == 15 and set(one.asked) == {"files"}


def test_it_works_from_a_folder(folder, opened):
    one = opened("workshop", base=folder.as_uri())
    one.element.get_by_role("button", name="1 Data").click()
    one.element.locator("textarea[id$='-text']").fill(TABLE)
    assert one.wait(OWN_ROWS) == 12


@pytest.mark.parametrize("language", ["id", "en"])
def test_without_a_network_it_says_so_and_tries_again(language, opened):
    one = opened("workshop", language)
    one.fails = True
    one.element.get_by_role("button", name="1 Data").click()
    box = one.element.locator("textarea[id$='-text']")
    box.fill(TABLE)
    one.message().get_by_text(SAID[language]).wait_for()
    text = one.message().inner_text()
    assert text.endswith(".") and "http" not in text
    one.fails = False
    box.fill(TABLE + "\n12\t21")
    assert one.wait(OWN_ROWS) == 13
    one.message().wait_for(state="hidden")


@pytest.mark.parametrize("paper", PHONE)
def test_a_tap_fetches_what_listens_to_the_sensors(paper, opened):
    one = opened(paper, "id")
    one.fails = True
    if paper == "workshop":
        one.element.get_by_role("button", name="1 Data").click()
    button = one.element.get_by_role("button", name="Pakai sensor ponsel ini")
    button.click()
    one.message().get_by_text(SAID["id"]).wait_for()
    one.fails = False
    one.page.evaluate("DeviceMotionEvent.requestPermission = async () => 'denied'")
    button.click()
    one.message().get_by_text("Izin membaca sensor ditolak").wait_for()
    assert set(one.asked) == {"sensors"}


def test_the_permission_is_asked_in_the_tap_and_once_however_late_the_room_is(opened):
    """iOS shows its question only while the finger is on the button; two taps are one question."""
    one = opened("gyro")
    one.holds = True
    asked = one.element.evaluate("""e => {
      window.asked = 0;
      DeviceMotionEvent.requestPermission = async () => { asked++; return 'denied'; };
      const button = e.querySelector('.explorer-control.sensor button');
      button.click();
      const now = asked;
      button.click();
      return now;
    }""")
    assert asked == 1
    one.page.wait_for_timeout(50)
    one.release()
    one.message().get_by_text("was not allowed").wait_for()
    assert one.page.evaluate("asked") == 1


def test_a_button_that_writes_a_workbook_fetches_what_writes_it(opened):
    one = opened("smoother")
    with one.page.expect_download() as info:
        one.element.get_by_role("button", name="live formulas").click()
    assert info.value.suggested_filename.endswith(".xlsx") and one.asked == ["files"]


def test_what_is_kept_on_the_phone_can_be_replayed_at_the_next_visit(opened):
    """The list is there at once; the recording is read when it is chosen."""
    one = opened("gyro")
    head = "Time (s)," + ",".join(
        f"{name} {axis} ({unit})"
        for name, unit in (("Gyroscope", "deg/s"), ("Acceleration", "m/s^2"))
        for axis in "xyz"
    )
    rows = "\n".join(f"{k / 10},0.1,0,0,0,0,9.8," for k in range(30))
    one.page.evaluate(
        """([text]) => {
          localStorage.setItem('kalman-motion', '[{"when":"2026-01-01 10:00","seconds":3}]');
          localStorage.setItem('kalman-motion-2026-01-01 10:00', text);
        }""",
        [f"{head},Compass (deg)\n{rows}\n"],
    )
    one.page.reload()
    shown(one.element)
    assert one.asked == []
    one.element.get_by_label("Replay a kept recording").select_option("2026-01-01 10:00")
    assert one.wait("e => e.explorer.s.motion?.T") == 30 and one.asked == ["sensors"]


def test_another_text_of_a_room_has_another_address(folder):
    core = (folder / "en" / "core.js").read_text()
    other = (folder / "id" / "core.js").read_text()
    for room in explorers.rooms():
        addresses = [text.partition(f'"{room}.js?v=')[2][:8] for text in (core, other)]
        assert len(set(addresses)) == 2 and all(len(one) == 8 for one in addresses)
