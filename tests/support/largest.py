"""A request of each call at about the largest input that the service allows."""

from tests.support.asking import box, line

UNEVEN = {"lengths": [2.2 + 0.001 * (k % 97) for k in range(2000)], "widths": [0.3] * 2000, "overhangs": [0.275] * 2000}
COIL = {"kind": "spiral", "pitch": 1.1, "start_turns": 100}
ON_COIL = {"dragon": UNEVEN, "path": COIL, "stray": 0.05}
IN_TURN = {"dragon": UNEVEN, "path": {"kind": "turn"}}
THIN = {"benches": 6308, "head_length": 0.001, "body_length": 0.001, "overhang": 0}
WIDE = {"benches": 2000, "pitch": 10, "start_turns": 200}
WIDE_TURN = WIDE | {"turning_diameter": 200}
CROSSING = {
    "dances": [
        {"dragon": {"benches": 2000}, "path": line((0, 0), (9000, 0))},
        {"dragon": {"benches": 2000}, "path": line((4000, -4500), (4000, 5000))},
    ]
}
PARADES = {
    "dances": [
        {"dragon": {"benches": 50}, "path": line((0, 3 * k), (400, 3 * k + 1)), "delay": 0.5 * k} for k in range(200)
    ]
}
PLACES = [
    {"x": 2.0 * (k % 140), "y": 0.7 * (k // 140), "heading": 0.1, "length": 2.2, "width": 0.3} for k in range(20_000)
]
# A request of each call.
LARGEST = {
    "trajectory": PARADES | {"times": {"start": 0, "stop": 400, "step": 5}},
    "collision_time": THIN,
    "collision_time_of": ON_COIL,
    "encounter": PARADES,
    "safe_delay": CROSSING,
    "minimum_pitch": THIN,
    "pitch_scan": THIN,
    "pitch_scan_of": {"dragon": UNEVEN},
    "minimum_pitch_of": {"dragon": UNEVEN},
    "clearance": WIDE,
    "clearance_of": IN_TURN,
    "turn": {"pitch": 10},
    "turn_of": {"path": {"kind": "turn", "pitch": 10}},
    "shortest_turn": WIDE_TURN,
    "shortest_turn_of": {"dragon": UNEVEN, "pitch": 10, "turning_diameter": 200},
    "turn_time": WIDE_TURN,
    "turn_time_of": IN_TURN,
    "quickest_turn": WIDE_TURN,
    "quickest_turn_of": {"dragon": UNEVEN, "pitch": 10, "turning_diameter": 200},
    "maximum_head_speed": {"head_length": 1.001},
    "maximum_head_speed_of": IN_TURN,
    "check": PARADES,
    "proposals": {"venue": box(-2000, -2000, 2000, 2000), "dragon": {"benches": 2000}},
    "course": ON_COIL,
    "envelope": IN_TURN,
    "tolerance": WIDE,
    "tolerance_of": CROSSING,
    "tolerance_curve": {"head_length": 1.001},
    "tolerance_curve_of": {"dragon": UNEVEN},
    "contact_probability": IN_TURN,
    "overlaps": {"benches": PLACES},
    "paper": {},
    "trajectory_figure": {"benches": 5000},
    "trajectory_figure_of": PARADES,
    "contact_figure": {"benches": 5000},
    "contact_figure_of": CROSSING,
    "encounter_figure": PARADES,
    "pitch_scan_figure": {"head_length": 1.001},
    "pitch_scan_figure_of": {"dragon": UNEVEN},
    "films": {"dragon": {"benches": 500}, "path": COIL, "seconds": 60},
    "maps": IN_TURN,
    "plan": CROSSING,
    "safety_sheet": IN_TURN,
    "cues": {"dragon": {"benches": 2000}, "path": COIL, "last_bench": 999, "reach": 1000, "stop": 1000},
    "crew": ON_COIL,
    "contest_answer": {"question": 4, "further": True},
    "class_table": {
        "files": [
            {
                "team": f"{k}",
                "file": "result1.xlsx",
                "verdict": "wrong",
                "unusual": [f"x {(k % 2 * 20 + i) % 60} s 1: 1.234567" for i in range(40)],
            }
            for k in range(2_000)
        ]
    },
    "contest_kit": {},
}
