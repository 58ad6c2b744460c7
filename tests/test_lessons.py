"""The lesson sheets of examples/lessons: one code in two languages, every cell runs, and their sentences are true."""

import re

import pytest

from tests.conftest import ROOT
from tests.support.near import assert_near
from tests.support.notebooks import cells, ran

LESSONS = sorted((ROOT / "examples" / "lessons").glob("*.en.py"))
NAMES = [path.name.removesuffix(".en.py") for path in LESSONS]


def lesson_of(name):
    return ran(ROOT / "examples" / "lessons" / f"{name}.en.py")


@pytest.mark.parametrize("path", LESSONS, ids=NAMES)
def test_both_languages_have_the_same_code_between_words_of_their_own(path):
    chinese = path.with_name(path.name.replace(".en.", ".zh."))
    assert cells(path, "code") == cells(chinese, "code")
    english_words = cells(path, "markdown")
    chinese_words = cells(chinese, "markdown")
    assert len(english_words) == len(chinese_words) > 6
    assert sum(words.startswith(("## Exercise", "# Lesson")) for words in english_words) == 3
    assert not any(re.search("[一-鿿]", words) for words in english_words)
    assert all(re.search("[一-鿿]", words) for words in chinese_words)


def test_positions_and_speeds_of_ten_lines_are_those_of_the_library_and_a_length_for_a_chord_is_found():
    lesson = lesson_of("1_positions_and_speeds")
    assert lesson["apart"] < 1e-11  # "to eleven digits"
    assert lesson["furthest"] < 1e-11
    assert lesson["own"] == ("right", [])
    for name, words in (("long_benches", "The length of a bench"), ("differences", "forward difference quotients")):
        verdict, (error,) = lesson[name]
        assert verdict == "wrong"
        assert words in error


def test_a_look_once_a_second_misses_a_contact_that_a_step_which_is_a_proof_finds():
    lesson = lesson_of("2_first_contact")
    assert 0.0 < lesson["closer"].clearance.min() < 1e-3  # "less than a millimetre"
    assert lesson["first_seen"] - lesson["true"].time > 2.5  # "three seconds later"
    assert lesson["contact"].time - 1e-3 < lesson["time"] <= lesson["contact"].time
    assert lesson["mine"].verdict == "right"
    assert (lesson["paper"].verdict, lesson["halved"].verdict) == ("wrong", "wrong")
    begin, end = lesson["clear_again"][[0, -1]]
    assert 415.0 < begin < end < 415.4


def test_halving_for_a_radius_ends_beside_a_jump_and_the_grader_judges_the_pitches():
    lesson = lesson_of("3_smallest_pitch")
    below = lesson["radius"](lesson["low"])
    above = lesson["radius"](lesson["high"])
    assert lesson["high"] - lesson["low"] < 1e-9
    assert_near(below - above, 0.17, 0.005)  # "17 cm apart"
    assert above < 4.5 < below
    assert_near(lesson["smallest"].head_radius, 4.57, 0.005)
    assert "in steps of 1 s" in lesson["looked"].possible[0].words
    assert list(lesson["verdicts"].values()) == ["right", "right", "infeasible", "wrong", "wrong"]
