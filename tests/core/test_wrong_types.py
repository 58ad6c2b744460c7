"""Every public function of core refuses a value of a wrong type by the name of its parameter."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from typing import Any

import pytest

import core
from core import Dragon, InvalidValue, Spiral
from tests.support.public_calls import CALLS, COLUMN, DANCE, DRAGON, POSES, SPIRAL

# Parameters that a refusal calls by another name: as part of the whole, or by their columns.
WORDS = {
    core.Arc: dict.fromkeys(CALLS[core.Arc], "arc."),
    core.Area: {"name": "venue", "rings": "venue"},
    core.Clothoid: dict.fromkeys(CALLS[core.Clothoid], "clothoid."),
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
# Right values: None where it stands for a default, and the types that these parameters have.
ALLOWED = {
    ("nothing", name)
    for name in ("venue", "benches", "speed_limit", "start", "step", "stop", "entry_radius", "exit_radius", "ratio")
} | {("nothing", name) for name in ("start_heading", "end_heading", "gates", "figures")}
ALLOWED |= {("path", "path"), ("dragon", "dragon"), ("text", "name")}
# Parameters that refuse None although others of the same name take it.
NONE_REFUSED = {*((call, "start") for call in (core.Legs, core.Line, core.Route)), (core.Turn, "ratio")}
NONE_REFUSED |= {(core.quickest_turn, "ratio"), (core.quickest_turn, "speed_limit"), (core.turn_time, "speed_limit")}
NONE_REFUSED |= {(core.propose, "venue")}
NONE_REFUSED |= {(core.ClothoidTurn, "ratio"), (core.deepest_turn, "ratio"), (core.dubins_turn, "ratio")}


def words_of(call: Callable[..., Any]) -> str:
    return getattr(call, "__qualname__", str(call))


def refusal(call: Callable[..., Any], **arguments: Any) -> InvalidValue | None:
    try:
        call(**arguments)
    except InvalidValue as refused:
        return refused
    return None


@pytest.mark.parametrize("call", CALLS, ids=words_of)
def test_each_call_is_answered(call: Callable[..., Any]) -> None:
    call(**CALLS[call])


def test_every_public_function_is_called() -> None:
    functions = {vars(core)[name] for name in core.__all__ if callable(vars(core).get(name))}
    functions = {one for one in functions if not isinstance(one, type)}
    assert functions - set(CALLS) == set(), "add a short call of it to tests/support/public_calls.py"


@pytest.mark.parametrize("call", CALLS, ids=words_of)
def test_a_wrong_type_is_refused_by_name(call: Callable[..., Any]) -> None:
    for name, (kind, wrong) in product(CALLS[call], WRONG.items()):
        if (kind, name) in ALLOWED and (call, name) not in NONE_REFUSED:
            continue
        expected = WORDS.get(call, {}).get(name, name)
        refused = refusal(call, **{**CALLS[call], name: wrong})
        assert refused, f"this {kind} is taken as {name}"
        assert refused.field.startswith(expected)
        assert expected in refused.message


SUBJECTS = {"dance": "Dance", "dragon": "Dragon", "contact": "FirstContact", "minimum": "MinimumPitch"}
QUESTIONS = [call for call, good in CALLS.items() if next(iter(good)) in SUBJECTS and not isinstance(call, type)]
# Further arguments, and wrong subjects with their words in the message.
FURTHER: list[tuple[Any, ...]] = [(), (0.55,), (SPIRAL, 300.0), (None, None, None, None)]
WRONG_SUBJECTS = [(None, "None"), (0.55, "0.55"), (SPIRAL, "a Spiral"), (Dragon, "the class Dragon")]


@pytest.mark.parametrize("call", QUESTIONS, ids=words_of)
def test_a_wrong_subject_is_refused_by_name_whatever_arguments_follow(call: Callable[..., Any]) -> None:
    name = next(iter(CALLS[call]))
    for further, (wrong, in_words) in product(FURTHER, WRONG_SUBJECTS):
        with pytest.raises(InvalidValue) as refused:
            call(wrong, *further)
        assert refused.value.message == f"{name} must be a {SUBJECTS[name]}, got {in_words}"
        assert refused.value.field == name


@pytest.mark.parametrize(
    ("one", "several"),
    [
        ("bench_cues", "performance_cues"),
        ("check", "performance_check"),
        ("clearance_profile", "performance_clearance"),
        ("envelope", "performance_envelope"),
        ("first_contact", "first_encounter"),
        ("least_clearance", "performance_least_clearance"),
        ("quick_check", "performance_check"),
        ("tolerance", "performance_tolerance"),
        ("trajectory", "performance_trajectory"),
    ],
)
def test_a_performance_is_sent_to_the_question_about_several_dragons(one: str, several: str) -> None:
    assert callable(getattr(core, several))
    with pytest.raises(InvalidValue) as refused:
        getattr(core, one)(core.Performance([core.Part(DANCE)]), 0.55)
    assert refused.value.message == f"dance must be a Dance, got a Performance: for several dragons call {several}()"


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
