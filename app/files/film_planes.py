"""What moves in a film, drawn on the planes that its encoder takes: rectangles are filled, small pictures laid on.

Brightness and colour differences (BT.709) are linear in red, green and blue, so colours are mixed alike on all planes.
So a picture for H.264 is never converted: its planes are drawn, those of colour differences at half its size.

matplotlib fills the 223 benches of a picture of 1080 rows in 5 ms, aggdraw and skia-python need longer; a loop that
knows that they are rectangles takes 1 ms, and 0.6 ms for the other plane (measured 2026-11-29).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from core.kernels import fill_rectangles
from core.values import Floats

Bytes = NDArray[np.uint8]

# Full alpha in a picture that is laid, and on the planes, where a shift divides by it; what rounds to the nearest
# instead of down, and never takes a value of 16 bits past its end.
OPAQUE, WHOLE, ROUNDED = 255.0, 256.0, 127.0


class Tone(NamedTuple):
    """How a plane shows red, green, blue in [0, 1]: weights (C, 3), offset (C,); scale: its pixel, in the picture's"""

    scale: int
    weights: Floats
    offset: Floats

    def of(self, rgb: Floats) -> Floats:
        """Values (..., C) of colours (..., 3)."""
        values: Floats = rgb @ self.weights.T + self.offset
        return values


RED, GREEN, BLUE = 0.2126, 0.7152, 0.0722
_BRIGHT = np.array([RED, GREEN, BLUE])
_TO_BLUE, _TO_RED = (np.array([0.0, 0.0, 1.0]) - _BRIGHT) / (2 - 2 * BLUE), (np.eye(3)[0] - _BRIGHT) / (2 - 2 * RED)
COLOURS = (Tone(1, 255.0 * np.eye(3), np.zeros(3)),)
# Brightness, and the differences of blue and of red from it.
YUV = (
    Tone(1, 219.0 * _BRIGHT[None], np.array([16.0])),
    Tone(2, 224.0 * np.stack([_TO_BLUE, _TO_RED]), np.array([128.0, 128.0])),
)


class Stamp:
    """A small picture (rows, columns, 4) in red, green, blue, alpha, which is laid on planes."""

    def __init__(self, picture: Bytes) -> None:
        self.height, self.width = picture.shape[:2]
        self._picture = picture
        self._parts: dict[tuple[int, int, int], tuple[NDArray[np.uint16], NDArray[np.uint16]]] = {}

    def part(self, tone: Tone, dx: int, dy: int) -> tuple[NDArray[np.uint16], NDArray[np.uint16]]:
        """How much of a plane stays [1 / WHOLE], and what is added [value / WHOLE].

        dx, dy: place of the left upper corner in a pixel of the plane [pixels of the picture]
        """
        key = (id(tone), dx, dy)
        if key not in self._parts:
            scale, after = tone.scale, (-(self.height + dy) % tone.scale, -(self.width + dx) % tone.scale)
            alpha = self._picture[..., 3:] / OPAQUE
            whole = np.concatenate([alpha, alpha * tone.of(self._picture[..., :3] / OPAQUE)], axis=-1)
            whole = np.pad(whole, ((dy, after[0]), (dx, after[1]), (0, 0)))
            rows, columns, channels = whole.shape
            mean = whole.reshape(rows // scale, scale, columns // scale, scale, channels).mean(axis=(1, 3))
            self._parts[key] = (
                np.rint(WHOLE * (1.0 - mean[..., :1])).astype(np.uint16),
                np.rint(WHOLE * mean[..., 1:] + ROUNDED).astype(np.uint16),
            )
        return self._parts[key]


# A stamp, and the place of its left upper corner [pixels].
Placed = tuple[Stamp, int, int]


class PicturePlane:
    """A plane of a picture: what stands still, and what is drawn on it."""

    def __init__(self, tone: Tone, still: Bytes) -> None:
        """still: the picture (height, width, 3 or more) without what moves"""
        self.tone, (height, width) = tone, still.shape[:2]
        shape = (height // tone.scale, tone.scale, width // tone.scale, tone.scale, 3)
        mean = still[..., :3].reshape(shape).mean(axis=(1, 3)) / OPAQUE
        self._still: Bytes = np.rint(tone.of(mean)).astype(np.uint8)
        self.drawn = self._still.copy()

    def begin(self) -> None:
        """Take away what was drawn."""
        np.copyto(self.drawn, self._still)

    def fill(self, rectangles: Floats, face: str, edge: str, line: float) -> None:
        """Fill rectangles as rectangles_of() gives them. line: half width of the lines around them"""
        inks = np.rint(self.tone.of(np.array([to_rgb(face), to_rgb(edge)])))
        scale = self.tone.scale
        fill_rectangles(self.drawn, rectangles / np.array([scale, scale, 1, 1, scale, scale]), line / scale, inks)

    def lay(self, stamp: Stamp, left: int, top: int) -> None:
        """Lay a stamp. left, top: of its corner in the picture [pixels]"""
        scale = self.tone.scale
        (column, dx), (row, dy) = divmod(left, scale), divmod(top, scale)
        stays, added = stamp.part(self.tone, dx, dy)
        rows, columns = stays.shape[:2]
        above, before = max(-row, 0), max(-column, 0)
        under = self.drawn[max(row, 0) : max(row + rows, 0), max(column, 0) : max(column + columns, 0)]
        inside = slice(above, above + under.shape[0]), slice(before, before + under.shape[1])
        mixed = under * stays[inside]
        mixed += added[inside]
        np.right_shift(mixed, 8, out=mixed)
        under[...] = mixed


class PicturePlanes:
    """A picture on which benches and stamps are drawn again and again."""

    def __init__(self, still: Bytes, tones: tuple[Tone, ...]) -> None:
        """still: the picture (height, width, 4) without what moves"""
        self.height, self.width = still.shape[:2]
        self._planes = [PicturePlane(tone, still) for tone in tones]

    def begin(self) -> None:
        """Take away what was drawn."""
        for plane in self._planes:
            plane.begin()

    def fill(self, corners: Floats, face: str, edge: str, line: float) -> None:
        """Fill rectangles one after the other. edge, line: colour and width of the line around each

        corners: (N, 4, 2), in the order around each; all lengths in pixels from the upper left corner
        """
        rectangles = rectangles_of(corners)
        for plane in self._planes:
            plane.fill(rectangles, face, edge, 0.5 * line)

    def lay(self, stamps: Sequence[Placed]) -> None:
        """Lay stamps on what was drawn."""
        for stamp, left, top in stamps:
            if stamp.width:
                for plane in self._planes:
                    plane.lay(stamp, left, top)

    @property
    def picture(self) -> Bytes:
        """The picture until begin(): (height, width, 3) in COLOURS, (height * 3 / 2, width) as nv12 in YUV."""
        if len(self._planes) == 1:
            return self._planes[0].drawn
        return np.concatenate([plane.drawn.ravel() for plane in self._planes]).reshape(-1, self.width)


def rectangles_of(corners: Floats) -> Floats:
    """Middle, direction of the length, half length and half width (N, 6) of rectangles (N, 4, 2)."""
    a, b, c, d = np.moveaxis(corners, 1, 0)
    along, across = 0.25 * (a + b - c - d), 0.25 * (a + d - b - c)
    lengths, widths = np.hypot(*along.T), np.hypot(*across.T)
    # An area without length has the direction of its width.
    turned = np.stack([-across[:, 1], across[:, 0]], axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        ways = np.where(lengths[:, None] > 0.0, along / lengths[:, None], turned / widths[:, None])
    rectangles: Floats = np.column_stack([corners.mean(axis=1), np.nan_to_num(ways), lengths, widths])
    return rectangles
