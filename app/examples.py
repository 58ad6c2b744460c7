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
                "steps": 139,
                "clear_until": 412.47383768201473,
                "bound": 1.5787730552851817,
                "least_clearance": {"time": 409.83199150935167, "clearance": 0.000865234565106926, "benches": [0, 11]},
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
        answer={
            "pitch": 0.4503373930284276,
            "pitch_bracket": [0.4503373930253026, 0.4503373930284276],
            "limited_by": "graze",
            "benches": [0, 19],
            "head_radius": 4.5726032262560565,
            "other_feasible_intervals": [],
            "justified_by": "bound",
            "evaluations": 550,
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
    "/clearance": Example(
        query={"pitch": 0.55, "start": 409.5, "stop": 410.5, "step": 0.5},
        answer={
            "time": [409.5, 410.0, 410.5],
            "clearance": [0.001718769861873165, 0.0010864882361648898, 0.00440524173213222],
            "benches": [[0, 11], [0, 11], [0, 11]],
            "grazes": [{"time": 409.83199150935167, "clearance": 0.000865234565106926, "benches": [0, 11]}],
        },
    ),
    "/pitch-scan": Example(
        query={"benches": 4, "samples": 2},
        answer={
            "pitch": [0.225, 0.253125, 0.28125, 0.305859375, 0.33046875, 0.355078125, 0.3796875],
            "radius": [
                1.4216192722564407,
                1.4087056128460238,
                1.3958809507627425,
                1.3847532370600086,
                1.3737365868999227,
                1.362859361468651,
                1.3521577433224563,
            ],
            "pieces": [[0, 7]],
            "minimum_pitch": 0.28125,
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
        answer={
            "rows": [
                {
                    "quantity": "arc length of the spiral",
                    "unit": "m",
                    "source": "eq. 2",
                    "paper": 442.590256,
                    "ours": 442.5902564320173,
                    "difference": 4.3201731614317396e-07,
                    "reason": "The same, to the paper's six decimals.",
                    "evidence": [],
                },
                {
                    "quantity": "time of first contact",
                    "unit": "s",
                    "source": "figure 7",
                    "paper": 406.43,
                    "ours": 412.4738376821147,
                    "difference": 6.043837682114713,
                    "reason": "The paper's rule adds angles and calls 360 degrees a collision. Near an edge the sum nears 360 degrees without a contact: it passes 359.1 degrees at 406.43 s, where benches 0 and 9 are 4.3 mm apart. Rounding such a sum up to 360 gives the paper's time.",
                    "evidence": [
                        {"what": "largest angle sum at the paper's time", "value": 359.10177289683384, "unit": "deg"},
                        {
                            "what": "first time of an angle sum of 359.1 degrees",
                            "value": 406.42869536513456,
                            "unit": "s",
                        },
                        {
                            "what": "clearance at the paper's time, benches 0 and 9",
                            "value": 0.0043008190299901605,
                            "unit": "m",
                        },
                        {"what": "first time of an angle sum of 360 degrees", "value": 412.4738375104033, "unit": "s"},
                        {
                            "what": "the same with the corners of eq. 12 as printed, its wrong signs kept",
                            "value": 407.4142808882519,
                            "unit": "s",
                        },
                    ],
                },
                {
                    "quantity": "radius of the head at first contact",
                    "unit": "m",
                    "source": "section 3.3",
                    "paper": 2.883,
                    "ours": 2.288742638382155,
                    "difference": -0.5942573616178448,
                    "reason": "The paper's own numbers exclude each other: at its 406.43 s the head is at 2.509 m, and it passes 2.883 m at 394.91 s. No reading was found that gives the paper's number.",
                    "evidence": [
                        {"what": "radius of the head at the paper's time", "value": 2.5091305212111488, "unit": "m"},
                        {
                            "what": "time at which the head passes the paper's radius",
                            "value": 394.90882574035953,
                            "unit": "s",
                        },
                    ],
                },
                {
                    "quantity": "minimum pitch",
                    "unit": "m",
                    "source": "section 3.3",
                    "paper": 0.474924,
                    "ours": 0.4503373930284276,
                    "difference": -0.02458660697157239,
                    "reason": "The paper bisects the radius of first contact towards 4.5 m, but that radius jumps from 4.573 to 4.406 m at a pitch of 0.4503374 m: none gives 4.5 m, so the error that it drives to 1e-10 cannot vanish. At the paper's pitch the head gets to 3.846 m, well inside the circle. No reading was found that gives the paper's number.",
                    "evidence": [
                        {
                            "what": "pitch at which a bisection of the radius ends",
                            "value": 0.4503373930463568,
                            "unit": "m",
                        },
                        {"what": "radius of first contact just below it", "value": 4.57260645642985, "unit": "m"},
                        {"what": "radius of first contact just above it", "value": 4.40590926523223, "unit": "m"},
                        {
                            "what": "radius of first contact at the paper's pitch",
                            "value": 3.84584827371987,
                            "unit": "m",
                        },
                        {
                            "what": "largest pitch at which the pose on the circle alone touches",
                            "value": 0.42021689802408224,
                            "unit": "m",
                        },
                        {
                            "what": "the same with the pairs of the head only, as in eqs. 14-17",
                            "value": 0.417137597501278,
                            "unit": "m",
                        },
                    ],
                },
            ]
        },
    ),
}
