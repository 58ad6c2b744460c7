"""The spec of a film: interval, length, size and form."""

from __future__ import annotations

from dataclasses import dataclass
from importlib.util import find_spec

import numpy as np

from core.people.beats import Music
from core.values import Floats, Pair

MP4_TYPE, GIF_TYPE = "video/mp4", "image/gif"
# Forms of a film and the endings of their files, the default first: without PyAV a film is a GIF.
ENDINGS = ({MP4_TYPE: ".mp4"} if find_spec("av") else {}) | {GIF_TYPE: ".gif"}
# Frames a second and height of the picture [pixels]. A GIF holds every picture whole, so a large one takes much room.
LOOKS = {MP4_TYPE: (30, 1080), GIF_TYPE: (12, 360)}


@dataclass(frozen=True)
class FilmSpec:
    """start, stop: times in the dance [s]; seconds: length of the film [s]; rate: [frames/s]; height: [pixels]
    start_clock: time of day at time 0, see time_of_day(); touching: benches that touch at the last instant
    music: beats, which a film counts and an MP4 lets hear; music_begin: when they begin [s]; music_of: the dragon of
        several that has them, empty where all have the same
    dragons: of several, whose benches touch; colours: of several dragons
    marked: dragon, 0 for the only one, and bench of each bench that stands out, with its number and its name"""

    start: float
    stop: float
    seconds: float = 20.0
    rate: float = 30.0
    height: int = 1080
    start_clock: str | None = None
    touching: Pair | None = None
    music: Music | None = None
    music_begin: float = 0.0
    music_of: str = ""
    dragons: Pair | None = None
    colours: tuple[str, ...] = ()
    marked: tuple[Pair, ...] = ()

    @property
    def width(self) -> int:
        """Width for 16 : 9 [pixels]; even, as H.264 requires."""
        return 2 * round(self.height * 8 / 9)

    @property
    def times(self) -> Floats:
        """Instants of the dance that the frames show, (F,) [s]."""
        return np.linspace(self.start, self.stop, max(round(self.seconds * self.rate), 2))
