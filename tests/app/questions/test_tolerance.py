"""Tolerance over HTTP and from a terminal: core's answers on a circle, with errors of sizes, and of several dances."""

import pytest

import core
from app.questions.tolerance import ToleranceRequest
from app.settings import Settings
from core import Dragon, tolerance
from tests.support.asking import dance, json_like

SMALL = {"benches": 40, "start_turns": 9}
DANCES = [dance(4, (0, 0), (30, 0), name="a"), dance(4, (30, 0.8), (0, 0.8), name="b")]
SEVERAL = {"dances": DANCES}


def test_sizes_may_be_known_only_to_within_an_error(ask):
    errors = {"length_error": 0.01, "pitch_error": 0.005}
    got = ask("tolerance", **SMALL, **errors, pitch=0.7)
    assert got["stray_with_errors"] == core.uncertain_tolerance(Dragon(40), 0.7, **errors)
    assert 0.0 < got["stray_with_errors"] < got["stray"]
    spiral = {"kind": "spiral", "pitch": 0.7, "start_turns": 9}
    assert ask("tolerance", {"dragon": {"benches": 40}, "path": spiral, "turning_diameter": 9} | errors) == got
    assert ask("tolerance", **SMALL, pitch=0.7) == got | {"stray_with_errors": None}


def test_a_curve_is_answered_where_a_dance_at_the_minimum_pitch_begins_on_the_circle(ask):
    got = ask("tolerance-curve", benches=2, start_turns=9, samples=2)
    assert got["pitch"][0] == pytest.approx(0.5, rel=1e-5)
    assert got["limited_by"] == ["chord", "chord"]


@pytest.mark.parametrize("call", ["collision-time", "minimum-pitch"])
def test_an_answer_says_which_stray_it_allows_for_and_0_gives_the_same_bytes(ask, call):
    assert ask(call, **SMALL, stray=0.01, hole=0.05, pin=0.04) == ask(call, **SMALL, stray=0.015)
    assert ask.file(call, stray=0, hole=0, pin=0) == ask.file(call)


# -- several dances ------------------------------------------------------------------------------------------


def test_several_dances_have_the_tolerance_of_each_and_of_all(ask):
    got = ask("tolerance", SEVERAL)
    performance, _ = ToleranceRequest.model_validate(SEVERAL).to_placed(Settings())
    result = tolerance(performance)
    assert got["names"] == ["a", "b"]
    assert got["own"] == [one.stray for one in result.own]
    assert got["exhibit"]["handles"] == json_like(result.exhibit.handles)
