"""Sweeps: all places that one bench passes, cut into stretches over which no later bench touches it."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeGuard

from core.errors import ProofRefused
from core.proof.chain import Chain, SpiralStretch
from core.proof.ground import AT_ONCE, ONE_BY_ONE, best_side
from core.proof.pairs import ALL_FACES, CIRCLES, DIRECTION, Unfinished, Unproven, malformed
from core.proof.route import RouteChain
from core.proof.route_stretch import RouteStretch
from core.quantities import Parameter, quantities
from core.values import Progress

# First width of a stretch, its growth after a success, and the width at which the search gives up [rad], [m].
WIDTH_FIRST = 0.5
WIDTH_GROWTH = 1.5
WIDTH_LEAST = 1e-13

AnyChain = Chain | RouteChain
AnyStretch = SpiralStretch | RouteStretch
# Proof that a pair is apart: a face, or with a stray one side of their grounds or nine (16.).
Face = str | list[int]
# (highest place, lowest place, one face for each bench from the next but one on, until all others are far, and the
# directions)
Tile = tuple[float, float, str | list[Face], list[float]]
# Sweep of one bench: (bench, highest place, lowest place, places of 6.) -> proven tiles, in the order of the dance.
Source = Callable[[int, float, float, Sequence[float]], Iterator["tuple[AnyStretch, Tile]"]]


class SweepOverlap(Unfinished):
    """Benches a < b strictly overlap, or are nearer than the margin, when the front handle of a is at this place."""

    def __init__(self, chain: AnyChain, a: int, b: int, place: float) -> None:
        words = "benches {a} and {b} overlap when handle {a} is at {place}"
        if chain.margin > 0:
            words = "benches {a} and {b} are nearer than the margin when handle {a} is at {place}"
        super().__init__(words, a=a, b=b, place=chain.place_quantity(place))
        self.a, self.b, self.place = a, b, place


def stretch_of(chain: AnyChain, bench: int, low: float, high: float, last: int) -> AnyStretch:
    """A bench and those behind it over all places of its front handle from low to high [rad], [m]."""
    if isinstance(chain, RouteChain):
        return RouteStretch(chain, bench, low, high, last)
    return SpiralStretch(chain, bench, low, high, last)


def _faces(stretch: AnyStretch) -> Tile:
    """Verified faces that keep all benches of the stretch apart; raises SweepOverlap if two are too near at an end."""
    faces: Any = [] if _strays(stretch) else ""
    directions = []
    while not stretch.complete:
        stretch.grow()
        partner = len(stretch.placed) - 1
        if partner < 2:
            continue
        face, direction = _face(stretch, partner)
        faces += face if isinstance(face, str) else [face]
        if face == DIRECTION:
            directions.append(direction)
    return stretch.high, stretch.low, faces, directions


def _face(stretch: AnyStretch, partner: int) -> tuple[Face, float]:
    """The face that keeps this pair apart over the whole stretch, and the direction if it is one."""
    if _strays(stretch):
        return _sides(stretch, partner), 0.0
    if stretch.within_circles(partner):
        return CIRCLES, 0.0
    margin = stretch.chain.margin
    for place, pose in zip((stretch.low, stretch.high), stretch.ends, strict=True):
        if pose.within(partner, margin):
            raise SweepOverlap(stretch.chain, *_met(stretch, partner), place)
    low, high = (pose.gaps(partner) for pose in stretch.ends)
    tries = [(max(ALL_FACES, key=lambda k: min(float(low[int(k)]), float(high[int(k)]))), 0.0)]
    if margin > 0:
        tries.append((DIRECTION, min(pose.nearest(partner) for pose in stretch.ends)[1]))
    for face, direction in tries:
        if stretch.apart(partner, face, direction):
            return face, direction
    raise _unshown("benches {a} and {b} are not shown to be apart", stretch, partner)


def _unshown(template: str, stretch: AnyStretch, partner: int) -> Unproven:
    return Unproven(template, a=stretch.bench, b=stretch.bench + partner)


def _met(stretch: AnyStretch, partner: int) -> tuple[int, int]:
    """The first two benches that come to the places of this pair, by 6."""
    first = stretch.bench + stretch.chain.count - stretch.last
    return first, first + partner


def _strays(stretch: AnyStretch) -> TypeGuard[SpiralStretch]:
    """Whether the stretch is one of grounds, because the claim is about strays."""
    return isinstance(stretch, SpiralStretch) and bool(stretch.chain.grounds)


def _sides(stretch: SpiralStretch, partner: int) -> list[int]:
    """The side, or the nine sides, that keep the grounds of this pair apart over the whole stretch."""
    grounds = stretch.grounds(partner)
    seen = [(complex(to), complex(axis)) for to, axis in (pose.seen(0, partner) for pose in stretch.ends)]
    for hulls in (AT_ONCE, ONE_BY_ONE):
        best = [best_side(*grounds, pair, seen) for pair in hulls]
        sides = [number for number, _ in best]
        if min(gap for _, gap in best) > 0.0 and stretch.grounds_apart(partner, sides):
            return sides
    for place, instant in zip((stretch.low, stretch.high), seen, strict=True):
        if min(best_side(*grounds, pair, [instant])[1] for pair in ONE_BY_ONE) <= 0.0:
            a, b = _met(stretch, partner)
            words = "not proven: with strays up to {stray} benches {a} and {b} may touch when handle {a} is at {place}"
            values = quantities("m", stray=float(stretch.chain.stray)) | {"place": stretch.chain.place_quantity(place)}
            raise ProofRefused.in_words("claim", words, a=a, b=b, **values)
    raise _unshown("benches {a} and {b} are not shown to stay apart", stretch, partner)


def _apart(stretch: AnyStretch, partner: int, face: Face, direction: float) -> bool:
    """Whether this face keeps a pair apart over the whole stretch."""
    if not isinstance(face, str):
        return _strays(stretch) and stretch.grounds_apart(partner, face)
    return stretch.within_circles(partner) if face == CIRCLES else stretch.apart(partner, face, direction)


def searched_stretches(chain: AnyChain) -> Source:
    """Stretches as wide as the balls can prove."""

    def source(bench: int, high: float, low: float, places: Sequence[float]) -> Iterator[tuple[AnyStretch, Tile]]:
        width = WIDTH_FIRST
        while high > low:
            start = max(low, high - width)
            try:
                stretch = stretch_of(chain, bench, start, high, chain.count - bisect_left(places, start))
                tile = _faces(stretch)
            except Unproven as why:
                width = (high - start) / 2
                if width < WIDTH_LEAST:
                    words = f"not proven where handle {{at}} is at {{place}}: {why.template}"
                    values = {"at": bench, "place": chain.place_quantity(high), **why.values}
                    raise ProofRefused.in_words("claim", words, **values) from None
                continue
            yield stretch, tile
            high, width = start, width * WIDTH_GROWTH

    return source


def recorded_stretches(chain: AnyChain, sweeps: Sequence[Any]) -> Source:
    """The stretches of a certificate, each verified as it stands."""

    def source(bench: int, high: float, low: float, places: Sequence[float]) -> Iterator[tuple[AnyStretch, Tile]]:
        if bench >= len(sweeps):
            raise malformed("sweeps", "is missing", field=Parameter(f"sweeps.{bench}"))
        if sweeps[bench]["bench"] != bench:
            words, other = "sweep {sweep} is of another bench: {bench}", sweeps[bench]["bench"]
            raise ProofRefused.in_words("sweeps", words, sweep=bench, bench=other)
        for k, (high, low, faces, *rest) in enumerate(sweeps[bench]["stretches"]):
            most = max(0, chain.count - bench - 2)
            if len(faces) > most:
                rule = "must have at most {most} faces, one for each bench behind"
                raise malformed(f"sweeps.{bench}.stretches.{k}.2", rule, len(faces), most=most)
            stretch = stretch_of(chain, bench, low, high, chain.count - bisect_left(places, low))
            while len(stretch.placed) < min(len(faces) + 2, chain.count - bench):
                stretch.grow()
            if not stretch.complete:
                raise Unproven(
                    "pairs are missing from [{high}, {low}] of bench {bench}", high=high, low=low, bench=bench
                )
            directions = iter(rest[0] if rest else ())
            for partner, face in enumerate(faces, 2):
                direction = next(directions) if face == DIRECTION else 0.0
                if not _apart(stretch, partner, face, direction):
                    words = "benches {a} and {b} are not apart by face {face} over [{high}, {low}]"
                    raise Unproven(words, a=bench, b=bench + partner, face=str(face), high=high, low=low)
            yield stretch, (high, low, faces, rest[0] if rest else [])

    return source


def proven_sweeps(
    chain: AnyChain, high: float, low: float, repeats_from: int, source: Source, progress: Progress, follows: bool
) -> list[dict[str, Any]]:
    """Sweeps that prove that nothing touches while the head goes from the place high on to low [rad], [m].

    repeats_from: u of 6.; source: makes or reads the proven stretches; follows: also prove that one or two benches,
        which have no pair, follow all the way (13.)
    raises: Unproven if the stretches leave a place uncovered
    """
    sweeps: list[dict[str, Any]] = []
    if (chain.count < 3 and not follows) or low >= high:
        return sweeps
    for bench in range(repeats_from + 1):
        places = [math.inf]
        if bench == repeats_from:
            places = chain.outermost(bench, high)
            high = places[-1]
        tiles: list[list[Any]] = []
        rears: list[tuple[float, float]] = []
        end = high
        for stretch, tile in source(bench, high, low, places):
            if stretch.high < end or (tiles and stretch.high > end) or not chain.floor < stretch.low < stretch.high:
                raise Unproven(
                    "the stretches of bench {bench} do not join at {end}", bench=bench, end=chain.place_quantity(end)
                )
            if not stretch.rising and len(places) > 1 and not stretch.rear[1] <= places[1]:
                raise Unproven("handle {handle} may turn back far outside", handle=bench + 1)
            tiles.append(list(tile) if tile[3] else list(tile[:3]))
            rears.append(stretch.rear)
            end = stretch.low
            progress((bench + min(1.0, (high - end) / (high - low))) / (repeats_from + 1))
        if not end <= low:
            values = {"end": chain.place_quantity(end), "low": chain.place_quantity(low)}
            raise Unproven("the sweep of bench {bench} ends at {end}, short of {low}", bench=bench, **values)
        sweeps.append({"bench": bench, "stretches": tiles})
        high, low = max(rear[1] for rear in rears), min(rear[0] for rear in rears)
    return sweeps
