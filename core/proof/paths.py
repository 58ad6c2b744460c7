"""Paths of a certificate: in writing, as objects of core, and in balls.

The numbers of a spiral and of the turn define them exactly: the turn's arcs are computed in balls. The pieces of a
route meet to within 1e-9 m and 1e-9 rad only, so the route of a proof is joined exactly: each piece keeps its shape and
is moved and rotated so that it continues the one before it in place and direction; a line that meets the line before it
at a corner keeps the angle between their directions. The first piece continues backwards
and the last one forwards.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import Any

from flint import acb, arb

from core.dragon import Dragon
from core.errors import InvalidValue
from core.language import Listed, counted, say
from core.paths import pieces
from core.paths.clothoid_turn import ClothoidTurn
from core.paths.route import JOINT_KINK, Route
from core.paths.spiral import Spiral
from core.paths.turn import Turn
from core.proof.chain import Chain
from core.proof.route import BallCoil, BallPath, Piece, RouteChain, turned
from core.proof.words import spiral_words
from core.quantities import Parameter, format_number

Record = Mapping[str, Any]

# The members of each kind of path and of piece, in words that InvalidValue and the check of members share.
TURN = ("pitch", "turning_radius", "ratio", "start_turns", "entry_radius")
FREE_TURN = (*TURN, "exit_radius")
PIECES: dict[str, tuple[type[pieces.Line | pieces.Arc | pieces.Coil], tuple[str, ...]]] = {
    "line": (pieces.Line, ("start", "end")),
    "arc": (pieces.Arc, ("centre", "radius", "start_angle", "sweep")),
    "coil": (pieces.Coil, ("pitch", "start_turns", "end_turns", "centre", "rotation")),
}
# Members that are points, [x, y].
POINTS = frozenset({"start", "end", "centre"})


def recorded_path(path: Spiral | Route) -> dict[str, Any]:
    """A path as a certificate writes it. raises: InvalidValue for clothoids and waypoints"""
    if path.spiral is not None:
        return {"kind": "spiral", "pitch": path.spiral.pitch, "start_turns": path.spiral.start_turns}
    path = path.as_route(path.end)
    if isinstance(path, Turn):  # its arcs are computed in balls from these numbers, not taken from its rounded pieces
        free = path.exit_radius != path.entry_radius
        names = (*(name for name in (FREE_TURN if free else TURN) if name != "start_turns"), "start_turns")
        return {"kind": "free_turn" if free else "turn"} | {name: getattr(path, name) for name in names}
    recorded = []
    for k, piece in enumerate(path.pieces):
        if not isinstance(piece, pieces.Line | pieces.Arc | pieces.Coil):
            piece_at = Parameter(f"path.pieces.{k}")
            rule = "{piece} must be a line, an arc or a coil for a proof in ball arithmetic"
            if len(path.pieces) == 1:
                rule = (
                    "path must be a spiral, a turn or a route of lines, arcs and coils for a proof in ball arithmetic"
                )
            elif isinstance(path, ClothoidTurn):
                rule = "path must be a turn of two arcs, without `middle` and `ends`, for a proof in ball arithmetic"
            why = "on such a path a dance is checked in double precision, with bounds on its rounding"
            raise InvalidValue.in_words(
                piece_at.name, rule, got=type(piece).__name__.lower(), reason=why, piece=piece_at
            )
        kind, names = next((kind, names) for kind, (made, names) in PIECES.items() if isinstance(piece, made))
        recorded.append({"kind": kind} | {name: _as_numbers(name, getattr(piece, name)) for name in names})
    return {"kind": "route", "start": path.start, "pieces": recorded}


def _as_numbers(name: str, value: Any) -> float | list[float]:
    return [float(part) for part in value] if name in POINTS else float(value)


def core_path(record: Record) -> Spiral | Route:
    """The path as an object of core. raises: InvalidValue"""
    if record["kind"] == "spiral":
        return Spiral(record["pitch"], record["start_turns"])
    if record["kind"] in ("turn", "free_turn"):
        try:
            return Turn(**{name: record[name] for name in FREE_TURN if name in record})
        except InvalidValue as error:  # Turn does not name the path around its fields
            raise error.with_field(f"path.{error.field}") from error
    parts = []
    for k, piece in enumerate(record["pieces"]):
        made, names = PIECES[piece["kind"]]
        values: dict[str, Any] = {name: tuple(piece[name]) if name in POINTS else piece[name] for name in names}
        try:
            parts.append(made(**values))
        except InvalidValue as error:  # a piece does not name the route around its fields
            raise error.with_field(".".join([f"path.pieces.{k}", *error.field.split(".")[1:]])) from error
    return Route(parts, record["start"])


def path_words(record: Record) -> str:
    """The path in words, with all its numbers except those of pieces."""
    if record["kind"] == "spiral":
        return spiral_words(record["pitch"], record["start_turns"])
    if record["kind"] in ("turn", "free_turn"):
        leaves = ""
        if "exit_radius" in record:
            leaves = say(" and leaves {radius} m from it", radius=format_number(record["exit_radius"]))
        ratio, entry, pitch, turns = (
            format_number(record[name]) for name in ("ratio", "entry_radius", "pitch", "start_turns")
        )
        return say(
            "the turn of ratio {ratio}, which it enters {entry} m from the centre at 0 s{leaves}, between spirals of "
            "pitch {pitch} m and {turns} turns",
            ratio=ratio, entry=entry, leaves=leaves, pitch=pitch, turns=turns,
        )  # fmt: skip
    return say(
        "the route of {pieces} ({kinds}), joined exactly, its s = 0 at {start} m from its beginning",
        pieces=counted(len(record["pieces"]), "{count} piece", "{count} pieces"),
        kinds=Listed(piece["kind"] for piece in record["pieces"]), start=format_number(record["start"]),
    )  # fmt: skip


def chain_on(dragon: Dragon, record: Record, margin: float) -> Chain | RouteChain:
    """The dragon on the path, in balls."""
    if record["kind"] == "spiral":
        return Chain(dragon, arb(record["pitch"]), record["start_turns"], margin)
    if record["kind"] in ("turn", "free_turn"):
        return RouteChain(dragon, _turn_path(record), margin)
    placed = [_piece(piece) for piece in record["pieces"]]
    for (before, _, rotation), (after, _, then) in pairwise(placed):
        if type(before) is type(after) is Piece and before.curvature == after.curvature == 0:
            turn = then / rotation
            after.turn = turn if abs(turn - 1) > JOINT_KINK else after.turn
    path = BallPath([piece for piece, _, _ in placed], (0, arb(record["start"])), *placed[0][1:])
    return RouteChain(dragon, path, margin)


# The arcs of a turn, as complex numbers (core/paths/turn.py): the place P(t) = growth t e^(it) of the coil inwards, its
# direction T = -e^(it) (1 + it) / sqrt(1 + t^2), its normal n = -i T. From C1 to the entry goes -n1, to the tangent
# point w = (C2 - C1) / (r1 + r2), so the clockwise angle on the first arc is arg(-n1 / w); from C2 to the tangent point
# goes -w, to the exit n2, so the other angle is arg(-n2 / w). Both are from 0 to 2 pi; refusing arcs of almost no
# length (core/paths/turn.py) keeps them from the ends of that range.
def _turn_path(record: Record) -> BallPath:
    growth, ratio, start = _growth(record), arb(record["ratio"]), _radians(record["start_turns"])
    inner = arb(record["entry_radius"]) / growth
    outer = arb(record["exit_radius"]) / growth if "exit_radius" in record else inner
    (entry, n1), (opposite, n2) = (_place_and_normal(growth, theta) for theta in (inner, outer))
    apart, both = entry + opposite, ratio * n1 + n2
    curved, level, squared = (1 + ratio) ** 2 - _squared(both), (apart * both.conjugate()).real, _squared(apart)
    root = (level**2 + curved * squared).sqrt()
    least = squared / (root - level) if level < 0 else (root + level) / curved
    towards = (-opposite - least * n2 - entry - ratio * least * n1) / ((1 + ratio) * least)
    arcs = [
        Piece(sign / radius, radius * _positive_angle(-normal / towards))
        for sign, radius, normal in ((-1, ratio * least, n1), (1, least, n2))
    ]
    coils = BallCoil.between(growth, start, inner), BallCoil.between(growth, -outer, -start)
    return BallPath((coils[0], *arcs, coils[1]), (1, arb(0)), acb(0), acb(1))


def _growth(record: Record) -> arb:
    return arb(record["pitch"]) / (2 * arb.pi())


def _radians(turns: float) -> arb:
    return 2 * arb.pi() * arb(turns)


def _place_and_normal(growth: arb, theta: arb) -> tuple[acb, acb]:
    """Place of the coil inwards [m], and the normal to the right of the direction of travel."""
    outwards = turned(theta)
    return growth * theta * outwards, acb(0, 1) * outwards * acb(1, theta) / (1 + theta**2).sqrt()


def _squared(z: acb) -> arb:
    return z.real**2 + z.imag**2


def _positive_angle(z: acb) -> arb:
    """Angle of a complex number, from 0 to 2 pi [rad]: pi more than that of -z, which is from -pi to pi."""
    return (-z).arg() + arb.pi()


def _piece(record: Record) -> tuple[Piece, acb, acb]:
    """A piece, and its given position: shift and rotation."""
    if record["kind"] == "line":
        start, end = (acb(*record[name]) for name in ("start", "end"))
        return Piece(arb(0), abs(end - start)), start, (end - start) / abs(end - start)
    centre = acb(*record["centre"])
    if record["kind"] == "arc":
        radius, sweep = arb(record["radius"]), arb(record["sweep"])
        sign = 1 if sweep > 0 else -1
        outwards = turned(arb(record["start_angle"]))
        return Piece(sign / radius, radius * abs(sweep)), centre + radius * outwards, acb(0, sign) * outwards
    first, last = _radians(record["start_turns"]), _radians(record["end_turns"])
    if record["end_turns"] > record["start_turns"]:
        first, last = -first, -last
    return BallCoil.between(_growth(record), first, last), centre, turned(arb(record["rotation"]))
