"""Lists and tables of numbers."""

import numpy as np

from .chance import POSITIONS, VELOCITIES
from .style import (
    BLUE,
    DARK,
    GREY,
    LABEL,
    ORANGE,
    PALE_BLUE,
    PALE_GREY,
    PAPER,
    PURPLE,
    arrow,
    bare,
    cross,
    paper,
)

F = np.array([
    [1, 2],
    [0, 1],
])
STRETCH = np.array([
    [2, 1],
    [1, 2],
])


def vector():
    a, b = np.array([3, 4]), np.array([2, -1])
    labels = dict(xlabel="m", ylabel="m", xlim=(-0.3, 5.9), ylim=(-0.4, 4.6))
    with paper(2.9, xticks=range(6), yticks=range(5), **labels) as (picture, ax):
        ax.set_aspect("equal")
        cross(ax)
        arrow(ax, (0, 0), a, DARK)
        arrow(ax, a, a + b, DARK)
        arrow(ax, (0, 0), a + b, BLUE, 2.6)
        ax.text(1.1, 2.2, "$a$", fontsize=16, color=DARK)
        ax.text(4.1, 3.65, "$b$", fontsize=16, color=DARK)
    return picture


def matrix():
    labels = dict(xlabel="$p$ (m)", ylabel="$v$ (m/s)", xlim=(9, 17), ylim=(0, 3.7))
    with paper(xticks=[10, 12, 14, 16], yticks=[0, 1, 2, 3], **labels) as (picture, ax):
        for velocity in (1, 2, 3):
            before = np.array([10, velocity])
            after = F @ before
            ax.plot(*before, "o", color=GREY, markersize=7)
            ax.plot(*after, "o", color=BLUE, markersize=7)
            arrow(ax, before + [0.25, 0], after - [0.25, 0], DARK, 1.2)
    return picture


def product():
    with paper(1.35, xlim=(-0.1, 8.1), ylim=(2.25, -0.25)) as (picture, ax):
        bare(ax)
        table(ax, 0, F, {(0, 0), (0, 1)}, ORANGE)
        table(ax, 2.8, F, {(0, 1), (1, 1)}, PURPLE)
        table(ax, 5.9, F @ F, {(0, 1)}, BLUE)
        ax.text(5.35, 1, "=", ha="center", va="center", fontsize=16, color=DARK)
    return picture


def table(ax, left, numbers, marked, color):
    """A matrix as a table; the marked cells (row, column) are coloured."""
    for (row, column), number in np.ndenumerate(numbers):
        x, y = left + column, row
        is_marked = (row, column) in marked
        face = color if is_marked else PALE_GREY
        ax.fill([x, x, x + 1, x + 1], [y, y + 1, y + 1, y], facecolor=face, edgecolor=PAPER)
        ink = PAPER if is_marked else DARK
        ax.text(x + 0.5, y + 0.5, f"{number:g}", ha="center", va="center", fontsize=15, color=ink)


def transpose():
    numbers = np.arange(1, 7).reshape(2, 3)
    with paper(1.8, xlim=(-0.1, 8.1), ylim=(3.2, -0.2)) as (picture, ax):
        bare(ax)
        table(ax, 0, numbers, {(0, 0), (0, 1), (0, 2)}, BLUE)
        table(ax, 5.5, numbers.T, {(0, 0), (1, 0), (2, 0)}, BLUE)
        arrow(ax, (3.4, 1.2), (5.1, 1.2), DARK, 1.6)
        ax.text(4.2, 0.85, r"$\mathsf{T}$", ha="center", fontsize=15, color=DARK)
    return picture


def covariance_matrix():
    deviations = [POSITIONS - POSITIONS.mean(), VELOCITIES - VELOCITIES.mean()]
    root = np.linalg.cholesky(np.cov(deviations, bias=True))
    turn = np.linspace(0, 2 * np.pi, 200)
    edge = 2 * root @ [np.cos(turn), np.sin(turn)]
    labels = dict(xlabel="$p$ (m)", ylabel="$v$ (m/s)", xlim=(37, 63), ylim=(2.7, 7.3))
    with paper(2.4, xticks=[40, 50, 60], yticks=[3, 5, 7], **labels) as (picture, ax):
        ax.fill(edge[0] + 50, edge[1] + 5, facecolor=PALE_BLUE, edgecolor=BLUE, linewidth=1.6)
        ax.plot(POSITIONS, VELOCITIES, "o", color=ORANGE, markersize=8)
        ax.plot(50, 5, "+", color=BLUE, markersize=11, markeredgewidth=1.8)
    return picture


def inverse():
    first = np.array([9, 20])
    with paper(2.3, columns=2, xlim=(9, 20), ylim=(0, 16)) as (picture, (left, right)):
        left.plot(first, 35 - 2 * first, color=BLUE)
        left.plot(first, 20 - first, color=PURPLE, linestyle=(0, (4, 2)))
        left.plot(15, 5, "o", color=DARK, markersize=8)
        right.plot(first, 35 - 2 * first, color=BLUE, linewidth=7, alpha=0.35)
        right.plot(first, (70 - 4 * first) / 2, color=PURPLE, linewidth=2, linestyle=(0, (3, 3)))
        for ax in (left, right):
            ax.set(xlabel="$x_1$", xticks=[10, 15, 20], yticks=[0, 5, 10, 15])
        left.set_ylabel("$x_2$")
        right.set_yticklabels([])
    return picture


def eigenvalue():
    labels = dict(xlim=(-0.4, 3.5), ylim=(-1.3, 3.3))
    with paper(2.9, xticks=[0, 1, 2, 3], yticks=[-1, 0, 1, 2, 3], **labels) as (picture, ax):
        ax.set_aspect("equal")
        cross(ax)
        for before in ((1, 1), (1, -1), (1, 0)):
            after = STRETCH @ before
            arrow(ax, (0, 0), after, BLUE, 2.0)
            arrow(ax, (0, 0), before, GREY, 3.4)
        ax.text(2.2, 2.75, "3", fontsize=LABEL + 3, color=BLUE, ha="center")
        ax.text(1.15, -0.95, "1", fontsize=LABEL + 3, color=BLUE, ha="left")
    return picture


PICTURES = {
    "vector": vector,
    "matrix": matrix,
    "product": product,
    "transpose": transpose,
    "covariance-matrix": covariance_matrix,
    "inverse": inverse,
    "eigenvalue": eigenvalue,
}
