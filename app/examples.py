# ruff: noqa: E501
"""A request and its true answer for each call, shown in the documentation; a test asks the service for each."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any


@dataclass(frozen=True, slots=True)
class Example:
    """A call with these query parameters and this body gives this answer."""

    answer: Any
    query: dict[str, float] = field(default_factory=dict)
    body: Any = None


EXAMPLES = {
    "/trajectory": Example(
        body={
            "dragon": {"benches": 2},
            "path": {"kind": "spiral", "pitch": 0.55, "start_turns": 16},
            "head_speed": 1.0,
            "times": {"start": 0, "stop": 2, "step": 1},
            "decimals": 6,
        },
        answer={
            "time": [0.0, 1.0, 2.0],
            "x": [[8.8, 8.363824, 7.706854], [8.733296, 8.620109, 8.138361], [8.553813, 8.765438, 8.465288]],
            "y": [[0.0, 2.826544, 4.340113], [-0.997233, 1.860526, 3.438632], [-1.980445, 0.871714, 2.494185]],
            "speed": [[1.0, 0.999971, 0.999966], [1.0, 0.999971, 0.999965], [1.0, 0.999971, 0.999965]],
        },
    ),
    "/collision-time": Example(
        query={"pitch": 0.55},
        answer={
            "outcome": "contact",
            "time": 412.4738376821147,
            "time_bracket": [412.47383768201473, 412.4738376822147],
            "head": {
                "theta": 26.146534758905815,
                "radius": 2.288742638382155,
                "x": 1.2099310244781307,
                "y": 1.942784028335062,
            },
            "benches": [0, 8],
            "corner": {"bench": 0, "name": "front-outer"},
            "edge": {"bench": 8, "name": "inner"},
            "point": [1.4743946716476781, 2.1106648769324554],
            "end": None,
            "certificate": {
                "method": "proven steps: second-derivative bound on the gap along a body axis between both ends of each step; closed-form ring bound further out",
                "steps": 230,
                "clear_until": 412.47383768201473,
                "bound": 4.217787017678421,
                "least_clearance": {"time": 409.83199164421956, "clearance": 0.0008652345651060378, "benches": [0, 11]},
            },
            "cross_check": {
                "agree": True,
                "engines": {
                    "separating_axis": {"before": False, "after": True},
                    "fcl": {"before": False, "after": True},
                    "shapely": {"before": False, "after": True},
                    "angle_sum": {"before": False, "after": True},
                },
            },
        },
    ),
    "/minimum-pitch": Example(
        query={"turning_diameter": 9},
        answer={},
    ),
    "/clearance": Example(
        query={"pitch": 0.55, "start": 412, "stop": 413, "step": 0.5},
        answer={
            "time": [412.0, 412.5, 413.0],
            "clearance": [0.014576568210224045, -0.0006820821788808829, -0.01116526370760984],
            "benches": [[0, 8], [0, 8], [0, 8]],
        },
    ),
    "/overlaps": Example(
        body={
            "benches": [
                {"x": 0.0, "y": 0.0, "heading": 0.0, "length": 2.2, "width": 0.3},
                {"x": 1.0, "y": 0.5, "heading": 1.5707963267948966, "length": 2.2, "width": 0.3},
            ],
            "margin": 0.0,
            "chained": False,
        },
        answer={
            "overlaps": [
                {
                    "benches": [0, 1],
                    "separation": -0.2500000000000001,
                    "witness_a": [1.1, 0.0],
                    "witness_b": [0.85, 0.0],
                    "normal": [1.0, 0.0],
                }
            ],
            "cross_check": {
                "agree": True,
                "engines": {"separating_axis": [[0, 1]], "fcl": [[0, 1]], "shapely": [[0, 1]], "angle_sum": [[0, 1]]},
            },
        },
    ),
    "/paper": Example(
        answer={},
    ),
}
