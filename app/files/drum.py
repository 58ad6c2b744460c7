"""The sound of a film: a drum that is struck on every beat, the first of a bar lower and louder.

Every stroke is computed: a tone that falls and fades, and the noise of the stick. The same beats give the same samples.
"""

from __future__ import annotations

import numpy as np

from app.files.film_spec import FilmSpec
from core.values import Floats

# Samples a second.
RATE = 48_000
# Length of a stroke [s], and how fast its tone fades and falls [1/s].
STROKE, FADES, FALLS = 0.35, 11.0, 18.0
# Frequency at the end of a stroke [Hz] and its rise at the beginning, and loudness of full scale: of the first beat of
# a bar, and of the others.
FIRST, OTHERS = (62.0, 1.6, 0.8), (98.0, 1.2, 0.5)
# Share of the noise of the stick, and how fast it fades [1/s].
STICK, STICK_FADES = 0.35, 160.0
# Time over which a stroke rises to its loudness, so that it does not click [s].
RISE = 0.001


def stroke(tone: float, rise: float, loud: float) -> Floats:
    """Samples of one stroke, from -1 to 1."""
    time = np.arange(round(STROKE * RATE)) / RATE
    # The frequency is tone (1 + rise exp(-FALLS t)); its integral is the phase.
    phase = 2.0 * np.pi * tone * (time + rise / FALLS * (1.0 - np.exp(-FALLS * time)))
    noise = np.random.default_rng(1).uniform(-1.0, 1.0, time.size)
    shape = (1.0 - STICK) * np.cos(phase) * np.exp(-FADES * time) + STICK * noise * np.exp(-STICK_FADES * time)
    end = np.minimum(1.0, (STROKE - time) / 0.02)
    sound: Floats = loud * shape * np.minimum(1.0, time / RISE) * end
    return sound


def strokes_of(spec: FilmSpec) -> tuple[Floats, list[bool]]:
    """Times in the film (B,) at which a beat is to be heard [s], and which of them begin a bar.

    Frame k shows the instant k of spec.times, so that the film lasts a frame longer than from the first to the last.
    """
    if spec.music is None:
        return np.empty(0), []
    times, first = spec.music.beats(spec.start - spec.music_begin, spec.stop - spec.music_begin)
    pace = (spec.times.size - 1) / (spec.rate * (spec.stop - spec.start))
    return (times + spec.music_begin - spec.start) * pace, first


def samples_of(spec: FilmSpec) -> Floats:
    """The samples of the whole film, from -1 to 1; strokes that overlap add up, and none is louder than full scale."""
    sound = np.zeros(round(spec.times.size / spec.rate * RATE))
    low, high = stroke(*FIRST), stroke(*OTHERS)
    times, first = strokes_of(spec)
    for time, begins_bar in zip(times.tolist(), first, strict=True):
        at, one = round(time * RATE), low if begins_bar else high
        some = sound[at : at + one.size]
        some += one[: some.size]
    most = float(np.abs(sound).max(initial=1.0))
    quieter: Floats = sound / most
    return quieter
