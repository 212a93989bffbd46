"""The figures of the chapters."""

import numpy as np
import pytest

from kalman_lib import plots


@pytest.mark.parametrize("names", [("a", "b"), ("that of the paper", "that of the whole chapter")])
def test_a_wide_legend_takes_no_room_from_the_axes(names):
    """It takes more rows: the axes are as wide as without it, and nothing of it is cut off."""
    t = np.arange(10.0)
    rivals = {name: t + k for k, name in enumerate(names)}
    figure, alone = plots.series(t, x=t, rivals=rivals), plots.series(t, x=t)
    for one in (figure, alone):
        one.draw_without_rendering()
    wide, usual = (one.axes[0].get_position().width for one in (figure, alone))
    legend = figure.axes[0].get_legend()
    assert wide == pytest.approx(usual, rel=0.05)
    assert legend.get_window_extent().x1 <= figure.bbox.x1
    assert set(names) <= {text.get_text() for text in legend.get_texts()}
