"""Films of a dance or of several, as MP4 (H.264, through PyAV) or as GIF (Pillow).

matplotlib draws the background and the numbers of benches once. For each frame the background is copied back, the
benches are filled, and the numbers are laid on them. Meanwhile a second thread encodes the frames before. The same film
gives the same bytes on the same versions of these libraries.
"""

from __future__ import annotations

import io
import itertools
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from numpy.typing import NDArray

from app.files.drawing import draw_areas, in_turn
from app.files.film_labels import MARKED_SHARE, CornerText, Labels, LabelsBeside, NameLabels, numbered, size_of
from app.files.film_planes import COLOURS, YUV, PicturePlanes, Tone
from app.files.film_spec import MP4_TYPE, FilmSpec
from app.files.fonts import families_for
from app.files.looks import colour_of, with_square
from app.files.performances import LEGEND_MOST
from app.files.scratch import temporary
from app.wire.clocks import minutes_and_seconds, time_of_day
from core import Budget, Dance, Dragon, Performance, Trajectory, Venue, bench_outlines, trajectory
from core.language import say
from core.plots import BLUE, VERMILION, draw_dance
from core.questions import drawn
from core.values import Floats, Pair, Progress, unheard

DPI = 100
# Size of the type, as a share of the height of the picture.
TYPE_SHARE = 0.026
# Place of the first name of several dragons and distance to the next, as shares of the height of the picture.
NAME_AT, NAME_STEP = 0.97, 0.045
# Empty space around the dragon, as a share of its extent; number of instants from which the extent is taken.
AROUND, EXTENT_INSTANTS = 0.04, 60
# Instants whose handles are computed at once.
BATCH = 60
# Most frames that wait for the encoder.
WAITING = 4
# H.264: quality (crf, smaller is better), effort, and number of threads, which changes the bytes. With five frames
# between two others (bframes) and the quickest search the film of the default dance takes 7.8 MB in place of 26, and
# 0.6 of the processor's time of two frames and the usual search, for 1 % more bytes (measured 2026-11-28). No parts of
# blocks but 8 x 8, no search for cuts, and a quality of 26 in place of 25: 0.75 of the time, as many bytes, and 1.3
# in place of 1.2 of 255 as the mean error of brightness (measured 2026-11-29).
SEARCH = (
    "bframes=5:b-adapt=0:b-pyramid=none:subme=1:trellis=0:weightp=0:ref=1:rc-lookahead=6:partitions=p8x8:scenecut=0"
)
OPTIONS, THREADS = {"crf": "26", "preset": "veryfast", "x264-params": SEARCH}, 2
FAST_START = {"movflags": "faststart"}
# The sound is whole before the first picture, so the file waits for as many pictures as it takes.
WITH_SOUND = {"max_interleave_delta": "0"}
# AAC: bits a second, and samples that are handed over at once.
SOUND_BITS, AT_ONCE = 96_000, 1024
BODY_EDGE = "#003A5D"
# Colour of paths, and width of their lines, as a share of the height of the picture.
WAY, WAY_SHARE = "#9AA8B2", 0.0018
# A GIF shows every frame for whole hundredths of a second.
GIF_TICK = 100
# Colours of a GIF: steps from one colour to another, because edges are smooth. A palette of the most frequent colours
# would lack the head's colour, which only one bench of hundreds has.
GIF_STEPS = 9
GIF_BLENDS = (
    ("white", "black"), ("white", BLUE), ("white", BODY_EDGE), ("white", VERMILION), (BLUE, BODY_EDGE),
    (BLUE, VERMILION), (BODY_EDGE, VERMILION), ("black", VERMILION), ("black", BLUE), ("white", WAY),
)  # fmt: skip
DIGITS = "0123456789"
# Colour of marked benches.
MARKED = "#F0E442"
# Width of edges of benches [pixels], and of those that touch, as a share of the height of the picture. Benches narrower
# than EDGED edges have edges in their own colour, because dark ones would hide it.
EDGE, TOUCHING_SHARE, EDGED = 0.8 * DPI / 72.0, 0.0025, 4.0
# Least width at which a marked bench is drawn, as a share of the height of the picture.
MARKED_LEAST = 0.014
# Part of a marked bench that is dark, its front.
FRONT_SHARE = 0.18


def film(
    filmed: Dance | Performance,
    spec: FilmSpec,
    form: str,
    *,
    venue: Venue | None = None,
    title: str = "",
    budget: Budget | None = None,
    progress: Progress = unheard,
) -> bytes:
    """The bytes of a film in one of FORMS, of several dragons each in its own colour with its name beside.

    progress: called with the share of finished frames
    raises: OutsideRun; TooMuchWork where the budget is stopped; MissingPackage without a font for the language
    """
    budget, sink = budget or Budget(), io.BytesIO()

    def draw() -> bytes:
        tones, encode = (YUV, encoded_mp4) if form == MP4_TYPE else (COLOURS, encoded_gif)
        stage = FilmPicture(filmed, spec, venue, title, tones, budget)
        with encode(sink, spec) as take:
            for k, frame in enumerate(frames(stage, spec, budget), start=1):
                take(frame)
                progress(k / spec.times.size)
        return sink.getvalue()

    return drawn(filmed, "the film was not drawn", draw)


def frames(stage: FilmPicture, spec: FilmSpec, budget: Budget) -> Iterator[NDArray[np.uint8]]:
    """Pictures as FilmPicture.frame() gives them, each valid until the next one."""
    times = spec.times
    for first in range(0, times.size, BATCH):
        some = times[first : first + BATCH]
        placed = zip(stage.dragons, stage.trajectories(some, budget), strict=True)
        outlines = [bench_outlines(dragon, one.position) for dragon, one in placed]
        for k, time in enumerate(some.tolist()):
            budget.look()
            yield stage.frame(time, [own[k] for own in outlines], is_last=first + k == times.size - 1)


class DragonLayer(NamedTuple):
    """What moves of one dragon. head, body: colours of the area and of its line
    words: of the marked benches, by number; wider: times their widths are drawn (M,)"""

    head: tuple[str, str]
    body: tuple[str, str]
    words: dict[int, str]
    wider: Floats
    labels: list[Labels]


class FilmPicture:
    """A picture that is drawn again for each frame: the stored background, then the benches and the time.

    several: the performance, None for a single dance; dragons: all of the picture
    """

    def __init__(
        self,
        filmed: Dance | Performance,
        spec: FilmSpec,
        venue: Venue | None,
        title: str,
        tones: tuple[Tone, ...] = COLOURS,
        budget: Budget | None = None,
    ) -> None:
        """Draw the background, and make what moves before it. raises: Halted once the budget is stopped"""
        self.filmed, self.several = filmed, filmed if isinstance(filmed, Performance) else None
        self.dances = [filmed] if isinstance(filmed, Dance) else [part.dance for part in filmed.parts]
        self.dragons = [dance.dragon for dance in self.dances]
        self.start_clock, self.spec = spec.start_clock, spec
        in_turn(lambda: self._draw(spec, venue, title, tones), budget)

    def trajectories(self, times: Floats, budget: Budget | None = None) -> Sequence[Trajectory]:
        """Where each dragon is."""
        placed = trajectory(self.filmed, times, budget=budget)
        return [placed] if isinstance(placed, Trajectory) else placed

    def draw_paths(self, times: Floats) -> Floats:
        """Draw what does not move; returns the places (N, 2) of handles at these times [m]."""
        places = [one.position.reshape(-1, 2) for one in self.trajectories(times)]
        for dance, own in zip(self.dances, places, strict=True):
            draw_dance(self.axes, dance.path, own, np.empty((0, 4, 2)))
        look: dict[str, Any] = {"transform": self.axes.transAxes, "zorder": 9, "parse_math": False, "va": "top"}
        if self.several:
            for k in range(min(len(places), LEGEND_MOST)):
                name, colour = self.several.name_of(k), self.colours(k)[0]
                self.axes.text(0.015, NAME_AT - NAME_STEP * k, name, color=colour, **look)
        return np.concatenate(places)

    def colours(self, dragon: int) -> tuple[str, str, str, str]:
        """Colours of the head, of the body, of its edges, and of those of its numbers."""
        if self.several is None:
            return VERMILION, BLUE, BODY_EDGE, BLUE
        own = colour_of(self.several, dragon)
        return own, own, own, "black"

    def _draw(self, spec: FilmSpec, venue: Venue | None, title: str, tones: tuple[Tone, ...]) -> None:
        points, dragons = TYPE_SHARE * spec.height * 72.0 / DPI, self.dragons
        names = [name for k, bench in spec.marked for name in dragons[k].names[bench : bench + 1]]
        names += [area.name for area in venue.areas] if venue else []
        family = families_for([title, *names])
        with matplotlib.rc_context({"font.family": family, "font.size": points}):
            figure = Figure(figsize=(spec.width / DPI, spec.height / DPI), dpi=DPI)
            self.canvas = FigureCanvasAgg(figure)
            self.axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
            sampled = np.linspace(spec.start, spec.stop, EXTENT_INSTANTS)
            handles = self.draw_paths(sampled)
            for line in self.axes.lines:
                line.set(color=WAY, linewidth=WAY_SHARE * spec.height * 72.0 / DPI)
            paths = [np.asarray(line.get_xydata(), dtype=np.float64) for line in self.axes.lines]
            draw_areas(self.axes, venue)
            self._look(*with_square(venue, handles.min(axis=0), handles.max(axis=0)), spec)
            self.names = [NameLabels(self.axes, venue, spec.height, paths)] if venue else []
            place: dict[str, Any] = {"transform": self.axes.transAxes, "zorder": 9, "parse_math": False}
            self.axes.text(0.985, 0.97, title, ha="right", va="top", **place)
            self.time = CornerText(self.axes, points)
            self.layers = [self._layer(k, dragon, spec) for k, dragon in enumerate(dragons)]
        # Here, because matplotlib draws for one thread at a time.
        self.time.prepare(DIGITS + self.words(spec.stop))
        self.canvas.draw()
        self.planes = PicturePlanes(np.asarray(self.canvas.buffer_rgba()), tones)

    def _look(self, low: Floats, high: Floats, spec: FilmSpec) -> None:
        """Show everything between two corners, at one scale for x and y that fills the frame."""
        middle, half = 0.5 * (low + high), 0.5 * (1.0 + 2.0 * AROUND) * (high - low) + 1.0
        shape = spec.width / spec.height
        tall = max(float(half[1]), float(half[0]) / shape)
        self.axes.set(xlim=(middle[0] - shape * tall, middle[0] + shape * tall))
        self.axes.set(ylim=(middle[1] - tall, middle[1] + tall), aspect="auto")
        self.axes.set_axis_off()
        scale_bar(self.axes, middle - np.array([shape * tall, tall]), tall)

    def fill(self, outlines: Floats, face: str, edge: str, line: float) -> None:
        """Fill benches at outlines (N, 4, 2) [m]. line: width of the edges [pixels]"""
        if len(outlines):
            places = self.axes.transData.transform(outlines.reshape(-1, 2)).reshape(-1, 4, 2)
            self.planes.fill(np.array([0.0, self.planes.height]) + np.array([1.0, -1.0]) * places, face, edge, line)

    def _layer(self, k: int, dragon: Dragon, spec: FilmSpec) -> DragonLayer:
        """What moves of a dragon."""
        head, body, edge, around = self.colours(k)
        own = [bench for one, bench in spec.marked if one == k]
        (left, right), chord = self.axes.get_xlim(), float(np.mean(dragon.chords))
        size, to_pixels = size_of(spec.height), spec.width / (right - left)
        plain, widths = numbered(dragon.benches, chord * to_pixels, size), to_pixels * dragon.widths
        head_edge = "black"
        if float(widths.min()) < EDGED * EDGE:
            edge, head_edge = body, head
        drawn = np.maximum(widths[own], MARKED_LEAST * spec.height)
        words = {bench: " ".join([str(bench), *filter(None, dragon.names[bench : bench + 1])]) for bench in own}
        labels = [
            Labels(self.axes, {bench: str(bench) for bench in plain if bench not in words}, size, around),
            LabelsBeside(self.axes, words, size_of(spec.height, MARKED_SHARE), drawn),
        ]
        return DragonLayer((head, head_edge), (body, edge), words, drawn / widths[own], labels)

    def touching(self) -> tuple[list[Pair], str]:
        """Dragon and number of the two benches that touch at the last instant, and that they do in words."""
        if self.spec.touching is None:
            return [], ""
        dragons, (a, b) = self.spec.dragons or (0, 0), self.spec.touching
        words = say("benches {a} and {b} touch\n", a=a, b=b)
        if self.several:
            dragon, second = map(self.several.name_of, dragons)
            words = say(
                "bench {bench} of {dragon} and bench {other} of {second} touch\n",
                bench=a, dragon=dragon, other=b, second=second,
            )  # fmt: skip
        return [(dragons[0], a), (dragons[1], b)], words

    def frame(self, time: float, outlines: Sequence[Floats], *, is_last: bool = False) -> NDArray[np.uint8]:
        """The picture, as PicturePlanes.picture, at one instant [s].

        outlines: (n, 4, 2) of each dragon [m]; is_last: mark and name the benches that touch then
        """
        touching, first = self.touching() if is_last else ([], "")
        wide, written = TOUCHING_SHARE * self.spec.height, list[Labels](self.names)
        self.planes.begin()
        for layer, own in zip(self.layers, outlines, strict=True):
            marked = widened(own[list(layer.words)], layer.wider)
            self.fill(own[1:], *layer.body, EDGE)
            self.fill(own[:1], *layer.head, EDGE)
            self.fill(marked, MARKED, "black", wide)
            self.fill(fronts_of(marked), "black", "black", 0.0)
            for labels in layer.labels:
                labels.place(own)
            written += layer.labels
        if touching:
            self.fill(np.stack([outlines[k][bench] for k, bench in touching]), VERMILION, "black", wide)
        self.time.text = first + self.words(time)
        for labels in written:
            self.planes.lay(labels.placed)
        self.planes.lay(self.time.placed)
        return self.planes.picture

    def words(self, time: float) -> str:
        """The count, the clock as on the cards, and the time [s] of a picture."""
        clock = time_of_day(time, self.start_clock) if self.start_clock else minutes_and_seconds(time)
        words = say("{clock} ({time:.2f} s)", clock=clock, time=time)
        music = self.spec.music
        if music and (count := music.count(time - self.spec.music_begin)):
            counted = say("bar {bar} beat {beat}", bar=count[0], beat=count[1])
            if self.spec.music_of:
                counted = say("{name}: {text}", name=self.spec.music_of, text=counted)
            words = f"{counted}  {words}"
        return words


def widened(outlines: Floats, times: Floats) -> Floats:
    """Benches (M, 4, 2) at some times their widths (M,)."""
    front, rear = (outlines[:, k].mean(axis=1, keepdims=True) for k in ([0, 1], [2, 3]))
    ends = np.concatenate([front, front, rear, rear], axis=1)
    wider: Floats = ends + times[:, None, None] * (outlines - ends)
    return wider


def fronts_of(outlines: Floats) -> Floats:
    """The front parts (M, 4, 2) of benches (M, 4, 2)."""
    front, rear = outlines[:, :2], outlines[:, [3, 2]]
    parts: Floats = np.concatenate([front, (front + FRONT_SHARE * (rear - front))[:, ::-1]], axis=1)
    return parts


def scale_bar(axes: Axes, corner: Floats, half: float) -> None:
    """Draw a scale bar at the lower left. corner: lower left of the view [m]; half: half of the view's height [m]"""
    length = 10.0 ** np.floor(np.log10(half / 2.0))
    x, y = corner + 0.07 * half
    axes.plot([x, x + length], [y, y], color="black", linewidth=2.0, solid_capstyle="butt", zorder=9)
    axes.text(x, y + 0.02 * half, f"{length:g} m", ha="left", va="bottom", zorder=9)


Take = Callable[[NDArray[np.uint8]], None]


@contextmanager
def encoded_mp4(sink: io.BytesIO, spec: FilmSpec) -> Iterator[Take]:
    """Context that writes frames as H.264 in a second thread; yields the function that takes one.

    The table of the film (moov) stands first, so a player can begin before it has the whole film. libav can put it
    there only in a file.
    """
    import av
    from av.video.reformatter import ColorRange, Colorspace

    waiting: deque[Future[None]] = deque()
    # The encoder's context is left first: closing the file while a frame is written would end the process.
    with (
        temporary("film-") as folder,
        av.open(path := f"{folder}/film.mp4", "w", options=FAST_START | (WITH_SOUND if spec.music else {})) as file,
        ThreadPoolExecutor(1) as encoder,
    ):
        stream = file.add_stream("libx264", rate=round(spec.rate), options=OPTIONS)
        stream.width, stream.height, stream.pix_fmt = spec.width, spec.height, "nv12"
        stream.codec_context.thread_count = THREADS
        stream.codec_context.colorspace, stream.codec_context.color_range = Colorspace.ITU709, ColorRange.MPEG
        if spec.music:  # last, because the first sound opens the encoders of both streams
            add_drum(file, spec)

        def encode(picture: NDArray[np.uint8]) -> None:
            file.mux(stream.encode(av.VideoFrame.from_numpy_buffer(picture, format="nv12")))

        # Taken in turn: the oldest is encoded when its room is taken again. New room would cost as much as the copy.
        copies = itertools.cycle([np.empty((3 * spec.height // 2, spec.width), np.uint8) for _ in range(WAITING)])

        def take(picture: NDArray[np.uint8]) -> None:
            if len(waiting) == WAITING:
                waiting.popleft().result()
            np.copyto(copy := next(copies), picture)
            waiting.append(encoder.submit(encode, copy))

        try:
            yield take
            while waiting:
                waiting.popleft().result()
            file.mux(stream.encode(None))
            file.close()
            sink.write(Path(path).read_bytes())
        finally:
            for one in waiting:
                one.cancel()


def add_drum(file: Any, spec: FilmSpec) -> None:
    """Add the sound of a film to its file, which has the stream of the pictures already."""
    import av

    from app.files.drum import RATE, samples_of

    stream = file.add_stream("aac", rate=RATE, layout="mono")
    stream.bit_rate, stream.codec_context.thread_count = SOUND_BITS, 1
    samples = samples_of(spec).astype(np.float32)
    for first in range(0, samples.size, AT_ONCE):
        frame = av.AudioFrame.from_ndarray(samples[None, first : first + AT_ONCE], format="fltp", layout="mono")
        frame.sample_rate, frame.pts = RATE, first
        file.mux(stream.encode(frame))
    file.mux(stream.encode(None))


@contextmanager
def encoded_gif(sink: io.BytesIO, spec: FilmSpec) -> Iterator[Take]:
    """Context that writes frames as a GIF that repeats; yields the function that takes one."""
    from PIL import Image

    pictures: list[Image.Image] = []
    palette = Image.new("P", (1, 1))
    colours = [*spec.colours, *([MARKED] if spec.marked else [])]
    several = [pair for colour in colours for pair in (("white", colour), (colour, "black"))]
    ends = np.array([[to_rgb(colour) for colour in blend] for blend in (*GIF_BLENDS, *several)])
    blends = ends[:, :1] + np.linspace(0.0, 1.0, GIF_STEPS)[:, None] * (ends[:, 1:] - ends[:, :1])
    palette.putpalette(np.rint(255.0 * blends).astype(np.uint8).tobytes())

    def take(picture: NDArray[np.uint8]) -> None:
        pictures.append(Image.fromarray(picture).quantize(palette=palette, dither=Image.Dither.NONE))

    yield take
    ticks = max(round(GIF_TICK * spec.seconds / len(pictures)), 2)
    pictures[0].save(
        sink, "gif", save_all=True, append_images=pictures[1:], duration=1000 * ticks // GIF_TICK, loop=0,
        optimize=False, disposal=1,
    )  # fmt: skip
