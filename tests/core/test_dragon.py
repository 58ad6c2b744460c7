"""Dragon: sizes, limits, equality; strays add up, and impossible values are refused with their limit."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from core import Dragon, InvalidValue, Stray
from core.dragon import BENCHES_MAX, checked_stray
from core.errors import SIZE_MAX, SIZE_MIN

pytestmark = pytest.mark.uncompiled

SIZES = st.floats(0.5, 10.0)


def test_the_default_is_the_dragon_of_the_contest() -> None:
    dragon = Dragon()
    assert (dragon.benches, dragon.lengths[0], dragon.lengths[1], dragon.lengths[-1]) == (223, 3.41, 2.2, 2.2)
    np.testing.assert_allclose(dragon.chords[:2], [2.86, 1.65], rtol=1e-15)
    assert set(dragon.widths) == {0.3}
    assert dragon.uniform_from == 1


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("benches", 1),
        ("benches", BENCHES_MAX),
        ("head_length", SIZE_MAX),
        ("body_length", SIZE_MAX),
        ("width", SIZE_MIN),
        ("width", SIZE_MAX),
        ("overhang", 0.0),
        ("overhang", 1.0995 - 1e-12),
    ],
)
def test_a_size_at_its_limit_is_accepted(name: str, value: float) -> None:
    dragon = Dragon(**{"benches": 3, name: value})  # type: ignore[arg-type]
    assert dragon.chords.min() >= SIZE_MIN


def test_the_shortest_chord_is_accepted() -> None:
    assert Dragon(3, 5.0, SIZE_MIN, 0.1, 0.0).chords[1] == SIZE_MIN


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("benches", 0, "from 1 to 10000000 benches, got 0"),
        ("benches", -5, "got -5"),
        ("benches", BENCHES_MAX + 1, "got 10000001"),
        ("benches", 2.5, "whole number"),
        ("benches", True, "whole number"),
        ("benches", "223", "whole number"),
        ("head_length", 0.0, "must be positive, got 0 m"),
        ("body_length", -2.2, "must be positive, got -2.2 m"),
        ("width", -0.3, "dragon.width must be positive, got -0.3 m"),
        ("width", SIZE_MIN / 2, "at least 0.001 m, got 0.0005 m"),
        ("width", SIZE_MAX * 1.001, "at most 10000 m"),
        ("width", float("nan"), "finite"),
        ("width", float("inf"), "finite"),
        ("width", "0.3", "number"),
        ("width", True, "number"),
        ("width", None, "number"),
        ("overhang", -0.1, "zero or more, got -0.1 m"),
        ("overhang", 1.1, "less than half of dragon.body_length (2.2 m / 2 = 1.1 m), got 1.1 m"),
        ("overhang", 1.8, "less than half of dragon.head_length (3.41 m / 2 = 1.705 m), got 1.8 m"),
        ("overhang", 1e308, "at most 10000 m"),
    ],
)
def test_a_size_beyond_its_limit_is_refused_with_field_value_unit_and_limit(
    name: str, value: object, words: str
) -> None:
    with pytest.raises(InvalidValue) as refused:
        Dragon(**{name: value})  # type: ignore[arg-type]
    assert refused.value.field == f"dragon.{name}"
    assert words in str(refused.value)
    assert isinstance(refused.value, ValueError)


@pytest.mark.parametrize(
    ("columns", "field"),
    [
        (([], [], []), "dragon.lengths"),
        (([[2.0]], [0.3], [0.2]), "dragon.lengths"),
        ((["long", 2.0], [0.3, 0.3], [0.2, 0.2]), "dragon.lengths"),
        (([2.0, 2.0], [0.3], [0.2, 0.2]), "dragon.widths"),
        (([2.0, 2.0], [0.3, 0.3], [0.2] * 3), "dragon.overhangs"),
        (([2.0, SIZE_MIN / 2], [0.3, 0.3], [0.0, 0.0]), "dragon.lengths.1"),
        (([2.0, 2.0], [0.3, -0.3], [0.2, 0.2]), "dragon.widths.1"),
        (([2.0, 2.0], [np.nan, 0.3], [0.2, 0.2]), "dragon.widths.0"),
        (([2.0, 2.0], [0.3, SIZE_MAX * 2], [0.2, 0.2]), "dragon.widths.1"),
        (([2.0, 2.0], [0.3, 0.3], [0.2, -1e-9]), "dragon.overhangs.1"),
        (([2.0, 2.0], [0.3, 0.3], [0.2, 1.0]), "dragon.overhangs.1"),
    ],
)
def test_a_bench_that_cannot_be_is_refused_by_name(columns: tuple[list[float], ...], field: str) -> None:
    with pytest.raises(InvalidValue) as refused:
        Dragon.of(*columns)
    assert refused.value.field == field


@given(st.integers(2, 30), SIZES, SIZES, st.floats(0.01, 2.0), st.floats(0.0, 0.2))
def test_a_uniform_dragon_equals_the_same_one_bench_by_bench(
    benches: int, head: float, body: float, width: float, overhang: float
) -> None:
    uniform = Dragon(benches, head, body, width, overhang)
    listed = Dragon.of([head] + [body] * (benches - 1), [width] * benches, [overhang] * benches)
    assert uniform == listed
    assert hash(uniform) == hash(listed)
    assert uniform.uniform_from == listed.uniform_from == (1 if head != body else 0)


@given(st.lists(st.tuples(st.sampled_from([1.0, 2.0]), st.sampled_from([0.1, 0.2])), min_size=1, max_size=12))
def test_all_benches_from_uniform_from_on_are_alike_and_the_one_before_differs(rows: list[tuple[float, float]]) -> None:
    dragon = Dragon.of([length for length, _ in rows], [width for _, width in rows], [0.1] * len(rows))
    alike = dragon.uniform_from
    assert set(rows[alike:]) == {rows[-1]}
    assert alike == 0 or rows[alike - 1] != rows[-1]


def test_a_dragon_cannot_be_changed() -> None:
    dragon = Dragon()
    with pytest.raises(dataclasses.FrozenInstanceError):
        dragon.lengths = np.ones(3)  # type: ignore[misc]
    with pytest.raises(ValueError, match="read-only"):
        dragon.widths[0] = 1.0


def test_a_dragon_keeps_no_hold_of_the_lists_it_was_made_from() -> None:
    widths = np.array([0.3, 0.3])
    dragon = Dragon.of(np.array([2.0, 2.0]), widths, np.array([0.1, 0.1]))
    widths[0] = 9.0
    assert dragon.widths[0] == 0.3


def test_dragons_of_another_width_differ() -> None:
    assert Dragon(width=0.3) != Dragon(width=0.31)
    assert Dragon() != "a dragon"


@pytest.mark.parametrize("benches", [1, 2, 3, 5])
def test_leading_benches_are_those_of_the_dragon(benches: int) -> None:
    lengths, widths, overhangs = [3.0, 2.0, 4.0, 2.0, 2.0], [0.3, 0.2, 0.3, 0.3, 0.3], [0.2, 0.1, 0.2, 0.2, 0.2]
    front = Dragon.of(lengths, widths, overhangs).leading(benches)
    expected = Dragon.of(lengths[:benches], widths[:benches], overhangs[:benches])
    assert front == expected
    assert front.uniform_from == expected.uniform_from
    np.testing.assert_array_equal(front.chords, expected.chords)


def test_people_and_play_add_up() -> None:
    assert Stray(0.02, 0.055, 0.045).total == pytest.approx(0.025, abs=1e-15)
    assert Stray(0.01, 0.055, 0.045).total == 0.015  # and not 0.015000000000000001
    assert checked_stray(Stray(0.02, 0.055, 0.045), Dragon()) == Stray(0.02, 0.055, 0.045).total
    assert Stray(0.02, 0.055, 0.045).total > checked_stray(0.02, Dragon())


@pytest.mark.parametrize(
    ("stray", "message"),
    [
        (-0.01, "stray must be zero or more, got -0.01 m"),
        (0.9, r"stray must be at most half the chord of bench 1 \(0.825[0-9]* m\), got 0.9 m"),
        (float("nan"), "stray must be a finite number"),
        ("0.1", "stray must be a number, got '0.1'"),
    ],
    ids=["negative", "beyond half a chord", "no number", "text"],
)
def test_strays_that_cannot_be_are_refused(stray: object, message: str) -> None:
    with pytest.raises(InvalidValue, match=message):
        checked_stray(stray, Dragon())


def test_a_pin_wider_than_its_hole_is_refused() -> None:
    with pytest.raises(InvalidValue, match=r"stray.pin must be no wider than its stray.hole \(0.05 m\), got 0.06 m"):
        Stray(0.0, 0.05, 0.06)


def test_half_a_chord_is_the_limit() -> None:
    assert checked_stray(0.825, Dragon()) == 0.825
    with pytest.raises(InvalidValue):
        checked_stray(0.8251, Dragon())
