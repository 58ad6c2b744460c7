"""The paper's numbers beside ours: each number of ours is what core answers, each reason can be recomputed."""

import re

import pytest

from app.questions.paper import PaperQuery, comparison, literature, paper
from app.settings import Settings
from app.wire.question import Terms
from core import Budget, Dance, Dragon, Spiral, TooMuchWork, first_contact, minimum_pitch
from core.language import Language, speaking
from tests.support.near import assert_near
from tests.support.refused import refused

# Printed digits of the paper, and how well the reference values are known.
MICROMETRE = 0.5e-6  # [m]
NANO = 1e-9  # [s and m]
LENGTH, TIME, RADIUS, PITCH = (
    "arc length of the spiral",
    "time of first contact",
    "radius of the head at first contact",
    "minimum pitch",
)


@pytest.fixture(scope="module")
def rows():
    return {row.quantity: row for row in comparison(Budget())}


def evidence(row, start):
    """The one value that begins with these words."""
    (value,) = (fact.value for fact in row.evidence if fact.what.startswith(start))
    return value


def test_ours_is_what_core_answers_and_an_independent_computation_proved(rows):
    contact = first_contact(Dance(Dragon(), Spiral()))
    ours = [rows[name].ours for name in (TIME, RADIUS, PITCH)]
    assert ours == [contact.time, contact.head.radius, minimum_pitch(Dragon()).pitch]
    proven = [412.47383768211466, 2.288742638382156, 0.4503373930271955]
    assert_near(ours, proven, NANO)
    assert abs(rows[LENGTH].difference) <= MICROMETRE


def test_the_exact_angle_rule_and_a_bisection_of_the_radius_agree_with_ours(rows):
    exact = evidence(rows[TIME], "first time of an angle sum of 360 degrees")
    assert_near(exact, rows[TIME].ours, 1e-6)  # [s]: the angle sum nears 360 degrees continuously
    ends = evidence(rows[PITCH], "pitch at which a bisection of the radius ends")
    assert_near(ends, rows[PITCH].ours, NANO)
    passed = evidence(rows[RADIUS], "time at which the head passes the paper's radius")
    assert_near(Spiral().head(passed).radius, 2.883, NANO)


def test_in_chinese_no_english_word_is_left_and_a_reason_tells_the_same_numbers():
    with speaking(Language.CHINESE):
        translated, others = list(comparison(Budget())), list(literature(Budget()))
    for english, chinese in zip(comparison(Budget()), translated, strict=True):
        words = [chinese.quantity, chinese.source, chinese.reason, *(fact.what for fact in chinese.evidence)]
        assert [word for word in words if re.search("[a-zA-Z]{3}", word.replace("cos", ""))] == []
        numbers = [set(re.findall(r"\d[\d.]*\d|\d", one.reason)) for one in (english, chinese)]
        assert numbers[0] == numbers[1]
    assert all(re.match("首次碰撞时刻|最小螺距", one.quantity) for one in others)


def test_the_paper_is_not_recomputed_beyond_the_deadline():
    budget = Budget()
    budget.stop()
    with refused("language", TooMuchWork):
        paper(PaperQuery(), Terms(Settings(), budget))
