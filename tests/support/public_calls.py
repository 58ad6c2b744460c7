"""A short call of each public function and class of core, which tests of wrong types, budgets and displays share."""

from functools import wraps
from inspect import isfunction, signature

import numpy as np

import core
from core import Area, Dragon, Line, Spiral, Venue
from core.old_names import NEW

DRAGON = Dragon(benches=5)
SPIRAL = Spiral()
SQUARE = Venue(Area("square", (((-30, -30), (30, -30), (30, 30), (-30, 30), (-30, -30)),)))
DANCE = core.Dance(DRAGON, SPIRAL)
POSES = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
COLUMN = [2.0, 2.0]
PERFORMANCE = core.Performance(
    [core.Part(DANCE), core.Part(core.Dance(DRAGON, core.Spiral(centre=(18.3, 0.0), rotation=3.0)))]
)
# The second one stands where the first one does.
ENCOUNTER = core.first_encounter(core.Performance([core.Part(DANCE), core.Part(core.Dance(DRAGON, SPIRAL))]), stop=9.0)
# What parameters of these names get.
COMMON = {
    "dance": DANCE,
    "dances": [DANCE],
    "performance": PERFORMANCE,
    "dragon": DRAGON,
    "path": SPIRAL,
    "venue": SQUARE,
    "times": [0.0],
    "start": 1.0,
    "stop": 9.0,
    "margin": 0.0,
    "stray": 0.0,
    "speed_limit": 2.0,
    "reach": 8.0,
    "excess": 0.01,
    "benches": [0],
    "pitch": 1.7,
    "turning_radius": 4.5,
    "ratio": 2.0,
    "start_turns": 16.0,
    "poses": POSES,
    "lengths": COLUMN,
    "widths": COLUMN,
    "centre": (0, 0),
    "rotation": 0.0,
    "heading": 0.5,
}
# What parameters of one call get, also of classes, which have a call only if they stand here.
OWN = {
    core.bench_outlines: {"handles": np.zeros((6, 2)) + np.arange(6)[:, None]},
    core.bench_poses: {"handles": np.zeros((3, 2)) + np.arange(3)[:, None]},
    core.bench_cues: {"dragon": 0},
    core.card_of: {"bench": core.bench_cues(DANCE, [2], stop=9.0)[0]},
    core.contact_check: {"contact": core.first_contact(DANCE)},
    core.contact_probability: {"model": core.Wobble(), "samples": 1, "seed": 1},
    core.crew: {"needed": [2] * 5, "relief": core.Relief(1, 3.0)},
    core.dubins_turn: {"ratio": 1.0},
    core.encounter_check: {"encounter": ENCOUNTER},
    core.minimum_pitch: {"dragons": 2},
    core.overlaps: {"engine": core.Engine.FCL},
    core.check: {"speed_limit": 0.9},
    core.pitch_check: {"minimum": core.minimum_pitch(DRAGON)},
    core.pitch_scan: {"pitches": [0.5, 0.6], "start_turns": 8.0},
    core.propose: {
        "gates": [core.Gate((-30.0, 0.0), 0.0)],
        "figures": ["ring"],
        "stray": 0.02,
        "margin": 0.0,
        "speed_limit": 2.0,
        "objective": "tolerance",
        "count": 1,
    },
    core.safe_delay: {"part": 1, "least": 0.0, "most": 9.0},
    core.stays: {"area": SQUARE.square},
    core.tail_reach: {"benches": 2},
    core.separation: {"poses_a": POSES, "sizes_a": [2.0, 1.0], "poses_b": POSES, "sizes_b": [2.0, 1.0]},
    core.tolerance_curve: {"pitches": [0.9], "start_turns": 6.0},
    core.turn_time: {"path": core.Turn(1.7)},
    core.uncertain_tolerance: {"pitch": 0.9, "length_error": 0.01, "pitch_error": 0.01},
    core.verdicts: {"before": POSES, "after": POSES},
    core.Wobble: {name: getattr(core.Wobble(), name) for name in core.Wobble.__slots__},
    core.Arc: {"radius": 3.0, "start_angle": 0.0, "sweep": 1.0},
    core.Area: {"name": "square", "rings": SQUARE.square.rings},
    core.Clothoid: {"start": (0, 0), "start_curvature": 0.0, "end_curvature": 0.3, "length": 2.0},
    core.ClothoidTurn: {"ratio": 1.0, "middle": 2.0, "ends": 0.5},
    core.Coil: {"pitch": 0.5, "start_turns": 5.0, "end_turns": 3.0},
    core.Dance: {"head_speed": 1.0},
    core.Dragon: {"benches": 5, "head_length": 3.0, "body_length": 2.0, "width": 0.3, "overhang": 0.2},
    core.Dragon.of: {"overhangs": [0.2, 0.2]},
    core.Gate: {"point": (0.0, 0.0)},
    core.Legs: {"points": ((0, 0), (9, 0), (9, 9)), "straight": [0, 1], "radius": 4.0},
    core.Line: {"start": (0, 0), "end": (60, 0)},
    core.Route: {"pieces": [Line((0, 0), (60, 0))]},
    core.Spiral: {"pitch": 0.55},
    core.Turn: {"entry_radius": 4.0},
    core.Venue: {"square": SQUARE.square, "obstacles": ()},
    core.Waypoints: {"points": ((0, 0), (5, 5)), "start_heading": 0.0, "end_heading": 0.0},
}
FUNCTIONS = [call for name in core.__all__ if isfunction(call := getattr(core, name))]


def arguments(call):
    """Valid arguments by the names of its parameters."""
    values = COMMON | OWN.get(call, {})
    names = [*signature(call).parameters, *OWN.get(call, {})]
    return {name: values[name] for name in names if name in values}


def of_several(call):
    """The same question, under a name of its own, to be asked of several dances."""

    @wraps(call)
    def asked(dance, *further, **query):
        return call(dance, *further, **query)

    asked.__qualname__ = asked.__name__ = f"{call.__name__}_of_several"
    return asked


CALLS = {call: arguments(call) for call in [*FUNCTIONS, *OWN]}
# Questions about a dance that take several too, but first_contact(), which is then first_encounter().
OF_SEVERAL = [of_several(getattr(core, name)) for name in (*NEW.values(), "quick_check")]
CALLS |= {call: CALLS[call.__wrapped__] | {"dance": PERFORMANCE} for call in OF_SEVERAL}
