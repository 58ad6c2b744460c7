"""Every field of an answer that a command prints has a label, and every code of a value has words."""

from app.questions.maximum_head_speed import MaximumHeadSpeed
from app.wire.labels import lines_of


def test_an_unknown_end_of_a_bracket_has_no_unit():
    answer = MaximumHeadSpeed(
        head_speed=1.5, head_speed_bracket=(None, 1.5), speed_ratio=2.0, handles=[1], time=3.0,
        time_at_unit_head_speed=4.5, passage=None, sentences=[],
    )  # fmt: skip
    assert dict(lines_of(answer))["head speed bracket"] == "unknown, 1.5 m/s"
