"""Every public function of core refuses a value of a wrong type by the name of its parameter."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import numpy as np
import pytest

import core
from core import Area, Dragon, InvalidValue, Line, Spiral, Venue

DRAGON, SPIRAL = Dragon(benches=5), Spiral()
SQUARE = Venue(Area("square", (((-30, -30), (30, -30), (30, 30), (-30, 30), (-30, -30)),)))
DANCE = core.Dance(DRAGON, SPIRAL)
POSES, COLUMN = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [2.0, 2.0]
CONTACT, PITCH = core.first_contact(DANCE), core.minimum_pitch(DRAGON)
# A valid call of each function; the names are those of its parameters.
CALLS: dict[Callable[..., Any], dict[str, Any]] = {
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
    core.first_contact: {"dance": DANCE, "margin": 0.0, "stray": 0.0, "start": 0.0, "stop": 9.0},
    core.first_excess: {"dance": DANCE, "speed_limit": 2.0, "start": 0.0, "stop": 9.0},
    core.highest_speed: {"dance": DANCE, "start": 0.0, "stop": 9.0},
    core.least_clearance: {"dance": DANCE, "start": 0.0, "stop": 9.0},
    core.maximum_head_speed: {"dance": DANCE, "speed_limit": 2.0, "start": 0.0, "stop": 9.0},
    core.minimum_pitch: {"dragon": DRAGON, "turning_radius": 4.5, "start_turns": 16.0, "margin": 0.0},
    core.overlaps: {
        "poses": POSES,
        "lengths": COLUMN,
        "widths": COLUMN,
        "engine": core.Engine.FCL,
        "margin": 0.0,
    },
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
# Parameters that a refusal calls by another name: as part of the whole, or by their columns.
SPOKEN = {
    core.Arc: dict.fromkeys(CALLS[core.Arc], "arc."),
    core.Area: {"name": "venue", "rings": "venue"},
    core.Coil: dict.fromkeys(CALLS[core.Coil], "coil."),
    core.Dragon: dict.fromkeys(CALLS[core.Dragon], "dragon."),
    core.Dragon.of: dict.fromkeys(CALLS[core.Dragon.of], "dragon."),
    core.Gate: dict.fromkeys(CALLS[core.Gate], "gate."),
    core.Legs: dict.fromkeys(CALLS[core.Legs], "path."),
    core.Line: dict.fromkeys(CALLS[core.Line], "line."),
    core.Route: {"pieces": "path.pieces", "start": "path.start"},
    core.Spiral: {"pitch": "path.pitch", "start_turns": "path.start_turns"},
    core.Venue: {"square": "venue", "obstacles": "venue"},
    core.Waypoints: dict.fromkeys(CALLS[core.Waypoints], "waypoints."),
    core.Wobble: dict.fromkeys(CALLS[core.Wobble], "model."),
    core.cross_check: {"poses": "benches"},
    core.overlaps: {"poses": "benches"},
    core.pitch_scan: {"start_turns": "path.start_turns"},
    core.tolerance_curve: {"start_turns": "path.start_turns"},
    core.uncertain_tolerance: {"pitch": "path.pitch"},
    core.verdicts: {"before": "benches", "after": "benches"},
}
WRONG = {
    "nothing": None,
    "number": 0.55j,
    "text": "0.55",
    "class": Dragon,
    "function": core.trajectory,
    "mapping": {"pitch": 0.55},
    "path": SPIRAL,
    "dragon": DRAGON,
    "ragged": [[1.0], [1.0, 2.0]],
}
# None stands for a default there, and these are right there.
ALLOWED = {
    ("nothing", name)
    for name in ("venue", "speed_limit", "start", "step", "stop", "entry_radius", "exit_radius", "ratio")
} | {("nothing", name) for name in ("start_heading", "end_heading", "gates", "figures")}
ALLOWED |= {("path", "path"), ("dragon", "dragon"), ("text", "name")}


# Places where nothing is refused although it is taken elsewhere.
SPELLED = {*((call, "start") for call in (core.Legs, core.Line, core.Route)), (core.Turn, "ratio")}
SPELLED |= {(core.quickest_turn, "ratio"), (core.quickest_turn, "speed_limit"), (core.turn_time, "speed_limit")}
SPELLED |= {(core.propose, "venue")}
SPELLED |= {(core.deepest_turn, "ratio"), (core.dubins_turn, "ratio")}


def spoken(call: Callable[..., Any]) -> str:
    return getattr(call, "__qualname__", str(call))


def refusal(call: Callable[..., Any], **given: Any) -> InvalidValue | None:
    try:
        call(**given)
    except InvalidValue as refused:
        return refused
    return None


@pytest.mark.parametrize("call", CALLS, ids=spoken)
def test_the_good_call_is_good(call: Callable[..., Any]) -> None:
    call(**CALLS[call])


def test_every_public_function_is_called() -> None:
    functions = {vars(core)[name] for name in core.__all__ if callable(vars(core).get(name))}
    functions = {one for one in functions if not isinstance(one, type)}
    assert functions - set(CALLS) == set()


@pytest.mark.parametrize("call", CALLS, ids=spoken)
def test_a_wrong_type_is_refused_by_name(call: Callable[..., Any]) -> None:
    for name, (kind, wrong) in product(CALLS[call], WRONG.items()):
        if (kind, name) in ALLOWED and (call, name) not in SPELLED:
            continue
        expected = SPOKEN.get(call, {}).get(name, name)
        refused = refusal(call, **{**CALLS[call], name: wrong})
        assert refused, f"this {kind} is taken as {name}"
        assert refused.field.startswith(expected)
        assert expected in refused.message


SUBJECTS = {"dance": "Dance", "dragon": "Dragon", "contact": "FirstContact", "minimum": "MinimumPitch"}
QUESTIONS = [call for call, good in CALLS.items() if next(iter(good)) in SUBJECTS and not isinstance(call, type)]


BEHIND: list[tuple[Any, ...]] = [(), (0.55,), (SPIRAL, 300.0), (None, None, None, None)]
SAID = [(None, "None"), (0.55, "0.55"), (SPIRAL, "a Spiral"), (Dragon, "the class Dragon")]


@pytest.mark.parametrize("call", QUESTIONS, ids=spoken)
def test_what_a_question_is_asked_of_is_refused_by_name_whatever_stands_behind_it(call: Callable[..., Any]) -> None:
    name = next(iter(CALLS[call]))
    for behind, (wrong, given) in product(BEHIND, SAID):
        with pytest.raises(InvalidValue) as refused:
            call(wrong, *behind)
        assert refused.value.message == f"{name} must be a {SUBJECTS[name]}, got {given}"
        assert refused.value.field == name


def test_a_dragon_is_not_taken_for_a_dance_and_a_right_dance_keeps_the_words_of_python() -> None:
    with pytest.raises(InvalidValue, match=r"^dance must be a Dance, got a Dragon$"):
        core.first_contact(DRAGON, 0.55)  # type: ignore[arg-type, call-arg]
    with pytest.raises(TypeError, match="takes 1 positional argument but 2 were given"):
        core.first_contact(DANCE, 0.55)  # type: ignore[call-arg]
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'dance'"):
        core.first_contact()  # type: ignore[call-arg]


@pytest.mark.parametrize("path", [0.55, None, Spiral, "spiral", DRAGON])
def test_an_invalid_path_says_what_it_must_be(path: Any) -> None:
    with pytest.raises(InvalidValue, match=r"^path must be a Spiral or a Route, got "):
        core.first_contact(core.Dance(DRAGON, path))


@pytest.mark.parametrize("engine", ["sat", None, 3])
def test_an_unknown_engine_is_refused(engine: Any) -> None:
    with pytest.raises(InvalidValue, match=r"^engine must be one of separating_axis, fcl, shapely, angle_sum, got "):
        core.overlaps(POSES, COLUMN, COLUMN, engine=engine)


@pytest.mark.parametrize("times", [["1"], [None], None, [True], "1", [[0.0]], [0j], [[0.0], [1.0, 2.0]]])
def test_times_are_numbers_and_never_read_from_something_else(times: Any) -> None:
    with pytest.raises(InvalidValue, match=r"^times must be "):
        core.trajectory(core.Dance(DRAGON, SPIRAL), times)


def test_a_message_names_the_type_of_a_wrong_object_and_shows_a_plain_value() -> None:
    with pytest.raises(InvalidValue, match=r"^dragon must be a Dragon, got a Dance$"):
        core.minimum_pitch(DANCE)  # type: ignore[arg-type]
    with pytest.raises(InvalidValue, match=r"^path must be a Spiral or a Route, got 0\.55$"):
        core.Dance(DRAGON, 0.55)  # type: ignore[arg-type]
