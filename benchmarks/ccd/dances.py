"""Random dances: dragons and the paths that they follow, drawn by Philox and written as records of JSON."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.random import Generator, Philox

from core import Dance, Dragon, Route, Spiral
from core.errors import InvalidValue
from core.paths.pieces import Arc, Line, Waypoints
from core.paths.turn import Turn
from core.proof.paths import core_path, recorded_path

KINDS = ("spiral", "turn", "arcs", "waypoints")
# Most draws of a dance, if its path bends too tightly for its dragon.
TRIES = 200
Record = dict[str, Any]


def generator(seed: int, stream: int) -> Generator:
    """Random numbers of one dance: Philox with the seed as its key, the number of the dance as its counter."""
    return Generator(Philox(key=seed, counter=[0, 0, 0, stream]))


def random_record(random: Generator, kind: str) -> Record:
    """A dance that its dragon can follow: kind, lengths, widths, overhangs [m], path."""
    for _ in range(TRIES):
        record = {"kind": kind, **_dragon(random), "path": _PATHS[kind](random)}
        try:
            dance = dance_of(record)
            if dance.end.time > dance.begin + 1.0:
                return record
        except InvalidValue:  # a bend too tight, a spiral too short, a joint that does not close: drawn again
            continue
    raise RuntimeError(f"no {kind} was found that a dragon can follow in {TRIES} draws")


def dance_of(record: Record) -> Dance:
    """The dance of a record, its head at 1 m/s."""
    path = record["path"]
    if path["kind"] == "waypoints":
        return Dance(_dragon_of(record), Route([Waypoints(tuple(map(tuple, path["points"])))]))
    return Dance(_dragon_of(record), core_path(path))


def _dragon_of(record: Record) -> Dragon:
    return Dragon.of(record["lengths"], record["widths"], record["overhangs"])


def _dragon(random: Generator) -> Record:
    """10 to 24 benches: a longer head and a uniform body, or, in a third of all dragons, no two benches alike."""
    benches = int(random.integers(10, 25))
    uneven = random.random() < 1 / 3
    body = random.uniform(0.6, 1.8)
    lengths = body * random.uniform(0.7, 1.3, benches) if uneven else np.full(benches, body)
    lengths[0] = body * random.uniform(1.0, 1.6)
    widths = random.uniform(0.1, 0.35) * (random.uniform(0.6, 1.4, benches) if uneven else np.ones(benches))
    overhangs = random.uniform(0.02, 0.16) * body * np.ones(benches)
    return {name: column.tolist() for name, column in zip(SIZES, (lengths, widths, overhangs), strict=True)}


SIZES = ("lengths", "widths", "overhangs")


def _spiral(random: Generator) -> Record:
    return recorded_path(Spiral(random.uniform(0.35, 1.1), random.uniform(4.0, 9.0)))


def _turn(random: Generator) -> Record:
    """A coil inwards, two arcs, and the coil outwards."""
    pitch = random.uniform(0.45, 1.2)
    radius = random.uniform(1.3, 3.0)
    turns = radius / pitch + random.uniform(1.0, 3.0)
    return recorded_path(Turn(pitch, radius, random.uniform(1.0, 2.5), start_turns=turns))


def _arcs(random: Generator) -> Record:
    """Lines and arcs, most of them to the left, so that the path comes back to itself."""
    point, heading, pieces = np.zeros(2), 0.0, []
    for _ in range(int(random.integers(10, 18))):
        if random.random() < 0.25:
            end = point + random.uniform(0.5, 3.0) * np.array([math.cos(heading), math.sin(heading)])
            pieces.append(Line((float(point[0]), float(point[1])), (float(end[0]), float(end[1]))))
            point = end
            continue
        side = 1.0 if random.random() < 0.8 else -1.0
        radius, sweep = random.uniform(1.1, 3.0), side * random.uniform(0.5, 4.0)
        angle = heading - side * math.pi / 2
        centre = point - radius * np.array([math.cos(angle), math.sin(angle)])
        pieces.append(Arc((float(centre[0]), float(centre[1])), radius, angle, sweep))
        point = centre + radius * np.array([math.cos(angle + sweep), math.sin(angle + sweep)])
        heading += sweep
    return recorded_path(Route(pieces))


def _waypoints(random: Generator) -> Record:
    """A smooth curve that winds several times around one place, at a distance that wanders."""
    step = random.uniform(0.5, 0.9)
    angles = np.arange(int(random.integers(24, 48))) * step
    drift = random.uniform(-0.05, 0.12)
    radii = np.maximum(random.uniform(1.4, 2.6) + drift * angles + random.uniform(-0.2, 0.2, angles.size), 1.0)
    x, y = radii * np.cos(angles), radii * np.sin(angles)
    stretch = random.uniform(0.7, 1.4)
    return {"kind": "waypoints", "points": np.stack([stretch * x, y], axis=1).tolist()}


_PATHS = {"spiral": _spiral, "turn": _turn, "arcs": _arcs, "waypoints": _waypoints}
