"""A short call of each public function and class of core, which tests of wrong types, budgets and displays share."""

import numpy as np

import core
from core import Area, Dragon, Line, Spiral, Venue

DRAGON, SPIRAL = Dragon(benches=5), Spiral()
SQUARE = Venue(Area("square", (((-30, -30), (30, -30), (30, 30), (-30, 30), (-30, -30)),)))
DANCE = core.Dance(DRAGON, SPIRAL)
POSES, COLUMN = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [2.0, 2.0]
CONTACT, PITCH = core.first_contact(DANCE), core.minimum_pitch(DRAGON)
PERFORMANCE = core.Performance([core.Part(DANCE), core.Part(core.Dance(DRAGON, core.Spiral(centre=(40.0, 0.0))))])
NEAR = core.Performance(
    [core.Part(DANCE), core.Part(core.Dance(DRAGON, core.Spiral(centre=(18.3, 0.0), rotation=3.0)))]
)
# The second one stands where the first one does.
ENCOUNTER = core.first_encounter(core.Performance([core.Part(DANCE), core.Part(core.Dance(DRAGON, SPIRAL))]), stop=9.0)
CUES = core.bench_cues(DANCE, [2], stop=9.0)[0]
# A valid call of each function; the names are those of its parameters.
CALLS = {
    core.bench_cues: {"dance": DANCE, "benches": [0], "reach": 8.0, "start": 0.0, "stop": 9.0},
    core.card_of: {"bench": CUES},
    core.crew: {"dance": DANCE, "needed": [2] * 5, "relief": core.Relief(1, 3.0), "start": 0.0, "stop": 9.0},
    core.bench_outlines: {"dragon": DRAGON, "handles": np.zeros((6, 2)) + np.arange(6)[:, None]},
    core.bench_poses: {"handles": np.zeros((3, 2)) + np.arange(3)[:, None]},
    core.check: {"dance": DANCE, "venue": SQUARE, "margin": 0.0, "speed_limit": 2.0, "stop": 9.0},
    core.clearance_profile: {"dance": DANCE, "times": [0.0]},
    core.contact_check: {"contact": CONTACT},
    core.contact_probability: {
        "dance": DANCE,
        "model": core.Wobble(),
        "samples": 1,
        "seed": 1,
        "start": 0.0,
        "stop": 9.0,
    },
    core.course: {"path": SPIRAL, "dragon": DRAGON},
    core.cross_check: {"poses": POSES, "lengths": COLUMN, "widths": COLUMN, "margin": 0.0},
    core.envelope: {"dance": DANCE, "start": 0.0, "stop": 9.0, "excess": 1e-3},
    core.encounter_check: {"encounter": ENCOUNTER},
    core.first_encounter: {"performance": PERFORMANCE, "margin": 0.0, "stray": 0.0, "start": 1.0, "stop": 9.0},
    core.first_contact: {"dance": DANCE, "margin": 0.0, "stray": 0.0, "start": 0.0, "stop": 9.0},
    core.first_excess: {"dance": DANCE, "speed_limit": 2.0, "start": 0.0, "stop": 9.0},
    core.highest_speed: {"dance": DANCE, "start": 0.0, "stop": 9.0},
    core.least_clearance: {"dance": DANCE, "start": 0.0, "stop": 9.0},
    core.maximum_head_speed: {"dance": DANCE, "speed_limit": 2.0, "start": 0.0, "stop": 9.0},
    core.minimum_pitch: {"dragon": DRAGON, "turning_radius": 4.5, "start_turns": 16.0, "dragons": 2},
    core.overlaps: {
        "poses": POSES,
        "lengths": COLUMN,
        "widths": COLUMN,
        "engine": core.Engine.FCL,
        "margin": 0.0,
    },
    core.performance_check: {"performance": PERFORMANCE, "margin": 0.0, "stray": 0.0, "speed_limit": 0.9, "stop": 9.0},
    core.performance_clearance: {"performance": PERFORMANCE, "times": [0.0, 9.0]},
    core.performance_cues: {
        "performance": PERFORMANCE,
        "dragon": 0,
        "benches": [0],
        "reach": 2.0,
        "start": 1.0,
        "stop": 9.0,
    },
    core.performance_envelope: {"performance": PERFORMANCE, "start": 1.0, "stop": 9.0, "excess": 0.01},
    core.performance_least_clearance: {"performance": PERFORMANCE, "stray": 0.0, "start": 1.0, "stop": 9.0},
    core.performance_tolerance: {"performance": NEAR, "start": 1.0, "stop": 9.0},
    core.performance_trajectory: {"performance": PERFORMANCE, "times": [0.0]},
    core.pitch_check: {"minimum": PITCH, "dragon": DRAGON, "margin": 0.0},
    core.pitch_scan: {"dragon": DRAGON, "pitches": [0.5, 0.6], "start_turns": 8.0, "margin": 0.0},
    core.propose: {
        "venue": SQUARE,
        "dragon": DRAGON,
        "gates": [core.Gate((-30.0, 0.0), 0.0)],
        "figures": ["ring"],
        "stray": 0.02,
        "margin": 0.0,
        "speed_limit": 2.0,
        "objective": "tolerance",
        "count": 1,
    },
    core.quick_check: {"dance": DANCE, "venue": SQUARE, "margin": 0.0, "speed_limit": 2.0, "stop": 9.0},
    core.safe_delay: {
        "performance": PERFORMANCE,
        "part": 1,
        "least": 0.0,
        "most": 9.0,
        "margin": 0.0,
        "stray": 0.0,
        "stop": 9.0,
    },
    core.separation: {"poses_a": POSES, "sizes_a": [2.0, 1.0], "poses_b": POSES, "sizes_b": [2.0, 1.0]},
    core.sharpest_bend: {"dance": DANCE, "start": 0.0, "stop": 9.0},
    core.shortest_turn: {"dragon": DRAGON, "pitch": 1.7, "turning_radius": 4.5, "ratio": 2.0, "margin": 0.0},
    core.deepest_turn: {"dragon": DRAGON, "pitch": 1.7, "turning_radius": 4.5, "ratio": 2.0, "margin": 0.0},
    core.dubins_turn: {"dragon": DRAGON, "pitch": 1.7, "turning_radius": 4.5, "ratio": 1.0, "margin": 0.0},
    core.quickest_turn: {"dragon": DRAGON, "pitch": 1.7, "turning_radius": 4.5, "ratio": 2.0, "speed_limit": 2.0},
    core.turn_length_bounds: {"dragon": DRAGON, "pitch": 1.7, "turning_radius": 4.5, "ratio": 2.0},
    core.turn_time: {"dragon": DRAGON, "path": core.Turn(1.7), "speed_limit": 2.0},
    core.tolerance: {"dance": DANCE, "start": 0.0, "stop": 9.0},
    core.tolerance_curve: {"dragon": DRAGON, "pitches": [0.9], "turning_radius": 4.5, "start_turns": 6.0},
    core.trajectory: {"dance": DANCE, "times": [0.0]},
    core.Turn: {"pitch": 1.7, "turning_radius": 4.5, "ratio": 2.0, "start_turns": 16.0, "entry_radius": 4.0},
    core.uncertain_tolerance: {"dragon": DRAGON, "pitch": 0.9, "length_error": 0.01, "pitch_error": 0.01},
    core.venue_clearance: {"dance": DANCE, "venue": SQUARE, "margin": 0.0, "stop": 9.0},
    core.verdicts: {"before": POSES, "after": POSES, "lengths": COLUMN, "widths": COLUMN, "margin": 0.0},
    core.Wobble: {name: getattr(core.Wobble(), name) for name in core.Wobble.__slots__},
    core.Arc: {"centre": (0, 0), "radius": 3.0, "start_angle": 0.0, "sweep": 1.0},
    core.Area: {"name": "square", "rings": SQUARE.square.rings},
    core.Clothoid: {
        "start": (0, 0),
        "heading": 0.0,
        "start_curvature": 0.0,
        "end_curvature": 0.3,
        "length": 2.0,
    },
    core.ClothoidTurn: {"pitch": 1.7, "turning_radius": 4.5, "ratio": 1.0, "middle": 2.0, "ends": 0.5},
    core.Coil: {"pitch": 0.5, "start_turns": 5.0, "end_turns": 3.0, "centre": (0, 0), "rotation": 0.0},
    core.Dance: {"dragon": DRAGON, "path": SPIRAL, "head_speed": 1.0},
    core.Dragon: {"benches": 5, "head_length": 3.0, "body_length": 2.0, "width": 0.3, "overhang": 0.2},
    core.Dragon.of: {"lengths": COLUMN, "widths": COLUMN, "overhangs": [0.2, 0.2]},
    core.Gate: {"point": (0.0, 0.0), "heading": 0.5},
    core.Legs: {"points": ((0, 0), (9, 0), (9, 9)), "straight": [0, 1], "radius": 4.0, "start": 1.0},
    core.Line: {"start": (0, 0), "end": (60, 0)},
    core.Route: {"pieces": [Line((0, 0), (60, 0))], "start": 0.0},
    core.Spiral: {"pitch": 0.55, "start_turns": 16.0},
    core.Venue: {"square": SQUARE.square, "obstacles": ()},
    core.Waypoints: {"points": ((0, 0), (5, 5)), "start_heading": 0.0, "end_heading": 0.0},
}
