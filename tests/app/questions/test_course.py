"""The course of a path, with the stretches on which its dance breaks a limit."""

import pytest

from app.questions.course import CourseRequest
from core import Dragon
from core.breaches import breaches_and_gaps
from tests.support.asking import box, line

BODY = {
    "dragon": {"benches": 3},
    "path": line((0, 0), (30, 0)),
    "venue": {"type": "GeometryCollection", "geometries": [box(-9, -9, 39, 9), box(14, 0.2, 16, 2.2)]},
}


def test_stretches_are_those_of_core_and_come_only_if_asked_for(ask):
    assert ask("course", BODY | {"margin": 0.1})["breaches"] is None
    assert ask("course", BODY | {"breaches": True})["breaches"] == []
    limits = {"margin": 0.06, "stray": 0.1, "speed_limit": 0.5}
    body = BODY | limits | {"breaches": True}
    got = ask("course", body)["breaches"]
    request = CourseRequest.model_validate(body)
    result, _ = breaches_and_gaps(request.to_dance(3), request.to_place(Dragon(3)).venue, **limits)
    assert [(one["kind"], one["start"]) for one in got] == [(one.kind.value, one.start) for one in result]
    assert {one["kind"] for one in got} == {"speed", "margin", "stray"}
    assert got[0]["points"] == result[0].points.tolist()
    late = ask("course", BODY | {"breaches": True, "margin": 0.06, "start": 14.0})["breaches"]
    assert late[0]["start"] > next(one["start"] for one in got if one["kind"] == "margin")


def test_how_near_benches_come_to_each_area_is_said_at_the_same_samples(ask):
    gaps = ask("course", BODY | {"breaches": True, "margin": 0.06})["gaps"]
    assert {one["name"]: one["distance"] for one in gaps} == pytest.approx({"square": 8.725, "obstacle 1": 0.05})
    assert {one["enough"] for one in gaps} == {0.06}
    inside = {"venue": {"type": "GeometryCollection", "geometries": [box(-9, -9, 39, 9), box(10, -3, 20, 3)]}}
    assert [one["distance"] for one in ask("course", BODY | inside | {"breaches": True})["gaps"]][1] == 0.0
    outside = {"venue": {"type": "GeometryCollection", "geometries": [box(-9, 3, 39, 9)]}}
    assert [one["distance"] for one in ask("course", BODY | outside | {"breaches": True})["gaps"]] == [0.0]


@pytest.mark.parametrize(
    "more",
    [{"path": line((0, 0), (2, 0), (2, 2), straight=[0, 1], radius=0.5)}, {"dragon": {"benches": 60}}],
    ids=["tight bend", "too short for the dragon"],
)
def test_a_path_that_the_dragon_cannot_follow_has_a_course_without_stretches(ask, more):
    answer = ask("course", BODY | {"breaches": True} | more)
    assert answer["breaches"] is None
    assert answer["gaps"] is None
    assert len(answer["x"]) > 5
