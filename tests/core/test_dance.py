"""A dance: its end, and its allowed head speeds and times."""

import math
import pickle
from functools import partial

import numpy as np
import pytest
from hypothesis import given, settings

import core
from core import (
    Dance,
    Dragon,
    EndReason,
    Legs,
    OutsideRun,
    Spiral,
    first_contact,
    sharpest_bend,
    trajectory,
    venue_clearance,
)
from core.passages import HEAD_SPEED_MAX, HEAD_SPEED_MIN
from tests.support.near import assert_near
from tests.support.random_dances import DANCES, unlike_dance
from tests.support.refused import refused
from tests.support.shared_dances import square
from tests.support.slow_search import SlowDance

pytestmark = pytest.mark.uncompiled
# The slow dance finds the end by bisecting on whether a chain exists: as good as the crest is flat [m of travel].
SLOW_END = 1e-8


def test_a_wide_spiral_is_danced_to_its_centre():
    dance = Dance(Dragon(5), Spiral(9.0, 3.0))
    end = dance.end
    assert (end.reason, end.bench, end.theta, end.time) == (EndReason.CENTRE, None, 0.0, dance.path.length)
    assert trajectory(dance, end.time).position[0].tolist() == [0.0, 0.0]


# The chord, in units of growth squared, from which on a bench folds: core/kernels/fold.py [1].
FOLDING = 33.44973623331110255


@pytest.mark.parametrize("excess", [1e-8, 1e-6, 1e-3])
def test_a_chord_that_just_folds_ends_the_run_before_the_centre(excess):
    """256 samples of delta missed that theta stops falling, and rises, between two of them."""
    for chord2, reason in ((FOLDING + excess, EndReason.FOLD), (FOLDING - excess, EndReason.CENTRE)):
        chord = 0.5 * math.sqrt(chord2)
        assert Dance(Dragon(1, chord, chord, 0.1, 0.0), Spiral(math.pi, 3.0)).end.reason is reason


@pytest.mark.parametrize("seed", range(12))
def test_a_run_of_unlike_benches_ends_where_the_slow_chain_stops(seed):
    dance = unlike_dance(np.random.default_rng(seed))
    assert_near(dance.end.time, SlowDance.of(dance.dragon, dance.path).end(), SLOW_END)


@settings(max_examples=40, deadline=None)
@given(DANCES)
def test_the_last_instant_is_danced_and_the_next_is_outside_the_run(of):
    dance = Dance(*of)
    end = dance.end
    assert np.isfinite(trajectory(dance, [0.0, end.time]).speed).all()
    with pytest.raises(OutsideRun) as caught:
        trajectory(dance, [0.0, math.nextafter(end.time, math.inf)])
    assert caught.value.field == "times.1"
    assert ("folds" in caught.value.message) == (end.reason is EndReason.FOLD)


def test_a_start_inside_the_fold_is_refused():
    turns = Dance(Dragon(), Spiral()).end.theta / (2 * math.pi)
    assert Dance(Dragon(), Spiral(0.55, turns * (1 + 1e-9))).end.time > 0.0
    with refused("path.start_turns"):
        Dance(Dragon(), Spiral(0.55, turns))


@pytest.mark.parametrize("limit, beyond", [(HEAD_SPEED_MIN, 0.5), (HEAD_SPEED_MAX, 2.0)])
def test_a_head_speed_at_its_limits_is_accepted_and_none_beyond(limit, beyond):
    assert Dance(Dragon(), Spiral(), limit).end.time == pytest.approx(432.917924228 / limit)
    with refused("head_speed"):
        Dance(Dragon(), Spiral(), beyond * limit)


CORNER = partial(Legs, [(0, 0), (60, 0), (60, 60)], [0, 1], radius=5.0)


@pytest.mark.parametrize(
    "path, start",
    [(CORNER(), 17.711), (CORNER(start=40.0), 0.0), (Spiral(0.9, 6), 0.0)],
    ids=["off the path at 0", "on the path at 0", "spiral"],
)
def test_without_a_start_a_question_asks_from_the_default_start(path, start):
    dance = Dance(Dragon(10), path)
    default = dance.default_start
    assert_near(default, start, 1e-3)
    for question in (first_contact, sharpest_bend, partial(venue_clearance, venue=square(150))):
        assert repr(question(dance, stop=default + 20.0)) == repr(question(dance, start=default, stop=default + 20.0))
    assert dance.span() == dance.span(None, None) == (default, dance.end.time)


@pytest.mark.parametrize(
    "path, other",
    [
        ("Spiral(0.55)", "Spiral(0.56)"),
        ("Turn(1.7, entry_radius=4.4)", "Turn(1.7, entry_radius=4.4, exit_radius=4.3)"),
        ("ClothoidTurn(1.7, 4.5, 1.0, middle=4.0, ends=0.5)", "ClothoidTurn(1.7, 4.5, 1.0, middle=4.0, ends=0.6)"),
        ("Route([Line((0.0, 0.0), (600.0, 0.0))], 500.0)", "Route([Line((0.0, 0.0), (600.0, 0.0))], 501.0)"),
        ("Legs([(0.0, 0.0), (600.0, 0.0)], start=500.0)", "Legs([(0.0, 0.0), (600.0, 1.0)], start=500.0)"),
    ],
)
def test_dances_of_equal_values_are_equal(path, other):
    names = {name: getattr(core, name) for name in core.__all__}
    first, second, different = (Dance(Dragon(), eval(source, names)) for source in (path, path, other))
    assert first == second == pickle.loads(pickle.dumps(first))
    assert hash(first) == hash(second)
    assert first != different
    assert first.path != different.path
