"""The performances of tests/reference/encounters.json."""

from core import Arc, Dance, Dragon, Legs, Line, Part, Performance, Route, Spiral
from tests.support.reference import reference_cases

CASES = reference_cases("encounters")
PIECES = {"arc": Arc, "line": Line}


def path_of(path):
    kind, rest = path["kind"], {name: value for name, value in path.items() if name != "kind"}
    if kind == "spiral":
        return Spiral(**rest)
    if kind == "waypoints":
        return Legs(rest["points"], rest["straight"])
    pieces = [{name: value for name, value in piece.items() if name != "kind"} for piece in rest["pieces"]]
    return Route([PIECES[one["kind"]](**piece) for one, piece in zip(rest["pieces"], pieces, strict=True)])


def performance_of(case):
    return Performance(
        [
            Part(Dance(Dragon(**one["dragon"]), path_of(one["path"]), one["head_speed"]), one["delay"])
            for one in case["dances"]
        ]
    )
