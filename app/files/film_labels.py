"""Numbers of benches in a film: each is drawn once, and its picture is laid on every frame at its bench."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.patheffects import Normal, Stroke
from numpy.typing import NDArray

from app.files.drawing import NamePlaces
from app.files.film_planes import Placed, Stamp
from core import Venue
from core.values import Floats

# Most numbers on one dragon, and from one number to the next along the dragon, in widths of a number.
NUMBERS_MOST, APART = 30, 3.0
# Size of the numbers, and of those of marked benches, as shares of the height of the picture; least size [pixels].
SHARE, MARKED_SHARE, LEAST = 0.0125, 0.028, 8.0
# Width of a digit, which is the widest a character of a name may have too, and height of a line, as parts of the size.
DIGIT, WIDEST, LINE = 0.65, 1.1, 2.2
# Width of the dark edge of a number, and of the paper around black words, as parts of their size.
EDGE, HALO = 0.16, 0.4
# Place of a number on its bench: from the middle to the front, as a part of this way.
TO_FRONT = 0.5
# Space between a marked bench and its number, and how much more free a number must be on the other side of its bench
# before it changes there, as parts of its size; number of nearest benches from which it counts how free it is.
BESIDE, CHANGES, NEAREST = 0.25, 0.25, 12
# Size of the names of areas, as a share of the height of the picture, and the least one [pixels].
NAME_SHARE, NAME_LEAST = 0.018, 11.0
# Lower right corner of the time, as shares of width and height, and distance of its lines in sizes of the type.
CORNER, SPACING = (0.985, 0.03), 1.2
# From the bottom of a character's picture to the bottom of its line, in sizes of the type.
BELOW = 0.75


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


def pictures_of(
    words: Sequence[str], size: float, edge: str, dpi: float, face: str = "white", weight: str = "bold"
) -> list[NDArray[np.uint8]]:
    """Pictures (rows, columns, 4) of words with an edge, each as small as it can be.

    size: [pixels]; edge, face: colours of the edge and of the words
    """
    if not words:
        return []
    # Even, so that the middle of a word is between two pixels, whatever the others are.
    line, width = (2 * math.ceil(0.5 * length) for length in (LINE * size, WIDEST * size * (max(map(len, words)) + 1)))
    figure = Figure(figsize=(width / dpi, line * len(words) / dpi), dpi=dpi, facecolor="none")
    canvas, points = FigureCanvasAgg(figure), size * 72.0 / dpi
    look: dict[str, Any] = {"color": face, "ha": "center", "va": "center", "weight": weight, "parse_math": False}
    wide = EDGE if face == "white" else HALO
    look["path_effects"] = [Stroke(linewidth=wide * points, foreground=edge), Normal()]
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


class Labels:
    """The words of some benches of a dragon, where place() puts them."""

    def __init__(
        self, axes: Axes, words: dict[int, str], size: float, edge: str = "black", face: str = "white"
    ) -> None:
        self._axes, self._benches = axes, list(words)
        self.stamps = [Stamp(one) for one in pictures_of(list(words.values()), size, edge, axes.figure.dpi, face)]
        self.places = np.zeros((len(words), 2))

    def place(self, outlines: Floats) -> None:
        """Put each word on its bench. outlines: (n, 4, 2), the front corners first [m]"""
        own = outlines[self._benches]
        front = own[:, :2].mean(axis=1)
        self.places = self._axes.transData.transform((1.0 - TO_FRONT) * own.mean(axis=1) + TO_FRONT * front)

    @property
    def placed(self) -> list[Placed]:
        """Each word, where it stands in the picture."""
        height = round(self._axes.bbox.height)
        return [
            (stamp, round(x - 0.5 * stamp.width), height - stamp.height - round(y - 0.5 * stamp.height))
            for (x, y), stamp in zip(self.places.tolist(), self.stamps, strict=True)
        ]


class CornerText:
    """Lines of text at the lower right of the picture, in the type of rc_context() where it is made.

    Each character is drawn once, because the time changes with every picture.
    """

    def __init__(self, axes: Axes, points: float) -> None:
        self.text, self._axes, self._dpi, self._size = "", axes, axes.figure.dpi, points * axes.figure.dpi / 72.0
        self._font = FontProperties(family=list(matplotlib.rcParams["font.family"]), size=points)
        self._characters: dict[str, tuple[float, Stamp, int, int]] = {}

    def prepare(self, text: str) -> None:
        """Draw the characters of a text, which placed() would draw when it first needs them."""
        for character in text:
            self._drawn(character)

    @property
    def placed(self) -> list[Placed]:
        """Each character, where it stands in the picture."""
        width, height = self._axes.bbox.size
        placed: list[Placed] = []
        for k, line in enumerate(reversed(self.text.split("\n"))):
            drawn = [self._drawn(character) for character in line]
            x = CORNER[0] * width - sum(advance for advance, *_ in drawn)
            y = CORNER[1] * height + SPACING * k * self._size
            for advance, stamp, left, above in drawn:
                placed.append((stamp, round(x) + left, round(height - y) - above))
                x += advance
        return placed

    def _drawn(self, character: str) -> tuple[float, Stamp, int, int]:
        """The way from a character to the next one, its picture, from its place to the left edge of the picture, and
        from the bottom of its line up to the upper edge [pixels]."""
        if character not in self._characters:
            side = math.ceil(3.0 * self._size)
            canvas = FigureCanvasAgg(Figure(figsize=(side / self._dpi, side / self._dpi), dpi=self._dpi))
            own = canvas.get_renderer()
            # Measured between two others, because a space alone has no width.
            wide, bare = (
                own.get_text_width_height_descent(text, self._font, ismath=False)[0]
                for text in (f"|{character}|", "||")
            )
            own.draw_text(own.new_gc(), self._size, 2.0 * self._size, character, self._font, 0.0, ismath=False)
            whole = np.asarray(canvas.buffer_rgba())
            rows, columns = (np.flatnonzero((whole[..., 3] > 0).any(axis=axis)) for axis in (1, 0))
            top, left = (int(one[0]) if one.size else 0 for one in (rows, columns))
            above = round(len(whole) - top - BELOW * self._size)
            self._characters[character] = wide - bare, Stamp(_cropped(whole)), left - round(self._size), above
        return self._characters[character]


class LabelsBeside(Labels):
    """The words of marked benches, beside them in black, on the side where the dragon is further away.

    State: that side of each. A word changes it only if the other one is much freer, because it would flicker.
    """

    def __init__(self, axes: Axes, words: dict[int, str], size: float, widths: Floats) -> None:
        """widths: of each of these benches in the picture [pixels]"""
        super().__init__(axes, words, size, "white", "black")
        self._away, self._changes = 0.5 * widths + BESIDE * size, CHANGES * size
        halves = [(0.5 * one.width, 0.5 * one.height) for one in self.stamps]
        self.halves, self.sides = np.array(halves).reshape(-1, 2), np.zeros(len(words))

    def place(self, outlines: Floats) -> None:
        if not self._benches:
            return
        to_pixels = self._axes.transData.transform
        middles, own = to_pixels(outlines.mean(axis=1)), outlines[self._benches]
        along = to_pixels(own[:, :2].mean(axis=1)) - to_pixels(own[:, 2:].mean(axis=1))
        normals = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.hypot(*along.T)[:, None]
        aways = (self._away + (np.abs(normals) * self.halves).sum(axis=1))[:, None] * normals
        for k, bench in enumerate(self._benches):
            others = np.delete(middles, bench, axis=0)
            sides = middles[bench] + np.array([[1.0], [-1.0]]) * aways[k]
            distances = np.sort(np.hypot(*np.moveaxis(others[None] - sides[:, None], -1, 0)), axis=1)[:, :NEAREST]
            lead = float(np.subtract(*distances.mean(axis=1))) if others.size else 0.0
            if self.sides[k] == 0.0 or lead * self.sides[k] < -self._changes:
                self.sides[k] = 1.0 if lead >= 0.0 else -1.0
            self.places[k] = sides[0 if self.sides[k] > 0.0 else 1]


class NameLabels(Labels):
    """The names of the areas of a venue, in black with the paper around them. lines: see NamePlaces"""

    def __init__(self, axes: Axes, venue: Venue, height: int, lines: Sequence[Floats]) -> None:
        """height: of the picture [pixels]; the axes show what they will show"""
        super().__init__(axes, {}, 0.0)
        names, size = [area.name for area in venue.areas], max(NAME_SHARE * height, NAME_LEAST)
        self.stamps = [Stamp(one) for one in pictures_of(names, size, "white", axes.figure.dpi, "black", "normal")]
        sizes = np.array([(one.width, one.height) for one in self.stamps], dtype=np.float64)
        self.places = NamePlaces(venue, lines).middles(axes, sizes)
