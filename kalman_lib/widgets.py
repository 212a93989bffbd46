"""The live parts of the notebooks, one function for each. Alone imports ipywidgets."""
import base64
import io
import math
import re
import warnings
from dataclasses import dataclass, replace
from functools import partial
from html import escape
from textwrap import dedent

import numpy as np
from IPython.display import display
from ipywidgets import (HTML, Button, Checkbox, Dropdown, FileUpload, FloatLogSlider, FloatSlider, HBox, HTMLMath,
                        IntRangeSlider, IntSlider, Label, Play, Text, Textarea, ToggleButtons, VBox)

from . import plots
from .fast import kalman_filter, rts_smooth
from .filters import predict, update
from .metrics import chi2_bounds, nis, rmse
from .papers import beetle as beetle_paper
from .papers import describe, param, smoother, theory
from .papers import gyro as gyro_paper
from .papers import quadrotor as quadrotor_paper
from .papers import ship as ship_paper
from .data import InputError, read_file, read_recording, read_text, rest_seconds, write_workbook

SEED = 2                    # of every synthetic measurement
TABLE_ROWS = 1000           # a longer table shows its beginning and its end
LONGEST = 5000              # series for maximum likelihood and for the ship's smoother


def theory_steps(p=None):
    """Chapter 1: prediction and update one by one. p is a theory.Params or None."""
    board = TheorySteps(p)
    board.moment.value = 2
    show(board.view, "theory", board.ellipses())
    board.moment.value = 0


def smoother_form(z=None, p=None):
    """Chapter 2: the paper's Excel form, also for the data z (T,). p is a smoother.Params or None."""
    board = SmootherForm(z, p)
    show(board.view, "smoother", board.figure())


def smoother_online(p=None):
    """Chapter 2: one measurement at a time. p is a smoother.Params or None."""
    board = SmootherOnline(p)
    board.add(*board.stream[:60])
    show(board.view, "smoother", board.figure(), view="online")
    board.reset()


def gyro(p=None):
    """Chapter 3: the paper's simulation with its four inputs. p is a gyro.Params or None."""
    board = GyroFlight(p)
    show(board.view, "gyro", plots.panels(board.rows, xlabel="$t$ (s)", height=1.9))


def gyro_mismatch(p=None):
    """Chapter 3: what it costs when the filter believes the wrong sigmas. p is a gyro.Params, the truth, or None."""
    board = GyroMismatch(p)
    show(board.view, "gyro", board.figure(), view="mismatch")


def ship(p=None):
    """Chapter 4: the AR(2) filter on a towing run or on the reader's file. p is a ship.Params or None."""
    board = ShipRun(p)
    show(board.view, "ship", board.figure())


def beetle(p=None):
    """Chapter 5: the beetle's R, time step, direction and speed. p is a beetle.Params or None."""
    board = Beetle(p)
    show(board.view, "beetle", board.figure())


def quadrotor(p=None):
    """Chapter 6: the attitude filter on a flight or on the reader's recording. p is a quadrotor.Params or None."""
    board = Quadrotor(p)
    show(board.view, "quadrotor", board.picture())


def show(widget, paper, figure, view=None):
    """Display what is live in Jupyter and, in the built book, the figure inside <kalman-explorer>.

    view names one of the paper's explorers where it has several (book/explorers/papers/<paper>.js)."""
    data = widget._repr_mimebundle_()
    png = base64.b64encode(figure.png(dpi=150)).decode()
    chosen = f' view="{view}"' if view else ""
    data["text/plain"] = f"[{paper}]"
    data["text/html"] = (f'<kalman-explorer paper="{paper}"{chosen}><img alt="" src="data:image/png;base64,{png}">'
                         "</kalman-explorer>")
    display(data, raw=True)


# --- what all widgets share ------------------------------------------------------------------------------------------

def number(text):
    """The finite number that was typed, with decimal comma or point; InputError if it is none."""
    try:
        value = float(text.strip().replace(",", "."))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise InputError(f"{text[:40]!r} is not a number.", f"{text[:40]!r} bukan bilangan.")
    return value


def bilingual(table):
    """Lines "key = Indonesian | English" -> {key: {"id", "en"}}; lines that are indented further go on."""
    lines = re.sub(r"\n +", " ", dedent(table).strip()).split("\n")
    return {key: dict(zip(("id", "en"), both.split(" | "))) for key, both in (line.split(" = ", 1) for line in lines)}


class Board:
    """The base of every widget: words in two languages, fields for the Params p, errors that become messages.

    A subclass has a `page` of parts, `calculate`, which runs when a field changes, and `redraw`, which writes the texts.
    """
    words = bilingual("""
        noise = Derau baru | New noise
        restart = Ulang dari awal | Start again
        """)

    def __init__(self, p):
        self.p, self.meta, self.seed = p, describe(type(p)), SEED
        self.language = ToggleButtons(options=[("Bahasa Indonesia", "id"), ("English", "en")],
                                      style=dict(button_width="auto"))
        self.message = HTML()
        self.said = None                # the message, {"id", "en"} or None
        self.quiet = False              # while True, no callback runs
        self.places = []                # functions that write a word where it belongs
        self.fields = {}                # name in Params -> the part that holds its value
        self.on(self.language, self.translate)

    def say(self, key, **values):
        """The sentence `key` in the current language, floats with three digits."""
        values = {name: self.decimal(value, 3) if isinstance(value, float) else value for name, value in values.items()}
        return self.words[key][self.language.value].format(**values)

    def both(self, key, **values):
        return {language: sentence.format(**values) for language, sentence in self.words[key].items()}

    def error(self, key, **values):
        return InputError(**self.both(key, **values))

    def decimal(self, value, digits=4):
        """A number for a sentence: with decimal comma in Indonesian."""
        text = f"{value:.{digits}g}".replace("-", "\u2212")
        return text.replace(".", ",") if self.language.value == "id" else text

    def label(self, part, key, trait="description", **values):
        """Write the word `key` on a part, now and whenever the language changes."""
        def write():
            setattr(part, trait, self.say(key, **values))
        self.places.append(write)
        write()
        return part

    def under(self, key, *parts, kind=Label):
        """The parts below the word `key`."""
        return VBox([self.label(kind(), key, "value"), *parts])

    def translate(self):
        for write in self.places:
            write()
        self.tell(self.said)
        self.redraw()

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

    def on(self, part, react, trait="value"):
        """Run react() when a button is clicked or a value changes."""
        def safely(_):
            if self.quiet:
                return
            try:
                if part is not self.language:
                    self.tell(None)
                react()
            except Exception as error:          # the reader must see it
                self.tell(error)
        if isinstance(part, Button):
            part.on_click(safely)
        else:
            part.observe(safely, trait)

    def put(self, part, **traits):
        """Set traits of a part without any reaction."""
        before, self.quiet = self.quiet, True
        for name, value in traits.items():
            setattr(part, name, value)
        self.quiet = before

    def page(self, *rows):
        self.view = VBox([self.language, *rows], layout=dict(width="98%"))

    def button(self, key, react, **values):
        button = _wide(self.label(Button(), key, **values))
        self.on(button, react)
        return button

    def dropdown(self, key, words=(), **options):
        """A choice among words, whose keys are the values, or among options."""
        part = _wide(self.label(Dropdown(**options), key))

        def write():
            self.put(part, options=[(self.say(word), word) for word in words], value=part.value or words[0])
        if words:
            self.places.append(write)
            write()
        return part

    def slider(self, name, width="17em", **options):
        """A slider over the range of the parameter `name`."""
        meta = self.meta[name]
        options = dict(value=getattr(self.p, name), layout=dict(width=width), **options)
        if not meta["log"]:
            return FloatSlider(min=meta["min"], max=meta["max"], step=meta["step"], **options)
        return FloatLogSlider(min=math.log10(meta["min"]), max=math.log10(meta["max"]), step=0.05, **options)

    def field(self, name, part, row=None, sign=None, unit=True):
        """Let the part hold the parameter `name`, as self.<name>, below its sign, meaning and unit."""
        meta = self.meta[name]
        if name not in self.words:
            before, after = f"{sign}, " if sign else "", f" ({meta['unit']})" if unit and meta["unit"] else ""
            self.words = {**self.words, name: {key: before + meta[key] + after for key in ("id", "en")}}
        self.fields[name] = part
        setattr(self, name, part)
        self.on(part, self.calculate)
        return self.under(name, row or part)

    def text_field(self, name, sign=None, unit=False, slider=None):
        text = Text(f"{getattr(self.p, name):.12g}", continuous_update=False, layout=dict(width="7.5em"))
        return self.field(name, text, HBox([slider, text]) if slider else text, sign or name, unit)

    def log_field(self, name, sign=None, unit=False):
        """A log slider and a text field for one number; the text counts, the slider follows."""
        slider = self.slider(name, "10em", readout=False)
        row = self.text_field(name, sign, unit, slider)
        text, low, high = self.fields[name], self.meta[name]["min"], self.meta[name]["max"]

        def typed():                    # what the slider should show, 0 where the text is no number
            try:
                return min(max(number(text.value), low), high)
            except InputError:
                return 0

        def far():                      # by more than half a step, to which the browser rounds the slider
            return not 0.943 < typed() / slider.value < 1.06

        def follow(_):
            if typed() and far():
                self.put(slider, value=typed())

        def lead():
            if far():
                text.value = f"{slider.value:.3g}"

        text.observe(follow, "value")
        self.on(slider, lead)
        return row

    def settings(self):
        """The Params p with what the fields hold."""
        return replace(self.p, **{name: number(part.value) if isinstance(part, Text) else part.value
                                  for name, part in self.fields.items()})

    def set_fields(self, p):
        """Write the Params p into the fields without any reaction."""
        for name, part in self.fields.items():
            value = getattr(p, name)
            self.put(part, value=f"{value:.12g}" if isinstance(part, Text) else value)

    def renew(self):
        self.seed += 1
        self.start()

    def reset(self):
        self.seed = SEED
        self.set_fields(self.p)
        self.start()

    def start(self):
        self.calculate()


class Screen(HTML):
    """A place for quick drawings below each other: what the functions return, figures of plots.py."""

    def draw(self, *makes):
        with plots.live():
            self.value = "".join(make().svg() for make in makes)


def _row(*parts, align="flex-end"):
    """Parts beside each other; they wrap where the page is narrow."""
    return HBox(parts, layout=dict(flex_flow="row wrap", align_items=align, grid_gap="4px 12px"))


def _column(width, *parts, **layout):
    """Parts below each other, at least about so many pixels wide."""
    return VBox(parts, layout=dict(flex=f"1 1 {width}px", **layout))


def _text(height=None):
    """A place for sentences, so high that nothing below it moves."""
    return HTML(layout=dict(width="98%", min_height=height))


def _wide(part):
    """Give a part the width of its words."""
    part.layout.width = "auto"
    if hasattr(part.style, "description_width"):
        part.style.description_width = "initial"
    return part


def _paragraph(text, style=""):
    return f'<p style="line-height:1.5;{style}">{text}</p>'


def _headed(head, values=()):
    cells = (f"{value:.4g}" if math.isfinite(value) else "\u2013" for value in values)
    return f"<th scope='row'>{head}</th>" + "".join(f"<td>{cell}</td>" for cell in cells)


def _table(head, rows, style=""):
    """An HTML table whose head stays in place while it scrolls."""
    heads = "".join(f"<th scope='col' style='position:sticky;top:0;background:var(--jp-layout-color1,#fff);"
                    f"text-align:right'>{word}</th>" for word in head)
    body = "".join(f"<tr>{row}</tr>" for row in rows)
    return (f"<div tabindex='0' style='overflow:auto;{style}'><table style='border-spacing:8px 0;text-align:right;"
            f"line-height:1.5;font-variant-numeric:tabular-nums'><thead><tr>{heads}</tr></thead><tbody>{body}</tbody>"
            "</table></div>")


class OwnData(Board):
    """A board whose reader may bring data. A subclass gives its sources, first a built-in one, and has `use_built_in`
    and `use_own`, which fetch and filter them; what cannot be read leaves everything as it was."""
    words = Board.words | bilingual("""
        source = Data | Data
        file = berkas yang diunggah | uploaded file
        upload = Unggah CSV atau Excel | Upload CSV or Excel
        decimal = Tanda desimal | Decimal sign
        auto = kenali sendiri | find out
        , = koma (1,5) | comma (1,5)
        . = titik (1.5) | point (1.5)
        no_file = Belum ada berkas yang diunggah. | No file has been uploaded yet.
        """)

    def __init__(self, p, sources, **upload):
        super().__init__(p)
        self.source = self.dropdown("source", sources)
        self.upload = _wide(self.label(FileUpload(**upload), "upload"))
        self.on(self.source, self.load)
        self.on(self.upload, lambda: self.load("file"))
        self.built_in_source = sources[0]

    def start(self):
        self.load(self.built_in_source)

    def paste_field(self):
        self.text = self.label(Textarea(rows=3, layout=dict(width="99%")), "paste", "placeholder")
        self.sign = self.dropdown("decimal", ["auto", ",", "."])
        self.on(self.text, lambda: self.load("text"))
        self.on(self.sign, self.load)

    def load(self, source=None):
        self.put(self.source, value=source or self.source.value)
        if self.source.value in ("text", "file"):
            self.use_own()
        else:
            self.use_built_in()

    def uploaded(self):
        if not self.upload.value:
            raise self.error("no_file")
        return {file["name"]: bytes(file["content"]) for file in self.upload.value}

    def own_table(self):
        """The Table that was pasted or uploaded, and its note {"id", "en"}."""
        sign = None if self.sign.value == "auto" else self.sign.value
        if self.source.value == "text":
            table = read_text(self.text.value, sign)
        else:
            table = read_file(*next(iter(self.uploaded().items())), sign)
        return table, {"id": table.note_id, "en": table.note_en}


# --- chapter 1 -------------------------------------------------------------------------------------------------------

class TheorySteps(Board):
    """Moments 0 (start), 1 (prediction of step 1), 2 (update of step 1), 3, 4 ..."""
    STEPS = 5                       # then the car stands still
    words = Board.words | bilingual("""
        back = Sebelumnya | Previous
        next = Berikutnya | Next
        z = z, posisi terukur pada langkah ini (m) | z, measured position at this step (m)
        title 0 = Awal | Start
        title 1 = Langkah {k} dari {of}: prediksi | Step {k} of {of}: prediction
        title 2 = Langkah {k} dari {of}: pembaruan | Step {k} of {of}: update
        text 0 = Sebelum pengukuran pertama, mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s; simpangan
            bakunya {sx} m dan {sv} m/s.
            | Before the first measurement the car is believed to be at {x} m with a velocity of {v} m/s; the standard
            deviations are {sx} m and {sv} m/s.
        text 1 = Prediksi: {dt} s kemudian mobil diperkirakan berada di {x} m dengan kecepatan {v} m/s. Simpangan baku
            posisi berubah dari {before} m menjadi {sx} m.
            | Prediction: {dt} s later the car is expected at {x} m with a velocity of {v} m/s. The standard deviation
            of the position goes from {before} m to {sx} m.
        text 2 = Pembaruan: K = {K}: {percent} % dari selisih {y} m antara pengukuran dan prediksi diterima. Simpangan
            baku posisi berubah dari {before} m menjadi {sx} m. {origin}
            | Update: K = {K}: {percent} % of the difference of {y} m between measurement and prediction is accepted.
            The standard deviation of the position goes from {before} m to {sx} m. {origin}
        source = Pengukuran ini dari contoh pada sumber. | This measurement comes from the source.
        synthetic = Pengukuran ini sintetis (benih acak {seed}). | This measurement is synthetic (random seed {seed}).
        yours = Pengukuran ini pilihan Anda. | This measurement is your choice.
        """)

    def __init__(self, p=None):
        super().__init__(p or theory.Params())
        drive = theory.simulate(self.p, np.random.default_rng(SEED), self.STEPS)
        self.given = np.concatenate(([self.p.z], drive.z[1:, 0].round(1)))
        self.z = self.given.copy()
        self.moment = IntSlider(0, 0, 2 * self.STEPS, readout=False, layout=dict(width="12em"))
        self.back = self.button("back", lambda: self.go(-1))
        self.next = self.button("next", lambda: self.go(1))
        self.restart = self.button("restart", self.reset)
        limits = self.meta["z"]
        self.measured = FloatSlider(
            self.z[0], min=min(limits["min"], self.z.min() - 3), max=max(limits["max"], self.z.max() + 3),
            step=limits["step"], readout_format=".1f", layout=dict(width="24em"))
        self.equations = HTMLMath(layout=dict(width="100%", overflow="auto", min_height="15em"))
        self.sentence, self.plane, self.bells = _text("4.5em"), Screen(), Screen()
        self.page(
            _row(self.back, self.next, self.restart, self.moment),
            _row(self.log_field("Q"), self.log_field("R"), self.under("z", self.measured)),
            self.message, self.sentence,
            _row(_column(320, self.plane, self.bells), _column(400, self.equations, min_width="0"), align="flex-start"))
        self.on(self.measured, self.measure)
        self.on(self.moment, self.redraw)
        self.usual = self.boxes(self.walk())
        self.calculate()

    def go(self, step):
        self.moment.value += step

    def start(self):
        self.z = self.given.copy()
        self.put(self.moment, value=0)
        self.calculate()

    def calculate(self):
        self.steps = self.walk()
        self.redraw()

    def measure(self):
        k = (self.moment.value + 1) // 2
        if k and self.z[k - 1] != self.measured.value:
            self.z[k - 1] = self.measured.value
            self.calculate()

    def walk(self):
        """The whole filter run: for every step (x, P) before it, Prediction, Update."""
        self.model = theory.model(self.settings())
        x, P, steps = self.model.x0, self.model.P0, []
        for z in self.z:
            prediction = predict(self.model, x, P, np.array([self.p.u]))
            updated = update(self.model, prediction.x_pred, prediction.P_pred, np.array([z]))
            steps.append(((x, P), prediction, updated))
            x, P = updated.x, updated.P
        return steps

    def boxes(self, steps):
        """The lowest and the highest (p, v) of all ellipses and measurements."""
        x, P = (np.array(values) for values in zip(*(belief[:2] for step in steps for belief in step)))
        reach = 2.5 * np.sqrt(np.diagonal(P, axis1=1, axis2=2))
        low, high = (x - reach).min(axis=0), (x + reach).max(axis=0)
        low[0], high[0] = min(low[0], self.z.min() - 0.5), max(high[0], self.z.max() + 0.5)
        return low, high

    def redraw(self):
        """Kind 0 is the start, 1 the prediction of step k, 2 its update."""
        moment = self.moment.value
        k, kind = (moment + 1) // 2, 0 if moment == 0 else 2 - moment % 2
        before, prediction, updated = step = self.steps[max(k - 1, 0)]
        low, high = zip(self.usual, self.boxes(self.steps))
        self.limits = np.array([2 * np.floor(np.min(low, axis=0) / 2), 2 * np.ceil(np.max(high, axis=0) / 2)])
        self.current = k, kind, step
        self.plane.draw(self.ellipses)
        self.bells.draw(self.gaussians)
        self.equations.value = self.filled_in()
        x, P = step[kind][:2]
        K, z, given = updated.K[0, 0], self.z[max(k - 1, 0)], self.given[max(k - 1, 0)]
        origin = "yours" if z != given else "source" if k == 1 else "synthetic"
        self.sentence.value = _paragraph(
            f"<b>{self.say(f'title {kind}', k=k, of=self.STEPS)}</b><br>" + self.say(
                f"text {kind}", x=x[0], v=x[1], sx=math.sqrt(P[0, 0]), sv=math.sqrt(P[1, 1]), dt=self.p.dt,
                before=math.sqrt(step[max(kind - 1, 0)][1][0, 0]), K=K, percent=self.decimal(100 * K, 2),
                y=updated.y[0], origin=self.say(origin, seed=SEED)))
        self.put(self.measured, value=z, disabled=kind != 2)
        self.back.disabled, self.next.disabled = moment == 0, moment == self.moment.max

    def beliefs(self):
        """Label -> (x, P, look) of what is shown."""
        k, kind, (before, prediction, updated) = self.current
        shown = {f"$x_{{{max(k - 1, 0)}}}$": (*before, plots.ESTIMATE)} if kind < 2 else {}
        if kind:
            shown[f"$x_{{\\mathrm{{pred}},{k}}}$"] = (*prediction[:2], plots.PREDICTION)
        if kind == 2:
            shown[f"$x_{{{k}}}$"] = (*updated[:2], plots.ESTIMATE)
        return shown

    def ellipses(self):
        k, kind, _ = self.current
        z = dict(z=self.z[k - 1], R=self.model.R[0, 0]) if kind == 2 else {}
        return plots.ellipses(self.beliefs(), **z, limits=self.limits.T)

    def gaussians(self):
        """The position alone, above the same axis as the ellipses."""
        k, kind, _ = self.current
        *curves, last = [(label, (x[0], P[0, 0], look)) for label, (x, P, look) in self.beliefs().items()]
        measured = [("$z$", (self.z[k - 1], self.model.R[0, 0], plots.MEASUREMENT))] if kind == 2 else []
        curves = dict([*curves, *measured, last])
        figure = plots.gaussians(curves, xlabel="$p$ (m)", height=2.2)
        highest = max(1 / math.sqrt(2 * math.pi * variance) for _, variance, _ in curves.values())
        figure.axes[0].set(ylabel="$f(p)$", xlim=self.limits[:, 0], ylim=(0, 1.1 * 2 ** math.ceil(math.log2(highest))))
        return figure

    def filled_in(self):
        """The equations of the moment with their numbers, as LaTeX."""
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
            minus = f"({_tex(x_pred[0])})" if x_pred[0] < 0 else _tex(x_pred[0])
            lines = [f"y &= z - H x{pred} = {_tex(z)} - {minus} = {_tex(y)}",
                     f"S &= H P{pred} {HT} + R = {_tex(P_pred[0, 0])} + {_tex(m.R)} = {_tex(S)}",
                     rf"K &= P{pred} {HT} S^{{-1}} = {_tex(P_pred[:, 0])} \frac{{1}}{{{_tex(S)}}} = {_tex(K)}",
                     f"x &= x{pred} + K y = {_tex(x_pred)} + {_tex(K)} ({_tex(y)}) = {_tex(x_new)}",
                     f"P &= (I - K H) P{pred}", f"&= {_tex(np.eye(2) - K @ m.H)} {_tex(P_pred)} = {_tex(P_new)}"]
        return r"$$\begin{aligned}" + r"\\[4pt]".join(lines) + r"\end{aligned}$$"


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
    """The paper's form: No / Measured / Filtered, driven by Q, R, x0, P0."""
    LOOK_ALIKES = {"silkworm_room": dict(R=1e-3, window=3), "cutting_force": dict(R=1e-3, window=5),
                   "tank_level": dict(R=7.7e-4, window=2)}      # the paper's settings; Q is 1e-5
    words = OwnData.words | bilingual("""
        paper = 16 nilai dari makalah | the paper's 16 values
        silkworm_room = suhu ruang ulat sutra (sintetis) | temperature of a silkworm room (synthetic)
        cutting_force = gaya potong pelepah sawit (sintetis) | cutting force of oil-palm frond (synthetic)
        tank_level = muka air tangki ikan (sintetis) | water level of a fish tank (synthetic)
        given = data dari sel kode | data from the code cell
        text = kolom yang ditempel | pasted column
        paste = Tempelkan satu kolom bilangan di sini, misalnya dari Excel.
            | Paste a column of numbers here, for example from Excel.
        column = Kolom | Column
        shown = N = {n}. Data yang ditampilkan: {what} | N = {n}. Data shown: {what}
        steady = Rentang tunak (No) | Steady stretch (No)
        take_R = R dari rentang ini | R from this stretch
        too_short = Rentang itu berisi kurang dari dua nilai. | That stretch holds fewer than two values.
        likelihood = Q dan R paling mungkin | Most likely Q and R
        cut = Hanya {n} nilai pertama yang dipakai untuk mencari Q dan R.
            | Only the first {n} values were used to find Q and R.
        window = Jendela rataan bergerak | Window of the moving average
        measured = Terukur | Measured
        filtered = Hasil filter | Filtered
        average = Rataan bergerak | Moving average
        middle = {n} baris di tengah tidak ditampilkan; unduhan memuat semuanya.
            | {n} rows in the middle are not shown; the download has them all.
        filter = Filter Kalman | Kalman filter
        roughness = Kekasaran (simpangan baku langkah) | Roughness (standard deviation of the steps)
        lag_truth = Kelambatan terhadap nilai sebenarnya (sampel) | Lag behind the truth (samples)
        lag_rts = Kelambatan terhadap penghalus RTS (sampel) | Lag behind the RTS smoother (samples)
        rmse = RMSE | RMSE
        no_truth = nilai sebenarnya tidak diketahui | no truth known
        csv = Siapkan CSV | Prepare CSV
        xlsx = Siapkan Excel dengan rumus hidup | Prepare Excel with live formulas
        save = Simpan {name} | Save {name}
        """)

    def __init__(self, z=None, p=None):
        self.given = None if z is None else np.asarray(z, dtype=float).ravel()
        given = [] if z is None else ["given"]
        super().__init__(p or smoother.Params(), ["paper", *self.LOOK_ALIKES, *given, "text", "file"],
                         accept=".csv,.txt,.tsv,.xlsx")
        self.paste_field()
        self.figure = self.result = None
        self.column = self.dropdown("column")
        self.steady = IntRangeSlider(min=1, layout=dict(width="17em"))
        self.take_R = self.button("take_R", self.R_from_steady)
        self.likelihood = self.button("likelihood", self.most_likely)
        self.csv, self.xlsx = self.button("csv", self.prepare_csv), self.button("xlsx", self.prepare_xlsx)
        self.note, self.measures, self.link = HTML(), HTML(), HTML()
        self.table, self.plot = HTML(layout=dict(flex="0 0 270px")), Screen()
        window = IntSlider(self.p.window, 1, max(50, self.p.window), layout=dict(width="15em"))
        self.page(
            _row(self.source, self.column, self.sign, self.upload), self.text,
            self.note, self.message,
            _row(self.log_field("Q"), self.log_field("R"), self.text_field("x0"), self.text_field("P0"),
                 self.field("window", window)),
            _row(self.under("steady", HBox([self.steady, self.take_R])), self.likelihood),
            _row(self.table, _column(380, self.plot, self.measures), align="flex-start"),
            _row(self.csv, self.xlsx, self.link))
        self.on(self.column, self.choose)
        self.put(self.source, value=[*given, "paper"][0])
        self.take(*self.built_in())

    def use_own(self):
        table, what = self.own_table()
        self.take(table.columns, None, what)

    def use_built_in(self):
        source = self.source.value
        if source != "given":
            self.set_fields(smoother.Params(**self.LOOK_ALIKES.get(source, {})))
        self.take(*self.built_in())

    def built_in(self):
        """The columns, the truth (T,) or None, and what it is."""
        source = self.source.value
        what = {language: word + "." for language, word in self.words[source].items()}
        if source in self.LOOK_ALIKES:
            made_up = getattr(smoother, source)(np.random.default_rng(SEED))
            return {"z": made_up.z[:, 0]}, made_up.x[:, 0], what
        return {"z": self.given if source == "given" else smoother.MEASURED}, None, what

    def take(self, columns, truth, what):
        self.columns, self.truth, self.what = columns, truth, what
        names = list(columns)
        self.put(self.column, options=names, value=names[0])
        self.column.layout.display = None if len(names) > 1 else "none"
        self.choose()

    def choose(self):
        self.z = self.columns[self.column.value]
        self.steady.max, self.steady.value = len(self.z), (1, min(len(self.z), 20))
        self.calculate()

    def calculate(self):
        """Filter and show; nothing on the screen changes before all of it is known."""
        p, z, truth, n = self.settings(), self.z, self.truth, len(self.z)
        x, P, K, smooth = smoother.scalar_filter(z, p)
        average = smoother.moving_average(z, p.window)

        def figure():
            return plots.series(np.arange(1, n + 1), z, x, rivals={f"MA({p.window})": average}, truth=truth)

        self.plot.draw(figure)
        self.figure, self.result = figure, (p, z, truth, x, P, K, smooth, average, self.what)
        self.redraw()

    def redraw(self):
        if self.result is None:
            return
        p, z, truth, x, P, K, smooth, average, what = self.result
        self.link.value = ""
        self.note.value = f"<p style='margin:0'>{escape(self.say('shown', n=len(z), what=what[self.language.value]))}</p>"
        self.table.value = self.table_of(z, x)
        reference, rivals = smooth if truth is None else truth, (x, average)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")         # a mean of nothing is NaN, shown as a dash
            rows = {"roughness": [smoother.roughness(values) for values in rivals],
                    "lag_rts" if truth is None else "lag_truth": [smoother.lag(values, reference) for values in rivals],
                    "rmse": [] if truth is None else [rmse(truth, values) for values in rivals]}
        no_truth = f"<td colspan='2'>{self.say('no_truth')}</td>"
        self.measures.value = _table(["", self.say("filter"), f"{self.say('average')} ({p.window})"],
                                     [_headed(self.say(key), values) if values else _headed(self.say(key)) + no_truth
                                      for key, values in rows.items()])

    def table_of(self, z, x):
        """The table No / Measured / Filtered as HTML; a long one without its middle."""
        n, half = len(z), TABLE_ROWS // 2
        scale = np.nanmax(np.abs(z))
        digits = 6 if not 0 < scale < 0.01 else 4 - math.floor(math.log10(scale))      # small values get more
        rows = [f"<td>{k}</td><td>{'' if np.isnan(a) else _fixed(a, digits, trim='-')}</td><td>{_fixed(b, digits)}</td>"
                for k, a, b in zip(range(1, n + 1), z, x) if n <= TABLE_ROWS or not half < k <= n - half]
        hidden = ""
        if n > TABLE_ROWS:
            rows.insert(half, "<td>⋮</td>" * 3)
            hidden = f"<p style='margin:4px 0;line-height:1.4'>{self.say('middle', n=n - TABLE_ROWS)}</p>"
        return _table(["No", self.say("measured"), self.say("filtered")], rows, "height:26em") + hidden

    def R_from_steady(self):
        first, last = self.steady.value
        stretch = self.z[first - 1:last]
        if np.isfinite(stretch).sum() < 2:
            raise self.error("too_short")
        self.R.value = f"{smoother.R_from_steady(stretch):.6g}"

    def most_likely(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")         # absurd pairs overflow and lose
            found = smoother.maximum_likelihood(self.z[:LONGEST])
        Q, R = (float(f"{np.clip(value, self.meta[name]['min'], self.meta[name]['max']):.6g}")
                for name, value in zip("QR", found))
        first = self.z[np.isfinite(self.z)][0]      # where the likelihood starts
        self.set_fields(replace(self.result[0], Q=Q, R=R, x0=first, P0=R))
        self.calculate()
        if len(self.z) > LONGEST:
            self.tell(self.both("cut", n=LONGEST))

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
        """A link that holds the file."""
        data = base64.b64encode(content).decode()
        self.link.value = (f'<a download="{name}" href="data:{kind};base64,{data}" '
                           f'style="color:#1f6fb4;text-decoration:underline">{self.say("save", name=name)}</a>')


def _fixed(value, digits, **options):
    if abs(value) >= 1e12:
        return f"{value:.6e}"
    return np.format_float_positional(value, digits, **options) if options else f"{value:.{digits}f}"


# --- chapter 2: one measurement at a time ----------------------------------------------------------------------------

class SmootherOnline(Board):
    """Whenever a measurement arrives: one `predict`, one `update`."""
    words = bilingual("""
        new = Pengukuran baru | New measurement
        hint = bilangan, lalu Enter | a number, then Enter
        add = Tambahkan | Add
        clear = Kosongkan | Clear
        stream = Aliran sintetis (suhu ruang ulat sutra, benih acak {seed}):
            | Synthetic stream (temperature of a silkworm room, random seed {seed}):
        waiting = Belum ada pengukuran. Isilah satu bilangan atau jalankan aliran sintetis.
            | No measurement yet. Enter a number or play the synthetic stream.
        """)

    def __init__(self, p=None):
        super().__init__(p or smoother.Params(Q=1e-3, R=0.09, P0=1000))
        self.model = smoother.model(self.p)
        self.stream = smoother.silkworm_room(np.random.default_rng(SEED)).z[:, 0]
        self.entry = _wide(self.label(self.label(Text(continuous_update=False), "new"), "hint", "placeholder"))
        self.entry.layout.width = "22em"
        self.button, self.restart = self.button("add", self.enter), self.button("clear", self.reset)
        self.play = Play(min=0, max=len(self.stream), interval=300, show_repeat=False)
        self.numbers, self.plot = _text("4em"), Screen()
        self.page(
            _row(self.entry, self.button, self.restart),
            _row(self.label(Label(), "stream", "value", seed=SEED), self.play),
            self.message, self.numbers, self.plot)
        self.on(self.entry, self.enter)
        self.on(self.play, self.feed)
        self.reset()

    def reset(self):
        self.x, self.P, self.K, self.fed = self.model.x0, self.model.P0, None, 0
        self.history = []               # (z, x, P) of every arrival
        self.put(self.play, playing=False, value=0)
        self.redraw()

    def enter(self):
        if self.entry.value.strip():
            z = number(self.entry.value)
            self.put(self.entry, value="")
            self.add(z)

    def feed(self):
        arrived, self.fed = self.stream[self.fed:self.play.value], self.play.value
        self.add(*arrived)

    def add(self, *measurements):
        for z in measurements:
            self.x, self.P, _ = predict(self.model, self.x, self.P)
            self.x, self.P, _, _, self.K = update(self.model, self.x, self.P, np.array([z]))
            self.history.append((z, self.x[0], self.P[0, 0]))
        self.redraw()

    def figure(self):
        """The last 200 measurements."""
        z, x, P = np.array(self.history[-200:]).T
        first = len(self.history) - len(z)
        figure = plots.series(np.arange(first + 1, first + len(z) + 1), z, x, np.sqrt(P))
        figure.axes[0].set(xlim=(first, first + 50 * math.ceil(len(z) / 50)))
        return figure

    def redraw(self):
        self.plot.layout.display = None if self.history else "none"
        if not self.history:
            self.numbers.value = f"<p>{self.say('waiting')}</p>"
            return
        self.plot.draw(self.figure)
        z, x, P = self.history[-1]
        cells = [f"{len(self.history)}", f"{z:.6g}", f"{self.K[0, 0]:.6f}", f"{x:.6f}", f"{P:.6g}"]
        self.numbers.value = _table(["k", "z", "K", "x", "P"], ["".join(f"<td>{cell}</td>" for cell in cells)])


# --- chapter 3 -------------------------------------------------------------------------------------------------------

class GyroFlight(Board):
    """The paper's simulation: its four inputs and its two panels."""
    FIELDS = {"duration": "t", "T": "T", "sigma_w": "σ_w", "sigma_v": "σ_v"}
    words = Board.words | bilingual("""
        case = Kasus {figure} | Case {figure}
        angle = Sudut (rad) terhadap t (s) | Angle (rad) against t (s)
        errors = Galat (rad) terhadap t (s) | Error (rad) against t (s)
        first = langkah pertama | first step
        last = langkah terakhir | last step
        outcome = Galat pengukuran terbesar {z} rad, galat estimasi terbesar {x} rad. RMSE sensor {sensor} rad, RMSE
            filter {rmse} rad; {inside} % dari galat filter berada di dalam ±2√P. Data sintetis (benih acak {seed}).
            | Largest measurement error {z} rad, largest estimation error {x} rad. RMSE of the sensor {sensor} rad, of
            the filter {rmse} rad; {inside} % of the filter's errors lie within ±2√P. Synthetic data (random seed
            {seed}).
        """)

    def __init__(self, p=None):
        super().__init__(p or gyro_paper.Params())
        rows = [self.log_field(name, sign, unit=True) for name, sign in self.FIELDS.items()]
        self.noise = self.button("noise", self.renew)
        self.figures = {figure: self.button("case", lambda figure=figure: self.choose(figure), figure=figure)
                        for figure in gyro_paper.CASES}
        self.sentence, self.table, self.angle, self.errors = _text("4.5em"), HTML(), Screen(), Screen()
        self.page(
            _row(*rows), _row(self.noise, *self.figures.values()), self.message, self.sentence,
            _row(_column(320, self.under("angle", self.angle), self.under("errors", self.errors)), self.table,
                 align="flex-start"))
        self.calculate()

    def choose(self, figure):
        sigma_w, sigma_v = gyro_paper.CASES[figure]
        self.set_fields(gyro_paper.Params(sigma_w=sigma_w, sigma_v=sigma_v))
        self.calculate()

    def calculate(self):
        p = self.settings()
        flight = gyro_paper.simulate(p, np.random.default_rng(self.seed))
        result = kalman_filter(gyro_paper.model(p), flight.z, flight.u)
        self.rows = gyro_paper.layout(p, flight, result)
        for screen, row in zip((self.angle, self.errors), self.rows):
            screen.draw(lambda: plots.series(**row, xlabel="$t$ (s)", height=2.2))
        self.result = flight, result, self.seed
        self.redraw()

    def redraw(self):
        flight, result, seed = self.result
        z, x = gyro_paper.maxima(flight, result)
        sigma = np.sqrt(result.P[:, 0, 0])
        inside = 100 * np.mean(np.abs(flight.x - result.x)[:, 0] <= 2 * sigma)
        self.sentence.value = '<p role="status" style="line-height:1.5">' + self.say(
            "outcome", z=z, x=x, sensor=rmse(flight.x, flight.z)[0], rmse=rmse(flight.x, result.x)[0], inside=inside,
            seed=seed) + "</p>"
        rows = {"K": result.K[:, 0, 0], "P (rad²)": result.P[:, 0, 0], "√P (rad)": sigma}
        self.table.value = _table(["", self.say("first"), self.say("last")],
                                  [_headed(name, values[[0, -1]]) for name, values in rows.items()])


class GyroMismatch(Board):
    """What a wrong sigma costs: RMSE and NEES of every pair that the filter may believe; one pair against 500 runs."""
    RUNS, POWERS = 500, np.linspace(-1, 1, 31)          # along both axes: 10 ** POWERS times the true sigma
    LEVELS = {"cost": (1.1, 1.3, 1.6, 2, 2.5, 3), "nees": (0.03, 0.1, 0.3, 1, 3, 10, 30)}
    words = Board.words | bilingual("""
        truth = Filter percaya yang benar | Let the filter believe the truth
        cost = RMSE dibagi yang terbaik: σ_w mendatar, σ_v tegak (log₁₀)
            | RMSE divided by the best: σ_w across, σ_v upwards (log₁₀)
        nees = NEES: σ_w mendatar, σ_v tegak (log₁₀) | NEES: σ_w across, σ_v upwards (log₁₀)
        outcome = Filter percaya σ_w = {w} rad/s dan σ_v = {v} rad, padahal yang benar {true_w} dan {true_v}. RMSE-nya
            {rmse} rad, {cost} kali yang terbaik ({best} rad), dan NEES-nya {nees}: {word}. Dari {runs} percobaan
            sintetis (benih acak {seed}): RMSE {all} rad, NEES {mean}.
            | The filter believes σ_w = {w} rad/s and σ_v = {v} rad; the truth is {true_w} and {true_v}. Its RMSE is
            {rmse} rad, {cost} times the best ({best} rad), and its NEES {nees}: {word}. From {runs} synthetic runs
            (random seed {seed}): RMSE {all} rad, NEES {mean}.
        sure = terlalu yakin | too sure
        doubtful = terlalu ragu | too doubtful
        honest = P-nya jujur | its P is honest
        """)

    @dataclass(frozen=True)
    class Params(gyro_paper.Params):
        """The truth, and how many times its sigmas the filter believes."""
        c_w: float = param(1, min=0.1, max=10, step=0.1, unit="", log=True,
                           id="σ_w menurut filter dibagi yang benar", en="σ_w as the filter believes it, over the true one")
        c_v: float = param(1, min=0.1, max=10, step=0.1, unit="", log=True,
                           id="σ_v menurut filter dibagi yang benar", en="σ_v as the filter believes it, over the true one")

    def __init__(self, p=None):
        super().__init__(self.Params(**vars(p or gyro_paper.Params())))
        self.flights = {}               # what they depend on -> the runs
        signs = {"c_w": "c_w", "c_v": "c_v", "sigma_w": "σ_w", "sigma_v": "σ_v"}
        rows = [self.log_field(name, sign, unit=True) for name, sign in signs.items()]
        self.noise, self.truth = self.button("noise", self.renew), self.button("truth", self.believe)
        self.sentence, self.maps = _text("4.5em"), {"cost": Screen(), "nees": Screen()}
        self.page(
            _row(*rows), _row(self.noise, self.truth), self.message, self.sentence,
            _row(*(_column(300, self.under(name, screen, kind=HTML)) for name, screen in self.maps.items())))
        self.calculate()

    def believe(self):
        for part in (self.c_w, self.c_v):
            self.put(part, value="1")
        self.calculate()

    def calculate(self):
        """Both maps, without data, and the chosen pair from 500 runs; nothing changes before all of it is known."""
        p, grid = self.settings(), 10 ** self.POWERS
        w, v = p.c_w * p.sigma_w, p.c_v * p.sigma_v
        rmse_map, nees_map = gyro_paper.expected(p, grid * p.sigma_w, grid[:, np.newaxis] * p.sigma_v)
        best, wrong = rmse_map[15, 15], gyro_paper.expected(p, w, v)
        drawn = p.sigma_w, p.sigma_v, self.seed
        if drawn not in self.flights:
            self.flights = {drawn: gyro_paper.simulate(p, np.random.default_rng(self.seed), self.RUNS)}
        flight = self.flights[drawn]
        told = kalman_filter(replace(gyro_paper.model(p), Q=(w * p.T) ** 2, R=v ** 2), flight.z, flight.u)
        squares = np.mean((flight.x - told.x)[:, 0] ** 2, axis=1)
        self.result = dict(w=w, v=v, true_w=p.sigma_w, true_v=p.sigma_v, rmse=wrong[0], nees=wrong[1], best=best,
                           cost=wrong[0] / best, all=np.sqrt(squares.mean()), mean=np.mean(squares / told.P[:, 0, 0]),
                           runs=self.RUNS, seed=self.seed)
        self.tables = {"cost": rmse_map / best, "nees": nees_map}
        for name, screen in self.maps.items():
            screen.draw(lambda: self.figure(name, height=3.0))
        self.redraw()

    def figure(self, name="cost", height=3.4):
        """One map; the truth and what the filter believes are marked. Levels of NEES are even in its logarithm."""
        r, table, levels, fmt = self.result, self.tables[name], self.LEVELS[name], "%g"
        if name == "nees":
            table, levels, fmt = np.log10(table), np.log10(levels), lambda power: f"{round(10 ** power, 2):g}"
        truth, told = np.log10([r["true_w"], r["true_v"]]), np.log10([r["w"], r["v"]])
        return plots.contours(self.POWERS + truth[0], self.POWERS + truth[1], table, r"$\log_{10} \sigma_w$",
                              r"$\log_{10} \sigma_v$", levels, {r"$\sigma$": truth, r"$c\,\sigma$": told},
                              height=height, fmt=fmt)

    def redraw(self):
        nees = self.result["nees"]
        word = self.say("sure" if nees > 1.1 else "doubtful" if nees < 0.9 else "honest")
        self.sentence.value = '<p role="status" style="line-height:1.5">' + self.say(
            "outcome", word=word, **self.result) + "</p>"


# --- chapter 5 -------------------------------------------------------------------------------------------------------

class Beetle(Board):
    """The EKF on a synthetic walk of 20 s: what it can learn, and what not."""
    SECONDS = 20
    SLIDERS = {"dt": "Δt", "theta": "θ", "v": "v", "theta0": "θ₀", "v0": "v₀"}
    words = Board.words | bilingual("""
        printed = R dari sumber (cm²) | R of the source (cm²)
        distance = Jarak menurut pengukuran, filter (dengan pita), dan yang sebenarnya:
            | Distance: measured, filtered (with band), and true:
        uncertainty = Simpangan baku menurut filter, dibagi nilai awalnya (s = v cos θ):
            | Standard deviations the filter states, divided by their start (s = v cos θ):
        result = Sesudah {t} s filter menyatakan d = {d} cm dan s = {s} cm/s (sebenarnya {d_true} dan {s_true}). Untuk
            θ ia menyatakan {theta} rad dan untuk v {v} cm/s (sebenarnya {theta_true} dan {v_true}); menurutnya, dari
            simpangan baku awalnya tersisa {left_theta} % dan {left_v} %, sedangkan untuk s {left_s} %. Simpangan baku
            sensornya {sensor} cm; RMSE jarak hasil filter {rmse} cm.
            | After {t} s the filter states d = {d} cm and s = {s} cm/s (true: {d_true} and {s_true}). For θ it states
            {theta} rad and for v {v} cm/s (true: {theta_true} and {v_true}); it claims that of their initial standard
            deviations {left_theta} % and {left_v} % remain, of that of s {left_s} %. The sensor's standard deviation
            is {sensor} cm; the RMSE of the filtered distance is {rmse} cm.
        high = NIS rata-rata {nis}, di atas pita 95 %: filter terlalu yakin (R-nya terlalu kecil, atau tebakan awalnya
            lebih buruk daripada yang dikiranya).
            | Mean NIS {nis}, above the 95 % band: the filter is overconfident (its R is too small, or its initial
            guess worse than it thinks).
        low = NIS rata-rata {nis}, di bawah pita 95 %: filter terlalu ragu (R-nya terlalu besar).
            | Mean NIS {nis}, below the 95 % band: the filter is too doubtful (its R is too large).
        fits = NIS rata-rata {nis}, di dalam pita 95 %: inovasinya sesuai dengan R itu.
            | Mean NIS {nis}, inside the 95 % band: the innovations fit that R.
        origin = Jalannya kumbang sintetis (benih acak {seed}). | The walk is synthetic (random seed {seed}).
        """)

    def __init__(self, p=None):
        super().__init__(p or beetle_paper.Params())
        self.printed = ToggleButtons(options=[(f"{R:g}", R) for R in sorted(beetle_paper.PRINTED_R)], value=None,
                                     style=dict(button_width="auto"))
        self.sliders = self.fields
        self.noise, self.restart = self.button("noise", self.renew), self.button("restart", self.reset)
        self.sentence, self.plot, self.spread = _text("6em"), Screen(), Screen()
        self.page(
            _row(self.under("printed", self.printed), self.log_field("R")),
            _row(*(self.field(name, self.slider(name, continuous_update=False), sign=sign)
                   for name, sign in self.SLIDERS.items())),
            _row(self.noise, self.restart),
            self.message, self.sentence,
            _row(_column(320, self.under("distance", self.plot, kind=HTML)),
                 _column(320, self.under("uncertainty", self.spread, kind=HTML))))
        self.on(self.printed, self.choose)
        self.calculate()

    def choose(self):
        if self.printed.value is not None:
            self.R.value = f"{self.printed.value:g}"

    def calculate(self):
        p = self.settings()
        model = beetle_paper.model(p)
        walk = beetle_paper.simulate(p, np.random.default_rng(self.seed), round(self.SECONDS / p.dt))
        result = kalman_filter(model, walk.z)
        self.put(self.printed, value=p.R if p.R in beetle_paper.PRINTED_R else None)
        self.current = p, walk, result, self.shares(model, result)
        self.plot.draw(self.figure)
        self.spread.draw(self.spreads)
        self.redraw()

    def figure(self):
        p, walk, result, _ = self.current
        t = p.dt * np.arange(1, len(walk.z) + 1)
        figure = plots.series(t, walk.z[:, 0], result.x[:, 0], np.sqrt(result.P[:, 0, 0]), walk.x[:, 0],
                              names={"x": "$d$", "truth": r"$d_{\mathrm{true}}$"}, xlabel="$t$ (s)", ylabel="cm")
        figure.axes[0].set(xlim=(0, 1.02 * self.SECONDS))
        return figure

    def spreads(self):
        p, walk, _, shares = self.current
        t = p.dt * np.arange(len(walk.z) + 1)
        signs = {"theta": r"$\sigma_\theta$", "v": r"$\sigma_v$", "s": r"$\sigma_s$"}
        return plots.curve({signs[name]: (t, share) for name, share in shares.items()}, "$t$ (s)",
                           r"$\sigma\,/\,\sigma_0$", ylim=(0, 1.2), height=3.0)

    @staticmethod
    def shares(model, result):
        """Standard deviations of theta, v and s (T + 1,), divided by the initial ones."""
        x, P = np.vstack([model.x0, result.x]), np.concatenate([model.P0[np.newaxis], result.P])
        sigmas = {"theta": np.sqrt(P[:, 1, 1]), "v": np.sqrt(P[:, 2, 2]), "s": beetle_paper.away_sigma(x, P)}
        return {name: sigma / sigma[0] for name, sigma in sigmas.items()}

    def redraw(self):
        p, walk, result, shares = self.current
        x, truth, mean = result.x[-1], walk.x[-1], float(np.nanmean(nis(result.y, result.S)))
        low, high = chi2_bounds(1, runs=len(walk.z))
        verdict = "high" if mean > high else "low" if mean < low else "fits"
        sentences = [
            self.say("result", t=self.decimal(len(walk.z) * p.dt), d=x[0], d_true=truth[0], s=beetle_paper.away(x),
                     s_true=beetle_paper.away(truth), theta=x[1], theta_true=truth[1], v=x[2], v_true=truth[2],
                     rmse=rmse(walk.x[:, 0], result.x[:, 0]), sensor=math.sqrt(p.R_true),
                     **{f"left_{name}": 100 * share[-1] for name, share in shares.items()}),
            self.say(verdict, nis=self.decimal(mean, 2)), self.say("origin", seed=self.seed)]
        self.sentence.value = _paragraph(" ".join(sentences))


# --- chapter 4: the towing run ---------------------------------------------------------------------------------------

class ShipRun(OwnData):
    """Fit AR(2) and filter: the synthetic towing run, or a reader's two columns time and speed."""
    words = OwnData.words | bilingual("""
        synthetic = uji tarik sintetis | synthetic towing run
        text = kolom yang ditempel | pasted columns
        paste = Tempelkan dua kolom di sini: waktu, lalu kecepatan. | Paste two columns here: time, then speed.
        two = Diperlukan dua kolom bilangan, waktu dan kecepatan; hanya satu yang ditemukan.
            | Two columns of numbers are needed, time and speed; only one was found.
        same = Waktu dan kecepatan harus dua kolom yang berbeda. | Time and speed must be two different columns.
        time = Kolom waktu | Time column
        speed = Kolom kecepatan | Speed column
        time_unit = Satuan waktu | Unit of time
        speed_unit = Satuan kecepatan | Unit of speed
        sigma = Derau uji tarik sintetis (m/s) | Noise of the synthetic towing run (m/s)
        first = mulai dari pengukuran pertama | start at the first measurement
        smooth = penghalus (maju, lalu mundur) | smoother (forwards, then backwards)
        too_long = Di sini penghalus hanya melayani paling banyak {n} baris.
            | Here the smoother handles at most {n} rows.
        made = Data sintetis, benih acak {seed}. | Synthetic data, random seed {seed}.
        gaps = {n} kecepatan kosong: di sana filter hanya memprediksi.
            | {n} speeds are missing: there the filter only predicts.
        result = Kuadrat terkecil: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Kutub: {poles}.
            | Least squares: c = {c} m/s, a₁ = {a1}, a₂ = {a2}. Poles: {poles}.
        unstable = Ada kutub di luar lingkaran: model ini tidak stabil.
            | A pole lies outside the circle: this model is unstable.
        rmse = RMSE: pengukuran {z} m/s, estimasi {x} m/s. | RMSE: measurements {z} m/s, estimate {x} m/s.
        nis = Rata-rata NIS = {nis} (seharusnya sekitar 1). | Mean NIS = {nis} (it should be about 1).
        """)

    def __init__(self, p=None):
        super().__init__(p or ship_paper.Params(), ["synthetic", "text", "file"], accept=".csv,.txt,.tsv,.xlsx")
        self.paste_field()
        self.figure = self.result = self.data = self.columns = None
        self.time, self.speed = self.dropdown("time"), self.dropdown("speed")
        self.time_unit = self.dropdown("time_unit", options=list(ship_paper.TIME_UNITS))
        self.speed_unit = self.dropdown("speed_unit", options=list(ship_paper.SPEED_UNITS))
        self.sigma = self.slider("sigma", "19em")
        self.new = self.button("noise", self.renew)
        self.first, self.smooth = (self.label(Checkbox(indent=False), key) for key in ("first", "smooth"))
        self.note, self.sentence, self.plot, self.circle = _text(), _text(), Screen(), Screen()
        self.page(
            _row(self.source, self.under("sigma", self.sigma), self.new),
            _row(self.upload, self.time_unit, self.speed_unit, self.sign, self.time, self.speed), self.text,
            self.note, self.message,
            _row(self.log_field("Q"), self.log_field("R"), VBox([self.first, self.smooth])),
            self.sentence,
            _row(_column(380, self.plot), _column(300, self.circle, max_width="420px"), align="flex-start"))
        self.on(self.sigma, self.start)
        for part in (self.time, self.speed, self.time_unit, self.speed_unit):
            self.on(part, self.choose)
        for part in (self.first, self.smooth):
            self.on(part, self.calculate)
        self.start()

    def use_built_in(self):
        t, run = ship_paper.towing_run(np.random.default_rng(self.seed), self.sigma.value)
        if self.columns:                # until now a reader's; the synthetic run starts at rest
            self.put(self.first, value=False)
        self.columns = None
        self.calculate((t, run.z[:, 0], run.x[:, 0], self.both("made", seed=self.seed)))

    def use_own(self):
        table, what = self.own_table()
        if len(table.columns) < 2:
            raise self.error("two")
        names = list(table.columns)
        self.put(self.time, options=names, value=names[0])
        self.put(self.speed, options=names, value=names[1])
        self.put(self.first, value=True)        # a stranger's run need not start at rest
        self.columns, self.what = table.columns, what
        self.choose()

    def choose(self):
        if not self.columns:
            return
        if self.time.value == self.speed.value:
            raise self.error("same")
        t = self.columns[self.time.value] * ship_paper.TIME_UNITS[self.time_unit.value]
        z = self.columns[self.speed.value] * ship_paper.SPEED_UNITS[self.speed_unit.value]
        self.calculate((t, z, None, self.what))

    def calculate(self, data=None):
        """Fit, filter and show the data (t, z, truth or None, what it is), or those shown now."""
        t, z, truth, _ = data = data or self.data
        sampled = ship_paper.sampling(t)
        p = self.settings()
        p = ship_paper.fitted(z, replace(p, Q_copy=p.Q))
        if self.first.value:
            p = replace(p, x0=float(z[np.isfinite(z)][0]), P0=p.R)
        model = ship_paper.model(p)                 # refuses what is out of range
        x, P, y, S = ship_paper.quick_filter(z, p)
        if self.smooth.value:
            if len(z) > LONGEST:
                raise self.error("too_long", n=LONGEST)
            result = rts_smooth(kalman_filter(model, z, u=np.ones(len(z))))
            x, P = result.x[:, 0], result.P[:, 0, 0]

        def figure():
            return plots.series(t, z, x, np.sqrt(P), truth=truth, names={"x": "$x_s$" if self.smooth.value else "$x$"},
                                xlabel="$t$ (s)", ylabel="m/s")

        self.plot.draw(figure)
        self.circle.draw(lambda: plots.poles({"$p$": ship_paper.poles(p.a1, p.a2)}, height=3.4))
        for part in (self.time, self.speed):
            part.layout.display = None if self.columns else "none"
        self.figure, self.data, self.result = figure, data, (p, x, nis(y[:, np.newaxis], S[:, np.newaxis, np.newaxis]), sampled)
        self.redraw()

    def redraw(self):
        if self.result is None:
            return
        (p, x, nis_values, sampled), (t, z, truth, what) = self.result, self.data
        gaps = int(np.isnan(z).sum())
        notes = [what[self.language.value], getattr(sampled, self.language.value)]
        notes += [self.say("gaps", n=gaps)] if gaps else []
        poles = ship_paper.poles(p.a1, p.a2)
        shown = " ; ".join(self.decimal(pole.real) for pole in poles)
        if abs(poles[0].imag) > 0:
            shown = f"{self.decimal(poles[0].real)} ± {self.decimal(abs(poles[0].imag))} i"
        said = [self.say("result", c=self.decimal(p.c), a1=self.decimal(p.a1), a2=self.decimal(p.a2), poles=shown)]
        said += [self.say("unstable")] if np.abs(poles).max() > 1 else []
        said += [] if truth is None else [self.say("rmse", z=rmse(truth, z), x=rmse(truth, x))]
        said += [self.say("nis", nis=np.nanmean(nis_values))]
        self.note.value, self.sentence.value = (_paragraph(escape(" ".join(lines)), "margin:0") for lines in (notes, said))


# --- chapter 6 -------------------------------------------------------------------------------------------------------

class Quadrotor(OwnData):
    """The three methods on a synthetic flight or on a phone's recording."""
    SENSORS = ("gyr", "acc", "mag")
    words = OwnData.words | bilingual("""
        gyr = giroskop | gyroscope
        acc = akselerometer | accelerometer
        mag = magnetometer | magnetometer
        flight = penerbangan sintetis | synthetic flight
        file = rekaman saya | my recording
        upload = Unggah rekaman (CSV atau ZIP) | Upload a recording (CSV or ZIP)
        no_file = Belum ada rekaman yang diunggah. | No recording has been uploaded yet.
        no_rest = Rekaman ini tidak diawali keadaan diam. Letakkan ponsel diam selama beberapa detik, lalu mulai.
            | This recording does not begin at rest. Let the phone lie still for a few seconds, then start.
        method = Cara | Method
        literal = persis seperti tercetak | to the letter of the paper
        paper = makalah, dibetulkan | the paper, corrected
        adaptive = adaptif | adaptive
        sensors = Sensor yang dipakai | Sensors in use
        moment = Saat (s) | Moment (s)
        angles = Roll, pitch, dan yaw (derajat): estimasi tebal, pembanding tipis
            | Roll, pitch and yaw (degrees): estimate thick, reference thin
        craft = Wahana, dilihat dari selatan dan dari atas: estimasi tebal, pembanding tipis
            | The craft, seen from the south and from above: estimate thick, reference thin
        rmse = RMSE terhadap {reference}: roll {roll}°, pitch {pitch}°, yaw {yaw}°; sensor saja {z_roll}°, {z_pitch}°,
            {z_yaw}°.
            | RMSE against {reference}: roll {roll}°, pitch {pitch}°, yaw {yaw}°; the sensors alone {z_roll}°,
            {z_pitch}°, {z_yaw}°.
        galat = Galat menurut makalah: {roll} %, {pitch} %, {yaw} %.
            | Error by the paper's formula: {roll} %, {pitch} %, {yaw} %.
        truth = sudut sebenarnya | the true angles
        device = sudut dari alat itu sendiri | the device's own angles
        nothing = Rekaman ini tidak memuat sudut pembanding. | This recording holds no reference angles.
        made = Penerbangan sintetis (benih acak {seed}). | The flight is synthetic (random seed {seed}).
        no_mag = Tanpa magnetometer, yaw dimulai dari 0 dan hanya giroskop yang memutarnya.
            | Without the magnetometer the yaw starts at 0 and only the gyroscope turns it.
        fixed = Pada cara adaptif m, q, jendela, dan ambang tidak dipakai.
            | The adaptive method uses neither m, q, window nor threshold.
        """)

    def __init__(self, p=None):
        super().__init__(p or quadrotor_paper.Params(dt=0.1), ["flight", "file"],       # few samples: a quick answer
                         accept=".csv,.zip,.txt,.xlsx", multiple=True)
        self.method = self.dropdown("method", ["paper", "adaptive", "literal"], value=None)
        self.sensors = {name: self.label(Checkbox(True, indent=False, layout=dict(width="auto")), name)
                        for name in self.SENSORS}
        self.noise, self.restart = self.button("noise", self.renew), self.button("restart", self.reset)
        self.moment = FloatSlider(40, min=0, max=126, step=0.5, readout_format=".1f", layout=dict(width="20em"))
        self.note, self.sentence = _text(), _text()
        self.plots, self.craft = Screen(), Screen()
        self.page(
            _row(self.source, self.upload, self.method, self.noise, self.restart),
            _row(self.log_field("m"), self.log_field("q", unit=True),
                 self.field("window", self.slider("window", continuous_update=False)),
                 self.field("threshold", self.slider("threshold", readout_format=".3g", continuous_update=False))),
            _row(self.label(Label(), "sensors", "value"), *self.sensors.values()),
            self.note, self.message, self.sentence,
            _row(_column(320, self.under("angles", self.plots, kind=HTML)),
                 _column(320, self.under("craft", self.craft, kind=HTML), self.under("moment", self.moment))))
        for part in (self.method, *self.sensors.values()):
            self.on(part, self.calculate)
        self.on(self.moment, self.turn)
        self.start()

    def reset(self):
        self.put(self.method, value="paper")
        for sensor in self.sensors.values():
            self.put(sensor, value=True)
        super().reset()

    def use_built_in(self):
        flight = quadrotor_paper.simulate(self.p, np.random.default_rng(self.seed))
        self.calculate((*flight.sensors, flight.truth, "truth", self.both("made", seed=self.seed)))

    def use_own(self):
        recording = read_recording(self.uploaded())
        rest_s = rest_seconds(recording)
        if not rest_s:
            raise self.error("no_rest")
        said = {language: " ".join(note[language] for note in recording.notes) for language in ("id", "en")}
        self.calculate((recording.t, recording.gyr, recording.acc, recording.mag, rest_s, recording.reference,
                        "device" if recording.reference is not None else "nothing", said))

    def calculate(self, data=None):
        t, gyr, acc, mag, rest_s, *_ = data = data or self.data
        gyr, acc, mag = (sensor if self.sensors[name].value else None
                         for name, sensor in zip(self.SENSORS, (gyr, acc, mag)))
        method = quadrotor_paper.METHODS[self.method.value]
        if not method.kept:
            p = self.settings()
            method = replace(method, m=p.m, q=p.q * quadrotor_paper.DEG ** 2, window=p.window, threshold=p.threshold)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            result = quadrotor_paper.attitude(t, np.zeros((len(t), 3)) if gyr is None else gyr, acc, mag, rest_s, method)
        self.data, self.result = data, result
        if caught:
            self.tell(caught[0].message)
        self.plots.draw(*(partial(plots.series, **row, xlabel="$t$ (s)", height=1.7) for row in self.rows()))
        self.put(self.moment, max=float(t[-1]))
        self.turn()
        self.redraw()

    def rows(self):
        """For each axis what plots.series draws, in degrees."""
        t, reference = self.data[0], self.data[5]
        for i, name in enumerate(quadrotor_paper.AXES):
            x = np.unwrap(self.result.angles[:, i])             # no jumps of the yaw
            z, truth = (None if part is None else np.degrees(x + quadrotor_paper.wrap(part[:, i] - x))
                        for part in (self.result.z, reference))
            yield dict(t=t, z=z, x=np.degrees(x), truth=truth, ylabel="°", names={"x": name, "truth": f"{name} (ref.)"})

    def picture(self):
        return plots.panels(list(self.rows()), xlabel="$t$ (s)", height=1.5)

    def moments(self, *seconds):
        t, reference = self.data[0], self.data[5]
        places = [min(np.searchsorted(t, second), len(t) - 1) for second in seconds]
        return {f"{t[k]:.0f} s": (self.result.angles[k], None if reference is None else reference[k]) for k in places}

    def turn(self):
        self.craft.draw(lambda: plots.craft(self.moments(self.moment.value), height=3.0))

    def each(self, values, prefix=""):
        """The values (3,) of the axes for a sentence, a dash for none."""
        return {prefix + axis: "–" if np.isnan(value) else self.decimal(round(value, 2 if value < 10 else 1), 6)
                for axis, value in zip(quadrotor_paper.AXES, values)}

    def redraw(self):
        reference, name, said = self.data[5:]
        sentences = [said[self.language.value]]
        if reference is None:
            sentences.append(self.say("nothing"))
        else:
            ours, alone = (quadrotor_paper.rmse_deg(reference, part) for part in (self.result.angles, self.result.z))
            galat = quadrotor_paper.galat(reference, quadrotor_paper.wrap(self.result.angles))
            sentences += [self.say("rmse", reference=self.say(name), **self.each(ours), **self.each(alone, "z_")),
                          self.say("galat", **self.each(galat))]
        if not self.sensors["mag"].value or self.data[3] is None:
            sentences.append(self.say("no_mag"))
        if self.method.value == "adaptive":
            sentences.append(self.say("fixed"))
        self.sentence.value = "".join(_paragraph(escape(sentence), "margin:0 0 .3em") for sentence in sentences)
