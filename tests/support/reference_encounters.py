"""The performances of tests/reference/encounters.json."""

from core import Arc, Dance, Dragon, Legs, Line, Part, Performance, Route, Spiral
from tests.support.reference import reference_cases

CASES = reference_cases("encounters")
KINDS = {"arc": Arc, "line": Line, "spiral": Spiral, "waypoints": Legs}


def path_of(kind, **rest):
    """A path or a piece of one."""
    if kind == "route":
        return Route([path_of(**piece) for piece in rest["pieces"]])
    return KINDS[kind](**rest)


def performance_of(case):
    return Performance(
        [
            Part(Dance(Dragon(**one["dragon"]), path_of(**one["path"]), one["head_speed"]), one["delay"])
            for one in case["dances"]
        ]
    )
