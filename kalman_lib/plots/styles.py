"""Colours and lines of the figures: one look means one thing in every chapter."""

GREY, DARK, GRID, PAPER = "#6b7278", "#3a4147", "#e3dfd6", "#fdfcf9"
INK = "#1d2327"
BLUE, ORANGE, PURPLE, GREEN, BLACK = "#1f6fb4", "#c8641b", "#8a4fa3", "#3b7d3b", "#222222"

TRUTH = dict(color=BLACK, linewidth=1.0)
MEASUREMENT = dict(color=ORANGE, marker="o", markersize=3.2, linestyle="none")
ESTIMATE = dict(color=BLUE, linewidth=1.8)
PREDICTION = dict(color=PURPLE, linewidth=1.6, linestyle=(0, (4, 2)))
RIVAL = dict(color=GREEN, linewidth=1.6, linestyle=(0, (5, 1.5, 1, 1.5)))  # a moving average
BAND = dict(color=BLUE, alpha=0.16, linewidth=0)  # +-2 sigma
PALE = dict(alpha=0.10, linewidth=0)  # inside a bell or an ellipse
EDGE = dict(markeredgecolor=PAPER, zorder=5)  # of a single mark

# matplotlib's settings: paper background, few lines, text that stays readable on a phone
STYLE = {
    "figure.facecolor": PAPER,
    "figure.constrained_layout.use": True,
    "figure.constrained_layout.w_pad": 0.1,
    "font.family": "DejaVu Sans",
    "font.size": 12,
    "mathtext.fontset": "cm",
    "text.color": INK,
    "axes.facecolor": PAPER,
    "axes.labelsize": 12,
    "axes.labelcolor": DARK,
    "axes.titlesize": 12,
    "axes.titlelocation": "left",
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.6,
    "xtick.color": GREY,
    "xtick.labelcolor": DARK,
    "xtick.labelsize": 10.8,  # 12 pixels on a phone that is 390 wide
    "ytick.color": GREY,
    "ytick.labelcolor": DARK,
    "ytick.labelsize": 10.8,
    "legend.frameon": False,
    "legend.fontsize": 12,
    "legend.handlelength": 1.5,
    "lines.linewidth": 1.6,
    "lines.solid_capstyle": "round",
}
