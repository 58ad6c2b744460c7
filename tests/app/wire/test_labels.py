"""Every field of an answer that a command prints has a label, and every code of a value has words."""

from enum import Enum
from typing import get_args

import pytest
from pydantic import BaseModel

from app.questions.maximum_head_speed import MaximumHeadSpeed
from app.questions.registry import QUESTIONS
from app.wire.answers import MultiPolygon, Polygon
from app.wire.labels import UNSHOWN, VALUES, lines_of
from app.wire.question import typed_fields
from core.display import Readable

# Questions whose commands do more than ask them, and print the fields of the answer.
BY_HAND = ("encounter", "envelope")
PRINTED = [
    question
    for name, question in QUESTIONS.items()
    if name in BY_HAND or (question.command and not question.command.parts)
]


def codes_in(kind):
    """The codes that an answer or a part of one may have."""
    if isinstance(kind, type) and issubclass(kind, Enum):
        return {code.value for code in kind}
    inner = get_args(kind)
    if isinstance(kind, type) and issubclass(kind, BaseModel | Readable) and kind not in (Polygon, MultiPolygon):
        inner = [of_field for name, (of_field, _) in typed_fields(kind).items() if name not in UNSHOWN]
    return set().union(*map(codes_in, inner))


@pytest.mark.parametrize("question", PRINTED, ids=lambda question: question.name)
def test_every_code_has_its_words(question):
    assert codes_in(question.model) | codes_in(question.several) <= VALUES.keys()


def test_an_unknown_end_of_a_bracket_has_no_unit():
    answer = MaximumHeadSpeed(
        head_speed=1.5, head_speed_bracket=(None, 1.5), speed_ratio=2.0, handles=[1], time=3.0,
        time_at_unit_head_speed=4.5, passage=None, sentences=[],
    )  # fmt: skip
    assert dict(lines_of(answer))["head speed bracket"] == "unknown, 1.5 m/s"
