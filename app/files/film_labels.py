"""Numbers of benches in a film: each is drawn once, and its picture is laid on every frame at its bench."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.patheffects import Normal, Stroke
from numpy.typing import NDArray

from core.values import Floats

# Most numbers on one dragon, and from one number to the next along the dragon, in widths of a number.
NUMBERS_MOST, APART = 30, 3.0
# Size of the numbers, and of those of marked benches, as shares of the height of the picture; least size [pixels].
SHARE, MARKED_SHARE, LEAST = 0.0125, 0.022, 8.0
# Width of a digit, which is the widest a character of a name may have too, and height of a line, as parts of the size.
DIGIT, WIDEST, LINE = 0.65, 1.1, 2.2
# Width of the dark edge of a number, as a part of its size.
EDGE = 0.16
# Place of a number on its bench: from the middle to the front, as a part of this way.
TO_FRONT = 0.5


def size_of(height: int, share: float = SHARE) -> float:
    """Size of numbers in a picture of a height [pixels]."""
    return max(share * height, LEAST)


def numbered(benches: int, spacing: float, size: float) -> range:
    """Numbers of the benches that are numbered: each, every 2nd, 5th, 10th, ... of them, the head first.

    spacing: from a bench to the next in the picture [pixels]; size: of the numbers [pixels]

    >>> list(numbered(223, 110.0, 14.6))[:4], numbered(9, 110.0, 14.6).step, numbered(223, 0.5, 8.0).step
    ([0, 10, 20, 30], 1, 100)
    """
    least = max(APART * DIGIT * size * len(str(benches - 1)) / spacing if spacing > 0.0 else benches, 1.0)
    step = 1
    while step < benches and (step < least or benches > NUMBERS_MOST * step):
        step = 10 * step // 4 if str(step)[0] == "2" else 2 * step
    return range(0, benches, step)


def pictures_of(words: Sequence[str], size: float, edge: str, dpi: float) -> list[NDArray[np.uint8]]:
    """Pictures (rows, columns, 4) of words, in white with an edge, each as small as it can be.

    size: [pixels]; edge: its colour
    """
    if not words:
        return []
    # Even, so that the middle of a word is between two pixels, whatever the others are.
    line, width = (2 * math.ceil(0.5 * length) for length in (LINE * size, WIDEST * size * (max(map(len, words)) + 1)))
    figure = Figure(figsize=(width / dpi, line * len(words) / dpi), dpi=dpi, facecolor="none")
    canvas, points = FigureCanvasAgg(figure), size * 72.0 / dpi
    look: dict[str, Any] = {"color": "white", "ha": "center", "va": "center", "weight": "bold", "parse_math": False}
    look["path_effects"] = [Stroke(linewidth=EDGE * points, foreground=edge), Normal()]
    for k, word in enumerate(words):
        figure.text(0.5, 1.0 - (k + 0.5) / len(words), word, fontsize=points, **look)
    canvas.draw()
    whole = np.asarray(canvas.buffer_rgba())
    return [_cropped(whole[line * k : line * (k + 1)]) for k in range(len(words))]


def _cropped(picture: NDArray[np.uint8]) -> NDArray[np.uint8]:
    seen = picture[..., 3] > 0
    rows, columns = np.flatnonzero(seen.any(axis=1)), np.flatnonzero(seen.any(axis=0))
    if not rows.size:
        return picture[:0, :0]
    return picture[rows[0] : rows[-1] + 1, columns[0] : columns[-1] + 1]


class Labels(Artist):
    """The words of some benches of a dragon, where place() puts them."""

    def __init__(self, axes: Axes, words: dict[int, str], size: float, edge: str = "black") -> None:
        super().__init__()
        self._axes, self._benches = axes, list(words)
        # Agg takes the lowest row first.
        pictures = pictures_of(list(words.values()), size, edge, axes.figure.dpi)
        self._pictures = [one[::-1].copy() for one in pictures]
        self._places = np.zeros((len(words), 2))

    def place(self, outlines: Floats) -> None:
        """Put each word on its bench. outlines: (n, 4, 2), the front corners first [m]"""
        own = outlines[self._benches]
        front = own[:, :2].mean(axis=1)
        self._places = self._axes.transData.transform((1.0 - TO_FRONT) * own.mean(axis=1) + TO_FRONT * front)

    def draw(self, renderer: Any) -> None:
        context = renderer.new_gc()
        for (x, y), picture in zip(self._places.tolist(), self._pictures, strict=True):
            rows, columns = picture.shape[:2]
            if rows:
                renderer.draw_image(context, round(x - 0.5 * columns), round(y - 0.5 * rows), picture)
        context.restore()
