"""Numbers that scatter."""

import numpy as np

from .style import BLUE, DARK, GREY, LABEL, ORANGE, PALE_BLUE, PALE_GREY, PURPLE, arrow, bare, paper

WEIGHTS = np.array([204, 198, 200, 202, 201])  # g
ERRORS = np.array([1, -7, 5, -5])  # m
VELOCITIES = np.array([4, 4, 6, 6])  # m/s
POSITIONS = np.array([43, 49, 51, 57])  # m
MEMORY = 0.95  # of the series with a large autocorrelation


def mean():
    with paper(1.4, xlim=(196, 206), ylim=(-1.1, 0.9), xticks=[], yticks=[]) as (picture, ax):
        bare(ax)
        ax.plot([197, 205], [0, 0], color=DARK, linewidth=1.6)
        ax.plot(WEIGHTS, 0 * WEIGHTS + 0.14, "o", color=ORANGE, markersize=8)
        ax.plot(WEIGHTS.mean(), -0.17, "^", color=BLUE, markersize=13)
        for weight in WEIGHTS:
            if weight != WEIGHTS.mean():
                ax.text(weight, -0.15, str(weight), ha="center", va="top", color=DARK)
        ax.text(WEIGHTS.mean(), -0.48, "201 g", ha="center", va="top", color=BLUE)
    return picture


def variance():
    deviations = np.abs(WEIGHTS - WEIGHTS.mean())
    sides = sorted(deviations, reverse=True)
    with paper(1.7, ylim=(-0.9, 3.3), xlim=(-0.3, 13.2)) as (picture, ax):
        bare(ax)
        ax.set_aspect("equal")
        left = 0.0
        for side in sides:
            if side == 0:
                ax.plot(left + 0.2, 0.1, "o", color=GREY, markersize=4)
            square(ax, left, side, PALE_GREY, GREY)
            left += max(side, 0.4) + 0.4
        square(ax, left + 0.7, WEIGHTS.std(), PALE_BLUE, BLUE)
        ax.text(left + 1.7, -0.15, r"$\sigma$", ha="center", va="top", color=BLUE)
    return picture


def square(ax, left, side, face, edge):
    """A square that stands on zero, with its area inside."""
    corners = [left, left, left + side, left + side], [0, side, side, 0]
    ax.fill(*corners, facecolor=face, edgecolor=edge, linewidth=1.4)
    if side > 0:
        ax.text(left + side / 2, side / 2, f"{side**2:.0f}", ha="center", va="center", color=DARK)


def rmse():
    k = np.arange(1, len(ERRORS) + 1)
    size = np.sqrt(np.mean(ERRORS**2))
    labels = dict(xlabel="$k$", ylabel="$e$ (m)", xlim=(0.5, 4.5), ylim=(-8.5, 8.5))
    with paper(xticks=k, yticks=[-5, 0, 5], **labels) as (picture, ax):
        ax.axhspan(-size, size, color=PALE_BLUE, linewidth=0)
        ax.axhline(0, color=GREY, linewidth=0.8)
        ax.vlines(k, 0, ERRORS, color=ORANGE, linewidth=2.2)
        ax.plot(k, ERRORS, "o", color=ORANGE, markersize=7)
    return picture


def density(x):
    """The bell N(0, 1)."""
    return np.exp(-(x**2) / 2) / np.sqrt(2 * np.pi)


def normal():
    x = np.linspace(-3.3, 3.3, 400)
    names = [r"$-2\sigma$", r"$-\sigma$", "0", r"$\sigma$", r"$2\sigma$"]
    with paper(2.4, ylim=(-0.12, 0.42), yticks=[]) as (picture, ax):
        ax.plot(x, density(x), color=BLUE)
        ax.fill_between(x, density(x), where=np.abs(x) <= 2, color=PALE_BLUE, linewidth=0)
        ax.axhline(0, color=GREY, linewidth=0.8)
        ax.spines["left"].set_visible(False)
        ax.spines["bottom"].set_visible(False)
        ax.vlines([-1, 1], 0, density(1), color=BLUE, linewidth=0.8)
        ax.text(0, 0.14, "68%", ha="center", color=DARK)
        arrow(ax, (0, -0.065), (-2, -0.065), DARK, 1.0)
        arrow(ax, (0, -0.065), (2, -0.065), DARK, 1.0)
        inside = dict(ha="center", va="center", color=DARK, backgroundcolor="#fdfcf9")
        ax.text(0, -0.065, "95%", **inside)
        ax.set_xticks([-2, -1, 0, 1, 2], names, fontsize=LABEL + 2)
    return picture


def covariance():
    labels = dict(xlabel="$v$ (m/s)", ylabel="$p$ (m)", xlim=(3, 7), ylim=(40, 60))
    with paper(2.5, xticks=[4, 5, 6], yticks=[40, 50, 60], **labels) as (picture, ax):
        ax.axvline(VELOCITIES.mean(), color=GREY, linewidth=1, linestyle=(0, (4, 3)))
        ax.axhline(POSITIONS.mean(), color=GREY, linewidth=1, linestyle=(0, (4, 3)))
        for v, p, sign in ((3.3, 42, "+"), (6.7, 58, "+"), (3.3, 58, "−"), (6.7, 42, "−")):
            color = BLUE if sign == "+" else PURPLE
            ax.text(v, p, sign, ha="center", va="center", fontsize=17, color=color)
        ax.plot(VELOCITIES, POSITIONS, "o", color=ORANGE, markersize=8)
    return picture


def noise():
    x = np.linspace(-3.2, 3.2, 500)
    labels = dict(xlabel="$w$", xlim=(-3.2, 3.2), ylim=(0, 0.9))
    with paper(xticks=range(-3, 4), yticks=[], **labels) as (picture, ax):
        for sigma, name, color, place in (
            (0.5, "1/4", PURPLE, (0.5, 0.68)),
            (1, "1", BLUE, (1.4, 0.22)),
        ):
            ax.plot(x, density(x / sigma) / sigma, color=color)
            ax.text(*place, f"$Q = {name}$", color=color, fontsize=LABEL + 2)
        ax.spines["left"].set_visible(False)
    return picture


def correlation(dots=150):
    rng = np.random.default_rng(4)
    names = dict(xlim=(-3.2, 3.2), ylim=(-3.2, 3.2), xticks=[], yticks=[])
    with paper(1.75, columns=3, **names) as (picture, axes):
        for ax, rho, name in zip(axes, (-0.8, 0, 0.8), ("−4/5", "0", "4/5")):
            first, second = rng.normal(size=(2, dots))
            second = rho * first + np.sqrt(1 - rho**2) * second
            ax.set_aspect("equal")
            ax.plot(first, second, "o", color=ORANGE, markersize=2.4)
            ax.set_title(name, loc="center")
    return picture


def white_noise(steps=60):
    rng = np.random.default_rng(39)
    white = rng.normal(size=steps)
    slow = np.zeros(steps)
    for k, step in enumerate(rng.normal(size=steps - 1), start=1):
        slow[k] = MEMORY * slow[k - 1] + step
    with paper(2.6, rows=2, yticks=[0]) as (picture, (top, bottom)):
        for ax, series, color in ((top, white, ORANGE), (bottom, slow, BLUE)):
            ax.axhline(0, color=GREY, linewidth=0.8)
            ax.plot(series, "o-", color=color, markersize=3, linewidth=1.1)
        top.set_xticklabels([])
        bottom.set_xlabel("$k$")
    return picture


def chi_square():
    x = np.linspace(0.04, 7, 500)
    height = np.exp(-x / 2) / np.sqrt(2 * np.pi * x)
    labels = dict(xlabel=r"$(e/\sigma)^2$", xlim=(0, 7), ylim=(0, 1.3))
    with paper(yticks=[], **labels) as (picture, ax):
        ax.fill_between(x, height, where=x <= 3.84, color=PALE_BLUE, linewidth=0)
        ax.plot(x, height, color=BLUE)
        ax.axvline(1, color=DARK, linewidth=1.2, linestyle=(0, (4, 3)))
        ax.text(1.9, 0.32, "95%", color=DARK)
        ax.set_xticks([0, 1, 2, 4, 6])
        ax.spines["left"].set_visible(False)
    return picture


def nees(steps=40):
    rng = np.random.default_rng(24)
    labels = dict(xlabel="$k$", ylabel="NIS", xlim=(0, steps + 1), ylim=(0, 6))
    with paper(xticks=[1, 20, 40], **labels) as (picture, ax):
        k = np.arange(1, steps + 1)
        ax.vlines(k, 0, rng.normal(size=steps) ** 2, color=BLUE, linewidth=3)
        ax.axhline(3.84, color=DARK, linewidth=1.2, linestyle=(0, (4, 3)))
        ax.set_yticks([0, 1, 2, 4, 6])
    return picture


PICTURES = {
    "mean": mean,
    "variance": variance,
    "rmse": rmse,
    "normal": normal,
    "noise": noise,
    "covariance": covariance,
    "correlation": correlation,
    "white-noise": white_noise,
    "chi-square": chi_square,
    "nees": nees,
}
