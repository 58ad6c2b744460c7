"""Dragon: sizes, limits, equality; strays add up, and impossible values are refused with their limit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Dragon, Stray
from core.checks import SIZE_MAX, SIZE_MIN
from core.dragon import BENCHES_MAX, checked_stray
from tests.support.depth import thorough
from tests.support.near import assert_near
from tests.support.refused import refused

pytestmark = pytest.mark.uncompiled

SIZES = st.floats(0.5, 10.0)


@pytest.mark.parametrize(
    "name, value",
    [
        ("benches", 1),
        *thorough(("benches", BENCHES_MAX)),
        ("width", SIZE_MIN),
        ("width", SIZE_MAX),
        ("overhang", 0.0),
        ("overhang", 1.0995 - 1e-12),
    ],
)
def test_a_size_at_its_limit_is_accepted(name, value):
    assert Dragon(**{"benches": 3, name: value}).chords.min() >= SIZE_MIN


def test_the_shortest_chord_is_accepted():
    assert Dragon.of([2.0], [0.3], [0.9994]).chords[0] >= SIZE_MIN


# Half of a length of the body is 1.1 m.
@pytest.mark.parametrize("name, value", [("benches", BENCHES_MAX + 1), ("width", SIZE_MIN / 2), ("overhang", 1.1)])
def test_a_size_beyond_its_limit_is_refused_by_its_field(name, value):
    with refused(f"dragon.{name}"):
        Dragon(**{name: value})


@pytest.mark.parametrize(
    "field, lengths, widths, overhangs",
    [
        ("lengths.1", [2.0, SIZE_MIN / 2], [0.3, 0.3], [0.0, 0.0]),
        ("widths.0", [2.0, 2.0], [np.nan, 0.3], [0.2, 0.2]),
    ],
)
def test_a_bench_that_cannot_be_is_refused_by_name(field, lengths, widths, overhangs):
    with refused(f"dragon.{field}"):
        Dragon.of(lengths, widths, overhangs)


@given(st.integers(2, 30), SIZES, SIZES, st.floats(0.01, 2.0), st.floats(0.0, 0.2))
def test_a_uniform_dragon_equals_the_same_one_bench_by_bench(benches, head, body, width, overhang):
    uniform = Dragon(benches, head, body, width, overhang)
    listed = Dragon.of([head] + [body] * (benches - 1), [width] * benches, [overhang] * benches)
    assert uniform == listed
    assert hash(uniform) == hash(listed)
    assert uniform.uniform_from == listed.uniform_from == (head != body)


@given(st.lists(st.tuples(st.sampled_from([1.0, 2.0]), st.sampled_from([0.1, 0.2])), min_size=1, max_size=12))
def test_all_benches_from_uniform_from_on_are_alike_and_the_one_before_differs(rows):
    alike = Dragon.of(*zip(*rows, strict=True), [0.1] * len(rows)).uniform_from
    assert set(rows[alike:]) == {rows[-1]}
    assert alike == 0 or rows[alike - 1] != rows[-1]


def test_a_dragon_cannot_be_changed_nor_by_the_lists_it_was_made_from():
    widths = np.array([0.3, 0.3])
    dragon = Dragon.of(np.array([2.0, 2.0]), widths, np.array([0.1, 0.1]))
    widths[0] = 9.0
    assert dragon.widths[0] == 0.3
    with pytest.raises(ValueError, match="read-only"):
        dragon.widths[0] = 1.0


@pytest.mark.parametrize("benches", [1, 2, 3, 5])
def test_leading_benches_are_those_of_the_dragon(benches):
    columns = [3.0, 2.0, 4.0, 2.0, 2.0], [0.3, 0.2, 0.3, 0.3, 0.3], [0.2, 0.1, 0.2, 0.2, 0.2]
    front = Dragon.of(*columns).leading(benches)
    expected = Dragon.of(*(column[:benches] for column in columns))
    assert front == expected
    assert front.uniform_from == expected.uniform_from


def test_people_and_play_add_up():
    stray = Stray(0.02, 0.055, 0.045)
    assert_near(stray.total, 0.025, 1e-15)
    assert Stray(0.01, 0.055, 0.045).total == 0.015  # and not 0.015000000000000001
    assert checked_stray(stray, Dragon()) == stray.total > checked_stray(0.02, Dragon())
    assert checked_stray(0.825, Dragon()) == 0.825
