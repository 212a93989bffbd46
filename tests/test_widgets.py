"""The widgets without a browser: their Python side is driven as the browser would drive it."""
import base64
import datetime
import io
import re
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from openpyxl import load_workbook

from kalman_lib import kalman_filter, rmse, rts_smooth, widgets
from kalman_lib.papers import beetle, gyro, quadrotor, ship, smoother, theory

LANGUAGES = ("id", "en")


def parts(widget):
    """The widget and everything inside it."""
    yield widget
    for child in getattr(widget, "children", ()):
        yield from parts(child)


def text_of(board):
    """Every word that the widget shows, one string; the language toggle itself left out."""
    words = []
    for part in parts(board.view):
        if part is not board.language:
            words += [getattr(part, name, "") for name in ("description", "placeholder", "value")]
            words += [label for label in getattr(part, "_options_labels", ())]
    return re.sub(r"<[^>]*>", " ", " | ".join(word for word in words if isinstance(word, str)))


def rows(form):
    """The table No / Measured / Filtered as it is shown: lists of strings."""
    return [re.findall(r"<td>(.*?)</td>", row) for row in re.findall(r"<tr>(<td>.*?)</tr>", form.table.value)]


def filtered(z, p):
    return kalman_filter(smoother.model(p), z).x[:, 0]


def upload(form, name, content):
    form.upload.value = ({"name": name, "type": "", "size": len(content), "content": memoryview(content),
                          "last_modified": datetime.datetime(2026, 1, 1)},)


def test_importing_starts_nothing():
    code = "import kalman_lib.widgets, ipywidgets.widgets.widget as w; print(len(w._instances))"
    out = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert out.stdout.split() == ["0"] and out.stderr == ""


# --- the static twin, the language, the messages ---------------------------------------------------------------------

@pytest.mark.parametrize("start, paper", [(widgets.theory_steps, 'paper="theory"'), (widgets.smoother_form, 'paper="smoother"'),
                                          (widgets.smoother_online, 'paper="smoother" view="online"')])
def test_one_output_live_in_jupyter_and_static_in_the_book(start, paper, monkeypatch):
    shown = []
    monkeypatch.setattr(widgets, "display", lambda data, raw: shown.append((data, raw)))
    assert start() is None
    (data, raw), = shown
    assert raw and "application/vnd.jupyter.widget-view+json" in data
    match = re.fullmatch(rf'<kalman-explorer {paper}><img alt="" src="data:image/png;base64,(.*?)">'
                         "</kalman-explorer>", data["text/html"])
    png = base64.b64decode(match[1])
    assert png.startswith(b"\x89PNG") and 3_000 < len(png) < 60_000


def every_state():
    """The three widgets, each in states that show all of its words."""
    steps = widgets.TheorySteps()
    for moment in range(3):
        steps.moment.value = moment
        yield steps
    form = widgets.SmootherForm()
    for text in ("", "1\n2\n3", "word", "\n".join("12345" * 300)):
        form.text.value = text
        yield form
    form.source.value = "tank_level"
    yield form
    form.csv.click()
    yield form
    online = widgets.SmootherOnline()
    yield online
    online.add(1.0, 2.0)
    yield online


def test_switching_the_language_leaves_no_word_of_the_other():
    for board in every_state():
        seen = {}
        for language in ("en", "id"):
            board.language.value = language
            seen[language] = text_of(board)
        for key, word in board.words.items():
            for language, other in (("id", "en"), ("en", "id")):
                pieces = [piece for piece in re.split(r"\{\w+\}", word[other]) if len(piece.strip(" .:(),%m")) > 3]
                for piece in pieces:
                    if not any(piece in mine[language] for mine in board.words.values()):
                        assert piece not in seen[language], (key, language, piece)
        assert seen["id"] != seen["en"]


def test_every_word_exists_in_both_languages_and_keeps_its_blanks():
    for board in (widgets.TheorySteps, widgets.SmootherForm, widgets.SmootherOnline):
        for key, word in board.words.items():
            assert all(word[language].strip() for language in LANGUAGES), key
            assert word["id"] != word["en"] or key in ("source", "rmse"), f"{key} is not translated"
            assert len({tuple(sorted(re.findall(r"\{\w+\}", word[language]))) for language in LANGUAGES}) == 1, key


def test_an_unexpected_error_in_a_callback_becomes_a_message(monkeypatch):
    form = widgets.SmootherForm()
    before = form.table.value
    monkeypatch.setattr(widgets.plots, "series", lambda *_, **__: 1 / 0)
    form.Q.value = "0.5"
    assert "division by zero" in form.message.value and form.table.value == before


# --- the form --------------------------------------------------------------------------------------------------------

def test_the_paper_s_table_to_every_printed_digit():
    shown = rows(widgets.SmootherForm())
    assert [row[0] for row in shown] == [str(k) for k in range(1, 17)]
    assert [float(row[1]) for row in shown] == list(smoother.MEASURED)
    assert [float(row[2]) for row in shown] == list(smoother.FILTERED)


@pytest.mark.parametrize("changes", [dict(Q="7.7e-4"), dict(R="0,25"), dict(x0="-0,4"), dict(P0="0"),
                                     dict(Q="0.01", R="1")])
def test_every_typed_number_reaches_the_table(changes):
    form = widgets.SmootherForm()
    for name, typed in changes.items():
        getattr(form, name).value = typed
    p = smoother.Params(**{name: float(typed.replace(",", ".")) for name, typed in changes.items()})
    assert [row[2] for row in rows(form)] == [f"{x:.6f}" for x in filtered(smoother.MEASURED, p)]
    assert form.message.value == ""


def slider_of(form, text):
    return next(part.children[0] for part in parts(form.view) if getattr(part, "children", ())[1:] == (text,))


def test_slider_and_text_follow_each_other():
    form = widgets.SmootherForm()
    slider = slider_of(form, form.R)
    slider.value = 10 ** -2.5
    assert form.R.value == "0.00316" and rows(form)[5][2] == f"{filtered(smoother.MEASURED, smoother.Params(R=0.00316))[5]:.6f}"
    form.R.value = "0.00077"
    assert slider.value == pytest.approx(0.00077)
    slider.value = 10 ** -3.1                   # the browser rounds the slider to its next step: the typed number stays
    assert form.R.value == "0.00077"
    form.R.value = "nonsense"
    slider.value = 0.1
    assert form.R.value == "0.1" and form.message.value == ""


@pytest.mark.parametrize("typed", ["", "abc", "nan", "inf", "-1", "0", "1e300"])
def test_an_absurd_R_gives_one_sentence_in_both_languages_and_keeps_the_result(typed):
    form = widgets.SmootherForm()
    before = rows(form)
    form.R.value = typed
    said = {}
    for language in LANGUAGES:
        form.language.value = language
        said[language] = re.sub("<.*?>", "", form.message.value)
    assert said["id"] and said["en"] and said["id"] != said["en"] and " / " not in said["id"] + said["en"]
    assert rows(form) == before
    form.R.value = "1e-5"
    assert form.message.value == ""


def test_pasting_a_column_with_decimal_commas_and_a_gap():
    form = widgets.SmootherForm()
    form.text.value = "Suhu\n20,5\n\n21,25\n20,75\n"
    z = np.array([20.5, np.nan, 21.25, 20.75])
    assert form.source.value == "text" and [row[1] for row in rows(form)] == ["20.5", "", "21.25", "20.75"]
    assert [row[2] for row in rows(form)] == [f"{x:.6f}" for x in filtered(z, smoother.Params())]
    assert "koma" in form.note.value and "N = 4" in form.note.value
    form.language.value = "en"
    assert "comma" in form.note.value


def test_bad_text_says_so_in_both_languages_and_keeps_the_table():
    form = widgets.SmootherForm()
    form.source.value = "tank_level"
    before = form.table.value, form.measures.value, form.note.value
    form.text.value = "1\n2\nthree <b>"
    assert "Baris 3" in form.message.value and "&lt;b&gt;" in form.message.value
    assert (form.table.value, form.measures.value, form.note.value) == before
    form.language.value = "en"
    assert "Line 3" in form.message.value and "Measured" in form.table.value
    form.Q.value = "0.001"                      # still the data before, with its truth
    assert len(rows(form)) == 240 and "no truth" not in form.measures.value


def test_uploading_a_file_with_several_columns():
    form = widgets.SmootherForm()
    upload(form, "data.csv", "t;suhu;arus\n1;20,5;3\n2;21,5;4\n3;22,5;6\n".encode("utf-16"))
    assert form.column.options == ("t", "suhu", "arus") and form.column.layout.display is None
    form.column.value = "suhu"
    assert [row[1] for row in rows(form)] == ["20.5", "21.5", "22.5"] and form.message.value == ""
    form.sign.value = "."
    assert "N = 3" in form.note.value and form.column.value == "t"
    upload(form, "picture.png", b"\x89PNG\0")
    assert "picture.png" in form.message.value and len(rows(form)) == 3


def test_the_file_source_without_a_file_says_so():
    form = widgets.SmootherForm()
    form.source.value = "file"
    assert form.words["no_file"]["id"] in form.message.value and len(rows(form)) == 16


def test_the_measures_beside_the_plot():
    form = widgets.SmootherForm()
    assert "nilai sebenarnya tidak diketahui" in form.measures.value
    form.source.value = "silkworm_room"
    p = smoother.Params(R=1e-3, window=3)       # the paper's settings come with the data
    drive = smoother.silkworm_room(np.random.default_rng(widgets.SEED))
    z, truth = drive.z[:, 0], drive.x[:, 0]
    x, average = filtered(z, p), smoother.moving_average(z, 3)
    shown = re.findall(r"<td>(.*?)</td>", form.measures.value)
    assert shown == [f"{value:.4g}" for value in (
        smoother.roughness(x), smoother.roughness(average), smoother.lag(x, truth), smoother.lag(average, truth),
        rmse(truth, x), rmse(truth, average))]


def test_a_long_series_shows_its_ends_and_stays_quick_to_read():
    form = widgets.SmootherForm(z=np.random.default_rng(1).normal(size=30_000))
    shown = rows(form)
    assert len(shown) == 1001 and shown[500] == ["⋮"] * 3 and shown[499][0] == "500" and shown[501][0] == "29501"
    assert "29000 baris" in form.table.value and form.source.value == "given"
    assert len(form.plot.value) < 60_000


@pytest.mark.parametrize("z", [[3.0], [3.0, 3.0], [1e300, -1e300, 0.0], [np.nan, 1.0, np.nan]])
def test_tiny_constant_and_huge_data(z):
    form = widgets.SmootherForm(z=z)
    assert form.message.value == "" and len(rows(form)) == len(z)
    form.likelihood.click()
    assert form.said is None or form.said["id"] != form.said["en"]


def test_small_values_get_more_digits():
    form = widgets.SmootherForm(z=[1.234e-6, 2.5e-6])
    assert rows(form)[0][1] == "0.000001234"


@pytest.mark.parametrize("seed", range(5))
def test_the_quick_scalar_filter_equals_the_reference(seed):
    rng = np.random.default_rng(seed)
    z = rng.normal(size=300).cumsum()
    z[rng.random(300) < 0.2] = np.nan
    p = smoother.Params(*10 ** rng.uniform(-6, 2, 2), x0=rng.normal(), P0=rng.choice([0, 1.0, 1e6]))
    result = kalman_filter(smoother.model(p), z)
    ours = smoother.scalar_filter(z, p)
    for mine, reference in zip(ours, (result.x[:, 0], result.P[:, 0, 0], result.K[:, 0, 0], rts_smooth(result).x[:, 0])):
        assert mine == pytest.approx(reference, rel=1e-12, abs=1e-12)


def test_R_from_a_steady_stretch_and_maximum_likelihood():
    form = widgets.SmootherForm()
    form.source.value = "silkworm_room"
    z = smoother.silkworm_room(np.random.default_rng(widgets.SEED)).z[:, 0]
    form.steady.value = (11, 30)
    form.take_R.click()
    assert float(form.R.value) == pytest.approx(np.var(z[10:30], ddof=1), rel=1e-5)
    form.steady.value = (5, 5)
    form.take_R.click()
    assert form.words["too_short"]["id"] in form.message.value
    form.likelihood.click()
    assert (float(form.Q.value), float(form.R.value)) == pytest.approx(smoother.maximum_likelihood(z), rel=1e-5)
    assert float(form.x0.value) == pytest.approx(z[0])          # where the likelihood starts, too
    assert float(form.P0.value) == pytest.approx(float(form.R.value))
    assert slider_of(form, form.Q).value == pytest.approx(float(form.Q.value)) and form.message.value == ""


def linked(form):
    name, data = re.search(r'download="(.*?)" href="data:.*?;base64,(.*?)"', form.link.value).groups()
    return name, base64.b64decode(data)


def test_downloads():
    form = widgets.SmootherForm(z=[20.5, np.nan, 21.25])
    form.csv.click()
    name, content = linked(form)
    head, *lines = content.decode().splitlines()
    assert name == "kalman.csv" and head == "No,Terukur,Hasil filter,K,P,MA3"
    x = filtered(np.array([20.5, np.nan, 21.25]), smoother.Params())
    assert [float(line.split(",")[2]) for line in lines] == pytest.approx(x, rel=1e-14) and lines[1].startswith("2,,")
    form.xlsx.click()
    name, content = linked(form)
    cells = [cell for row in load_workbook(io.BytesIO(content)).worksheets[0].iter_rows(values_only=True) for cell in row]
    assert name == "kalman.xlsx" and 20.5 in cells and any(str(cell).startswith("=") for cell in cells)
    form.Q.value = "1"
    assert form.link.value == ""                # it would hold the result before


# --- the step-through ------------------------------------------------------------------------------------------------

def test_the_steps_equal_kalman_filter():
    steps = widgets.TheorySteps()
    steps.Q.value, steps.R.value = "0,3", "0.2"
    result = kalman_filter(theory.model(replace(theory.Params(), Q=0.3, R=0.2)), steps.z, u=np.full((5, 1), -2.0))
    for k, (_, prediction, updated) in enumerate(steps.walk()):
        assert np.array_equal(prediction.P_pred, result.P_pred[k]) and np.array_equal(updated.x, result.x[k])
        steps.moment.value = 2 * k + 2
        assert all(f"{value:.4g}" in steps.equations.value for value in (*result.x[k], *result.K[k, :, 0]))
        assert f"{result.K[k, 0, 0]:.3g}".replace(".", ",") in steps.sentence.value


def test_walking_forward_and_back_through_the_worked_example():
    steps = widgets.TheorySteps()
    assert steps.back.disabled and "x_0" in steps.equations.value
    steps.next.click()
    assert "0.36" in steps.equations.value and steps.measured.disabled and "Prediksi" in steps.sentence.value
    steps.next.click()
    for printed in ("0.878", "1.22", "2.237", "3.634", "0.0439", "0.06098", "0.4902", "0.41", "0.122", "-1.22"):
        assert printed in steps.equations.value
    assert "K = 0,878: 88 %" in steps.sentence.value and "dari contoh pada sumber" in steps.sentence.value
    steps.next.click()
    steps.next.click()
    assert "sintetis" in steps.sentence.value
    steps.moment.value = 10
    assert steps.next.disabled
    steps.back.click()
    assert "Langkah 5 dari 5: prediksi" in steps.sentence.value


def test_a_bad_Q_keeps_the_step_and_its_sentence_follows_the_language():
    steps = widgets.TheorySteps()
    steps.moment.value = 2
    before = steps.equations.value
    steps.Q.value = "100"
    assert "yang diterima" in steps.message.value and steps.equations.value == before
    steps.language.value = "en"
    assert "accepted are" in steps.message.value and "Update: K = 0.878" in steps.sentence.value


def test_dragging_the_measurement_lets_the_gain_decide():
    steps = widgets.TheorySteps()
    steps.moment.value = 2
    steps.measured.value = 4.5
    x = 2.5 + 0.36 / 0.41 * (4.5 - 2.5)
    assert f"{x:.4g}" in steps.equations.value and "pilihan Anda" in steps.sentence.value
    steps.restart.click()
    steps.moment.value = 2
    assert steps.measured.value == 2.2 and "2.237" in steps.equations.value


@pytest.mark.parametrize("Q, R", [(0.1, 0.05), (10, 10), (1e-4, 1e-4), (10, 1e-4), (1e-4, 10)])
def test_no_ellipse_is_ever_clipped_and_the_axes_stand_still(Q, R):
    steps = widgets.TheorySteps()
    steps.Q.value, steps.R.value = str(Q), str(R)
    limits = set()
    for steps.moment.value in range(11):
        assert steps.message.value == ""
        ax = steps.ellipses().axes[0]
        limits.add((ax.get_xlim(), ax.get_ylim()))
        outlines = [line.get_xydata() for line in ax.lines if len(line.get_xdata()) > 100]
        assert outlines
        for outline in outlines:
            assert ax.get_xlim()[0] <= outline[:, 0].min() and outline[:, 0].max() <= ax.get_xlim()[1]
            assert ax.get_ylim()[0] <= outline[:, 1].min() and outline[:, 1].max() <= ax.get_ylim()[1]
    assert len(limits) == 1


def test_every_step_has_another_picture():
    steps = widgets.TheorySteps()
    pictures = set()
    for steps.moment.value in range(11):
        pictures |= {steps.plane.value, steps.bells.value}
    assert len(pictures) == 22


# --- one measurement at a time ---------------------------------------------------------------------------------------

def test_online_equals_kalman_filter():
    online = widgets.SmootherOnline()
    online.entry.value = "24,5"
    assert online.entry.value == ""             # ready for the next one, even the same
    online.entry.value = "24,5"
    online.play.value = 3
    online.play.value = 40
    z = np.concatenate(([24.5, 24.5], online.stream[:40]))
    result = kalman_filter(online.model, z)
    assert np.array_equal([row[1] for row in online.history], result.x[:, 0])
    assert np.array_equal([row[2] for row in online.history], result.P[:, 0, 0])
    for value in (result.K[-1, 0, 0], result.x[-1, 0]):
        assert f"{value:.6f}" in online.numbers.value


def test_online_refuses_words_and_resets():
    online = widgets.SmootherOnline()
    online.entry.value = "hangat"
    assert "bukan bilangan" in online.message.value and not online.history
    online.entry.value = "1"
    assert online.message.value == "" and len(online.history) == 1
    online.button.click()                       # nothing typed: nothing happens
    assert online.message.value == "" and len(online.history) == 1
    online.restart.click()
    assert not online.history and online.play.value == 0 and "Belum ada" in online.numbers.value


@pytest.mark.parametrize("seed", range(6))
def test_maximum_likelihood_of_steady_data_stays_in_the_range_of_the_fields(seed):
    form = widgets.SmootherForm(np.random.default_rng(seed).normal(5, 0.01, 100))
    form.likelihood.click()
    p = form.result[0]
    assert p.Q >= 1e-12 and p.R == pytest.approx(1e-4, rel=0.5)
    assert form.message.value == "" and form.result[3][-1] == pytest.approx(5, abs=0.01)


# --- chapter 3: the gyroscope ----------------------------------------------------------------------------------------

def gyro_run(seed=widgets.SEED, **changes):
    p = replace(gyro.Params(), **changes)
    flight = gyro.simulate(p, np.random.default_rng(seed))
    return flight, kalman_filter(gyro.model(p), flight.z, flight.u)


def outcome(board):
    """The numbers of the sentence: largest errors, RMSE of sensor and filter, share inside."""
    return [float(word.replace(",", ".")) for word in re.findall(r"\d+(?:[.,]\d+)?", board.sentence.value.split(">", 1)[1])]


def test_the_gyro_is_live_in_jupyter_and_static_in_the_book(monkeypatch):
    shown = []
    monkeypatch.setattr(widgets, "display", lambda data, raw: shown.append((data, raw)))
    assert widgets.gyro() is None
    (data, raw), = shown
    assert raw and "application/vnd.jupyter.widget-view+json" in data
    png = base64.b64decode(re.search(r'paper="gyro"><img alt="" src="data:image/png;base64,(.*?)">', data["text/html"])[1])
    assert png.startswith(b"\x89PNG") and 3_000 < len(png) < 60_000


def test_the_gyro_tells_the_filter_s_own_numbers():
    board = widgets.GyroFlight()
    for name, typed in dict(duration="8", T="0,05", sigma_w="2.5", sigma_v="0,3").items():
        getattr(board, name).value = typed
    flight, result = gyro_run(duration=8, T=0.05, sigma_w=2.5, sigma_v=0.3)
    errors = np.abs(flight.x - flight.z), np.abs(flight.x - result.x)
    expected = [error.max() for error in errors] + [np.sqrt(np.mean(error ** 2)) for error in errors]
    expected += [100 * np.mean(errors[1][:, 0] <= 2 * np.sqrt(result.P[:, 0, 0]))]
    assert outcome(board)[:4] == [float(f"{value:.3g}") for value in expected[:4]]
    assert float(f"{expected[4]:.3g}") in outcome(board) and board.message.value == ""
    cells = re.findall(r"<td>(.*?)</td>", board.table.value)
    assert cells[:4] == [f"{value:.4g}" for value in (result.K[0, 0, 0], result.K[-1, 0, 0], result.P[0, 0, 0], result.P[-1, 0, 0])]
    assert np.array_equal(board.rows[0]["x"], result.x[:, 0])


def test_the_map_of_a_wrong_sigma_and_500_runs():
    assert widgets.gyro_mismatch() is None
    board = widgets.GyroMismatch()
    for name, typed in dict(sigma_w="2,5", sigma_v="4", c_w="3", c_v="0,5").items():
        getattr(board, name).value = typed
    p, grid = gyro.Params(sigma_w=2.5, sigma_v=4), 10 ** np.linspace(-1, 1, 31)
    rmse_, nees_ = gyro.expected(p, grid * 2.5, grid[:, np.newaxis] * 4)
    assert board.tables["cost"] == pytest.approx(rmse_ / rmse_[15, 15]) and board.tables["nees"] == pytest.approx(nees_)
    many = gyro.simulate(p, np.random.default_rng(widgets.SEED), 500)
    told = kalman_filter(gyro.model(replace(p, sigma_w=7.5, sigma_v=2)), many.z, many.u)
    squares = (many.x - told.x)[:, 0] ** 2
    (wrong, scale), best = gyro.expected(p, 7.5, 2), gyro.expected(p, 2.5, 4)[0]
    numbers = [7.5, 2, 2.5, 4, wrong, wrong / best, best, scale, 500, widgets.SEED, np.sqrt(squares.mean()),
               np.mean(squares / told.P[:, 0, 0][:, np.newaxis])]
    assert outcome(board) == [float(f"{value:.3g}") for value in numbers] and board.message.value == ""
    before = board.sentence.value, *(screen.value for screen in board.maps.values())
    for name, typed, said in (("c_w", "11", "c_w = 11.0: yang diterima 0.1 sampai 10."), ("sigma_v", "0", "rad."), ("sigma_w", "x", "bukan bilangan")):
        kept = getattr(board, name).value
        getattr(board, name).value = typed
        assert said in board.message.value and (board.sentence.value, *(screen.value for screen in board.maps.values())) == before
        getattr(board, name).value = kept
    board.noise.click()
    assert board.sentence.value != before[0] and board.maps["nees"].value == before[2]          # the maps hold no noise
    board.truth.click()
    assert board.tables["nees"][15, 15] == pytest.approx(1) and "jujur" in board.sentence.value
    board.language.value = "en"
    assert "honest" in board.sentence.value and "believes" in text_of(board)


def test_new_noise_and_the_paper_s_figures():
    board = widgets.GyroFlight()
    before = board.sentence.value, board.angle.value, board.errors.value
    board.noise.click()
    assert all(now != then for now, then in zip((board.sentence.value, board.angle.value, board.errors.value), before))
    flight, result = gyro_run(seed=widgets.SEED + 1)
    assert outcome(board)[:2] == [float(f"{value:.3g}") for value in gyro.maxima(flight, result)]
    board.T.value = "0.5"
    for figure, (sigma_w, sigma_v) in gyro.CASES.items():
        board.figures[figure].click()
        assert [float(getattr(board, name).value) for name in board.FIELDS] == [20, 0.1, sigma_w, sigma_v]
        flight, result = gyro_run(seed=widgets.SEED + 1, sigma_w=sigma_w, sigma_v=sigma_v)
        assert outcome(board)[:2] == [float(f"{value:.3g}") for value in gyro.maxima(flight, result)]


@pytest.mark.parametrize("name, typed", [("T", "0"), ("sigma_v", "nan"), ("sigma_w", "abc"), ("duration", "1e9")])
def test_a_bad_setting_of_the_gyro_says_so_and_keeps_the_result(name, typed):
    board = widgets.GyroFlight()
    before = board.sentence.value
    getattr(board, name).value = typed
    said = board.message.value
    assert said and board.sentence.value == before
    board.language.value = "en"
    assert board.message.value and board.message.value != said
    getattr(board, name).value = "1"
    assert board.message.value == ""


@pytest.mark.parametrize("changes", [dict(duration="60", T="0.01"), dict(duration="1", T="1"),
                                     dict(sigma_w="0.0001", sigma_v="100"), dict(sigma_w="100", sigma_v="0.0001")])
def test_the_gyro_at_the_ends_of_its_sliders(changes):
    board = widgets.GyroFlight()
    for name, typed in changes.items():
        getattr(board, name).value = typed
    assert board.message.value == "" and "nan" not in board.sentence.value and len(board.angle.value) < 60_000


def test_the_gyro_speaks_one_language_at_a_time():
    board = widgets.GyroFlight()
    for language, other in (("en", "id"), ("id", "en")):
        board.language.value = language
        shown = text_of(board)
        for key, word in board.words.items():
            pieces = [piece for piece in re.split(r"\{\w+\}", word[other]) if len(piece.strip(" .:(),%m")) > 3]
            for piece in pieces:
                if not any(piece in mine[language] for mine in board.words.values()):
                    assert piece not in shown, (key, piece)
            assert word["id"] != word["en"] and all(word.values())
            assert len({tuple(sorted(re.findall(r"\{\w+\}", word[each]))) for each in LANGUAGES}) == 1


# --- chapter 5: the beetle -------------------------------------------------------------------------------------------

def beetle_result(**changes):
    p = replace(beetle.Params(), **changes)
    walk = beetle.simulate(p, np.random.default_rng(widgets.SEED), round(20 / p.dt))
    return p, walk, kalman_filter(beetle.model(p), walk.z)


def test_beetle_is_one_output_live_in_jupyter_and_static_in_the_book(monkeypatch):
    shown = []
    monkeypatch.setattr(widgets, "display", lambda data, raw: shown.append(data))
    assert widgets.beetle() is None
    assert '<kalman-explorer paper="beetle"><img' in shown[0]["text/html"]
    assert "application/vnd.jupyter.widget-view+json" in shown[0]


@pytest.mark.parametrize("R", ["0.05", "0.001", "0.1", "0.08"])
def test_beetle_offers_the_four_R_of_the_source(R):
    board = widgets.Beetle()
    board.printed.value = float(R)
    assert board.R.value == R and board.current[0].R == float(R) and board.message.value == ""
    assert board.current[2].x == pytest.approx(beetle_result(R=float(R))[2].x, rel=1e-12)
    board.R.value = "0,2"
    assert board.printed.value is None and board.current[0].R == 0.2


@pytest.mark.parametrize("name, value", [("dt", 0.1), ("theta", -0.3), ("v", 1.5), ("theta0", 0.0), ("v0", 3.0)])
def test_every_slider_of_the_beetle_reaches_the_filter_and_the_pictures(name, value):
    board = widgets.Beetle()
    before = board.plot.value, board.spread.value, board.sentence.value
    board.sliders[name].value = value
    p, walk, result = beetle_result(**{name: value})
    assert board.current[0] == p and np.array_equal(board.current[2].x, result.x)
    assert board.sentence.value != before[2] and board.plot.value != before[0]
    assert f"{walk.x[-1, 0]:.3g}".replace(".", ",") in board.sentence.value
    board.restart.click()
    assert (board.plot.value, board.spread.value, board.sentence.value) == before


def test_beetle_says_what_was_learnt_and_whether_R_fits():
    board = widgets.Beetle(beetle.Params(theta0=0))
    board.language.value = "en"
    assert "For θ it states 0 rad" in board.sentence.value and "100 %" in board.sentence.value    # a guess of 0 never moves
    for R, words in (("0.001", "above the 95 % band"), ("1", "below the 95 % band"), ("0.05", "inside the 95 % band")):
        board.R.value = R
        assert words in board.sentence.value
    board.R.value = "x"
    assert "is not a number" in board.message.value


def test_beetle_new_noise_and_both_languages():
    board = widgets.Beetle()
    first = board.current[1].z
    board.noise.click()
    assert not np.array_equal(board.current[1].z, first) and f"benih acak {widgets.SEED + 1}" in board.sentence.value
    seen = {}
    for language in ("en", "id"):
        board.language.value = language
        seen[language] = text_of(board)
    for key, word in board.words.items():
        assert word["id"] != word["en"] and all(word[language].strip() for language in LANGUAGES), key
        assert len({tuple(sorted(re.findall(r"\{\w+\}", word[language]))) for language in LANGUAGES}) == 1, key
    assert "synthetic" not in seen["id"] and "sintetis" not in seen["en"] and "random seed" in seen["en"]


# --- chapter 4: the towing run ---------------------------------------------------------------------------------------

def drawn(board):
    """(t, z, truth, what) and (Params, x, NIS, sampling) of what the widget shows."""
    return board.data, board.result


def pasted(t, z):
    return "t;v\n" + "\n".join(f"{a:.10g};{b:.10g}" for a, b in zip(t, z))


def test_the_ship_s_output_is_live_in_jupyter_and_static_in_the_book(monkeypatch):
    shown = []
    monkeypatch.setattr(widgets, "display", lambda data, raw: shown.append((data, raw)))
    assert widgets.ship() is None
    (data, raw), = shown
    assert raw and "application/vnd.jupyter.widget-view+json" in data
    match = re.fullmatch(r'<kalman-explorer paper="ship"><img alt="" src="data:image/png;base64,(.*?)"></kalman-explorer>',
                         data["text/html"])
    png = base64.b64decode(match[1])
    assert png.startswith(b"\x89PNG") and 3_000 < len(png) < 60_000


def test_the_ship_shows_the_source_s_filter_of_the_synthetic_run():
    board = widgets.ShipRun()
    t, run = ship.towing_run(np.random.default_rng(widgets.SEED))
    p = ship.fitted(run.z[:, 0], ship.Params())
    x = kalman_filter(ship.model(p), run.z, u=np.ones(len(run.z))).x[:, 0]
    assert np.abs(drawn(board)[1][1] - x).max() < 1e-12
    assert f"{p.a1:.4g}".replace(".", ",") in board.sentence.value and "tidak seragam" not in board.note.value
    assert f"{rmse(run.x[:, 0], x):.3g}".replace(".", ",") in board.sentence.value


def test_the_ship_s_sliders_and_buttons():
    board = widgets.ShipRun()
    before = drawn(board)
    board.R.value = "0,1"
    assert drawn(board)[1][0].R == 0.1 and drawn(board)[0][1] is before[0][1]
    board.Q.value = "0.001"
    assert drawn(board)[1][0].Q == drawn(board)[1][0].Q_copy == 0.001
    board.sigma.value = 0.0
    t, z, truth, _ = drawn(board)[0]
    assert np.array_equal(z, truth) and abs(drawn(board)[1][0].a1 - 1.998) < 0.001
    picture = board.circle.value
    board.sigma.value = 0.2
    assert board.circle.value != picture and np.std(drawn(board)[0][1] - truth) == pytest.approx(0.2, rel=0.15)
    z = drawn(board)[0][1]
    board.new.click()
    assert (drawn(board)[0][1] != z).any() and str(widgets.SEED + 1) in board.note.value
    board.first.value = True
    assert drawn(board)[1][0].x0 == drawn(board)[0][1][0] and board.message.value == ""


def test_the_ship_s_smoother_is_rts_smooth():
    board = widgets.ShipRun()
    board.smooth.value = True
    (_, z, _, _), (p, x, _, _) = drawn(board)
    assert np.array_equal(x, rts_smooth(kalman_filter(ship.model(p), z, u=np.ones(len(z)))).x[:, 0])


def corners(svg):
    """Left, right, top and bottom of the longest line of a drawing, in its own units."""
    longest = max(re.findall(r'd="(M[^"HVhz]*)"', svg), key=len)
    x, y = np.array(re.findall(r"-?[\d.]+", longest), dtype=float).reshape(-1, 2).T
    return x.min(), x.max(), y.min(), y.max()


def test_the_unit_circle_is_round_and_stays_so():
    board = widgets.ShipRun()
    board.new.click()
    left, right, top, bottom = corners(board.circle.value)
    assert right - left == pytest.approx(bottom - top, abs=0.2) and right - left > 100


def test_a_reader_s_towing_file_in_other_units():
    t, run = ship.towing_run(np.random.default_rng(1))
    knots = run.z[:, 0] / (1852 / 3600)
    board = widgets.ShipRun()
    board.time_unit.value, board.speed_unit.value = "ms", "kn"
    upload(board, "run.csv", pasted(1000 * t, knots).replace(".", ",").encode())
    shown = drawn(board)[0]
    assert shown[0] == pytest.approx(t) and shown[1] == pytest.approx(run.z[:, 0]) and shown[2] is None
    assert board.source.value == "file" and board.message.value == "" and board.first.value
    assert "seragam, 0,1 s" in board.note.value and "RMSE" not in board.sentence.value
    board.sigma.value = 0.05                    # back to the synthetic run, which starts at rest
    assert board.source.value == "synthetic" and not board.first.value and drawn(board)[1][0].x0 == 0


def test_uneven_sampling_is_told_in_one_sentence_in_both_languages():
    t, run = ship.towing_run(np.random.default_rng(1))
    keep = np.r_[0:100, 105:300]
    board = widgets.ShipRun()
    board.text.value = pasted(t[keep], run.z[keep, 0])
    assert ship.sampling(t[keep]).id in board.note.value and "tidak seragam" in board.note.value
    board.language.value = "en"
    assert ship.sampling(t[keep]).en in board.note.value and "unevenly" in board.note.value


@pytest.mark.parametrize("text, id, en", [
    ("1\n2\n3\n4\n5\n6", "dua kolom", "Two columns"), ("t;v\n0;1\n1;2\n1;3\n2;4\n3;5", "tidak bertambah", "not increase"),
    ("t;v\n" + "\n".join(f"{k};1" for k in range(9)), "satu garis lurus", "on a line"), ("word", "bilangan", "numbers")])
def test_a_towing_file_that_cannot_be_used_keeps_the_plot(text, id, en):
    board = widgets.ShipRun()
    before = board.plot.value, board.note.value, board.sentence.value
    board.text.value = text
    assert id in board.message.value and (board.plot.value, board.note.value, board.sentence.value) == before
    board.language.value = "en"
    assert en in board.message.value


def test_choosing_among_several_columns_and_gaps():
    t, run = ship.towing_run(np.random.default_rng(3))
    lines = ["run;t;v"] + [f"7;{a:.1f};{'' if k == 40 else f'{b:.4f}'}" for k, (a, b) in enumerate(zip(t, run.z[:, 0]))]
    board = widgets.ShipRun()
    board.text.value = "\n".join(lines)
    assert "tidak bertambah" in board.message.value             # the first two columns are the wrong ones
    board.quiet, board.time.value, board.quiet = True, "t", False
    board.speed.value = "v"
    assert board.message.value == "" and np.isnan(drawn(board)[0][1][40]) and "1 kecepatan kosong" in board.note.value
    board.speed.value = "t"
    assert "berbeda" in board.message.value


def test_the_ship_s_words_exist_in_both_languages_and_switching_leaves_none_of_the_other():
    board = widgets.ShipRun()
    t, run = ship.towing_run(np.random.default_rng(1))
    for text in (None, pasted(np.delete(t, 50), np.delete(run.z[:, 0], 50)), "word"):
        if text:
            board.text.value = text
        seen = {}
        for board.language.value in LANGUAGES:
            seen[board.language.value] = text_of(board)
        for key, word in board.words.items():
            for language, other in (("id", "en"), ("en", "id")):
                assert word[language].strip() and (word["id"] != word["en"] or key == "source"), key
                for piece in (piece for piece in re.split(r"\{\w+\}", word[other]) if len(piece.strip(" .:(),%m/s")) > 3):
                    if not any(piece in mine[language] for mine in board.words.values()):
                        assert piece not in seen[language], (key, language, piece)


def test_a_long_towing_file_stays_quick_and_refuses_only_the_smoother():
    z = np.random.default_rng(0).normal(size=20_000).cumsum()
    board = widgets.ShipRun()
    board.text.value = pasted(np.arange(20_000), z)
    assert board.message.value == "" and len(drawn(board)[1][1]) == 20_000
    assert len(board.plot.value) < 60_000
    board.smooth.value = True
    assert "5000" in board.message.value


# --- chapter 6: the quadrotor ----------------------------------------------------------------------------------------

@pytest.fixture(scope="module")
def quick():
    """Params of a flight with few samples."""
    return quadrotor.Params(dt=0.1)


def test_the_quadrotor_is_one_output_live_in_jupyter_and_static_in_the_book(monkeypatch, quick):
    shown = []
    monkeypatch.setattr(widgets, "display", lambda data, raw: shown.append(data))
    assert widgets.quadrotor(quick) is None
    assert '<kalman-explorer paper="quadrotor"><img' in shown[0]["text/html"]
    assert "application/vnd.jupyter.widget-view+json" in shown[0]


def test_the_quadrotor_shows_what_attitude_computes(quick):
    board = widgets.Quadrotor(quick)
    flight = quadrotor.simulate(quick, np.random.default_rng(widgets.SEED))
    how = quadrotor.METHODS["paper"]
    assert np.array_equal(board.result.angles, quadrotor.attitude(*flight.sensors, how).angles)
    board.m.value, board.q.value, board.window.value, board.threshold.value = "0,16", "1", 2.0, 10.0
    changed = replace(how, m=0.16, q=quadrotor.DEG ** 2, window=2.0, threshold=10.0)
    expected = quadrotor.attitude(*flight.sensors, changed).angles
    assert np.allclose(board.result.angles, expected, atol=1e-12)
    roll = quadrotor.rmse_deg(flight.truth, expected)[0]
    assert f"roll {roll:.2f}".replace(".", ",") in board.sentence.value
    for method in ("adaptive", "literal"):
        board.method.value = method
        kept = quadrotor.METHODS[method]
        expected = kept if kept.kept else replace(kept, m=0.16, q=quadrotor.DEG ** 2, window=2.0, threshold=10.0)
        assert np.array_equal(board.result.angles, quadrotor.attitude(*flight.sensors, expected).angles)
    board.restart.click()
    assert np.array_equal(board.result.angles, quadrotor.attitude(*flight.sensors, how).angles)
    board.noise.click()
    assert str(widgets.SEED + 1) in board.sentence.value and board.message.value == ""


def test_the_quadrotor_s_sensors_can_be_switched_off(quick):
    board = widgets.Quadrotor(quick)
    t, gyr, acc, mag, rest_s = quadrotor.simulate(quick, np.random.default_rng(widgets.SEED)).sensors
    how = quadrotor.METHODS["paper"]
    for name, sensors in (("gyr", (np.zeros_like(gyr), acc, mag)), ("acc", (gyr, None, mag)), ("mag", (gyr, acc, None))):
        board.sensors[name].value = False
        assert np.array_equal(board.result.angles, quadrotor.attitude(t, *sensors, rest_s, how).angles)
        board.sensors[name].value = True
    assert "nan" not in board.sentence.value


def test_the_craft_turns_with_the_moment(quick):
    board = widgets.Quadrotor(quick)
    before = board.craft.value
    board.moment.value = 65.0
    assert board.craft.value != before and list(board.moments(65))[0] == "65 s"


def phone_file(seconds, rest=4.0):
    """A made-up phone export, one file: the phone lies still and then turns about its z axis."""
    t = np.arange(0, seconds, 0.05)
    turn = np.where(t < rest, 0, 0.5)
    noise = np.random.default_rng(0).normal(size=(2, len(t))) * 1e-3
    rows = [f"{a:.2f},0,0,{b:.4f},0,0,{c:.4f},20,0,-30" for a, b, c in zip(t, turn + noise[0], 9.81 + noise[1])]
    names = ["Time (s)"] + [f"{sensor} {axis} ({unit})" for sensor, unit in (
        ("Gyroscope", "rad/s"), ("Acceleration", "m/s^2"), ("Magnetic Field", "µT")) for axis in "xyz"]
    return "\n".join([",".join(names), *rows]).encode()


def test_a_phone_recording_in_the_quadrotor_and_what_it_lacks(quick):
    board = widgets.Quadrotor(quick)
    before = board.sentence.value
    board.source.value = "file"
    assert "Belum ada rekaman" in board.message.value and board.sentence.value == before
    upload(board, "phone.csv", b"Time (s);Gyroscope x (rad/s)\n0;1\n")
    assert board.message.value and board.sentence.value == before
    upload(board, "phone.csv", phone_file(12))
    assert board.message.value == "" and "tidak memuat sudut pembanding" in board.sentence.value
    assert board.result.angles.shape[0] == 240 and board.moment.max == pytest.approx(11.95)
    upload(board, "moving.csv", phone_file(12, rest=0))
    assert "tidak diawali keadaan diam" in board.message.value and board.result.angles.shape[0] == 240
    board.language.value = "en"
    assert "does not begin at rest" in board.message.value and "no reference" in board.sentence.value


def test_the_quadrotor_s_words_exist_in_both_languages(quick):
    board = widgets.Quadrotor(quick)
    for key, word in board.words.items():
        assert word["id"].strip() and word["en"].strip() and (word["id"] != word["en"] or key in ("source", "mag")), key
    board.language.value = "en"
    text = text_of(board)
    for key, word in board.words.items():
        pieces = [piece for piece in re.split(r"\{\w+\}", word["id"]) if len(piece.strip(" .:(),%°")) > 6]
        assert not [piece for piece in pieces if piece in text and piece not in word["en"]], key
