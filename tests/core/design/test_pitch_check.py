"""Four engines on the dance around a minimum pitch: they confirm found pitches, and no forged ones."""

from __future__ import annotations

from dataclasses import replace

import pytest

from core import Dance, Dragon, InvalidValue, Spiral, Verdict, clearance_profile, minimum_pitch
from core.design.pitch_check import pitch_check
from core.design.pitch_search import LimitedBy
from core.shapes.engines import Engine

AS_REPORTED = Verdict(before=False, after=True)
DRAGON = Dragon()
# Difference of a wrong pitch from the minimum [m]; far above CHECK_PITCH.
WRONG = 1e-4


@pytest.mark.parametrize("whole", [True, False], ids=["dragon", "pair"])
@pytest.mark.parametrize(
    ("options", "limited_by"),
    [({}, LimitedBy.GRAZE), ({"turning_radius": 3.0}, None), ({"margin": 0.05}, None), ({"turning_radius": 4.0}, None)],
    ids=["default", "6 m", "margin", "8 m"],
)
def test_engines_agree_on_the_minimum_pitch(options: dict[str, float], limited_by: LimitedBy, whole: bool) -> None:
    result = minimum_pitch(DRAGON, **options)
    check = pitch_check(result, DRAGON, margin=options.get("margin", 0.0), whole=whole)
    assert check is not None
    assert limited_by in (None, result.limited_by)
    assert check.agree
    assert check.judged == (tuple(range(223)) if whole else result.benches)
    assert set(check.engines.values()) == {AS_REPORTED}


def test_a_wrong_minimum_pitch_is_noticed() -> None:
    result = minimum_pitch(DRAGON)
    for pitch, verdict in ((result.pitch - WRONG, Verdict(True, True)), (result.pitch + WRONG, Verdict(False, False))):
        check = pitch_check(replace(result, pitch=pitch), DRAGON)
        assert check is not None
        assert not check.agree
        assert set(check.engines.values()) == {verdict}


def test_a_minimum_pitch_that_no_pair_limits_is_not_judged() -> None:
    result = minimum_pitch(Dragon(3), turning_radius=4.5, start_turns=3.0)
    assert result.benches is None
    assert pitch_check(result, Dragon(3)) is None


def test_a_minimum_pitch_of_a_longer_dragon_is_refused() -> None:
    with pytest.raises(InvalidValue, match="must be that of the search, with bench 19, got one of 5 benches"):
        pitch_check(minimum_pitch(Dragon()), Dragon(5))


def test_a_pitch_limited_at_the_start_is_judged_with_the_head_at_the_start() -> None:
    dragon, turns = Dragon(80), 8.0
    low, high = 0.2, 1.0

    def nearest(pitch: float) -> tuple[float, tuple[int, int]]:
        profile = clearance_profile(Dance(dragon, Spiral(pitch, turns)), [0.0])
        a, b = profile.benches[0].tolist()
        return float(profile.clearance[0]), (a, b)

    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (low, middle) if nearest(middle)[0] > 0.0 else (middle, high)
    graze = minimum_pitch(DRAGON)
    start = {"limited_by": LimitedBy.START, "benches": nearest(low)[1], "head_radius": turns * low}
    check = pitch_check(replace(graze, pitch=high, pitch_bracket=(low, high), **start), dragon)
    assert check is not None
    assert check.agree
    assert set(check.engines.values()) == {AS_REPORTED}


def test_with_a_stray_the_minimum_pitch_is_that_at_which_grounds_meet() -> None:
    result = minimum_pitch(DRAGON, stray=0.02, margin=0.01)
    check = pitch_check(result, DRAGON, stray=0.02, margin=0.01)
    assert check is not None
    assert check.agree
    assert check.engines == {Engine.SHAPELY: AS_REPORTED}
    for shift in (-1e-4, 1e-4):
        wrong = replace(result, pitch=result.pitch + shift)
        assert not pitch_check(wrong, DRAGON, stray=0.02, margin=0.01).agree


@pytest.mark.parametrize("options", [{}, {"margin": 0.05}, {"stray": 0.02}], ids=["plain", "margin", "stray"])
@pytest.mark.parametrize("whole", [True, False], ids=["dragons", "pair"])
def test_engines_agree_on_the_minimum_pitch_of_two_dragons(options: dict[str, float], whole: bool) -> None:
    dragon = Dragon(40)
    result = minimum_pitch(dragon, dragons=2, **options)
    check = pitch_check(result, dragon, dragons=2, whole=whole, **options)
    assert check is not None
    assert check.agree
    assert check.judged == (
        tuple(range(80)) if whole or "stray" in options else (result.benches[0], 40 + result.benches[1])
    )
    wrong = replace(result, pitch=result.pitch - WRONG)
    assert not pitch_check(wrong, dragon, dragons=2, whole=whole, **options).agree


def test_a_minimum_pitch_of_more_dragons_is_refused() -> None:
    with pytest.raises(InvalidValue, match="dragons must be that of the search, with dragon 1, got 1"):
        pitch_check(minimum_pitch(Dragon(40), dragons=2), Dragon(40))
