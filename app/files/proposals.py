"""Pictures of proposed dances: one dance, and an overview of all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection

from app.files.drawing import canvas, draw_venue, file_bytes, in_turn, with_square
from core import Proposal, bench_outlines, trajectory
from core.plots import GREY, VERMILION

# Size of one picture [inch], pictures in a row of an overview, and points along a drawn path.
SIZE, ACROSS, POINTS = 4.4, 3, 1_500
# Moments at which the benches are drawn, as parts of the dance, and their colours.
MOMENTS = ((0.0, "#56b4e9"), (0.5, VERMILION))
# Room around what is drawn [m], and part of the dragon's way in a street that is not drawn [1].
AROUND, STREET = 4.0, 0.8
# Room around a square [m].
EDGE = 1.0
# Shorter side of the drawn part over the longer one, at least [1].
SHORTER = 0.75


def proposal_picture(proposal: Proposal, format: str = "png") -> bytes:
    """The square with the path of one dance, and its benches at the start and halfway."""
    return overview([proposal], format)


def overview(proposals: Sequence[Proposal], format: str = "png", words: Sequence[str] = ()) -> bytes:
    """The pictures of some dances beside one another. words: a title for each; default: figure, stray and duration"""
    across = min(len(proposals), ACROSS)
    down = math.ceil(len(proposals) / across)
    titles = [*words] or [
        f"{one.figure.value}: strays up to {one.tolerance:.2f} m, {one.duration:.0f} s" for one in proposals
    ]

    def drawn() -> bytes:
        figure = canvas(SIZE * across, SIZE * down)
        for k, (one, title) in enumerate(zip(proposals, titles, strict=True)):
            axes = figure.add_subplot(down, across, k + 1)
            _draw(axes, one)
            axes.set_title(title, fontsize=10)
        return file_bytes(figure, format)

    return in_turn(drawn)


def _draw(axes: Axes, proposal: Proposal) -> None:
    dance, report = proposal.dance, proposal.report
    line = dance.path.position(np.linspace(dance.path.begin, dance.path.end, POINTS))
    draw_venue(axes, proposal.venue, [line])
    axes.plot(*line.T, color=GREY, linewidth=0.8, zorder=2)
    for part, colour in MOMENTS:
        handles = trajectory(dance, [report.start + part * (report.stop - report.start)]).position[0]
        outlines = bench_outlines(dance.dragon, handles)
        axes.add_collection(PolyCollection(list(outlines), facecolor=colour, edgecolor="none", zorder=3))
    low, high = _drawn_part(proposal)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.tick_params(labelsize=7)


def _drawn_part(proposal: Proposal) -> tuple[list[float], list[float]]:
    """Corners of the drawn part [m]: the dance and, without gates, the square; of a street only its end."""
    dance = proposal.dance
    street = STREET * float(dance.dragon.chords.sum()) if proposal.gates else 0.0
    s = np.linspace(dance.path.begin + street, dance.path.end - street, POINTS)
    points = dance.path.position(s)
    low, high = points.min(axis=0) - AROUND, points.max(axis=0) + AROUND
    if not proposal.gates:
        low, high = with_square(proposal.venue, low, high)
        low, high = low - EDGE, high + EDGE
    more = 0.5 * np.maximum(SHORTER * (high - low).max() - (high - low), 0.0)
    return (low - more).tolist(), (high + more).tolist()
