"""Pictures of proposed dances: one dance, and an overview of all of them."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from app.files.drawing import canvas, draw_venue
from app.files.figures import figure_file
from app.files.looks import with_square
from app.wire.labels import value_word
from core import Proposal, bench_outlines, trajectory
from core.language import phrase, say
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


def overview(proposals: Sequence[Proposal], format: str = "png") -> bytes:
    """The pictures of some dances beside one another."""
    across = min(len(proposals), ACROSS)
    down = math.ceil(len(proposals) / across)

    def drawn() -> Figure:
        figure = canvas(SIZE * across, SIZE * down)
        for k, one in enumerate(proposals):
            axes = figure.add_subplot(down, across, k + 1)
            _draw(axes, one)
            axes.set_title(_title(one), fontsize=10)
        return figure

    return figure_file(drawn, format)


def _title(one: Proposal) -> str:
    """Figure, gates, stray and duration."""
    figure, stray, duration = value_word(one.figure.value), one.tolerance, one.duration
    if not one.gates:
        words = phrase("{figure}: strays up to {stray:.2f} m, {duration:.0f} s")
        return say(words, figure=figure, stray=stray, duration=duration)
    way = " → ".join(map(str, one.gates))
    words = phrase("{figure} {way}: strays up to {stray:.2f} m, {duration:.0f} s")
    return say(words, figure=figure, way=way, stray=stray, duration=duration)


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
