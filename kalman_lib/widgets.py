"""The live parts of the notebooks: sliders, buttons and tables that answer at once. Alone imports ipywidgets.

Every public function shows one widget. Every widget is a Board: it speaks both languages, and an error inside it
becomes a sentence on its message line instead of vanishing.
"""
import base64
import io
import math
import warnings
from dataclasses import replace
from html import escape

import ipywidgets as widgets
import numpy as np
from IPython.display import display

from . import plots
from .fast import kalman_filter, rts_smooth
from .filters import predict, update
from .metrics import chi2_bounds, nis, rmse
from .papers import beetle as beetle_paper
from .papers import describe, smoother, theory
from .papers import gyro as gyro_paper
from .papers import quadrotor as quadrotor_paper
from .papers import ship as ship_paper
from .recording import read_recording, rest_seconds
from .spreadsheet import InputError, read_file, read_text, write_workbook

SEED = 2                    # of every synthetic measurement in this room
TABLE_ROWS = 1000           # a longer table shows its beginning and its end
PLOT_POINTS = 3000          # a longer series is drawn with every second, third, ... value
LIKELIHOOD_POINTS = 5000    # maximum likelihood looks at no more values than this


def theory_steps(p=None):
    """Chapter 1: walk through prediction and update one by one. p is a theory.Params or None."""
    board = TheorySteps(p)
    board.moment.value = 2
    show(board.view, "theory", board.ellipses())
    board.moment.value = 0


def smoother_form(z=None, p=None):
    """Chapter 2: the paper's Excel form. z (T,) is offered as data beside the built-in ones; p a smoother.Params."""
    board = SmootherForm(z, p)
    show(board.view, "smoother", board.figure())


def smoother_online(p=None):
    """Chapter 2: one measurement at a time. p is a smoother.Params or None."""
    board = SmootherOnline(p)
    board.add(*board.stream[:60])
    show(board.view, "smoother", board.figure(), view="online")
    board.reset()


def gyro(p=None):
    """Chapter 3: the paper's simulation with sliders for its four inputs. p is a gyro.Params or None."""
    board = GyroFlight(p)
    show(board.view, "gyro", plots.panels(board.rows, xlabel="$t$ (s)", height=1.9))


def gyro_mismatch(p=None):
    """Chapter 3: what it costs when the filter believes the wrong sigmas. p is a gyro.Params, the truth, or None."""
    board = GyroMismatch(p)
    show(board.view, "gyro", board.figure(), view="mismatch")


def beetle(p=None):
    """Chapter 5: the beetle's R, time step, and true and believed direction and speed. p is a beetle.Params or None."""
    board = Beetle(p)
    show(board.view, "beetle", board.figure())


def ship(p=None):
    """Chapter 4: the source's AR(2) filter on a towing run or on the reader's own file. p is a ship.Params or None."""
    board = ShipRun(p)
    show(board.view, "ship", board.figure())


def quadrotor(p=None):
    """Chapter 6: the attitude filter on a synthetic flight or on the reader's own recording. p a quadrotor.Params."""
    board = Quadrotor(p)
    show(board.view, "quadrotor", board.picture())


def show(widget, paper, figure, view=None):
    """Display one output that is live in Jupyter and, in the built book, the figure inside <kalman-explorer>.

    view names one of the paper's explorers where it has several (book/explorers/papers/<paper>.js)."""
    data = widget._repr_mimebundle_()
    png = base64.b64encode(figure.png(dpi=150)).decode()
    data["text/plain"] = f"[{paper}]"
    chosen = f' view="{view}"' if view else ""
    data["text/html"] = (f'<kalman-explorer paper="{paper}"{chosen}><img alt="" src="data:image/png;base64,{png}">'
                         "</kalman-explorer>")
    display(data, raw=True)


# --- what all widgets share ------------------------------------------------------------------------------------------

def number(text):
    """What was typed, with decimal comma or point, as a finite number; InputError if it is none."""
    try:
        value = float(text.strip().replace(",", "."))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{text[:40]!r} is not a number.", f"{text[:40]!r} bukan bilangan.")
    return value


class Board:
    """The base of every widget: its words in two languages, a message line, callbacks that cannot fail silently.

    A subclass lists its words, key -> {"id", "en"}, puts them on its parts with `label` and `choices`, and writes
    every text that depends on numbers in `redraw`, which also runs when the language changes.
    """
    words = {}

    def __init__(self):
        self.language = widgets.ToggleButtons(options=[("Bahasa Indonesia", "id"), ("English", "en")],
                                              style={"button_width": "auto"})
        self.message = widgets.HTML()
        self.said = None                # what the message line says, {"id", "en"} or None
        self.quiet = False              # while True, no callback runs
        self.places = []                # functions that write a word where it belongs
        self.on(self.language, self.translate)

    def say(self, key, **values):
        """The word or sentence `key` in the current language, with the values filled in."""
        return self.words[key][self.language.value].format(**values)

    def decimal(self, value, digits=4):
        """A number for a sentence: with decimal comma in Indonesian."""
        text = f"{value:.{digits}g}".replace("-", "\u2212")
        return text.replace(".", ",") if self.language.value == "id" else text

    def label(self, part, key, trait="description"):
        """Write the word `key` on a part, now and whenever the language changes. Returns the part."""
        def write():
            setattr(part, trait, self.say(key))
        self.places.append(write)
        write()
        return part

    def under(self, key, part):
        """The part below the word `key`."""
        return widgets.VBox([self.label(widgets.Label(), key, "value"), part])

    def choices(self, part, keys):
        """Offer the words `keys` as the options of a dropdown, each standing for its own key. Returns the part."""
        def write():
            value = part.value
            part.options = [(self.say(key), key) for key in keys]
            part.value = value or keys[0]
        self.places.append(write)
        write()
        return part

    def on(self, part, react, trait="value"):
        """Run react() when a button is clicked or a value changes; an error becomes the message."""
        def safely(_):
            if self.quiet:
                return
            try:
                if part is not self.language:
                    self.tell(None)
                react()
            except Exception as error:          # whatever it is, the reader must see it
                self.tell(error)
        if isinstance(part, widgets.Button):
            part.on_click(safely)
        else:
            part.observe(safely, trait)

    def tell(self, message):
        """Put a message on its line: {"id", "en"}, an exception, or None for none."""
        if isinstance(message, InputError):
            message = {"id": message.id, "en": message.en}
        elif isinstance(message, Exception):    # our own ones say "English. / Indonesian."
            en, _, id = (str(message) or repr(message)).partition(" / ")
            message = {"id": id or en, "en": en}
        self.said = message
        self.message.value = "" if message is None else (
            f'<p role="status" style="margin:0;color:#b3261e;line-height:1.4">{escape(message[self.language.value])}</p>')

    def translate(self):
        self.quiet = True
        for write in self.places:
            write()
        self.quiet = False
        self.tell(self.said)
        self.redraw()

    def log_field(self, name, meta, value):
        """A log slider and a text field for one number -> (text, row); the text counts, the slider follows it."""
        self.words = {**self.words, name: {"id": f"{name}, {meta['id']}", "en": f"{name}, {meta['en']}"}}
        low, high = math.log10(meta["min"]), math.log10(meta["max"])
        text = widgets.Text(f"{value:.12g}", continuous_update=False, layout=widgets.Layout(width="7.5em"))
        slider = widgets.FloatLogSlider(value, min=low, max=high, step=0.05, readout=False,
                                        layout=widgets.Layout(width="10em"))

        def typed():                    # what the slider should show; None where the text is no number
            try:
                return min(max(number(text.value), meta["min"]), meta["max"])
            except InputError:
                return None

        def far():                      # by more than half a step, to which the browser rounds the slider
            return typed() is None or abs(math.log10(typed() / slider.value)) > 0.0251

        def follow(_):
            if typed() is not None and far():
                slider.value = typed()

        def lead():
            if far():
                text.value = f"{slider.value:.3g}"

        text.observe(follow, "value")
        self.on(slider, lead)
        return text, widgets.VBox([self.label(widgets.Label(), name, "value"), widgets.HBox([slider, text])])


class Screen(widgets.HTML):
    """A place for a drawing that is quick to renew."""

    def draw(self, make):
        """Show what make() returns, a figure of plots.py, as a sketch."""
        with plots.live():
            self.value = make().svg()


def _row(*parts):
    """Parts beside each other, which wrap where the page is narrow."""
    return widgets.HBox(parts, layout=widgets.Layout(flex_flow="row wrap", align_items="flex-end", grid_gap="4px 12px"))


def _wide(part):
    """Give a part the width of its words."""
    part.layout.width = "auto"
    if hasattr(part.style, "description_width"):
        part.style.description_width = "initial"
    return part


class OwnData(Board):
    """A board whose reader may bring data: a text field to paste into, a file upload, and the decimal sign.

    A subclass has the Dropdown `source` with "text" and "file" among its choices, the words "text" and "paste", and
    `load(source=None)`, which fetches what the source says.
    """
    words = {
        "source": {"id": "Data", "en": "Data"},
        "file": {"id": "berkas yang diunggah", "en": "uploaded file"},
        "upload": {"id": "Unggah CSV atau Excel", "en": "Upload CSV or Excel"},
        "decimal": {"id": "Tanda desimal", "en": "Decimal sign"},
        "auto": {"id": "kenali sendiri", "en": "find out"},
        ",": {"id": "koma (1,5)", "en": "comma (1,5)"},
        ".": {"id": "titik (1.5)", "en": "point (1.5)"},
        "no_file": {"id": "Belum ada berkas yang diunggah.", "en": "No file has been uploaded yet."},
    }

    def own_data_parts(self):
        self.text = self.label(widgets.Textarea(rows=3, layout=widgets.Layout(width="100%")), "paste", "placeholder")
        self.upload = _wide(self.label(widgets.FileUpload(accept=".csv,.txt,.tsv,.xlsx"), "upload"))
        self.sign = _wide(self.choices(self.label(widgets.Dropdown(), "decimal"), ["auto", ",", "."]))

    def load_own_data_on_change(self):
        for part in (self.source, self.sign):
            self.on(part, self.load)
        self.on(self.text, lambda: self.load("text"))
        self.on(self.upload, lambda: self.load("file"))

    def read_own_data(self):
        """The Table of the pasted text or of the uploaded file, whichever the source says."""
        sign = None if self.sign.value == "auto" else self.sign.value
        if self.source.value == "text":
            return read_text(self.text.value, sign)
        if not self.upload.value:
            raise InputError(self.words["no_file"]["en"], self.words["no_file"]["id"])
        upload = self.upload.value[0]
        return read_file(upload["name"], bytes(upload["content"]), sign)


# --- chapter 1 -------------------------------------------------------------------------------------------------------

class TheorySteps(Board):
    """Moments 0 (start), 1 (prediction of step 1), 2 (update of step 1), 3, 4 ... of the worked example."""
    STEPS = 5                       # then the car, which brakes with 2 m/s2 from 5 m/s, stands still
    words = {
        "back": {"id": "Sebelumnya", "en": "Previous"},
        "next": {"id": "Berikutnya", "en": "Next"},
        "reset": {"id": "Ulang dari awal", "en": "Start again"},
        "z": {"id": "z, posisi terukur pada langkah ini (m)", "en": "z, measured position at this step (m)"},
        "title 0": {"id": "Awal", "en": "Start"},
        "title 1": {"id": "Langkah {k} dari {of}: prediksi", "en": "Step {k} of {of}: prediction"},
        "title 2": {"id": "Langkah {k} dari {of}: pembaruan", "en": "Step {k} of {of}: update"},
        "text 0": {"id": "Sebelum pengukuran pertama, mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s; "
                         "simpangan bakunya {sx} m dan {sv} m/s.",
                   "en": "Before the first measurement the car is believed to be at {x} m with a velocity of {v} m/s; "
                         "the standard deviations are {sx} m and {sv} m/s."},
        "text 1": {"id": "Prediksi: {dt} s kemudian mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s. "
                         "Simpangan baku posisi berubah dari {before} m menjadi {sx} m.",
                   "en": "Prediction: {dt} s later the car is expected at {x} m with a velocity of {v} m/s. "
                         "The standard deviation of the position goes from {before} m to {sx} m."},
        "text 2": {"id": "Pembaruan: K = {K}: {percent} % dari selisih {y} m antara pengukuran dan prediksi diterima. "
                         "Simpangan baku posisi berubah dari {before} m menjadi {sx} m. {origin}",
                   "en": "Update: K = {K}: {percent} % of the difference of {y} m between measurement and prediction is "
                         "accepted. The standard deviation of the position goes from {before} m to {sx} m. {origin}"},
        "source": {"id": "Pengukuran ini dari contoh pada sumber.", "en": "This measurement comes from the source."},
        "synthetic": {"id": "Pengukuran ini sintetis (benih acak {seed}).",
                      "en": "This measurement is synthetic (random seed {seed})."},
        "yours": {"id": "Pengukuran ini pilihan Anda.", "en": "This measurement is your choice."},
    }

    def __init__(self, p=None):
        super().__init__()
        self.p = p or theory.Params()
        drive = theory.simulate(self.p, np.random.default_rng(SEED), self.STEPS)
        self.given = np.concatenate(([self.p.z], drive.z[1:, 0].round(1)))
        self.z = self.given.copy()
        meta = describe(theory.Params)
        self.Q, row_Q = self.log_field("Q", meta["Q"], self.p.Q)
        self.R, row_R = self.log_field("R", meta["R"], self.p.R)
        self.moment = widgets.IntSlider(0, 0, 2 * self.STEPS, readout=False, layout=widgets.Layout(width="12em"))
        self.back, self.next, self.restart = (_wide(self.label(widgets.Button(), key)) for key in ("back", "next", "reset"))
        self.measured = widgets.FloatSlider(
            self.z[0], min=min(meta["z"]["min"], self.z.min() - 3), max=max(meta["z"]["max"], self.z.max() + 3),
            step=meta["z"]["step"], readout_format=".1f", layout=widgets.Layout(width="24em"))
        self.equations = widgets.HTMLMath(layout=widgets.Layout(width="100%", overflow="auto", min_height="15em"))
        self.sentence = widgets.HTML(layout=widgets.Layout(width="98%", min_height="4.5em"))
        self.plane, self.bells = Screen(), Screen()
        self.steps = self.walk()
        self.usual = self.boxes(self.steps)
        self.view = widgets.VBox([
            self.language,
            _row(self.back, self.next, self.restart, self.moment),
            _row(row_Q, row_R, widgets.VBox([self.label(widgets.Label(), "z", "value"), self.measured])),
            self.message, self.sentence,
            widgets.HBox([widgets.VBox([self.plane, self.bells], layout=widgets.Layout(flex="1 1 320px")),
                          widgets.VBox([self.equations], layout=widgets.Layout(flex="1 1 400px", min_width="0"))],
                         layout=widgets.Layout(flex_flow="row wrap", align_items="flex-start")),
        ], layout=widgets.Layout(width="98%"))
        self.on(self.back, lambda: self.go(self.moment.value - 1))
        self.on(self.next, lambda: self.go(self.moment.value + 1))
        self.on(self.restart, self.reset)
        self.on(self.measured, self.measure)
        self.on(self.moment, self.redraw)
        for part in (self.Q, self.R):
            self.on(part, self.calculate)
        self.redraw()

    def go(self, moment):
        self.moment.value = min(max(moment, 0), self.moment.max)

    def reset(self):
        self.quiet = True
        self.z, self.moment.value = self.given.copy(), 0
        self.Q.value, self.R.value = f"{self.p.Q:.12g}", f"{self.p.R:.12g}"
        self.quiet = False
        self.calculate()

    def calculate(self):
        """Run the filter again, then show the current moment."""
        self.steps = self.walk()
        self.redraw()

    def measure(self):
        """The slider of the measurement was moved."""
        k = (self.moment.value + 1) // 2
        if k and self.z[k - 1] != self.measured.value:
            self.z[k - 1] = self.measured.value
            self.calculate()

    def walk(self):
        """The whole filter run with the current settings: for every step (x, P) before it, Prediction, Update."""
        self.model = theory.model(replace(self.p, Q=number(self.Q.value), R=number(self.R.value)))
        x, P, steps = self.model.x0, self.model.P0, []
        for z in self.z:
            prediction = predict(self.model, x, P, np.array([self.p.u]))
            updated = update(self.model, prediction.x_pred, prediction.P_pred, np.array([z]))
            steps.append(((x, P), prediction, updated))
            x, P = updated.x, updated.P
        return steps

    def boxes(self, steps):
        """The corners ((p, v) lowest, (p, v) highest) of what holds every ellipse and measurement, with some room."""
        beliefs = [steps[0][0]] + [(a.x_pred, a.P_pred) for _, a, _ in steps] + [(b.x, b.P) for _, _, b in steps]
        centres = np.array([x for x, _ in beliefs])
        reach = 2.5 * np.sqrt([np.diag(P) for _, P in beliefs])
        low, high = (centres - reach).min(axis=0), (centres + reach).max(axis=0)
        low[0], high[0] = min(low[0], self.z.min() - 0.5), max(high[0], self.z.max() + 0.5)
        return low, high

    def redraw(self):
        moment = self.moment.value
        steps = self.steps
        k, kind = (moment + 1) // 2, 0 if moment == 0 else 2 - moment % 2
        (x, P), prediction, updated = steps[max(k - 1, 0)]
        belief = [(x, P), (prediction.x_pred, prediction.P_pred), (updated.x, updated.P)][kind]
        low, high = zip(self.usual, self.boxes(steps))
        self.limits = np.array([2 * np.floor(np.min(low, axis=0) / 2), 2 * np.ceil(np.max(high, axis=0) / 2)])
        self.current = k, kind, steps[max(k - 1, 0)]
        self.plane.draw(self.ellipses)
        self.bells.draw(self.gaussians)
        self.equations.value = self.filled_in()
        before = (P, P, prediction.P_pred)[kind]
        gain, y = updated.K[0, 0], updated.y[0]
        at_z = self.z[max(k - 1, 0)]
        origin = "yours" if at_z != self.given[max(k - 1, 0)] else "source" if k == 1 else "synthetic"
        numbers = dict(x=belief[0][0], v=belief[0][1], sx=math.sqrt(belief[1][0, 0]), sv=math.sqrt(belief[1][1, 1]),
                       before=math.sqrt(before[0, 0]), K=gain, y=y, dt=self.p.dt)
        numbers = {name: self.decimal(value, 3) for name, value in numbers.items()}
        self.sentence.value = (
            f'<p style="line-height:1.5"><b>{self.say(f"title {kind}", k=k, of=self.STEPS)}</b><br>'
            + self.say(f"text {kind}", percent=self.decimal(100 * gain, 2), origin=self.say(origin, seed=SEED), **numbers)
            + "</p>")
        self.quiet = True
        self.measured.value, self.measured.disabled = at_z, kind != 2
        self.quiet = False
        self.back.disabled, self.next.disabled = moment == 0, moment == self.moment.max

    def ellipses(self):
        """The figure of the current moment in the plane of position and velocity."""
        k, kind, (before, prediction, updated) = self.current
        shown = {f"$x_{{{max(k - 1, 0)}}}$": (*before, plots.ESTIMATE)} if kind < 2 else {}
        if kind:
            shown[f"$x_{{\\mathrm{{pred}},{k}}}$"] = (prediction.x_pred, prediction.P_pred, plots.PREDICTION)
        if kind == 2:
            shown[f"$x_{{{k}}}$"] = (updated.x, updated.P, plots.ESTIMATE)
        z = dict(z=self.z[k - 1], R=self.model.R[0, 0]) if kind == 2 else {}
        (x_low, v_low), (x_high, v_high) = self.limits
        return plots.ellipses(shown, **z, limits=((x_low, x_high), (v_low, v_high)))

    def gaussians(self):
        """The figure of the current moment for the position alone, above the same axis as the ellipses."""
        k, kind, (before, prediction, updated) = self.current
        curves = {f"$x_{{{max(k - 1, 0)}}}$": (before[0][0], before[1][0, 0], plots.ESTIMATE)} if kind < 2 else {}
        if kind:
            curves[f"$x_{{\\mathrm{{pred}},{k}}}$"] = (prediction.x_pred[0], prediction.P_pred[0, 0], plots.PREDICTION)
        if kind == 2:
            curves["$z$"] = (self.z[k - 1], self.model.R[0, 0], plots.MEASUREMENT)
            curves[f"$x_{{{k}}}$"] = (updated.x[0], updated.P[0, 0], plots.ESTIMATE)
        figure = plots.gaussians(curves, xlabel="$p$ (m)", height=2.2)
        highest = max(1 / math.sqrt(2 * math.pi * variance) for _, variance, _ in curves.values())
        figure.axes[0].set(ylabel="$f(p)$", xlim=self.limits[:, 0], ylim=(0, 1.1 * 2 ** math.ceil(math.log2(highest))))
        return figure

    def filled_in(self):
        """The equations of the current moment with their numbers, as LaTeX."""
        k, kind, ((x, P), (x_pred, P_pred, F), (x_new, P_new, y, S, K)) = self.current
        m, u, z, pred = self.model, _tex(self.p.u), self.z[max(k - 1, 0)], r"_{\mathrm{pred}}"
        FT, HT = r"F^{\top}", r"H^{\top}"
        if kind == 0:
            lines = [f"x_0 &= {_tex(x)} & P_0 &= {_tex(P)}", f"F &= {_tex(F)} & B &= {_tex(m.B)}",
                     f"H &= {_tex(m.H)} & Q &= {_tex(m.Q)}", rf"R &= {_tex(m.R)} & u &= {u}"]
        elif kind == 1:
            lines = [f"x{pred} &= F x + B u",
                     f"&= {_tex(F)} {_tex(x)} + {_tex(m.B)} ({u}) = {_tex(x_pred)}",
                     f"P{pred} &= F P {FT} + Q",
                     f"&= {_tex(F)} {_tex(P)} {_tex(F.T)} + {_tex(m.Q)}", f"&= {_tex(P_pred)}"]
        else:
            HPH = P_pred[0, 0]
            lines = [f"y &= z - H x{pred} = {_tex(z)} - {_signed(x_pred[0])} = {_tex(y)}",
                     f"S &= H P{pred} {HT} + R = {_tex(HPH)} + {_tex(m.R)} = {_tex(S)}",
                     rf"K &= P{pred} {HT} S^{{-1}} = {_tex(P_pred[:, 0])} \frac{{1}}{{{_tex(S)}}} = {_tex(K)}",
                     f"x &= x{pred} + K y = {_tex(x_pred)} + {_tex(K)} ({_tex(y)}) = {_tex(x_new)}",
                     f"P &= (I - K H) P{pred}", f"&= {_tex(np.eye(2) - K @ m.H)} {_tex(P_pred)} = {_tex(P_new)}"]
        return r"$$\begin{aligned}" + r"\\[4pt]".join(lines) + r"\end{aligned}$$"


def _signed(value):
    """A number that follows a minus sign."""
    return f"({_tex(value)})" if value < 0 else _tex(value)


def _tex(a):
    """A number, a column or a matrix in LaTeX, four significant digits."""
    a = np.asarray(a, dtype=float)
    if a.size == 1:
        text = f"{a.item() + 0.0:.4g}"
        mantissa, e, exponent = text.partition("e")
        return rf"{mantissa}\times10^{{{int(exponent)}}}" if e else text
    rows = a if a.ndim == 2 else a[:, np.newaxis]
    return r"\begin{bmatrix}" + r"\\".join(" & ".join(map(_tex, row)) for row in rows) + r"\end{bmatrix}"


# --- chapter 2: the form ---------------------------------------------------------------------------------------------

class SmootherForm(OwnData):
    """The paper's form: No / Measured / Filtered, driven by Q, R, x0, P0, with any data the reader brings."""
    LOOK_ALIKES = {"silkworm_room": dict(R=1e-3, window=3), "cutting_force": dict(R=1e-3, window=5),
                   "tank_level": dict(R=7.7e-4, window=2)}      # the paper's settings; Q is 1e-5
    words = {
        **OwnData.words,
        "paper": {"id": "16 nilai dari makalah", "en": "the paper's 16 values"},
        "silkworm_room": {"id": "suhu ruang ulat sutra (sintetis)", "en": "temperature of a silkworm room (synthetic)"},
        "cutting_force": {"id": "gaya potong pelepah sawit (sintetis)", "en": "cutting force of oil-palm frond (synthetic)"},
        "tank_level": {"id": "muka air tangki ikan (sintetis)", "en": "water level of a fish tank (synthetic)"},
        "given": {"id": "data dari sel kode", "en": "data from the code cell"},
        "text": {"id": "kolom yang ditempel", "en": "pasted column"},
        "paste": {"id": "Tempelkan satu kolom bilangan di sini, misalnya dari Excel.",
                  "en": "Paste a column of numbers here, for example from Excel."},
        "column": {"id": "Kolom", "en": "Column"},
        "shown": {"id": "N = {n}. Data yang ditampilkan: {what}", "en": "N = {n}. Data shown: {what}"},
        "steady": {"id": "Rentang tunak (No)", "en": "Steady stretch (No)"},
        "take_R": {"id": "R dari rentang ini", "en": "R from this stretch"},
        "too_short": {"id": "Rentang itu berisi kurang dari dua nilai.", "en": "That stretch holds fewer than two values."},
        "likelihood": {"id": "Q dan R paling mungkin", "en": "Most likely Q and R"},
        "cut": {"id": "Hanya {n} nilai pertama yang dipakai untuk mencari Q dan R.",
                "en": "Only the first {n} values were used to find Q and R."},
        "window": {"id": "Jendela rataan bergerak", "en": "Window of the moving average"},
        "measured": {"id": "Terukur", "en": "Measured"},
        "filtered": {"id": "Hasil filter", "en": "Filtered"},
        "average": {"id": "Rataan bergerak", "en": "Moving average"},
        "middle": {"id": "{n} baris di tengah tidak ditampilkan; unduhan memuat semuanya.",
                   "en": "{n} rows in the middle are not shown; the download has them all."},
        "filter": {"id": "Filter Kalman", "en": "Kalman filter"},
        "roughness": {"id": "Kekasaran (simpangan baku langkah)", "en": "Roughness (standard deviation of the steps)"},
        "lag_truth": {"id": "Kelambatan terhadap nilai sebenarnya (sampel)", "en": "Lag behind the truth (samples)"},
        "lag_rts": {"id": "Kelambatan terhadap penghalus RTS (sampel)", "en": "Lag behind the RTS smoother (samples)"},
        "rmse": {"id": "RMSE", "en": "RMSE"},
        "no_truth": {"id": "nilai sebenarnya tidak diketahui", "en": "no truth known"},
        "csv": {"id": "Siapkan CSV", "en": "Prepare CSV"},
        "xlsx": {"id": "Siapkan Excel dengan rumus hidup", "en": "Prepare Excel with live formulas"},
        "save": {"id": "Simpan {name}", "en": "Save {name}"},
    }

    def __init__(self, z=None, p=None):
        super().__init__()
        p = p or smoother.Params()
        self.given = None if z is None else np.asarray(z, dtype=float).ravel()
        self.figure = self.result = None
        keys = ["paper", *self.LOOK_ALIKES, *([] if z is None else ["given"]), "text", "file"]
        self.source = _wide(self.choices(self.label(widgets.Dropdown(), "source"), keys))
        self.own_data_parts()
        self.column = _wide(self.label(widgets.Dropdown(), "column"))
        meta = describe(smoother.Params)
        self.Q, row_Q = self.log_field("Q", meta["Q"], p.Q)
        self.R, row_R = self.log_field("R", meta["R"], p.R)
        self.x0, row_x0 = self.text_field("x0", meta["x0"], p.x0)
        self.P0, row_P0 = self.text_field("P0", meta["P0"], p.P0)
        self.window = widgets.IntSlider(p.window, 1, max(50, p.window), layout=widgets.Layout(width="15em"))
        self.steady = widgets.IntRangeSlider(min=1, layout=widgets.Layout(width="17em"))
        self.take_R, self.likelihood, self.csv, self.xlsx = (
            _wide(self.label(widgets.Button(), key)) for key in ("take_R", "likelihood", "csv", "xlsx"))
        self.note, self.table, self.measures, self.link = (widgets.HTML() for _ in range(4))
        self.table.layout = widgets.Layout(flex="0 0 270px")
        self.plot = Screen()

        self.view = widgets.VBox([
            self.language,
            _row(self.source, self.column, self.sign, self.upload), self.text,
            self.note, self.message,
            _row(row_Q, row_R, row_x0, row_P0, self.under("window", self.window)),
            _row(self.under("steady", widgets.HBox([self.steady, self.take_R])), self.likelihood),
            widgets.HBox([self.table, widgets.VBox([self.plot, self.measures], layout=widgets.Layout(flex="1 1 380px"))],
                         layout=widgets.Layout(flex_flow="row wrap", align_items="flex-start", grid_gap="8px")),
            _row(self.csv, self.xlsx, self.link),
        ], layout=widgets.Layout(width="98%"))
        self.load_own_data_on_change()
        self.on(self.column, self.choose)
        for part in (self.Q, self.R, self.x0, self.P0, self.window):
            self.on(part, self.calculate)
        self.on(self.take_R, self.R_from_steady)
        self.on(self.likelihood, self.most_likely)
        self.on(self.csv, self.prepare_csv)
        self.on(self.xlsx, self.prepare_xlsx)
        if z is not None:
            self.quiet, self.source.value, self.quiet = True, "given", False
        self.load(settings=p)

    def text_field(self, name, meta, value):
        self.words = {**self.words, name: {"id": f"{name}, {meta['id']}", "en": f"{name}, {meta['en']}"}}
        text = widgets.Text(f"{value:.12g}", continuous_update=False, layout=widgets.Layout(width="7.5em"))
        return text, widgets.VBox([self.label(widgets.Label(), name, "value"), text])

    # --- from the data to the result ---

    def load(self, source=None, settings=None):
        """Fetch the data of the source, then filter it. What cannot be read leaves everything as it was."""
        self.quiet, self.source.value, self.quiet = True, source or self.source.value, False
        source, truth = self.source.value, None
        if source in ("text", "file"):
            table = self.read_own_data()
            columns, what = table.columns, {"id": table.note_id, "en": table.note_en}
        else:
            z, truth = self.built_in(source)
            columns, what = {"z": z}, {key: word + "." for key, word in self.words[source].items()}
            if source != "given":
                settings = settings or smoother.Params(**self.LOOK_ALIKES.get(source, {}))
        if settings:
            self.set_fields(settings)
        self.columns, self.truth, self.what = columns, truth, what
        self.quiet = True
        self.column.options = list(columns)
        self.column.value = self.column.options[0]
        self.column.layout.display = None if len(columns) > 1 else "none"
        self.quiet = False
        self.choose()

    def built_in(self, source):
        """The measurements (T,) of a built-in source and the truth (T,), which only a look-alike knows."""
        if source in ("paper", "given"):
            return smoother.MEASURED if source == "paper" else self.given, None
        made_up = getattr(smoother, source)(np.random.default_rng(SEED))
        return made_up.z[:, 0], made_up.x[:, 0]

    def set_fields(self, p):
        """Write the settings p into the fields without calculating for each of them."""
        self.quiet = True
        for name in ("Q", "R", "x0", "P0"):
            getattr(self, name).value = f"{getattr(p, name):.12g}"
        self.window.value = p.window
        self.quiet = False

    def choose(self):
        """Take the chosen column."""
        self.z = self.columns[self.column.value]
        n = len(self.z)
        self.steady.max, self.steady.value = n, (1, min(n, 20))
        self.calculate()

    def calculate(self):
        """Filter the data and show everything; nothing on the screen changes before all of it is known."""
        p = smoother.Params(**{name: number(getattr(self, name).value) for name in ("Q", "R", "x0", "P0")},
                            window=self.window.value)
        z, truth, n = self.z, self.truth, len(self.z)
        x, P, K, smooth = smoother.scalar_filter(z, p)
        average = smoother.moving_average(z, p.window)
        some = slice(None, None, -(-n // PLOT_POINTS))

        def figure():
            return plots.series(np.arange(1, n + 1)[some], z[some], x[some], rivals={f"MA({p.window})": average[some]},
                                truth=None if truth is None else truth[some])

        self.plot.draw(figure)
        self.figure, self.result = figure, (p, z, truth, x, P, K, smooth, average, self.what)
        self.redraw()

    def redraw(self):
        """Write the result in the current language."""
        if self.result is None:
            return
        p, z, truth, x, P, K, smooth, average, what = self.result
        self.link.value = ""
        self.note.value = f"<p style='margin:0'>{escape(self.say('shown', n=len(z), what=what[self.language.value]))}</p>"
        self.table.value = self.table_of(z, x)
        reference = smooth if truth is None else truth
        no_truth = f"<td colspan='2'>{self.say('no_truth')}</td>"
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")         # a mean of nothing is NaN, which is shown as a dash
            rows = {"roughness": [smoother.roughness(values) for values in (x, average)],
                    "lag_rts" if truth is None else "lag_truth": [smoother.lag(values, reference) for values in (x, average)],
                    "rmse": None if truth is None else [rmse(truth, values) for values in (x, average)]}
        cells = {key: no_truth if values is None else "".join(f"<td>{_short(value)}</td>" for value in values)
                 for key, values in rows.items()}
        self.measures.value = _table(["", self.say("filter"), f"{self.say('average')} ({p.window})"],
                                     [f"<th scope='row'>{self.say(key)}</th>{row}" for key, row in cells.items()])

    def table_of(self, z, x):
        """The table No / Measured / Filtered as HTML; a long one without its middle."""
        n = len(z)
        scale = np.nanmax(np.abs(z))
        digits = 6 if not 0 < scale < 0.01 else 4 - math.floor(math.log10(scale))      # small values get more
        rows = [f"<td>{k}</td><td>{'' if np.isnan(a) else _fixed(a, digits, trim='-')}</td><td>{_fixed(b, digits)}</td>"
                for k, a, b in zip(range(1, n + 1), z, x)
                if n <= TABLE_ROWS or not TABLE_ROWS // 2 < k <= n - TABLE_ROWS // 2]
        hidden = ""
        if n > TABLE_ROWS:
            rows.insert(TABLE_ROWS // 2, "<td>⋮</td>" * 3)
            hidden = f"<p style='margin:4px 0;line-height:1.4'>{self.say('middle', n=n - TABLE_ROWS)}</p>"
        return _table(["No", self.say("measured"), self.say("filtered")], rows, "height:26em") + hidden

    # --- Q and R from the data ---

    def R_from_steady(self):
        first, last = self.steady.value
        stretch = self.z[first - 1:last]
        if np.isfinite(stretch).sum() < 2:
            raise InputError(self.words["too_short"]["en"], self.words["too_short"]["id"])
        self.R.value = f"{smoother.R_from_steady(stretch):.6g}"

    def most_likely(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")         # a search over absurd pairs overflows; they lose
            Q, R = smoother.maximum_likelihood(self.z[:LIKELIHOOD_POINTS])
        limits = describe(smoother.Params)
        Q, R = (float(f"{np.clip(value, limits[name]['min'], limits[name]['max']):.6g}") for name, value in (("Q", Q), ("R", R)))
        first = self.z[np.isfinite(self.z)][0]      # the likelihood starts there, so the filter does, too
        p = replace(self.result[0], Q=Q, R=R, x0=first, P0=R)
        self.set_fields(p)
        self.calculate()
        if len(self.z) > LIKELIHOOD_POINTS:
            self.tell({key: text.format(n=LIKELIHOOD_POINTS) for key, text in self.words["cut"].items()})

    # --- downloads: a link that holds the file, made only when asked for ---

    def prepare_csv(self):
        p, z, _, x, P, K, _, average, _ = self.result
        lines = [",".join(["No", self.say("measured"), self.say("filtered"), "K", "P", f"MA{p.window}"])]
        lines += [",".join([str(k), *("" if np.isnan(value) else repr(float(value)) for value in row)])
                  for k, row in enumerate(zip(z, x, K, P, average), start=1)]
        self.offer("kalman.csv", "text/csv", "\r\n".join(lines).encode() + b"\r\n")

    def prepare_xlsx(self):
        p, z, *_ = self.result
        book = io.BytesIO()
        write_workbook(book, z, p.Q, p.R, p.x0, p.P0, name=self.say("measured"))
        self.offer("kalman.xlsx", "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet", book.getvalue())

    def offer(self, name, kind, content):
        data = base64.b64encode(content).decode()
        self.link.value = (f'<a download="{name}" href="data:{kind};base64,{data}" '
                           f'style="color:#1f6fb4;text-decoration:underline">{self.say("save", name=name)}</a>')


def _fixed(value, digits, **options):
    """A number with a fixed count of digits behind the point; a huge one with a power of ten."""
    if abs(value) >= 1e12:
        return f"{value:.6e}"
    return np.format_float_positional(value, digits, **options) if options else f"{value:.{digits}f}"


def _short(value):
    return f"{value:.4g}" if math.isfinite(value) else "\u2013"


def _table(head, rows, style=""):
    """An HTML table whose head stays in place while it scrolls."""
    heads = "".join(f"<th scope='col' style='position:sticky;top:0;background:var(--jp-layout-color1,#fff);"
                    f"text-align:right'>{word}</th>" for word in head)
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return (f"<div tabindex='0' style='overflow:auto;{style}'><table style='border-spacing:8px 0;text-align:right;"
            f"line-height:1.5;font-variant-numeric:tabular-nums'><thead><tr>{heads}</tr></thead><tbody>{body}</tbody>"
            "</table></div>")


# --- chapter 2: one measurement at a time ----------------------------------------------------------------------------

class SmootherOnline(Board):
    """The filter at work: whenever a measurement arrives, one `predict` and one `update`."""
    words = {
        "new": {"id": "Pengukuran baru", "en": "New measurement"},
        "hint": {"id": "bilangan, lalu Enter", "en": "a number, then Enter"},
        "add": {"id": "Tambahkan", "en": "Add"},
        "reset": {"id": "Kosongkan", "en": "Clear"},
        "stream": {"id": "Aliran sintetis (suhu ruang ulat sutra, benih acak {seed}):",
                   "en": "Synthetic stream (temperature of a silkworm room, random seed {seed}):"},
        "waiting": {"id": "Belum ada pengukuran. Isilah satu bilangan atau jalankan aliran sintetis.",
                    "en": "No measurement yet. Enter a number or play the synthetic stream."},
    }

    def __init__(self, p=None):
        super().__init__()
        self.p = p or smoother.Params(Q=1e-3, R=0.09, P0=1000)
        self.model = smoother.model(self.p)
        self.stream = smoother.silkworm_room(np.random.default_rng(SEED)).z[:, 0]
        self.entry = _wide(self.label(self.label(widgets.Text(continuous_update=False), "new"), "hint", "placeholder"))
        self.entry.layout.width = "22em"
        self.button, self.restart = (_wide(self.label(widgets.Button(), key)) for key in ("add", "reset"))
        self.play = widgets.Play(min=0, max=len(self.stream), interval=300, show_repeat=False)
        self.words = {**self.words, "stream": {key: text.format(seed=SEED) for key, text in self.words["stream"].items()}}
        self.numbers = widgets.HTML(layout=widgets.Layout(width="98%", min_height="4em"))
        self.plot = Screen()
        self.view = widgets.VBox([
            self.language,
            _row(self.entry, self.button, self.restart),
            _row(self.label(widgets.Label(), "stream", "value"), self.play),
            self.message, self.numbers, self.plot], layout=widgets.Layout(width="98%"))
        for part in (self.entry, self.button):
            self.on(part, self.enter)
        self.on(self.restart, self.reset)
        self.on(self.play, self.feed)
        self.reset()

    def reset(self):
        self.x, self.P, self.K, self.fed = self.model.x0, self.model.P0, None, 0
        self.history = []               # (z, x, P) of every arrival
        self.quiet, self.play.playing, self.play.value, self.quiet = True, False, 0, False
        self.redraw()

    def enter(self):
        """A number was typed; the field empties itself for the next one."""
        if self.entry.value.strip():
            z = number(self.entry.value)
            self.quiet, self.entry.value, self.quiet = True, "", False
            self.add(z)

    def feed(self):
        """The player moved on: pass the values that have arrived since."""
        until = self.play.value
        arrived, self.fed = self.stream[self.fed:until], until
        self.add(*arrived)

    def add(self, *measurements):
        """Every measurement: predict, then update."""
        for z in measurements:
            self.x, self.P, _ = predict(self.model, self.x, self.P)
            self.x, self.P, _, _, self.K = update(self.model, self.x, self.P, np.array([z]))
            self.history.append((z, self.x[0], self.P[0, 0]))
        self.redraw()

    def figure(self):
        """The last 200 measurements and what became of them."""
        z, x, P = np.array(self.history[-200:]).T
        first = len(self.history) - len(z)
        figure = plots.series(np.arange(first + 1, first + len(z) + 1), z, x, np.sqrt(P))
        figure.axes[0].set_xlim(first, first + 50 * math.ceil(len(z) / 50))
        return figure

    def redraw(self):
        self.plot.layout.display = None if self.history else "none"
        if not self.history:
            self.numbers.value = f"<p>{self.say('waiting')}</p>"
            return
        z, x, P = np.array(self.history).T
        k = np.arange(1, len(z) + 1)
        self.plot.draw(self.figure)
        cells = [f"{k[-1]}", f"{z[-1]:.6g}", f"{self.K[0, 0]:.6f}", f"{x[-1]:.6f}", f"{P[-1]:.6g}"]
        self.numbers.value = _table(["k", "z", "K", "x", "P"], ["".join(f"<td>{cell}</td>" for cell in cells)])


# --- chapter 3 -------------------------------------------------------------------------------------------------------

class GyroFlight(Board):
    """The paper's simulation: its four inputs as sliders, its two panels, and what the filter made of this noise."""
    words = {
        "noise": {"id": "Derau baru", "en": "New noise"},
        **{f"case {figure}": {"id": f"Kasus {figure}", "en": f"Case {figure}"} for figure in gyro_paper.CASES},
        "angle": {"id": "Sudut (rad) terhadap t (s)", "en": "Angle (rad) against t (s)"},
        "errors": {"id": "Galat (rad) terhadap t (s)", "en": "Error (rad) against t (s)"},
        "first": {"id": "langkah pertama", "en": "first step"},
        "last": {"id": "langkah terakhir", "en": "last step"},
        "outcome": {"id": "Galat pengukuran terbesar {z} rad, galat estimasi terbesar {x} rad. RMSE sensor {sensor} rad, "
                          "RMSE filter {rmse} rad; {inside} % dari galat filter berada di dalam \u00b12\u221aP. "
                          "Data sintetis (benih acak {seed}).",
                    "en": "Largest measurement error {z} rad, largest estimation error {x} rad. RMSE of the sensor "
                          "{sensor} rad, of the filter {rmse} rad; {inside} % of the filter's errors lie within "
                          "\u00b12\u221aP. Synthetic data (random seed {seed})."},
    }
    FIELDS = {"duration": "t", "T": "T", "sigma_w": "\u03c3_w", "sigma_v": "\u03c3_v"}

    def __init__(self, p=None):
        super().__init__()
        self.p, self.seed = p or gyro_paper.Params(), SEED
        rows = []
        for name, letter in self.FIELDS.items():
            meta = describe(gyro_paper.Params)[name]
            meta = {**meta, **{key: f"{meta[key]} ({meta['unit']})" for key in ("id", "en")}}
            text, row = self.log_field(letter, meta, getattr(self.p, name))
            setattr(self, name, text)
            rows.append(row)
        self.noise = _wide(self.label(widgets.Button(), "noise"))
        self.figures = {figure: _wide(self.label(widgets.Button(), f"case {figure}")) for figure in gyro_paper.CASES}
        self.sentence, self.table = widgets.HTML(layout=widgets.Layout(width="98%", min_height="4.5em")), widgets.HTML()
        self.angle, self.errors = Screen(), Screen()
        self.view = widgets.VBox([
            self.language, _row(*rows), _row(self.noise, *self.figures.values()), self.message, self.sentence,
            widgets.HBox([widgets.VBox([self.label(widgets.Label(), "angle", "value"), self.angle,
                                        self.label(widgets.Label(), "errors", "value"), self.errors],
                                       layout=widgets.Layout(flex="1 1 320px")), self.table],
                         layout=widgets.Layout(flex_flow="row wrap", align_items="flex-start", grid_gap="8px")),
        ], layout=widgets.Layout(width="98%"))
        for name in self.FIELDS:
            self.on(getattr(self, name), self.calculate)
        self.on(self.noise, self.renew)
        for figure, button in self.figures.items():
            self.on(button, lambda figure=figure: self.choose(figure))
        self.calculate()

    def renew(self):
        """The same settings with other random numbers."""
        self.seed += 1
        self.calculate()

    def choose(self, figure):
        """The settings of one of the paper's figures."""
        p = gyro_paper.Params()
        values = {"duration": p.duration, "T": p.T, **dict(zip(("sigma_w", "sigma_v"), gyro_paper.CASES[figure]))}
        self.quiet = True
        for name, value in values.items():
            getattr(self, name).value = f"{value:.12g}"
        self.quiet = False
        self.calculate()

    def calculate(self):
        """Simulate, filter and draw; nothing on the screen changes before all of it is known."""
        p = replace(self.p, **{name: number(getattr(self, name).value) for name in self.FIELDS})
        flight = gyro_paper.simulate(p, np.random.default_rng(self.seed))
        result = kalman_filter(gyro_paper.model(p), flight.z, flight.u)
        some = slice(None, None, -(-len(flight.z) // PLOT_POINTS))
        rows = [{name: part[some] if isinstance(part, np.ndarray) else part for name, part in row.items()}
                for row in gyro_paper.layout(p, flight, result)]
        for screen, row in zip((self.angle, self.errors), rows):
            screen.draw(lambda: plots.series(**row, xlabel="$t$ (s)", height=2.2))
        self.rows, self.result = rows, (flight, result, self.seed)
        self.redraw()

    def redraw(self):
        """Write the outcome in the current language."""
        flight, result, seed = self.result
        largest = gyro_paper.maxima(flight, result)
        sigma = np.sqrt(result.P[:, 0, 0])
        inside = np.mean(np.abs(flight.x - result.x)[:, 0] <= 2 * sigma)
        numbers = dict(z=largest[0], x=largest[1], sensor=rmse(flight.x, flight.z)[0], rmse=rmse(flight.x, result.x)[0])
        self.sentence.value = '<p role="status" style="line-height:1.5">' + self.say(
            "outcome", inside=self.decimal(100 * inside, 3), seed=seed,
            **{name: self.decimal(value, 3) for name, value in numbers.items()}) + "</p>"
        rows = {"K": result.K[:, 0, 0], "P (rad\u00b2)": result.P[:, 0, 0], "\u221aP (rad)": sigma}
        self.table.value = _table(["", self.say("first"), self.say("last")],
                                  [f"<th scope='row'>{name}</th><td>{_short(values[0])}</td><td>{_short(values[-1])}</td>"
                                   for name, values in rows.items()])


class GyroMismatch(Board):
    """What a wrong sigma costs: RMSE and NEES of every pair that the filter may believe, and one pair against 500 runs."""
    words = {
        "noise": GyroFlight.words["noise"],
        "truth": {"id": "Filter percaya yang benar", "en": "Let the filter believe the truth"},
        "cost": {"id": "RMSE dibagi yang terbaik: \u03c3_w mendatar, \u03c3_v tegak (log\u2081\u2080)",
                 "en": "RMSE divided by the best: \u03c3_w across, \u03c3_v upwards (log\u2081\u2080)"},
        "nees": {"id": "NEES: \u03c3_w mendatar, \u03c3_v tegak (log\u2081\u2080)",
                 "en": "NEES: \u03c3_w across, \u03c3_v upwards (log\u2081\u2080)"},
        "outcome": {"id": "Filter percaya \u03c3_w = {w} rad/s dan \u03c3_v = {v} rad, padahal yang benar {true_w} dan {true_v}. RMSE-nya "
                          "{rmse} rad, {cost} kali yang terbaik ({best} rad), dan NEES-nya {nees}: {word}. Dari {runs} percobaan "
                          "sintetis (benih acak {seed}): RMSE {all} rad, NEES {mean}.",
                    "en": "The filter believes \u03c3_w = {w} rad/s and \u03c3_v = {v} rad; the truth is {true_w} and {true_v}. Its RMSE is "
                          "{rmse} rad, {cost} times the best ({best} rad), and its NEES {nees}: {word}. From {runs} synthetic "
                          "runs (random seed {seed}): RMSE {all} rad, NEES {mean}."},
        "sure": {"id": "terlalu yakin", "en": "too sure"},
        "doubtful": {"id": "terlalu ragu", "en": "too doubtful"},
        "honest": {"id": "P-nya jujur", "en": "its P is honest"},
    }
    RUNS, LEVELS = 500, {"cost": (1.1, 1.3, 1.6, 2, 2.5, 3), "nees": (0.03, 0.1, 0.3, 1, 3, 10, 30)}
    TIMES = {"min": 0.1, "max": 10, "id": "\u03c3_{} menurut filter dibagi yang benar", "en": "\u03c3_{} as the filter believes it, over the true one"}

    def __init__(self, p=None):
        super().__init__()
        self.p, self.seed, self.flights = p or gyro_paper.Params(), SEED, {}
        rows = []
        for letter in "wv":
            meta = {key: words.format(letter) if isinstance(words, str) else words for key, words in self.TIMES.items()}
            text, row = self.log_field(f"c_{letter}", meta, 1)
            setattr(self, f"times_{letter}", text)
            rows.append(row)
        for letter in "wv":
            name = f"sigma_{letter}"
            meta = describe(gyro_paper.Params)[name]
            meta = {**meta, **{key: f"{meta[key]} ({meta['unit']})" for key in ("id", "en")}}
            text, row = self.log_field(f"\u03c3_{letter}", meta, getattr(self.p, name))
            setattr(self, name, text)
            rows.append(row)
        self.noise, self.truth = (_wide(self.label(widgets.Button(), key)) for key in ("noise", "truth"))
        self.sentence = widgets.HTML(layout=widgets.Layout(width="98%", min_height="4.5em"))
        self.maps = {"cost": Screen(), "nees": Screen()}
        self.view = widgets.VBox([
            self.language, _row(*rows), _row(self.noise, self.truth), self.message, self.sentence,
            _row(*(widgets.VBox([self.label(widgets.Label(), name, "value"), screen], layout=widgets.Layout(flex="1 1 300px"))
                   for name, screen in self.maps.items())),
        ], layout=widgets.Layout(width="98%"))
        for part in (self.times_w, self.times_v, self.sigma_w, self.sigma_v):
            self.on(part, self.calculate)
        self.on(self.noise, self.renew)
        self.on(self.truth, self.believe)
        self.calculate()

    def renew(self):
        """The same settings with other random numbers."""
        self.seed += 1
        self.calculate()

    def believe(self):
        self.quiet, self.times_w.value, self.times_v.value, self.quiet = True, "1", "1", False
        self.calculate()

    def calculate(self):
        """Both maps, without data, and the chosen pair from 500 runs; nothing changes before all of it is known."""
        p = replace(self.p, sigma_w=number(self.sigma_w.value), sigma_v=number(self.sigma_v.value))
        times = [number(part.value) for part in (self.times_w, self.times_v)]
        for value in times:
            if not 0.1 <= value <= 10:
                raise InputError(f"{value:g}: accepted are 0.1 to 10.", f"{value:g}: yang diterima 0,1 sampai 10.")
        w, v = times[0] * p.sigma_w, times[1] * p.sigma_v
        grid = 10 ** np.linspace(-1, 1, 31)
        table = gyro_paper.expected(p, grid * p.sigma_w, grid[:, np.newaxis] * p.sigma_v)
        if self.flights.get("key") != (p, self.seed):
            self.flights = {"key": (p, self.seed), "all": gyro_paper.simulate(p, np.random.default_rng(self.seed), self.RUNS)}
        flight = self.flights["all"]
        told = kalman_filter(replace(gyro_paper.model(p), Q=(w * p.T) ** 2, R=v ** 2), flight.z, flight.u)
        squares = np.mean((flight.x - told.x)[:, 0] ** 2, axis=1)
        self.result = dict(p=p, w=w, v=v, best=table[0][15, 15], wrong=gyro_paper.expected(p, w, v), seed=self.seed,
                           all=np.sqrt(squares.mean()), mean=np.mean(squares / told.P[:, 0, 0]))
        self.tables = {"cost": table[0] / table[0][15, 15], "nees": table[1]}
        for name, screen in self.maps.items():
            screen.draw(lambda: self.figure(name, height=3.0))
        self.redraw()

    def figure(self, name="cost", height=3.4):
        """One map; the truth and what the filter believes are marked."""
        p, powers = self.result["p"], np.linspace(-1, 1, 31)
        marks = {r"$\sigma$": (p.sigma_w, p.sigma_v), r"$c\,\sigma$": (self.result["w"], self.result["v"])}
        log = name == "nees"
        return plots.contours(powers + np.log10(p.sigma_w), powers + np.log10(p.sigma_v), np.log10(self.tables[name]) if log else self.tables[name],
                              r"$\log_{10} \sigma_w$", r"$\log_{10} \sigma_v$", np.log10(self.LEVELS[name]) if log else self.LEVELS[name],
                              {label: np.log10(at) for label, at in marks.items()}, height=height,
                              fmt=(lambda power: f"{round(10 ** power, 2):g}") if log else "%g")

    def redraw(self):
        """Write the outcome in the current language."""
        r = self.result
        rmse, nees = r["wrong"]
        numbers = dict(w=r["w"], v=r["v"], true_w=r["p"].sigma_w, true_v=r["p"].sigma_v, rmse=rmse, cost=rmse / r["best"],
                       best=r["best"], nees=nees, all=r["all"], mean=r["mean"])
        word = self.say("sure" if nees > 1.1 else "doubtful" if nees < 0.9 else "honest")
        self.sentence.value = '<p role="status" style="line-height:1.5">' + self.say(
            "outcome", word=word, runs=self.RUNS, seed=r["seed"],
            **{name: self.decimal(value, 3) for name, value in numbers.items()}) + "</p>"


# --- chapter 5 -------------------------------------------------------------------------------------------------------

class Beetle(Board):
    """The EKF on a synthetic walk of 20 s: what it learns about the distance, and what it cannot learn."""
    SECONDS = 20
    SLIDERS = {"dt": "Δt", "theta": "θ", "v": "v", "theta0": "θ₀", "v0": "v₀"}
    words = {
        "printed": {"id": "R dari sumber (cm²)", "en": "R of the source (cm²)"},
        "noise": {"id": "Derau baru", "en": "New noise"},
        "reset": {"id": "Ulang dari awal", "en": "Start again"},
        "distance": {"id": "Jarak menurut pengukuran, filter (dengan pita), dan yang sebenarnya:",
                     "en": "Distance: measured, filtered (with band), and true:"},
        "uncertainty": {"id": "Simpangan baku menurut filter, dibagi nilai awalnya (s = v cos θ):",
                        "en": "Standard deviations the filter states, divided by their start (s = v cos θ):"},
        "result": {"id": "Sesudah {t} s filter menyatakan d = {d} cm dan s = {s} cm/s (sebenarnya {d_true} dan {s_true}). "
                         "Untuk θ ia menyatakan {theta} rad dan untuk v {v} cm/s (sebenarnya {theta_true} dan "
                         "{v_true}); menurutnya, dari simpangan baku awalnya tersisa {left_theta} % dan {left_v} %, "
                         "sedangkan untuk s {left_s} %. "
                         "Simpangan baku sensornya {sensor} cm; RMSE jarak hasil filter {rmse} cm.",
                   "en": "After {t} s the filter states d = {d} cm and s = {s} cm/s (true: {d_true} and {s_true}). "
                         "For θ it states {theta} rad and for v {v} cm/s (true: {theta_true} and {v_true}); it claims that "
                         "of their initial standard deviations {left_theta} % and {left_v} % remain, of that of s {left_s} %. "
                         "The sensor's standard deviation is {sensor} cm; the RMSE of the filtered distance is {rmse} cm."},
        "high": {"id": "NIS rata-rata {nis}, di atas pita 95 %: filter terlalu yakin (R-nya terlalu kecil, atau tebakan "
                       "awalnya lebih buruk daripada yang dikiranya).",
                 "en": "Mean NIS {nis}, above the 95 % band: the filter is overconfident (its R is too small, or its "
                       "initial guess worse than it thinks)."},
        "low": {"id": "NIS rata-rata {nis}, di bawah pita 95 %: filter terlalu ragu (R-nya terlalu besar).",
                "en": "Mean NIS {nis}, below the 95 % band: the filter is too doubtful (its R is too large)."},
        "fits": {"id": "NIS rata-rata {nis}, di dalam pita 95 %: inovasinya sesuai dengan R itu.",
                 "en": "Mean NIS {nis}, inside the 95 % band: the innovations fit that R."},
        "origin": {"id": "Jalannya kumbang sintetis (benih acak {seed}).", "en": "The walk is synthetic (random seed {seed})."},
    }

    def __init__(self, p=None):
        super().__init__()
        self.p, self.seed = p or beetle_paper.Params(), SEED
        meta = describe(beetle_paper.Params)
        self.R, row_R = self.log_field("R", meta["R"], self.p.R)
        self.printed = widgets.ToggleButtons(options=[(f"{R:g}", R) for R in sorted(beetle_paper.PRINTED_R)], value=None,
                                             style={"button_width": "auto"})
        self.sliders = {name: widgets.FloatSlider(getattr(self.p, name), min=meta[name]["min"], max=meta[name]["max"],
                                                  step=meta[name]["step"], readout_format=".2f", continuous_update=False,
                                                  layout=widgets.Layout(width="17em")) for name in self.SLIDERS}
        self.words = {**self.words, **{name: {language: f"{sign}, {meta[name][language]} ({meta[name]['unit']})"
                                              for language in ("id", "en")} for name, sign in self.SLIDERS.items()}}
        self.noise, self.restart = (_wide(self.label(widgets.Button(), key)) for key in ("noise", "reset"))
        self.sentence = widgets.HTML(layout=widgets.Layout(width="98%", min_height="6em"))
        self.plot, self.spread = Screen(), Screen()

        self.view = widgets.VBox([
            self.language,
            _row(self.under("printed", self.printed), row_R),
            _row(*(self.under(name, slider) for name, slider in self.sliders.items())),
            _row(self.noise, self.restart),
            self.message, self.sentence,
            _row(*(widgets.VBox([self.label(widgets.HTML(), key, "value"), screen],
                                layout=widgets.Layout(flex="1 1 320px"))
                   for key, screen in (("distance", self.plot), ("uncertainty", self.spread)))),
        ], layout=widgets.Layout(width="98%"))
        self.on(self.printed, self.choose)
        self.on(self.noise, self.renew)
        self.on(self.restart, self.reset)
        for part in (self.R, *self.sliders.values()):
            self.on(part, self.calculate)
        self.calculate()

    def choose(self):
        """One of the source's four values was pressed."""
        if self.printed.value is not None:
            self.R.value = f"{self.printed.value:g}"

    def renew(self):
        self.seed += 1
        self.calculate()

    def reset(self):
        self.quiet, self.seed = True, SEED
        self.R.value = f"{self.p.R:.12g}"
        for name, slider in self.sliders.items():
            slider.value = getattr(self.p, name)
        self.quiet = False
        self.calculate()

    def calculate(self):
        """Walk and filter with the current settings, then show everything."""
        settings = {name: slider.value for name, slider in self.sliders.items()}
        p = replace(self.p, R=number(self.R.value), **settings)
        steps = round(self.SECONDS / p.dt)
        model = beetle_paper.model(p)
        walk = beetle_paper.simulate(p, np.random.default_rng(self.seed), steps)
        result = kalman_filter(model, walk.z)
        self.quiet = True
        self.printed.value = p.R if p.R in beetle_paper.PRINTED_R else None
        self.quiet = False
        self.current = p, walk, result, self.shares(model, result)
        self.plot.draw(self.figure)
        self.spread.draw(self.spreads)
        self.redraw()

    def figure(self):
        """The distance: measured, filtered, true."""
        p, walk, result, _ = self.current
        t = p.dt * np.arange(1, len(walk.z) + 1)
        figure = plots.series(t, walk.z[:, 0], result.x[:, 0], np.sqrt(result.P[:, 0, 0]), walk.x[:, 0],
                              names={"x": "$d$", "truth": r"$d_{\mathrm{true}}$"}, xlabel="$t$ (s)", ylabel="cm")
        figure.axes[0].set_xlim(0, 1.02 * self.SECONDS)
        return figure

    def spreads(self):
        """What is left of the initial standard deviations."""
        p, walk, _, shares = self.current
        t = p.dt * np.arange(len(walk.z) + 1)
        signs = {"theta": r"$\sigma_\theta$", "v": r"$\sigma_v$", "s": r"$\sigma_s$"}
        return plots.curve({signs[name]: (t, share) for name, share in shares.items()}, "$t$ (s)",
                           r"$\sigma\,/\,\sigma_0$", ylim=(0, 1.2), height=3.0)

    @staticmethod
    def shares(model, result):
        """Standard deviation of theta, v and s over time (T + 1,), divided by the initial one."""
        x, P = np.vstack([model.x0, result.x]), np.concatenate([model.P0[np.newaxis], result.P])
        sigmas = {"theta": np.sqrt(P[:, 1, 1]), "v": np.sqrt(P[:, 2, 2]), "s": beetle_paper.away_sigma(x, P)}
        return {name: sigma / sigma[0] for name, sigma in sigmas.items()}

    def redraw(self):
        """Write the outcome in the current language."""
        p, walk, result, shares = self.current
        x, truth, mean = result.x[-1], walk.x[-1], float(np.nanmean(nis(result.y, result.S)))
        low, high = chi2_bounds(1, runs=len(walk.z))
        verdict = "high" if mean > high else "low" if mean < low else "fits"
        values = dict(d=x[0], d_true=truth[0], s=beetle_paper.away(x), s_true=beetle_paper.away(truth), theta=x[1],
                      theta_true=truth[1], v=x[2], v_true=truth[2], rmse=rmse(walk.x[:, 0], result.x[:, 0]),
                      sensor=math.sqrt(p.R_true))
        values = {name: self.decimal(value, 3) for name, value in values.items()}
        left = {f"left_{name}": self.decimal(100 * share[-1], 3) for name, share in shares.items()}
        sentences = [self.say("result", t=self.decimal(len(walk.z) * p.dt), **values, **left),
                     self.say(verdict, nis=self.decimal(mean, 2)), self.say("origin", seed=self.seed)]
        self.sentence.value = f'<p style="line-height:1.5">{" ".join(sentences)}</p>'


# --- chapter 4: the towing run ---------------------------------------------------------------------------------------

class ShipRun(OwnData):
    """Fit AR(2), filter, look: the synthetic towing run with any noise, or a reader's two columns time and speed."""
    ROWS_TO_SMOOTH = 5000           # the smoother keeps matrices for every row
    words = {
        **OwnData.words,
        "synthetic": {"id": "uji tarik sintetis", "en": "synthetic towing run"},
        "text": {"id": "kolom yang ditempel", "en": "pasted columns"},
        "paste": {"id": "Tempelkan dua kolom di sini: waktu, lalu kecepatan.",
                  "en": "Paste two columns here: time, then speed."},
        "two": {"id": "Diperlukan dua kolom bilangan, waktu dan kecepatan; hanya satu yang ditemukan.",
                "en": "Two columns of numbers are needed, time and speed; only one was found."},
        "same": {"id": "Waktu dan kecepatan harus dua kolom yang berbeda.",
                 "en": "Time and speed must be two different columns."},
        "time": {"id": "Kolom waktu", "en": "Time column"},
        "speed": {"id": "Kolom kecepatan", "en": "Speed column"},
        "time_unit": {"id": "Satuan waktu", "en": "Unit of time"},
        "speed_unit": {"id": "Satuan kecepatan", "en": "Unit of speed"},
        "sigma": {"id": "Derau uji tarik sintetis (m/s)", "en": "Noise of the synthetic towing run (m/s)"},
        "new": {"id": "Derau baru", "en": "New noise"},
        "first": {"id": "mulai dari pengukuran pertama", "en": "start at the first measurement"},
        "smooth": {"id": "penghalus (maju, lalu mundur)", "en": "smoother (forwards, then backwards)"},
        "too_long": {"id": "Di sini penghalus hanya melayani paling banyak {n} baris.",
                     "en": "Here the smoother handles at most {n} rows."},
        "made": {"id": "Data sintetis, benih acak {seed}.", "en": "Synthetic data, random seed {seed}."},
        "gaps": {"id": "{n} kecepatan kosong: di sana filter hanya memprediksi.",
                 "en": "{n} speeds are missing: there the filter only predicts."},
        "result": {"id": "Kuadrat terkecil: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Kutub: {poles}.",
                   "en": "Least squares: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Poles: {poles}."},
        "unstable": {"id": "Ada kutub di luar lingkaran: model ini tidak stabil.",
                     "en": "A pole lies outside the circle: this model is unstable."},
        "rmse": {"id": "RMSE: pengukuran {z} m/s, estimasi {x} m/s.", "en": "RMSE: measurements {z} m/s, estimate {x} m/s."},
        "nis": {"id": "Rata-rata NIS = {nis} (seharusnya sekitar 1).", "en": "Mean NIS = {nis} (it should be about 1)."},
    }

    def __init__(self, p=None):
        super().__init__()
        self.p, self.seed = p or ship_paper.Params(), SEED
        self.figure = self.result = self.data = self.columns = None
        meta = describe(ship_paper.Params)
        self.source = _wide(self.choices(self.label(widgets.Dropdown(), "source"), ["synthetic", "text", "file"]))
        self.own_data_parts()
        self.time, self.speed = (_wide(self.label(widgets.Dropdown(), key)) for key in ("time", "speed"))
        self.time_unit, self.speed_unit = (
            _wide(self.label(widgets.Dropdown(options=list(units)), key))
            for key, units in (("time_unit", ship_paper.TIME_UNITS), ("speed_unit", ship_paper.SPEED_UNITS)))
        self.sigma = widgets.FloatSlider(self.p.sigma, min=meta["sigma"]["min"], max=meta["sigma"]["max"],
                                         step=meta["sigma"]["step"], layout=widgets.Layout(width="19em"))
        self.new = _wide(self.label(widgets.Button(), "new"))
        self.Q, row_Q = self.log_field("Q", meta["Q"], self.p.Q)
        self.R, row_R = self.log_field("R", meta["R"], self.p.R)
        self.first, self.smooth = (self.label(widgets.Checkbox(indent=False), key) for key in ("first", "smooth"))
        self.note, self.sentence = (widgets.HTML(layout=widgets.Layout(width="98%")) for _ in range(2))
        self.plot, self.circle = Screen(), Screen()
        self.view = widgets.VBox([
            self.language,
            _row(self.source, widgets.VBox([self.label(widgets.Label(), "sigma", "value"), self.sigma]), self.new),
            _row(self.upload, self.time_unit, self.speed_unit, self.sign, self.time, self.speed), self.text,
            self.note, self.message,
            _row(row_Q, row_R, widgets.VBox([self.first, self.smooth])),
            self.sentence,
            widgets.HBox([widgets.VBox([self.plot], layout=widgets.Layout(flex="1 1 380px")),
                          widgets.VBox([self.circle], layout=widgets.Layout(flex="1 1 300px", max_width="420px"))],
                         layout=widgets.Layout(flex_flow="row wrap", align_items="flex-start")),
        ], layout=widgets.Layout(width="98%"))
        self.load_own_data_on_change()
        self.on(self.sigma, lambda: self.load("synthetic"))
        self.on(self.new, self.new_noise)
        for part in (self.time, self.speed, self.time_unit, self.speed_unit):
            self.on(part, self.choose)
        for part in (self.Q, self.R, self.first, self.smooth):
            self.on(part, self.calculate)
        self.load()

    def new_noise(self):
        self.seed += 1
        self.load("synthetic")

    def load(self, source=None):
        """Fetch the data of the source, then filter it. What cannot be read leaves everything as it was."""
        self.quiet, self.source.value, self.quiet = True, source or self.source.value, False
        if self.source.value == "synthetic":
            t, run = ship_paper.towing_run(np.random.default_rng(self.seed), self.sigma.value)
            made = {language: self.words["made"][language].format(seed=self.seed) for language in ("id", "en")}
            if self.columns:            # back from a reader's file: the synthetic run starts at rest
                self.quiet, self.first.value, self.quiet = True, False, False
            self.columns = None
            self.calculate((t, run.z[:, 0], run.x[:, 0], made))
            return
        table = self.read_own_data()
        if len(table.columns) < 2:
            raise InputError(self.words["two"]["en"], self.words["two"]["id"])
        self.quiet = True
        names = list(table.columns)
        for part, name in ((self.time, names[0]), (self.speed, names[1])):
            part.options, part.value = names, name
        self.first.value = True         # a stranger's run need not start at rest
        self.quiet = False
        self.columns, self.what = table.columns, {"id": table.note_id, "en": table.note_en}
        self.choose()

    def choose(self):
        """Take the chosen columns in the chosen units; units do nothing to the synthetic run, which is in m/s."""
        if not self.columns:
            return
        if self.time.value == self.speed.value:
            raise InputError(self.words["same"]["en"], self.words["same"]["id"])
        t = self.columns[self.time.value] * ship_paper.TIME_UNITS[self.time_unit.value]
        z = self.columns[self.speed.value] * ship_paper.SPEED_UNITS[self.speed_unit.value]
        self.calculate((t, z, None, self.what))

    def calculate(self, data=None):
        """Fit, filter and show the data (t, z, truth or None, what it is), or again those shown now."""
        data = data or self.data
        t, z, truth, _ = data
        sampled = ship_paper.sampling(t)
        Q, R = number(self.Q.value), number(self.R.value)
        p = ship_paper.fitted(z, replace(self.p, Q=Q, Q_copy=Q, R=R))
        if self.first.value:
            p = replace(p, x0=float(z[np.isfinite(z)][0]), P0=R)
        model = ship_paper.model(p)                 # refuses what is out of range
        x, P, y, S = ship_paper.quick_filter(z, p)
        if self.smooth.value:
            if len(z) > self.ROWS_TO_SMOOTH:
                raise InputError(*(self.words["too_long"][key].format(n=self.ROWS_TO_SMOOTH) for key in ("en", "id")))
            result = rts_smooth(kalman_filter(model, z, u=np.ones(len(z))))
            x, P = result.x[:, 0], result.P[:, 0, 0]
        some = slice(None, None, -(-len(z) // PLOT_POINTS))

        def figure():
            return plots.series(t[some], z[some], x[some], np.sqrt(P[some]), truth=None if truth is None else truth[some],
                                names={"x": "$x_s$" if self.smooth.value else "$x$"}, xlabel="$t$ (s)", ylabel="m/s")

        self.plot.draw(figure)
        self.circle.draw(lambda: plots.poles({"$p$": ship_paper.poles(p.a1, p.a2)}, height=3.4))
        for part in (self.time, self.speed):
            part.layout.display = None if self.columns else "none"
        self.figure, self.data, self.result = figure, data, (p, x, nis(y[:, np.newaxis], S[:, np.newaxis, np.newaxis]), sampled)
        self.redraw()

    def redraw(self):
        """Write the result in the current language."""
        if self.result is None:
            return
        (p, x, nis_values, sampled), (t, z, truth, what) = self.result, self.data
        gaps = int(np.isnan(z).sum())
        notes = [what[self.language.value], getattr(sampled, self.language.value)]
        notes += [self.say("gaps", n=gaps)] if gaps else []
        poles = ship_paper.poles(p.a1, p.a2)
        if abs(poles[0].imag) > 0:
            shown = f"{self.decimal(poles[0].real)} ± {self.decimal(abs(poles[0].imag))} i"
        else:
            shown = " ; ".join(self.decimal(pole.real) for pole in poles)
        said = [self.say("result", c=self.decimal(p.c), a1=self.decimal(p.a1), a2=self.decimal(p.a2), poles=shown)]
        said += [self.say("unstable")] if np.abs(poles).max() > 1 else []
        said += [] if truth is None else [self.say("rmse", z=self.decimal(rmse(truth, z), 3), x=self.decimal(rmse(truth, x), 3))]
        said += [self.say("nis", nis=self.decimal(np.nanmean(nis_values), 3))]
        self.note.value, self.sentence.value = (
            f'<p style="margin:0;line-height:1.5">{escape(" ".join(lines))}</p>' for lines in (notes, said))


# --- chapter 6 -------------------------------------------------------------------------------------------------------

class Quadrotor(Board):
    """The three methods on a synthetic flight or on a phone's recording: angles, errors, and the craft at any moment."""
    SENSORS = {"gyr": {"id": "giroskop", "en": "gyroscope"}, "acc": {"id": "akselerometer", "en": "accelerometer"},
               "mag": {"id": "magnetometer", "en": "magnetometer"}}
    SLIDERS = ("window", "threshold")
    words = {
        **SENSORS,
        "source": {"id": "Data", "en": "Data"},
        "flight": {"id": "penerbangan sintetis", "en": "synthetic flight"},
        "file": {"id": "rekaman saya", "en": "my recording"},
        "upload": {"id": "Unggah rekaman (CSV atau ZIP)", "en": "Upload a recording (CSV or ZIP)"},
        "no_file": {"id": "Belum ada rekaman yang diunggah.", "en": "No recording has been uploaded yet."},
        "no_rest": {"id": "Rekaman ini tidak diawali keadaan diam. Letakkan ponsel diam selama beberapa detik, lalu mulai.",
                    "en": "This recording does not begin at rest. Let the phone lie still for a few seconds, then start."},
        "method": {"id": "Cara", "en": "Method"},
        "literal": {"id": "persis seperti tercetak", "en": "to the letter of the paper"},
        "paper": {"id": "makalah, dibetulkan", "en": "the paper, corrected"},
        "adaptive": {"id": "adaptif", "en": "adaptive"},
        "noise": {"id": "Derau baru", "en": "New noise"},
        "reset": {"id": "Ulang dari awal", "en": "Start again"},
        "sensors": {"id": "Sensor yang dipakai", "en": "Sensors in use"},
        "moment": {"id": "Saat (s)", "en": "Moment (s)"},
        "angles": {"id": "Roll, pitch, dan yaw (derajat): estimasi tebal, pembanding tipis", "en":
                   "Roll, pitch and yaw (degrees): estimate thick, reference thin"},
        "craft": {"id": "Wahana, dilihat dari selatan dan dari atas: estimasi tebal, pembanding tipis",
                  "en": "The craft, seen from the south and from above: estimate thick, reference thin"},
        "rmse": {"id": "RMSE terhadap {reference}: roll {roll}°, pitch {pitch}°, yaw {yaw}°; sensor saja "
                       "{z_roll}°, {z_pitch}°, {z_yaw}°.",
                 "en": "RMSE against {reference}: roll {roll}°, pitch {pitch}°, yaw {yaw}°; the sensors alone "
                       "{z_roll}°, {z_pitch}°, {z_yaw}°."},
        "galat": {"id": "Galat menurut makalah: {roll} %, {pitch} %, {yaw} %.",
                  "en": "Error by the paper's formula: {roll} %, {pitch} %, {yaw} %."},
        "truth": {"id": "sudut sebenarnya", "en": "the true angles"},
        "device": {"id": "sudut dari alat itu sendiri", "en": "the device's own angles"},
        "nothing": {"id": "Rekaman ini tidak memuat sudut pembanding.", "en": "This recording holds no reference angles."},
        "made": {"id": "Penerbangan sintetis (benih acak {seed}).", "en": "The flight is synthetic (random seed {seed})."},
        "no_mag": {"id": "Tanpa magnetometer, yaw dimulai dari 0 dan hanya giroskop yang memutarnya.",
                   "en": "Without the magnetometer the yaw starts at 0 and only the gyroscope turns it."},
        "fixed": {"id": "Pada cara adaptif m, q, jendela, dan ambang tidak dipakai.",
                  "en": "The adaptive method uses neither m, q, window nor threshold."},
    }

    def __init__(self, p=None):
        super().__init__()
        self.p, self.seed = p or quadrotor_paper.Params(dt=0.1), SEED        # fewer samples: a quicker answer
        meta = describe(quadrotor_paper.Params)
        self.words = {**self.words, **{name: {language: f"{meta[name][language]} ({meta[name]['unit']})".replace(" ()", "")
                                              for language in ("id", "en")} for name in self.SLIDERS}}
        self.source = _wide(self.choices(self.label(widgets.Dropdown(), "source"), ["flight", "file"]))
        self.upload = _wide(self.label(widgets.FileUpload(accept=".csv,.zip,.txt,.xlsx", multiple=True), "upload"))
        self.method = _wide(self.choices(self.label(widgets.Dropdown(value=None), "method"), ["paper", "adaptive", "literal"]))
        self.m, row_m = self.log_field("m", meta["m"], self.p.m)
        unit_q = {key: f"{meta['q'][key]} ({meta['q']['unit']})" for key in ("id", "en")}
        self.q, row_q = self.log_field("q", {**meta["q"], **unit_q}, self.p.q)
        self.window = widgets.FloatSlider(self.p.window, min=meta["window"]["min"], max=meta["window"]["max"], step=0.1,
                                          continuous_update=False, layout=widgets.Layout(width="17em"))
        self.threshold = widgets.FloatLogSlider(self.p.threshold, min=0, max=2, step=0.05, readout_format=".3g",
                                                continuous_update=False, layout=widgets.Layout(width="17em"))
        self.sensors = {name: self.label(widgets.Checkbox(True, indent=False, layout=widgets.Layout(width="auto")), name)
                        for name in self.SENSORS}
        self.noise, self.restart = (_wide(self.label(widgets.Button(), key)) for key in ("noise", "reset"))
        self.moment = widgets.FloatSlider(40, min=0, max=126, step=0.5, readout_format=".1f",
                                          layout=widgets.Layout(width="20em"))
        self.note, self.sentence = (widgets.HTML(layout=widgets.Layout(width="98%")) for _ in range(2))
        self.plots, self.craft = [Screen() for _ in quadrotor_paper.AXES], Screen()

        self.view = widgets.VBox([
            self.language,
            _row(self.source, self.upload, self.method, self.noise, self.restart),
            _row(row_m, row_q, self.under("window", self.window), self.under("threshold", self.threshold)),
            _row(self.label(widgets.Label(), "sensors", "value"), *self.sensors.values()),
            self.note, self.message, self.sentence,
            _row(widgets.VBox([self.label(widgets.HTML(), "angles", "value"), *self.plots],
                              layout=widgets.Layout(flex="1 1 320px")),
                 widgets.VBox([self.label(widgets.HTML(), "craft", "value"), self.craft, self.under("moment", self.moment)],
                              layout=widgets.Layout(flex="1 1 320px"))),
        ], layout=widgets.Layout(width="98%"))
        self.on(self.source, self.load)
        self.on(self.upload, lambda: self.load("file"))
        self.on(self.noise, self.renew)
        self.on(self.restart, self.reset)
        for part in (self.method, self.m, self.q, self.window, self.threshold, *self.sensors.values()):
            self.on(part, self.calculate)
        self.on(self.moment, self.turn)
        self.load()

    def renew(self):
        self.seed += 1
        self.load("flight")

    def reset(self):
        self.quiet, self.seed = True, SEED
        self.method.value = "paper"
        for name in ("m", "q"):
            getattr(self, name).value = f"{getattr(self.p, name):.12g}"
        for name in self.SLIDERS:
            getattr(self, name).value = getattr(self.p, name)
        for sensor in self.sensors.values():
            sensor.value = True
        self.quiet = False
        self.load("flight")

    def load(self, source=None):
        """Fetch the flight or the recording, then filter it. What cannot be read leaves everything as it was."""
        self.quiet, self.source.value, self.quiet = True, source or self.source.value, False
        if self.source.value == "flight":
            flight = quadrotor_paper.simulate(self.p, np.random.default_rng(self.seed))
            said = {language: self.words["made"][language].format(seed=self.seed) for language in ("id", "en")}
            self.calculate((*flight.sensors, flight.truth, "truth", said))
            return
        if not self.upload.value:
            raise InputError(self.words["no_file"]["en"], self.words["no_file"]["id"])
        recording = read_recording({file["name"]: bytes(file["content"]) for file in self.upload.value})
        rest_s = rest_seconds(recording)
        if not rest_s:
            raise InputError(self.words["no_rest"]["en"], self.words["no_rest"]["id"])
        said = {language: " ".join(note[language] for note in recording.notes) for language in ("id", "en")}
        self.calculate((recording.t, recording.gyr, recording.acc, recording.mag, rest_s, recording.reference,
                        "device" if recording.reference is not None else "nothing", said))

    def calculate(self, data=None):
        """Filter with the current settings and draw; nothing on the screen changes before all of it is known."""
        data = data or self.data
        t, gyr, acc, mag, rest_s, reference, *_ = data
        used = {name: part if self.sensors[name].value else None
                for name, part in (("gyr", gyr), ("acc", acc), ("mag", mag))}
        method = quadrotor_paper.METHODS[self.method.value]
        if not method.kept:
            method = replace(method, m=number(self.m.value), q=number(self.q.value) * quadrotor_paper.DEG ** 2,
                             window=self.window.value, threshold=self.threshold.value)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = quadrotor_paper.attitude(t, np.zeros_like(gyr) if used["gyr"] is None else gyr, used["acc"],
                                              used["mag"], rest_s, method)
        self.data, self.result = data, result
        if caught:
            self.tell(caught[0].message)
        for screen, row in zip(self.plots, self.rows()):
            screen.draw(lambda: plots.series(**row, xlabel="$t$ (s)", height=1.7))
        self.quiet, self.moment.max, self.quiet = True, float(t[-1]), False
        self.turn()
        self.redraw()

    def rows(self):
        """For each axis what plots.series draws: what the sensor alone says, the reference, the estimate; degrees."""
        t, reference = self.data[0], self.data[5]
        some = slice(None, None, -(-len(t) // PLOT_POINTS))
        for i, name in enumerate(quadrotor_paper.AXES):
            x = np.unwrap(self.result.angles[some, i])          # no line across the picture where the yaw goes round
            z, truth = (None if part is None else np.degrees(x + quadrotor_paper.wrap(part[some, i] - x))
                        for part in (self.result.z, reference))
            yield dict(t=t[some], z=z, x=np.degrees(x), truth=truth, ylabel="°",
                       names={"x": name, "truth": f"{name} (ref.)"})

    def picture(self):
        """The static picture of the built book."""
        return plots.panels(list(self.rows()), xlabel="$t$ (s)", height=1.5)

    def moments(self, *seconds):
        t, reference = self.data[0], self.data[5]
        places = [min(np.searchsorted(t, second), len(t) - 1) for second in seconds]
        return {f"{t[k]:.0f} s": (self.result.angles[k], None if reference is None else reference[k]) for k in places}

    def short(self, value):
        """A number for the sentences: one to two digits after the point, a dash for none."""
        return "–" if np.isnan(value) else self.decimal(round(value, 2 if value < 10 else 1), 6)

    def turn(self):
        """Draw the craft at the chosen moment."""
        self.craft.draw(lambda: plots.craft(self.moments(self.moment.value), height=3.0))

    def redraw(self):
        """Write the outcome in the current language."""
        reference, name, said = self.data[5:]
        sentences = [said[self.language.value]]
        if reference is None:
            sentences.append(self.say("nothing"))
        else:
            axes = quadrotor_paper.AXES
            ours, alone = (quadrotor_paper.rmse_deg(reference, part) for part in (self.result.angles, self.result.z))
            lie = quadrotor_paper.galat(reference, quadrotor_paper.wrap(self.result.angles))
            sentences += [
                self.say("rmse", reference=self.say(name), **{axis: self.short(v) for axis, v in zip(axes, ours)},
                         **{f"z_{axis}": self.short(v) for axis, v in zip(axes, alone)}),
                self.say("galat", **{axis: self.short(v) for axis, v in zip(axes, lie)})]
        if not self.sensors["mag"].value or self.data[3] is None:
            sentences.append(self.say("no_mag"))
        if self.method.value == "adaptive":
            sentences.append(self.say("fixed"))
        self.sentence.value = "".join(f'<p style="line-height:1.5;margin:0 0 .3em">{escape(s)}</p>' for s in sentences)
