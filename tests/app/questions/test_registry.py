"""The questions: each stands in a file of its own, and its answer has the numbers of core."""

import math
from pathlib import Path

import pytest

import core
from app.questions import registry
from core import Arc, Area, Dance, Dragon, Part, Performance, Route, Spiral, Turn, Venue, Waypoints
from tests.support.asking import box, dance, json_like, line
from tests.support.near import assert_near

DRAGON = Dragon(20)
CLOSE = Dance(Dragon(40), Spiral(0.5, 8.0))
POINTS = [(0.0, 0.0), (20.0, 0.0), (21.0, 2.0), (0.0, 3.0)]
WINDING = [(0, 0), (30, 0), (36, 5), (30, 10), (24, 5), (24, -20)]
ODD = {"lengths": [3.41, 2.2, 2.0, 2.2, 1.9, 2.2] * 4, "widths": [0.3] * 24, "overhangs": [0.275] * 24}
ODD_DANCE = Dance(Dragon.of(*ODD.values()), Route([Waypoints(WINDING)]), 2.0)
EAST = [(0, 0), (30, 0)]
NORTH = [(15, -20), (15, 20)]
LATE = 16.0
TWO = {"dances": [dance(5, *EAST, name="east"), dance(5, *NORTH, delay=LATE)]}
RING = {"kind": "arc", "centre": [0, 0], "radius": 5, "start_angle": 0, "sweep": 7}
WOBBLE = {"lateral": 0.02, "forward": 0.005, "correlation_time": 4.0, "step": 0.5, "hole": 0.055, "pin": 0.05}
YARD = (0, 0, 24, 20)
# Its head folds on its circle: below some pitch only single ones are proven.
FOLDING = {"benches": 14, "head_length": 2.21, "body_length": 1.47, "width": 0.06, "overhang": 0.12}
PITCH = (
    "pitch pitch_bracket limited_by benches bench justified_by proven_from proven_up_to scan_step "
    "other_feasible_intervals"
)
# The first and the third cross in the middle of both.
PLACES = [(0.0, 0.0, 0.0), (9.0, 9.0, 0.0), (0.2, 0.1, math.pi / 2), (0.6, 1.3, 0.3)]


def two():
    ways = [Route([Waypoints(points)]) for points in (EAST, NORTH)]
    return Performance([Part(Dance(Dragon(5), ways[0]), name="east"), Part(Dance(Dragon(5), ways[1]), LATE)])


def venue(left, low, right, high):
    return Venue(Area("square", (((left, low), (right, low), (right, high), (left, high), (left, low)),)))


# A request, the same question to core, and the names of what both tell.
REQUESTS = {
    "clearance": (
        {"dragon": {"benches": 40}, "path": {"pitch": 0.5, "start_turns": 8}, "times": [10, 20.5]},
        lambda: core.clearance_profile(CLOSE, [10.0, 20.5]),
        "time clearance benches grazes",
    ),
    "clearance of several": (
        TWO | {"times": [24, 32, 40]},
        lambda: core.clearance_profile(two(), [24.0, 32.0, 40.0]),
        "time clearance dragons benches grazes",
    ),
    "collision-time": (
        {"dragon": ODD, "path": line(*WINDING), "head_speed": 2, "margin": 0.1, "stray": 0.02},
        lambda: core.first_contact(ODD_DANCE, margin=0.1, stray=0.02, start=ODD_DANCE.begin),
        "outcome time time_bracket benches gap point head end certificate.clear_until certificate.claim",
    ),
    "collision-time that does not come": (
        {"dragon": {"benches": 40}, "path": {"pitch": 1.7}},
        lambda: core.first_contact(Dance(Dragon(40), Spiral(1.7))),
        "outcome time benches end.reason end.time end.bench",
    ),
    "minimum-pitch": (
        {"dragon": {"benches": 30}, "stray": 0.02},
        lambda: core.minimum_pitch(Dragon(30), stray=0.02),
        PITCH,
    ),
    "minimum-pitch of a dragon that folds": (
        {"dragon": FOLDING, "turning_diameter": 1.7, "start_turns": 5},
        lambda: core.minimum_pitch(Dragon(**FOLDING), turning_radius=0.85, start_turns=5.0),
        PITCH,
    ),
    "encounter": (
        TWO | {"margin": 0.1, "hole": 0.06, "pin": 0.02},
        lambda: core.first_encounter(two(), margin=0.1, stray=0.02),
        (
            "outcome time time_bracket dragons benches heads gap margin point end "
            "certificate.method certificate.claim.time certificate.bound"
        ),
    ),
    "encounter that does not come": (
        TWO | {"start": 14, "stop": 20},
        lambda: core.first_encounter(two(), start=14.0, stop=20.0),
        "outcome time dragons heads end.reason end.time certificate.clear_until certificate.claim.start",
    ),
    "safe-delay": (
        TWO | {"margin": 0.2, "least": -60, "most": 60},
        lambda: core.safe_delay(two(), 1, -60.0, 60.0, margin=0.2),
        "part safe undecided least most margin marches",
    ),
    "check": (
        TWO | {"margin": 0.05, "speed_limit": 1.0},
        lambda: core.check(two(), margin=0.05, speed_limit=1.0),
        "start stop least_clearance",
    ),
    "course": (
        {"dragon": {"benches": 20}, "path": line(*POINTS)},
        lambda: core.course(Route([Waypoints(POINTS)]), DRAGON),
        "s length",
    ),
    "envelope": (
        {"dragon": {"benches": 3}, "path": {"kind": "route", "pieces": [RING], "start": 8}, "head_speed": 2, "stop": 3},
        lambda: core.envelope(Dance(Dragon(3), Route([Arc((0.0, 0.0), 5.0, 0.0, 7.0)], start=8.0), 2.0), stop=3.0),
        "excess area start stop certificate.cells certificate.claim",
    ),
    "maximum-head-speed": (
        {"dragon": {"benches": 20}, "speed_limit": 1.5},
        lambda: core.maximum_head_speed(Dance(DRAGON, Turn(1.7)), 1.5),
        "head_speed head_speed_bracket speed_ratio handles time",
    ),
    "turn-time": (
        {"dragon": {"benches": 20}, "path": {"kind": "turn", "exit_radius": 4.45}, "speed_limit": 1.5},
        lambda: core.turn_time(DRAGON, Turn(1.7, exit_radius=4.45), 1.5),
        "length head_speed time handles",
    ),
    "quickest-turn": (
        {"dragon": {"benches": 8}, "speed_limit": 1.5, "margin": 0.01},
        lambda: core.quickest_turn(Dragon(8), 1.7, speed_limit=1.5, margin=0.01),
        "length head_speed time handles turn.entry_radius turn.exit_radius",
    ),
    "shortest-turn": (
        {"dragon": {"benches": 14, "head_length": 1.6, "body_length": 1.6}, "pitch": 1.2}
        | {"margin": 0.1, "exit_opposite": True, "turning_diameter": 40, "start_turns": 50},
        lambda: core.deepest_turn(Dragon(14, 1.6, 1.6), 1.2, 20.0, margin=0.1, start_turns=50.0),
        "entry_bracket limited_by benches time evaluations turn.length",
    ),
    "tolerance": (
        {"dragon": {"benches": 12}, "path": {"pitch": 0.9, "start_turns": 9}, "stop": 20, "venue": box(-9, -9, 9, 9)},
        lambda: core.tolerance(Dance(Dragon(12), Spiral(0.9, 9.0)), stop=20.0, venue=venue(-9, -9, 9, 9)),
        "stray stray_bracket time benches limited_by certificate.claim",
    ),
    "tolerance of several": (
        TWO,
        lambda: core.tolerance(two()),
        "stray stray_bracket time dragons benches limited_by",
    ),
    "contact-probability": (
        {"dragon": {"benches": 20}, **WOBBLE, "samples": 60, "seed": 3, "start": 395, "stop": 405},
        lambda: core.contact_probability(
            Dance(DRAGON, Spiral()), core.Wobble(**WOBBLE), 60, 3, start=395.0, stop=405.0
        ),
        "probability contacts samples tolerance strayed step instants start stop method limits claim",
    ),
    "proposals": (
        {"venue": box(*YARD), "dragon": {"benches": 10}, "figures": ["ring"], "count": 1},
        lambda: core.propose(venue(*YARD), Dragon(10), figures=["ring"], count=1),
        "tried checked proposals.0.tolerance proposals.0.figure proposals.0.duration",
    ),
}


def part_of(value, name):
    """A value below another one, by its dotted name."""
    for step in name.split("."):
        value = value[int(step)] if step.isdigit() else value[step] if isinstance(value, dict) else getattr(value, step)
    return value


@pytest.mark.parametrize("question", REQUESTS)
def test_an_answer_has_the_numbers_of_core(ask, question):
    body, request, names = REQUESTS[question]
    got = ask(question.split()[0], body)
    known = request()
    got["turn"] = got  # Of a turn the answer holds the fields themselves.
    for name in names.split():
        assert part_of(got, name) == json_like(part_of(known, name)), name


def test_a_pitch_scan_has_the_first_contacts_of_core_and_the_jumps_if_they_are_located(ask):
    look, scan = (
        ask("pitch-scan", {"dragon": {"benches": 30}, "samples": 3, "locate": each}) for each in (False, True)
    )
    assert look["minimum_pitch"] == core.minimum_pitch(Dragon(30)).pitch
    heads = [core.first_contact(Dance(Dragon(30), Spiral(pitch, 16.0))).head for pitch in look["pitch"]]
    assert_near(look["radius"], [head.radius for head in heads if head], 1e-9)  # [m]
    assert (len(heads), look["jumps"], scan["pitch"], scan["radius"]) == (3, [], look["pitch"], look["radius"])
    assert scan["pieces"][-1][1] == 3
    assert len(scan["jumps"]) > 10


def test_neighbours_of_a_chain_are_no_overlap_and_the_engines_may_disagree(ask):
    """The numbers are those of the example in the description of the call."""
    benches = [{"x": x, "y": y, "heading": heading, "length": 2.0, "width": 0.3} for x, y, heading in PLACES]
    for chained, pairs in ((True, [[0, 2]]), (False, [[0, 2], [2, 3]])):
        got = ask("overlaps", {"benches": benches, "chained": chained})
        assert [one["benches"] for one in got["overlaps"]] == pairs
    # No corner lies inside the other bench, so the angle sum cannot see the first crossing.
    assert (got["cross_check"]["agree"], got["cross_check"]["engines"]["angle_sum"]) == (False, [[2, 3]])


def test_every_file_of_this_folder_has_its_question():
    files = {path.stem for path in Path(registry.__file__).parent.glob("*.py")} - {"__init__", "registry"}
    assert {question.answer.__module__.rpartition(".")[2] for question in registry.QUESTIONS.values()} == files
