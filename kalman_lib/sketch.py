"""A drawing that is quick enough for a slider: the parts of matplotlib's Axes that plots.py uses, written as SVG.

Making a matplotlib figure and its PNG takes 40 ms and more, this takes 1 to 3. `plots.live()` chooses it, so that
widgets and notebooks share every function of plots.py. Names and meanings are those of matplotlib.
"""
import math
import re
from html import escape

import numpy as np

GREEK = dict(zip("alpha beta gamma delta theta lambda mu nu pi rho sigma tau phi psi".split(), "αβγδθλμνπρστφψ"))
WORDS = {**GREEK, "pm": "±", "cdot": "·", "ln": "ln", "max": "max", "Delta": "Δ", "sqrt": "√"}
GREY, DARK, GRID, PAPER = "#6b7278", "#3a4147", "#e3dfd6", "#fdfcf9"
POINTS = 1200               # a longer line is drawn by the smallest and the largest value of every piece
SHAPES = {"s": "h-{0}v-{0}h{1}v{1}h-{1}v-{0}", "D": "m0-{0}l{0} {0}l-{0} {0}l-{0}-{0}z", "^": "m0-{0}l{0} {1}h-{1}z",
          "v": "m0 {0}l{0}-{1}h-{1}z", "x": "m-{0}-{0}l{1} {1}m0-{1}l-{1} {1}", "+": "m-{0} 0h{1}m-{0}-{0}v{1}",
          "*": "m-{0} 0h{1}m-{0}-{0}v{1}"}


class Sketch:
    """A drawing with one Axes, width and height in inches."""

    def __init__(self, height=3.0, width=4.8):
        self.width, self.height = 100 * width, 100 * height
        self.axes = [Axes()]

    def svg(self):
        """The drawing as text; it fills the width it is given, up to 560 pixels."""
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width:g} {self.height:g}" aria-hidden="true" '
                f'style="display:block;width:100%;max-width:560px;background:{PAPER};font:15px DejaVu Sans,sans-serif">'
                f'{self.axes[0].svg(self.width, self.height)}</svg>')


class Axes:
    def __init__(self):
        self.parts, self.labels = [], []            # (zorder, svg of the part given the places of x and y); (words, look)
        self.x, self.y = [], []                     # numbers that must be visible
        self.options = dict(xlim=None, ylim=None, xlabel="", ylabel="", xscale="linear", aspect="auto", frame=True)

    def set(self, **options):
        self.options.update(options)

    def set_xlim(self, low, high):
        self.set(xlim=(low, high))

    def set_ylim(self, low, high):
        self.set(ylim=(low, high))

    def axis(self, word):
        self.set(frame=word != "off")

    def margins(self, *_):
        pass                                        # there is always room around

    autoscale_view = margins

    def plot(self, x, y, mark="", label=None, zorder=2, **look):
        x, y = np.atleast_1d(np.asarray(x, dtype=float)), np.atleast_1d(np.asarray(y, dtype=float))
        look = {"color": GREY, "marker": mark or None, **look}
        dots = bool(mark) or look.get("linestyle") == "none"
        self._see(x, y)
        self._add(zorder, label, look if dots else {**look, "marker": None}, lambda X, Y: (
            _dots(X(x), Y(y), look) if dots else _line(*_thin(X(x), Y(y)), look)))

    def fill_between(self, x, low, high=0, label=None, **look):
        x, low, high = np.broadcast_arrays(np.asarray(x, dtype=float), low, high)
        self.fill(np.r_[x, x[::-1]], np.r_[low, high[::-1]], label, **look)

    def fill(self, x, y, label=None, zorder=1, **look):
        self._see(x, y)
        self._add(zorder, label, {**look, "area": True}, lambda X, Y: (
            f'<path d="M{_places(X(x), Y(y))}Z" fill="{look["color"]}" fill-opacity="{look.get("alpha", 1)}"/>'))

    def axvspan(self, low, high, label=None, zorder=0, **look):
        self._see([low, high], [])
        self._add(zorder, label, {**look, "area": True}, lambda X, Y: (
            f'<path d="M{X(low):.1f} 0H{X(high):.1f}V999H{X(low):.1f}Z" fill="{look["color"]}" '
            f'fill-opacity="{look.get("alpha", 1)}"/>'))

    def axvline(self, x, label=None, zorder=1.5, **look):
        self._see([x], [])
        self._add(zorder, label, look, lambda X, Y: f'<path d="M{X(x):.1f} 0V999" {_stroke(look)}/>')

    def contourf(self, x, y, values, levels, alpha=1, **_):
        """Cells around the places x (w,), y (h,), the darker the more levels their value (h, w) has passed."""
        def edges(places):
            middles = (places[1:] + places[:-1]) / 2
            return np.concatenate([[2 * places[0] - middles[0]], middles, [2 * places[-1] - middles[-1]]])
        steps, x, y = np.searchsorted(levels, values, side="right") - 1, edges(np.asarray(x)), edges(np.asarray(y))
        self._see(x, y)

        def draw(X, Y):
            left, top, paths = np.round(X(x)).astype(int).tolist(), np.round(Y(y)).astype(int).tolist(), {}
            for j, row in enumerate(steps.tolist()):
                start = 0
                for i, step in enumerate(row):
                    if i + 1 == len(row) or row[i + 1] != step:         # one rectangle for equal neighbours
                        paths.setdefault(step, []).append(f"M{left[start]} {top[j]}H{left[i + 1]}V{top[j + 1]}H{left[start]}")
                        start = i + 1
            return "".join(f'<path d="{"".join(path)}" fill="#1f6fb4" fill-opacity="{alpha * step / (len(levels) - 2):.3f}"/>'
                           for step, path in sorted(paths.items()) if step)
        self._add(0, None, {}, draw)

    def contour(self, x, y, values, levels, **_):
        return x, y, values, levels

    def clabel(self, lines, fmt="%g", **_):
        """The number of every level where it crosses one of the two diagonals."""
        x, y, values, levels = lines
        i, words = np.arange(min(len(x), len(y))), fmt if callable(fmt) else lambda level: fmt % level
        for j in (i, i[::-1]):
            last = -9.0
            for level in levels:
                above = values[j, i] > level
                for k in np.flatnonzero(above[1:] != above[:-1]):
                    a, b = values[j[k], i[k]], values[j[k + 1], i[k + 1]]
                    place = k + (level - a) / (b - a)
                    if abs(place - last) > len(i) / 13:                 # no number upon another
                        self.text(np.interp(place, i, x[i]), np.interp(place, i, y[j]), words(level), ha="center")
                        last = place

    def grid(self, *_):
        pass

    def text(self, x, y, words, ha="left", **_):
        anchor = {"left": "start", "center": "middle", "right": "end"}[ha]
        self._add(5, None, {}, lambda X, Y: (
            f'<text x="{X(x):.1f}" y="{Y(y):.1f}" text-anchor="{anchor}" fill="{DARK}">{_words(words)}</text>'))

    def _see(self, x, y):
        self.x.append(x)
        self.y.append(y)

    def _add(self, zorder, label, look, draw):
        self.parts.append((zorder, draw))
        if label:
            self.labels.append((label, look))

    def svg(self, width, height):
        """All parts; width and height include the words around the frame."""
        o = self.options
        legend, rows = self._legend(width - 12)
        left, right, upper, lower = (66, 12, 8 + 22 * rows, 46) if o["frame"] else (4, 4, 4, 4)
        w, h = width - left - right, height - upper - lower
        xlim = self._limits(self.x, o["xscale"]) if o["xlim"] is None else o["xlim"]
        ylim = self._y_limits()
        if o["aspect"] == "equal":
            unit = min(w / (xlim[1] - xlim[0]), h / (ylim[1] - ylim[0]))
            left, w = left + (w - unit * (xlim[1] - xlim[0])) / 2, unit * (xlim[1] - xlim[0])
            upper, h = upper + (h - unit * (ylim[1] - ylim[0])) / 2, unit * (ylim[1] - ylim[0])
        f = np.log10 if o["xscale"] == "log" else np.asarray
        (x0, x1), (y0, y1) = f(xlim), ylim

        def X(x):
            with np.errstate(divide="ignore", invalid="ignore"):
                return np.clip((f(x) - x0) / (x1 - x0) * w, -9999, 9999)

        def Y(y):
            return np.clip((y1 - np.asarray(y)) / (y1 - y0) * h, -9999, 9999)

        inside = "".join(draw(X, Y) for _, draw in sorted(self.parts, key=lambda part: part[0]))
        frame = self._frame(X, Y, w, h, xlim, ylim) if o["frame"] else ""
        return (f'{legend}<g transform="translate({left:.1f} {upper:.1f})">{frame}'
                f'<svg width="{w:.1f}" height="{h:.1f}" overflow="{"hidden" if o["frame"] else "visible"}" fill="none">{inside}'
                '</svg></g>')

    def _y_limits(self):
        low, high = (None, None) if self.options["ylim"] is None else self.options["ylim"]
        auto = self._limits(self.y, "linear")
        return (auto[0] if low is None else low), (auto[1] if high is None else high)

    @staticmethod
    def _limits(values, scale):
        """The range of all numbers and a little more."""
        known = np.concatenate([np.ravel(part) for part in values]).astype(float) if values else np.zeros(0)
        known = known[np.isfinite(known) & ((known > 0) | (scale != "log"))]
        low, high = (known.min(), known.max()) if len(known) else (0.0, 1.0)
        if scale == "log":
            return (low, high) if high > low else (low / 2, high * 2)
        margin = 0.05 * (high - low) or 0.05 * abs(high) or 1.0
        return low - margin, high + margin

    def _frame(self, X, Y, w, h, xlim, ylim):
        """Grid, edges, numbers and names of the two axes."""
        x_ticks = log_ticks(*xlim) if self.options["xscale"] == "log" else ticks(*xlim, most=max(2, w / 62))
        y_ticks = ticks(*ylim, most=max(2, h / 34))
        rows = [f'<path d="{"".join(f"M{X(x):.1f} 0V{h:.1f}" for x in x_ticks)}{"".join(f"M0 {Y(y):.1f}H{w:.1f}" for y in y_ticks)}" '
                f'stroke="{GRID}"/><path d="M0 0V{h:.1f}H{w:.1f}" stroke="{GREY}" fill="none"/>']
        rows += [f'<text x="{X(x):.1f}" y="{h + 17:.1f}" text-anchor="middle" fill="{DARK}" font-size="13">{tick_words(x, x_ticks)}</text>'
                 for x in x_ticks]
        rows += [f'<text x="-6" y="{Y(y) + 5:.1f}" text-anchor="end" fill="{DARK}" font-size="13">{tick_words(y, y_ticks)}</text>'
                 for y in y_ticks]
        rows.append(f'<text x="{w / 2:.1f}" y="{h + 38:.1f}" text-anchor="middle" fill="{DARK}">{_words(self.options["xlabel"])}</text>')
        rows.append(f'<text transform="translate(-50 {h / 2:.1f}) rotate(-90)" text-anchor="middle" fill="{DARK}">'
                    f'{_words(self.options["ylabel"])}</text>')
        return "".join(rows)

    def _legend(self, width):
        """The legend above the axes and how many rows it needs."""
        x, y, rows, out = 12.0, 20.0, int(bool(self.labels)), ""
        for words, look in self.labels:
            text = _words(words)
            needs = 44 + 8.6 * len(re.sub("<[^>]*>|\u200b", "", text)) - 2.5 * text.count("font-size") * 4
            if x > 12 and x + needs > width:
                x, y, rows = 12.0, y + 22, rows + 1
            if look.get("area"):
                sign = f'<path d="M{x} {y - 9}h22v8h-22z" fill="{look["color"]}" fill-opacity="{look.get("alpha", 1)}"/>'
            elif look.get("marker"):
                sign = _dots(np.array([x + 11]), np.array([y - 5]), {**look, "markersize": min(look.get("markersize", 5), 6) + 1})
            else:
                sign = f'<path d="M{x} {y - 5}h22" {_stroke(look)}/>'
            out += f'{sign}<text x="{x + 28}" y="{y}" fill="#1d2327">{text}</text>'
            x += needs
        return f'<g fill="none">{out}</g>', rows


def ticks(low, high, most):
    """Round numbers between low and high, at most so many: steps of 1, 2 or 5 times a power of ten."""
    if not high > low:
        return []
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * factor for factor in (1, 2, 5, 10) if power * factor >= rough * (1 - 1e-9))
    return [step * k for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def log_ticks(low, high):
    """The powers of ten between low and high, at most seven; without two of them also 2 and 5 times them."""
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    for factors in ((1,), (1, 2, 5)):
        found = [factor * 10.0 ** k for k in powers for factor in factors if low <= factor * 10.0 ** k * (1 + 1e-9) and factor * 10.0 ** k <= high * (1 + 1e-9)]
        if len(found) > 1:
            break
    return found[::-(-len(found) // 7)]


def tick_words(value, all_ticks):
    largest = max(map(abs, all_ticks))
    if largest >= 1e5 or 0 < largest < 1e-3:
        return f"{value:.3g}".replace("-", "−")
    step = abs(all_ticks[1] - all_ticks[0]) if len(all_ticks) > 1 else largest or 1
    return f"{value:.{max(0, -math.floor(math.log10(step) + 1e-9))}f}".replace("-", "−")


def _thin(x, y):
    """The line as few points: the smallest and the largest y of every piece, so that it looks the same."""
    if len(x) <= POINTS:
        return x, y
    size = -(-len(x) // (POINTS // 2))
    starts = np.arange(0, len(x) - len(x) % size, size)
    pieces = np.nan_to_num(y[:len(starts) * size]).reshape(-1, size)
    keep = np.unique(np.r_[starts + pieces.argmin(axis=1), starts + pieces.argmax(axis=1), starts[-1] + size:len(x)])
    return x[keep], y[keep]


def _places(x, y):
    """Coordinates as text, a tenth of a pixel exact."""
    return " ".join(map(str, np.round(np.column_stack([x, y]), 1).ravel().tolist()))


def _line(x, y, look):
    known = np.isfinite(x) & np.isfinite(y)
    pieces = np.split(np.arange(len(x)), np.flatnonzero(~known))        # a gap interrupts the line
    path = "".join("M" + _places(x[piece], y[piece]) for piece in (piece[known[piece]] for piece in pieces) if len(piece))
    return f'<path d="{path}" {_stroke(look)} stroke-linejoin="round"/>'


def _dots(x, y, look):
    known = np.isfinite(x) & np.isfinite(y)
    size, mark = 1.45 * look.get("markersize", 5), look["marker"]
    places = np.round(np.column_stack([x[known], y[known]]), 1).tolist()
    if mark not in SHAPES:                          # round: a line without length, with round ends
        path = "".join(f"M{a} {b}h0" for a, b in places)
        if look.get("markerfacecolor") == "none":
            return "".join(f'<circle cx="{a}" cy="{b}" r="{size / 2:.1f}" stroke="{look["color"]}" stroke-width="2.4"/>'
                           for a, b in places)
        return f'<path d="{path}" stroke="{look["color"]}" stroke-width="{size:.1f}" stroke-linecap="round"/>'
    shape = SHAPES[mark].format(f"{size / 2:.1f}", f"{size:.1f}")
    fill = "none" if mark in "x+*" or look.get("markerfacecolor") == "none" else look["color"]
    return (f'<path d="{"".join(f"M{a} {b}{shape}" for a, b in places)}" fill="{fill}" stroke="{look["color"]}" '
            'stroke-width="2"/>')


def _stroke(look):
    width, style = 1.4 * look.get("linewidth", 1.6), look.get("linestyle", "-")
    dashes = "" if isinstance(style, str) else f' stroke-dasharray="{" ".join(f"{width * part:.1f}" for part in style[1])}"'
    return f'stroke="{look["color"]}" stroke-width="{width:.1f}" stroke-linecap="{look.get("solid_capstyle", "butt")}"{dashes}'


def _words(text):
    """Words with mathematics between dollars, as SVG: names, Greek letters, subscripts, a root."""
    return "".join(_math(part) if k % 2 else escape(part) for k, part in enumerate(str(text).split("$")))


def _math(text):
    text = re.sub(r"\\mathrm\{([^{}]*)\}", lambda match: "\x01" + match[1] + "\x02", text)       # upright
    text = re.sub(r"\\([A-Za-z]+)\s*", lambda match: WORDS.get(match[1], match[1]), text)
    text = text.replace(r"\,", "\u2009").replace(r"\ ", " ").replace("-", "−")
    text = re.sub(r"√\{([^{}]*)\}", r"√\1", text)
    parts = re.split(r"_(?:\{([^{}]*)\}|(.))", text)
    out = ""
    for k in range(0, len(parts), 3):
        out += _italic(parts[k])
        sub = parts[k + 1] or parts[k + 2] if k + 2 < len(parts) else ""
        if sub:
            out += f'<tspan dy="4" font-size="11">{_italic(sub)}</tspan><tspan dy="-4">\u200b</tspan>'
    return out


def _italic(text):
    pieces = re.split("\x01([^\x02]*)\x02", text)
    return "".join(escape(piece) if k % 2 else re.sub(r"([A-Za-zα-ω]+)", r'<tspan font-style="italic">\1</tspan>', escape(piece))
                   for k, piece in enumerate(pieces))
