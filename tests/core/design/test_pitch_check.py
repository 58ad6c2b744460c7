"""Four engines on the dance around a minimum pitch: they confirm found pitches, and no forged ones."""

from dataclasses import replace

import pytest

from core import Dance, Dragon, Spiral, Verdict, clearance_profile, minimum_pitch
from core.design.pitch_check import pitch_check
from core.design.pitch_search import LimitedBy
from core.sampling import bisect
from core.shapes.engines import Engine
from tests.support.refused import refused

AS_REPORTED = Verdict(before=False, after=True)
DRAGON = Dragon()
# Difference of a wrong pitch from the minimum [m]; far above CHECK_PITCH.
WRONG = 1e-4


@pytest.mark.parametrize("whole", [True, False], ids=["whole", "pair"])
@pytest.mark.parametrize(
    "dragons, options",
    [
        (1, {}),
        (1, {"margin": 0.05}),
        (1, {"stray": 0.02, "margin": 0.01}),
        (2, {"stray": 0.02}),
    ],
    ids=str,
)
def test_engines_agree_on_the_minimum_pitch(dragons, options, whole):
    """With a stray it is the pitch at which grounds meet, which only shapely judges."""
    dragon = DRAGON if dragons == 1 else Dragon(40)
    result = minimum_pitch(dragon, turning_radius=4.5, dragons=dragons, **options)
    check = pitch_check(result, dragon, dragons=dragons, whole=whole, **options)
    assert check.agree
    pair = (result.benches[0], result.benches[1] + dragon.benches * (dragons - 1))
    assert check.judged == (tuple(range(dragons * dragon.benches)) if whole or "stray" in options else pair)
    assert set(check.engines.values()) == {AS_REPORTED}
    assert ({*check.engines} == {Engine.SHAPELY}) is ("stray" in options)
    for shift, wrong in ((-WRONG, Verdict(True, True)), (WRONG, Verdict(False, False))):
        shifted = replace(result, pitch=result.pitch + shift)
        check = pitch_check(shifted, dragon, dragons=dragons, whole=whole, **options)
        assert not check.agree
        assert dragons == 2 or set(check.engines.values()) == {wrong}


def test_a_minimum_pitch_that_no_pair_limits_is_not_judged():
    result = minimum_pitch(Dragon(3), turning_radius=4.5, start_turns=3.0)
    assert result.benches is None
    assert pitch_check(result, Dragon(3)) is None


@pytest.mark.parametrize(
    "dragons, dragon, field, values",
    [
        (1, Dragon(5), "dragon", {"bench": 19, "got": "one of 5 benches"}),
        (2, Dragon(40), "dragons", {"k": 1, "got": 1}),
    ],
    ids=["a longer dragon", "more dragons"],
)
def test_a_minimum_pitch_of_others_is_refused(dragons, dragon, field, values):
    minimum = minimum_pitch(Dragon(40), dragons=dragons)
    with refused(field, **values):
        pitch_check(minimum, dragon)


def test_a_pitch_limited_at_the_start_is_judged_with_the_head_at_the_start():
    dragon = Dragon(80)
    turns = 8.0

    def nearest(pitch):
        profile = clearance_profile(Dance(dragon, Spiral(pitch, turns)), [0.0])
        return float(profile.clearance[0]), tuple(profile.benches[0].tolist())

    low, high = bisect(lambda pitch: nearest(pitch)[0] > 0.0, 0.2, 1.0)
    start = {"limited_by": LimitedBy.START, "benches": nearest(low)[1], "head_radius": turns * low}
    check = pitch_check(replace(minimum_pitch(DRAGON), pitch=high, pitch_bracket=(low, high), **start), dragon)
    assert check.agree
    assert set(check.engines.values()) == {AS_REPORTED}
