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
    "POST /trajectory": Example(
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
    "GET /collision-time": Example(
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
    "GET /minimum-pitch": Example(
        query={"turning_diameter": 9},
        answer={
            "pitch": 0.45033739302729764,
            "pitch_bracket": [0.45033739302719766, 0.45033739302729764],
            "limited_by": "graze",
            "benches": [0, 19],
            "head_radius": 4.572603226254922,
            "other_feasible_intervals": [],
            "justified_by": "bound",
            "evaluations": 38,
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
    "GET /clearance": Example(
        query={"pitch": 0.55, "start": 409.5, "stop": 410.5, "step": 0.5},
        answer={
            "time": [409.5, 410.0, 410.5],
            "clearance": [0.001718769861873165, 0.0010864882361648898, 0.00440524173213222],
            "benches": [[0, 11], [0, 11], [0, 11]],
            "grazes": [{"time": 409.83199150935167, "clearance": 0.000865234565106926, "benches": [0, 11]}],
        },
    ),
    "GET /pitch-scan": Example(
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
    "POST /overlaps": Example(
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
                "left_out": [],
            },
        },
    ),
    "GET /paper": Example(
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
                            "what": "the same with eq. 12 as printed: w/2 cos theta of the wrong sign in all four y",
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
                    "ours": 0.45033739302729764,
                    "difference": -0.02458660697242815,
                    "reason": "The paper bisects the radius of first contact towards 4.5 m, but that radius jumps from 4.573 to 4.406 m at a pitch of 0.4503374 m: none gives 4.5 m, so the error that it drives to 1e-10 cannot vanish. At the paper's pitch the head gets to 3.846 m, well inside the circle. No reading was found that gives the paper's number.",
                    "evidence": [
                        {
                            "what": "pitch at which a bisection of the radius ends",
                            "value": 0.4503373930463568,
                            "unit": "m",
                        },
                        {"what": "radius of first contact just below it", "value": 4.572606454449852, "unit": "m"},
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
    "POST /clearance": Example(
        body={"path": {"kind": "turn", "pitch": 1.7}, "times": {"start": 13, "stop": 15, "step": 1}},
        answer={
            "time": [13.0, 14.0, 15.0],
            "clearance": [0.44638693737338364, 0.33439748383834, 0.3599655448858322],
            "benches": [[0, 15], [0, 16], [0, 18]],
            "grazes": [
                {"time": 13.329214078262213, "clearance": 0.36975484774939227, "benches": [0, 15]},
                {"time": 13.858789679988373, "clearance": 0.3223087236640937, "benches": [0, 16]},
                {"time": 14.427680397230917, "clearance": 0.33099422536113166, "benches": [0, 17]},
            ],
        },
    ),
    "GET /turn": Example(
        query={"pitch": 1.7, "turning_diameter": 9, "ratio": 2},
        answer={
            "pitch": 1.7,
            "turning_diameter": 9.0,
            "ratio": 2.0,
            "entry_radius": 4.5,
            "radii": [3.0054176677890356, 1.5027088338945178],
            "centres": [[-0.7600091166555296, -1.3057264263462565], [1.7359324901810944, 2.448401974553665]],
            "angles": [3.0214868419806518, 3.021486841980652],
            "entry": [-2.7118558637066594, -3.591077522761074],
            "tangent_point": [0.9039519545688863, 1.1970258409203582],
            "exit": [2.7118558637066594, 3.591077522761074],
            "length": 13.621244906821124,
        },
    ),
    "GET /shortest-turn": Example(
        query={"pitch": 1.7, "turning_diameter": 9, "ratio": 1, "margin": 0.2},
        answer={
            "pitch": 1.7,
            "turning_diameter": 9.0,
            "ratio": 1.0,
            "entry_radius": 3.6560271231830135,
            "radii": [1.8330124713590636, 1.8330124713590636],
            "centres": [[0.959111179033588, 1.5620628881100351], [-0.959111179033588, -1.5620628881100351]],
            "angles": [2.9938524541912224, 2.993852454191222],
            "entry": [2.1377148985070997, 2.9659247020365576],
            "tangent_point": [0.0, 0.0],
            "exit": [-2.1377148985070997, -2.9659247020365576],
            "length": 10.9755377718829,
            "entry_bracket": [3.6560271225124614, 3.6560271231830135],
            "limited_by": "contact",
            "benches": [0, 13],
            "time": 25.054604428503456,
            "scan_step": 0.045,
            "evaluations": 46,
        },
    ),
    "GET /maximum-head-speed": Example(
        query={"pitch": 1.7, "turning_diameter": 9, "ratio": 2, "speed_limit": 2},
        answer={
            "head_speed": 1.2462663581574853,
            "head_speed_bracket": [1.2462430630737953, 1.2462663581574853],
            "speed_ratio": 1.6047933789666402,
            "handles": [3, 4, 5, 6, 7],
            "time": 11.618679669023782,
            "time_at_unit_head_speed": 14.479969597712685,
        },
    ),
    "POST /check": Example(
        body={
            "dragon": {"benches": 12},
            "path": {
                "kind": "route",
                "pieces": [
                    {"kind": "line", "start": [0, 0], "end": [30, 0]},
                    {
                        "kind": "arc",
                        "centre": [30, 5],
                        "radius": 5,
                        "start_angle": -1.5707963267948966,
                        "sweep": 3.141592653589793,
                    },
                    {"kind": "line", "start": [30, 10], "end": [0, 10]},
                ],
                "start": 0,
            },
            "venue": {
                "type": "FeatureCollection",
                "features": [
                    {
                        "type": "Feature",
                        "properties": {"name": "square"},
                        "geometry": {
                            "type": "Polygon",
                            "coordinates": [[[-2, -3], [37, -3], [37, 13], [-2, 13], [-2, -3]]],
                        },
                    },
                    {
                        "type": "Feature",
                        "properties": {"name": "well"},
                        "geometry": {
                            "type": "Polygon",
                            "coordinates": [[[20, 9], [21, 9], [21, 9.8], [20, 9.8], [20, 9]]],
                        },
                    },
                ],
            },
            "margin": 0.5,
            "speed_limit": 1.2,
            "head_speed": 1,
        },
        answer={
            "passed": False,
            "failures": [
                {
                    "kind": "venue",
                    "time": 53.935469549395705,
                    "benches": [0],
                    "area": "well",
                    "message": "Bench 0 comes within 0.5 m of 'well' at 53.935470 s.",
                }
            ],
            "start": 21.010000013018747,
            "stop": 75.70796326794897,
            "first_contact": {
                "outcome": "clear",
                "time": None,
                "time_bracket": None,
                "head": None,
                "benches": None,
                "corner": None,
                "edge": None,
                "point": None,
                "end": {"reason": "end", "time": 75.70796326794897},
                "certificate": {
                    "method": "proven steps: second-derivative bound on the gap along a body axis between both ends of each step; closed-form ring bound further out",
                    "steps": 38,
                    "clear_until": 75.70796326794897,
                    "bound": 4.294473499278129,
                    "least_clearance": {"time": 36.44336400533787, "clearance": 1.0289277260467204, "benches": [0, 2]},
                },
                "cross_check": None,
            },
            "least_clearance": {
                "distance": 1.0289277260467162,
                "at_least": 1.0289177260467162,
                "time": 36.40403757578354,
                "benches": [0, 2],
            },
            "venue": {
                "stray": None,
                "areas": [
                    {
                        "name": "square",
                        "outcome": "clear",
                        "time": None,
                        "time_bracket": None,
                        "bench": None,
                        "point": None,
                        "nearest": {
                            "distance": 1.7250000000000003,
                            "at_least": 1.7249900000000002,
                            "time": 75.70796326794897,
                            "bench": 0,
                            "point": [-0.2749999999999997, 10.0],
                            "wall": [-2.0, 10.0],
                        },
                    },
                    {
                        "name": "well",
                        "outcome": "contact",
                        "time": 53.935469549395705,
                        "time_bracket": [53.9354695492957, 53.93546954949571],
                        "bench": 0,
                        "point": [21.497493718553265, 9.85],
                        "nearest": {
                            "distance": 0.04999999999999907,
                            "at_least": 0.04998999999999907,
                            "time": 57.29296326795023,
                            "bench": 1,
                            "point": [21.0, 9.85],
                            "wall": [21.0, 9.8],
                        },
                    },
                ],
            },
            "highest_speed": {
                "speed": 1.0253742302121582,
                "speed_bracket": [1.0253742302121582, 1.025404225834663],
                "time": 46.65053743846384,
                "handles": [1, 2, 3, 4, 5, 6, 7, 8, 9],
            },
            "sharpest_bend": {"angle": 0.45580786839882254, "time": 34.558077340717674, "benches": [0, 1]},
        },
    ),
}
