"""Change: slopes, steps, curvature, rotation."""

import numpy as np

from .style import BLUE, DARK, GREY, ORANGE, PURPLE, arrow, cross, paper

DASHED = (0, (4, 2))


def derivative():
    t = np.linspace(0, 5, 200)
    labels = dict(xlabel="$t$ (s)", ylabel="$p$ (m)", xlim=(0, 5), ylim=(0, 25))
    with paper(2.4, xticks=range(6), yticks=[0, 9, 25], **labels) as (picture, ax):
        ax.plot(t, t**2, color=BLUE)
        ax.plot(t, 9 + 6 * (t - 3), color=PURPLE, linestyle=DASHED)
        ax.plot(3, 9, "o", color=DARK, markersize=8)
    return picture


def taylor():
    angle = np.linspace(0, 1.6, 200)
    labels = dict(xlabel=r"$\theta$ (rad)", xlim=(0, 1.6), ylim=(0, 1.6))
    with paper(2.4, **labels) as (picture, ax):
        ax.set_xticks([0, 0.5, 1, 1.5], ["0", "½", "1", "1½"])
        ax.set_yticks([0, 0.5, 1, 1.5], ["0", "½", "1", "1½"])
        ax.plot(angle, np.sin(angle), color=BLUE)
        ax.plot(angle, angle, color=PURPLE, linestyle=DASHED)
    return picture


def discretisation():
    t = np.linspace(0, 16, 200)
    steps = np.arange(0, 16, 5)
    labels = dict(xlabel="$t$ (min)", ylabel="$x$ (°C)", xlim=(-0.4, 16), ylim=(0, 65))
    with paper(2.4, xticks=[0, 5, 10, 15], yticks=[0, 30, 60], **labels) as (picture, ax):
        ax.plot(t, 60 * np.exp(-0.1 * t), color=BLUE)
        ax.plot(steps, 60 * 0.5 ** (steps / 5), "o", color=PURPLE, markersize=8)
        ax.plot(steps, 60 * 0.5 ** (steps / 5), color=PURPLE, linewidth=1, linestyle=DASHED)
    return picture


def jacobian():
    turn = np.linspace(0, np.pi / 2, 100)
    labels = dict(xlabel="$x_1$ (m)", ylabel="$x_2$ (m)", xlim=(0, 6.2), ylim=(0, 6))
    with paper(2.9, xticks=range(0, 7, 1), yticks=range(0, 6, 1), **labels) as (picture, ax):
        ax.set_aspect("equal")
        ax.plot(5 * np.cos(turn), 5 * np.sin(turn), color=GREY, linewidth=1.2)
        ax.plot([0, 3], [0, 4], color=DARK, linewidth=1.2, linestyle=DASHED)
        ax.text(1.1, 2.1, "$h$", fontsize=16, color=DARK, ha="right")
        arrow(ax, (3, 4), (4.2, 4), ORANGE, 2.2)
        arrow(ax, (3, 4), (3, 5.2), ORANGE, 2.2)
        ax.plot(3, 4, "o", color=BLUE, markersize=8)
        ax.text(4.3, 4, "3/5", va="center", color=DARK)
        ax.text(3, 5.3, "4/5", ha="center", color=DARK)
    return picture


def hessian():
    p = np.linspace(0.25, 0.985, 300)
    log = 3 * np.log(p) + np.log(1 - p)
    peak = 3 * np.log(0.75) + np.log(0.25)
    curvature = 3 / 0.75**2 + 1 / 0.25**2
    labels = dict(xlabel="$p$", ylabel=r"$\ln L$", xlim=(0.25, 1), ylim=(-4.6, -2))
    with paper(2.4, yticks=[-4, -3, -2], **labels) as (picture, ax):
        ax.set_xticks([0.25, 0.5, 0.75, 1], ["¼", "½", "¾", "1"])
        ax.plot(p, log, color=BLUE)
        ax.plot(p, peak - curvature / 2 * (p - 0.75) ** 2, color=PURPLE, linestyle=DASHED)
        ax.plot(0.75, peak, "o", color=BLUE, markersize=8)
    return picture


def complex_number():
    turn = np.linspace(0, 2 * np.pi, 200)
    powers = (0.5 + 0.5j) ** np.arange(9)
    with paper(2.9, xticks=[-1, 0, 1], xlim=(-1.2, 1.2)) as (picture, ax):
        ax.set_aspect("equal")
        cross(ax)
        ax.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=1.2)
        ax.plot(powers.real, powers.imag, "o-", color=BLUE, markersize=6, linewidth=1.2)
        arrow(ax, (0, 0), (0.5, 0.5), ORANGE, 2.2)
        ax.set_yticks([-1, 0, 1], ["$-i$", "0", "$i$"])
    return picture


PICTURES = {
    "derivative": derivative,
    "taylor": taylor,
    "discretisation": discretisation,
    "jacobian": jacobian,
    "hessian": hessian,
    "complex": complex_number,
}
