"""Combining what we know."""

import numpy as np

from .style import BLUE, DARK, GREY, LABEL, ORANGE, PALE_GREY, PAPER, PURPLE, paper

RAIN = 20  # mornings of 100
CLOUDY_AND_RAIN = 16
CLOUDY_AND_DRY = 16


def conditional():
    """A hundred mornings, column by column: first those with rain, the cloudy ones first."""
    with paper(2.9, xlim=(-0.6, 9.6), ylim=(9.6, -0.6), xticks=[], yticks=[]) as (picture, ax):
        ax.set_aspect("equal")
        for spine in ax.spines.values():
            spine.set_visible(False)
        for morning in range(100):
            column, row = divmod(morning, 10)
            rains = morning < RAIN
            face = BLUE if rains else PALE_GREY
            ax.plot(column, row, "s", color=face, markersize=15)
            since = morning if rains else morning - RAIN
            if since < (CLOUDY_AND_RAIN if rains else CLOUDY_AND_DRY):
                ax.plot(column, row, "o", color=PAPER if rains else DARK, markersize=5)
    return picture


def bayes():
    prior = np.array([0.2, 0.8])
    likelihood = np.array([0.8, 0.2])
    product = prior * likelihood
    bars = ((prior, PURPLE), (likelihood, ORANGE), (product / product.sum(), BLUE))
    with paper(2.4, ylim=(0, 1), yticks=[]) as (picture, ax):
        for place, (heights, color) in enumerate(bars):
            places = place + np.array([-0.19, 0.19])
            ax.bar(places, heights, width=0.34, color=color)
            for x, height in zip(places, heights):
                ax.text(
                    x, height + 0.02, f"{100 * height:.0f}%", ha="center", va="bottom", color=DARK
                )
        ax.set_xticks(range(3), [r"$p(x)$", r"$p(z \mid x)$", r"$p(x \mid z)$"], fontsize=LABEL + 3)
        ax.tick_params(axis="x", length=0)
        ax.spines["left"].set_visible(False)
    return picture


def likelihood():
    p = np.linspace(0, 1, 300)
    labels = dict(xlabel="$p$", ylabel="$L$", xlim=(0, 1), ylim=(0, 0.12))
    with paper(**labels) as (picture, ax):
        ax.set_xticks([0, 0.5, 0.75, 1], ["0", "½", "¾", "1"])
        ax.set_yticks([0, 0.05, 0.1], ["0", "1/20", "1/10"])
        ax.plot(p, p**3 * (1 - p), color=BLUE)
        peak = 0.75**3 * 0.25
        ax.plot([0.75, 0.75], [0, peak], color=GREY, linewidth=1, linestyle=(0, (4, 3)))
        ax.plot(0.75, peak, "o", color=BLUE, markersize=8)
    return picture


PICTURES = {"conditional": conditional, "bayes": bayes, "likelihood": likelihood}
