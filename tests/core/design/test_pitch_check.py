"""Four engines on the dance around a minimum pitch: they confirm found pitches, and no forged ones."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from core import Dance, Dragon, Spiral, Verdict, clearance_profile, minimum_pitch
from core.design.pitch_check import pitch_check
from core.design.pitch_search import LimitedBy
from core.shapes.engines import Engine
from tests.support.refused import refused

AS_REPORTED = Verdict(before=False, after=True)
DRAGON = Dragon()
# Difference of a wrong pitch from the minimum [m]; far above CHECK_PITCH.
WRONG = 1e-4


@pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])
@pytest.mark.parametrize(
    ("options", "turning_radius"),
    [({}, 4.5), ({}, 3.0), ({"margin": 0.05}, 4.5), ({}, 4.0), ({"stray": 0.02, "margin": 0.01}, 4.5)],
    ids=["default", "6 m", "margin", "8 m", "stray"],
)
def test_engines_agree_on_the_minimum_pitch(options: dict[str, float], turning_radius: float, whole: bool) -> None:
    """With a stray it is the pitch at which grounds meet, which only shapely judges."""
    result = minimum_pitch(DRAGON, turning_radius=turning_radius, **options)
    check = pitch_check(result, DRAGON, whole=whole, **options)
    assert check.agree
    assert check.judged == (tuple(range(223)) if whole or "stray" in options else result.benches)
    assert set(check.engines.values()) == {AS_REPORTED}
    assert ({*check.engines} == {Engine.SHAPELY}) is ("stray" in options)
    for shift, wrong in ((-WRONG, Verdict(True, True)), (WRONG, Verdict(False, False))):
        check = pitch_check(replace(result, pitch=result.pitch + shift), DRAGON, whole=whole, **options)
        assert not check.agree
        assert {wrong} == set(check.engines.values())


def test_a_minimum_pitch_that_no_pair_limits_is_not_judged() -> None:
    result = minimum_pitch(Dragon(3), turning_radius=4.5, start_turns=3.0)
    assert result.benches is None
    assert pitch_check(result, Dragon(3)) is None


@pytest.mark.parametrize(
    ("dragons", "dragon", "field", "values"),
    [
        (1, Dragon(5), "dragon", {"bench": 19, "got": "one of 5 benches"}),
        (2, Dragon(40), "dragons", {"k": 1, "got": 1}),
    ],
    ids=["a longer dragon", "more dragons"],
)
def test_a_minimum_pitch_of_others_is_refused(dragons: int, dragon: Dragon, field: str, values: dict[str, Any]) -> None:
    minimum = minimum_pitch(Dragon(40), dragons=dragons)
    with refused(field, **values):
        pitch_check(minimum, dragon)


def test_a_pitch_limited_at_the_start_is_judged_with_the_head_at_the_start() -> None:
    dragon, turns = Dragon(80), 8.0
    low, high = 0.2, 1.0

    def nearest(pitch: float) -> tuple[float, tuple[int, ...]]:
        profile = clearance_profile(Dance(dragon, Spiral(pitch, turns)), [0.0])
        return float(profile.clearance[0]), tuple(profile.benches[0].tolist())

    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if nearest(middle)[0] > 0.0 else (middle, high)
    start = {"limited_by": LimitedBy.START, "benches": nearest(low)[1], "head_radius": turns * low}
    check = pitch_check(replace(minimum_pitch(DRAGON), pitch=high, pitch_bracket=(low, high), **start), dragon)
    assert check.agree
    assert set(check.engines.values()) == {AS_REPORTED}


@pytest.mark.parametrize("options", [{}, {"margin": 0.05}, {"stray": 0.02}], ids=["plain", "margin", "stray"])
@pytest.mark.parametrize("whole", [True, False], ids=["dragons", "pair"])
def test_engines_agree_on_the_minimum_pitch_of_two_dragons(options: dict[str, float], whole: bool) -> None:
    dragon = Dragon(40)
    result = minimum_pitch(dragon, dragons=2, **options)
    check = pitch_check(result, dragon, dragons=2, whole=whole, **options)
    assert check.agree
    pair = (result.benches[0], 40 + result.benches[1])
    assert check.judged == (tuple(range(80)) if whole or "stray" in options else pair)
    wrong = replace(result, pitch=result.pitch - WRONG)
    assert not pitch_check(wrong, dragon, dragons=2, whole=whole, **options).agree
