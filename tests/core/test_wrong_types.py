"""Every public function of core refuses a value of a wrong type, or a number out of range, by its parameter's name."""

import math
from inspect import signature
from itertools import product

import pytest

import core
from core import BenchDragonError, Dragon, InvalidValue
from tests.support.public_calls import CALLS, DANCE, DRAGON, OF_SEVERAL, SPIRAL
from tests.support.refused import refused

# What a refusal writes before the name of a parameter, as part of the whole.
BEFORE = {
    core.Arc: "arc.",
    core.Clothoid: "clothoid.",
    core.Coil: "coil.",
    core.Dragon: "dragon.",
    core.Dragon.of: "dragon.",
    core.Gate: "gate.",
    core.Legs: "path.",
    core.Line: "line.",
    core.Route: "path.",
    core.Spiral: "path.",
    core.Waypoints: "waypoints.",
    core.Wobble: "model.",
    (core.pitch_scan, "start_turns"): "path.",
    (core.tolerance_curve, "start_turns"): "path.",
    (core.uncertain_tolerance, "pitch"): "path.",
}
# Parameters that a refusal calls by another name.
RENAMED = {(call, name): "venue" for call in (core.Area, core.Venue) for name in CALLS[call]}
RENAMED |= {(call, "poses"): "benches" for call in (core.cross_check, core.overlaps)}
RENAMED |= {(core.verdicts, name): "benches" for name in ("before", "after")}
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
# Right values: the types that these parameters have.
ALLOWED = {("path", "path"), ("dragon", "dragon"), ("text", "name")}
# Numbers that may be negative, and that may be zero; none may be infinite or huge.
SIGNED = "start least start_angle sweep heading start_curvature end_curvature rotation start_heading end_heading"
ZERO = "reach margin stray dragon length_error pitch_error lateral forward hole pin ends overhang end_turns"


def words_of(call):
    return getattr(call, "__qualname__", str(call))


def takes_none(call, name):
    """Whether a parameter may be None: by its annotation, or as one of the wishes for a proposal."""
    parameter = signature(call).parameters.get(name)
    return "None" in str(parameter.annotation) if parameter else name in ("gates", "figures", "speed_limit")


def name_of(call, name):
    """How a refusal's field begins."""
    return RENAMED.get((call, name), (BEFORE.get(call) or BEFORE.get((call, name), "")) + name)


@pytest.mark.parametrize("call", CALLS, ids=words_of)
def test_a_wrong_type_is_refused_by_name(call):
    for name, (kind, wrong) in product(CALLS[call], WRONG.items()):
        if (kind == "nothing" and takes_none(call, name)) or (kind, name) in ALLOWED:
            continue
        with pytest.raises(InvalidValue) as caught:
            call(**{**CALLS[call], name: wrong})
        assert caught.value.field.startswith(name_of(call, name)), f"{kind} as {name}"


@pytest.mark.parametrize("call", CALLS, ids=words_of)
def test_a_number_out_of_range_is_refused_by_name(call):
    for name, value in CALLS[call].items():
        if type(value) not in (int, float):
            continue
        signed = name in SIGNED.split() or (call, name) == (core.safe_delay, "stop")
        zero = signed or name in ZERO.split() or (call, name) in ((core.Coil, "start_turns"), (core.Legs, "radius"))
        for number in (math.nan, math.inf, 1e300, -1e300, *[-1e-3] * (not signed), *[0.0] * (not zero)):
            with pytest.raises(BenchDragonError) as caught:
                call(**{**CALLS[call], name: number})
            assert caught.value.field == name_of(call, name), f"{number} as {name}"


SUBJECTS = {"dance": "Dance", "dragon": "Dragon", "contact": "FirstContact", "minimum": "MinimumPitch"}
QUESTIONS = [call for call, good in CALLS.items() if next(iter(good)) in SUBJECTS and not isinstance(call, type)]
BOTH = [core.first_contact, core.stays, *OF_SEVERAL, *(call.__wrapped__ for call in OF_SEVERAL)]
# Further arguments, and wrong subjects.
FURTHER = [(), (0.55,), (SPIRAL, 300.0), (None, None, None, None)]


@pytest.mark.parametrize("call", QUESTIONS, ids=words_of)
def test_a_wrong_subject_is_refused_by_name_whatever_arguments_follow(call):
    name = next(iter(CALLS[call]))
    for further, wrong in product(FURTHER, [None, 0.55, SPIRAL, Dragon]):
        several = " or a FirstEncounter" if call is core.contact_check else " or a Performance" if call in BOTH else ""
        with refused(name, kinds=f"a {SUBJECTS[name]}{several}"):
            call(wrong, *further)


def test_a_right_dance_keeps_the_words_of_python():
    with pytest.raises(TypeError, match="takes 1 positional argument but 2 were given"):
        core.first_contact(DANCE, 0.55)
