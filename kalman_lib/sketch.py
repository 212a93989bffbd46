"""A drawing that is quick enough for a slider: what plots.py uses of matplotlib's Axes, written as SVG.

It takes 1 to 3 ms where matplotlib takes 40. `plots.live()` chooses it.
"""
import math
import re
from html import escape
from html.entities import html5

import numpy as np

GREY, DARK, GRID, PAPER = "#6b7278", "#3a4147", "#e3dfd6", "#fdfcf9"
POINTS = 400                # of a longer series the smallest and the largest value of every piece, and where a gap begins
SHAPES = {"o": "m-{0} 0a{0} {0} 0 1 0 {1} 0a{0} {0} 0 1 0-{1} 0", "s": "m-{0}-{0}h{1}v{1}h-{1}z",
          "D": "m0-{0}l{0} {0}-{0} {0}-{0}-{0}z", "^": "m0-{0}l{0} {1}h-{1}z", "v": "m0 {0}l{0}-{1}h-{1}z",
          "x": "m-{0}-{0}l{1} {1}m0-{1}l-{1} {1}", "+": "m-{0} 0h{1}m-{0}-{0}v{1}", "*": "m-{0} 0h{1}m-{0}-{0}v{1}"}


class Sketch:
    """A drawing with one Axes, width and height in inches."""

    def __init__(self, height=3.0, width=4.8):
        self.width, self.height = 100 * width, 100 * height
        self.axes = [Axes()]

    def svg(self):
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width:g} {self.height:g}" aria-hidden="true" '
                f'style="display:block;width:100%;max-width:560px;background:{PAPER};font:15px DejaVu Sans,sans-serif">'
                f'{self.axes[0].svg(self.width, self.height)}</svg>')


class Axes:
    def __init__(self):
        self.parts, self.labels = [], []            # (zorder, function (X, Y) -> svg); (words, look)
        self.x, self.y = [], []                     # numbers that must be visible
        self.options = dict(xlim=(None, None), ylim=(None, None), xlabel="", ylabel="", aspect="auto", frame=True)

    def set(self, **options):
        self.options.update(options)

    def set_axis_off(self):
        self.set(frame=False)

    def margins(self, _):
        pass                                        # there is always room around

    def plot(self, x, y, mark="", label=None, zorder=2, **look):
        x, y = (np.atleast_1d(np.asarray(values, dtype=float)) for values in (x, y))
        dots = mark or look.get("linestyle") == "none"
        look = {"color": GREY, "marker": mark, **look} if dots else {"color": GREY, **look, "marker": ""}
        self._add(x, y, zorder, label, look, lambda X, Y: (
            (_dots if dots else _line)(*_thin(X(x), Y(y)), look)))

    def fill_between(self, x, low, high=0, label=None, **look):
        x, low, high = np.broadcast_arrays(np.asarray(x, dtype=float), low, high)
        look["area"] = True

        def draw(X, Y):
            (x_low, low_edge), (x_high, high_edge) = _thin(X(x), Y(low)), _thin(X(x), Y(high))
            return f'<path d="M{_places(np.r_[x_low, x_high[::-1]], np.r_[low_edge, high_edge[::-1]])}Z" {_fill(look)}/>'
        self._add(x, [low, high], 1, label, look, draw)

    def fill(self, x, y, label=None, **look):
        look["area"] = True
        self._add(x, y, 1, label, look, lambda X, Y: f'<path d="M{_places(X(x), Y(y))}Z" {_fill(look)}/>')

    def axvspan(self, low, high, label=None, **look):
        look["area"] = True
        self._add([low, high], [], 0, label, look, lambda X, Y: (
            f'<path d="M{X(low):.1f} 0H{X(high):.1f}V999H{X(low):.1f}Z" {_fill(look)}/>'))

    def axvline(self, x, label=None, **look):
        self._add([x], [], 1.5, label, look, lambda X, Y: f'<path d="M{X(x):.1f} 0V999" {_stroke(look)}/>')

    def contourf(self, x, y, values, levels, alpha=1, **_):
        """Cells around the places x (w,), y (h,), the darker the more levels their value (h, w) has passed."""
        x, y = (np.r_[1.5 * at[0] - 0.5 * at[1], (at[1:] + at[:-1]) / 2, 1.5 * at[-1] - 0.5 * at[-2]] for at in (x, y))
        passed = np.searchsorted(levels, values, side="right") - 1

        def draw(X, Y):
            paths = [""] * len(levels)
            left, edges = X(x).round().astype(int), Y(y).round().astype(int)
            for row, above, below in zip(passed, edges, edges[1:]):
                starts = np.flatnonzero(np.diff(row, prepend=-1))       # one rectangle for equal neighbours
                for start, end in zip(starts, [*starts[1:], len(row)]):
                    paths[row[start]] += f"M{left[start]} {above}H{left[end]}V{below}H{left[start]}"
            return "".join(f'<path d="{path}" {_fill(dict(color="#1f6fb4", alpha=round(alpha * k / (len(levels) - 2), 3)))}/>'
                           for k, path in enumerate(paths) if k and path)
        self._add(x, y, 0, None, {}, draw)

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
                        self.text(np.interp(place, i, x[i]), np.interp(place, i, y[j]), words(level))
                        last = place

    def grid(self, *_):
        pass

    def text(self, x, y, words, **_):
        self._add([], [], 5, None, {}, lambda X, Y: _text(X(x), Y(y), words))

    def _add(self, x, y, zorder, label, look, draw):
        self.x.append(x)
        self.y.append(y)
        self.parts.append((zorder, draw))
        if label:
            self.labels.append((label, look))

    def svg(self, width, height):
        o = self.options
        legend, rows = self._legend(width - 12)
        left, right, upper, lower = (66, 12, 8 + 22 * rows, 46) if o["frame"] else (4, 4, 4, 4)
        w, h = width - left - right, height - upper - lower
        (x0, x1), (y0, y1) = xlim, ylim = _limits(self.x, o["xlim"]), _limits(self.y, o["ylim"])
        if o["aspect"] == "equal":
            unit = min(w / (x1 - x0), h / (y1 - y0))
            left, w = left + (w - unit * (x1 - x0)) / 2, unit * (x1 - x0)
            upper, h = upper + (h - unit * (y1 - y0)) / 2, unit * (y1 - y0)

        def X(x):
            return np.clip((np.asarray(x) - x0) / (x1 - x0) * w, -9999, 9999)

        def Y(y):
            return np.clip((y1 - np.asarray(y)) / (y1 - y0) * h, -9999, 9999)

        frame = self._frame(X, Y, w, h, xlim, ylim) if o["frame"] else ""
        inside = "".join(draw(X, Y) for _, draw in sorted(self.parts, key=lambda part: part[0]))
        return (f'{legend}<g transform="translate({left:.1f} {upper:.1f})">{frame}<svg width="{w:.1f}" height="{h:.1f}" '
                f'overflow="{"hidden" if o["frame"] else "visible"}" fill="none">{inside}</svg></g>')

    def _frame(self, X, Y, w, h, xlim, ylim):
        xs, ys = ticks(*xlim, most=max(2, w / 62)), ticks(*ylim, most=max(2, h / 34))
        grid = "".join([f"M{X(x):.1f} 0V{h:.1f}" for x in xs] + [f"M0 {Y(y):.1f}H{w:.1f}" for y in ys])
        return "".join([
            f'<path d="{grid}" stroke="{GRID}"/><path d="M0 0V{h:.1f}H{w:.1f}" stroke="{GREY}" fill="none"/>',
            *(_text(X(x), h + 17, tick_words(x, xs), size=13) for x in xs),
            *(_text(-6, Y(y) + 5, tick_words(y, ys), "end", 13) for y in ys),
            _text(w / 2, h + 38, self.options["xlabel"]),
            f'<g transform="translate(-50 {h / 2:.1f}) rotate(-90)">{_text(0, 0, self.options["ylabel"])}</g>'])

    def _legend(self, width):
        """The legend above the axes, and its number of rows."""
        x, y, out = 12.0, 20.0, ""
        for words, look in self.labels:
            text = _words(words)
            needs = 44 + 8.6 * len(re.sub("<[^>]*>|\u200b", "", text)) - 10 * text.count("font-size")
            if 12 < x > width - needs:
                x, y = 12.0, y + 22
            if look.get("area"):
                sign = f'<path d="M{x} {y - 9}h22v8h-22z" {_fill(look)}/>'
            elif look.get("marker"):
                size = min(look.get("markersize", 5), 6) + 1
                sign = _dots(np.array([x + 11]), np.array([y - 5]), {**look, "markersize": size})
            else:
                sign = f'<path d="M{x} {y - 5}h22" {_stroke(look)}/>'
            out += f'{sign}<text x="{x + 28}" y="{y}" fill="#1d2327">{text}</text>'
            x += needs
        return f'<g fill="none">{out}</g>', int((y + 2) / 22) if self.labels else 0


def _limits(values, given):
    """What an axis shows: the given limits, else the range of all numbers and a little more."""
    known = np.concatenate([np.zeros(0), *map(np.ravel, values)]).astype(float)
    known = known[np.isfinite(known)]
    low, high = (known.min(), known.max()) if len(known) else (0.0, 1.0)
    margin = 0.05 * (high - low) or 0.05 * abs(high) or 1.0
    return [number if limit is None else limit for number, limit in zip((low - margin, high + margin), given)]


def ticks(low, high, most):
    """Round numbers between low and high, at most so many."""
    if not high > low:
        return []
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(power * factor for factor in (1, 2, 5, 10) if power * factor >= rough * (1 - 1e-9))
    return [step * k for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


def tick_words(value, all_ticks):
    largest = max(map(abs, all_ticks))
    if largest >= 1e5 or 0 < largest < 1e-3:
        return f"{value:.3g}".replace("-", "−")
    step = abs(all_ticks[1] - all_ticks[0]) if len(all_ticks) > 1 else largest or 1
    return f"{value:.{max(0, -math.floor(math.log10(step) + 1e-9))}f}".replace("-", "−")


def _thin(x, y):
    """A long line as few points that look the same."""
    if len(x) <= POINTS:
        return x, y
    size = -(-len(x) // (POINTS // 2))
    starts = np.arange(0, len(x) - len(x) % size, size)
    pieces = y[:len(starts) * size].reshape(-1, size)
    gap = np.isnan(pieces)
    kept = [np.where(gap, np.inf, pieces).argmin(axis=1), np.where(gap, -np.inf, pieces).argmax(axis=1), gap.argmax(axis=1)]
    keep = np.unique(np.r_[starts + kept[0], starts + kept[1], starts + kept[2], starts[-1] + size:len(x)])
    return x[keep], y[keep]


def _places(x, y):
    return " ".join(map(str, np.round(np.column_stack([x, y]), 1).ravel().tolist()))


def _line(x, y, look):
    known = np.isfinite(x) & np.isfinite(y)
    pieces = (piece[known[piece]] for piece in np.split(np.arange(len(x)), np.flatnonzero(~known)))     # between gaps
    path = "".join("M" + _places(x[piece], y[piece]) for piece in pieces if len(piece))
    return f'<path d="{path}" {_stroke(look)} stroke-linejoin="round"/>'


def _dots(x, y, look):
    known = np.isfinite(x) & np.isfinite(y)
    size, mark, color = 1.45 * look.get("markersize", 5), look["marker"], look["color"]
    hollow = look.get("markerfacecolor") == "none"
    point = mark == "o" and not hollow              # then a line without length, with round ends
    shape = "h0" if point else SHAPES[mark].format(f"{size / 2:.1f}", f"{size:.1f}")
    places = np.round(np.column_stack([x[known], y[known]]), 1).tolist()
    path = "".join(f"M{a} {b}{shape}" for a, b in places)
    return (f'<path d="{path}" stroke="{color}" fill="{"none" if hollow else color}" stroke-linecap="round" '
            f'stroke-width="{size if point else 2:.1f}"/>')


def _fill(look):
    return f'fill="{look["color"]}" fill-opacity="{look.get("alpha", 1)}"'


def _stroke(look):
    width, style = 1.4 * look.get("linewidth", 1.6), look.get("linestyle", "-")
    dashes = "" if isinstance(style, str) else f' stroke-dasharray="{" ".join(f"{width * part:.1f}" for part in style[1])}"'
    return f'stroke="{look["color"]}" stroke-width="{width:.1f}" stroke-linecap="{look.get("solid_capstyle", "butt")}"{dashes}'


def _text(x, y, words, anchor="middle", size=15):
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{DARK}" font-size="{size}">{_words(words)}</text>'


def _words(text):
    """Words with mathematics between dollars, as SVG."""
    return "".join(_math(part) if k % 2 else escape(part) for k, part in enumerate(str(text).split("$")))


def _math(text):
    text = re.sub(r"\\mathrm\{([^{}]*)\}", "\x01\\1\x02", text)                     # upright
    text = re.sub(r"\\sqrt\{([^{}]*)\}", r"√\1", text).replace(r"\cdot", "·")
    text = re.sub(r"\\([A-Za-z]+)\s*", lambda name: html5.get(name[1] + ";", name[1]), text)
    text = text.replace(r"\,", "\u2009").replace(r"\ ", " ").replace("-", "−")
    parts = re.split(r"_(?:\{([^{}]*)\}|(.))", text)            # text, subscript in braces, subscript of one letter, text ...
    out = _italic(parts[0])
    for braces, letter, after in zip(parts[1::3], parts[2::3], parts[3::3]):
        out += f'<tspan dy="4" font-size="11">{_italic(braces or letter)}</tspan><tspan dy="-4">\u200b</tspan>{_italic(after)}'
    return out


def _italic(text):
    pieces = re.split("\x01([^\x02]*)\x02", text)
    return "".join(escape(piece) if k % 2 else re.sub(r"([A-Za-zα-ω]+)", r'<tspan font-style="italic">\1</tspan>', escape(piece))
                   for k, piece in enumerate(pieces))
