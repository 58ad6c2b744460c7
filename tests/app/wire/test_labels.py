"""Every field of an answer that a command prints has a label, and every code of a value has words."""

from enum import Enum
from typing import get_args

import pytest
from pydantic import BaseModel

from app.questions.maximum_head_speed import MaximumHeadSpeed
from app.questions.registry import QUESTIONS
from app.wire.answers import MultiPolygon, Polygon
from app.wire.labels import LABELS, UNSHOWN, VALUES, lines_of

# Questions whose commands do more than ask them, and print the fields of the answer.
BY_HAND = ("encounter", "envelope")
PRINTED = [
    question
    for name, question in QUESTIONS.items()
    if name in BY_HAND or (question.command and not question.command.parts)
]


def parts_of(kind):
    """A type, and the types of everything in it."""
    inner = get_args(kind)
    if isinstance(kind, type) and issubclass(kind, BaseModel) and kind not in (Polygon, MultiPolygon):
        inner = [field.annotation for name, field in kind.model_fields.items() if name not in UNSHOWN]
    yield kind
    for part in inner:
        yield from parts_of(part)


@pytest.mark.parametrize("question", PRINTED, ids=lambda question: question.name)
def test_every_field_has_a_label_and_every_code_its_words(question):
    kinds = {
        kind for answer in (question.model, question.several) for kind in parts_of(answer) if isinstance(kind, type)
    }
    models = [kind for kind in kinds if issubclass(kind, BaseModel) and kind not in (Polygon, MultiPolygon)]
    # Each engine has a row of its own; x and y are no words.
    names = {name for model in models for name in model.model_fields}
    assert names - UNSHOWN - {"engines", "x", "y"} <= LABELS.keys()
    codes = {code.value for kind in kinds if issubclass(kind, Enum) for code in kind}
    assert codes <= VALUES.keys()


def test_an_unknown_end_of_a_bracket_has_no_unit():
    answer = MaximumHeadSpeed(
        head_speed=1.5, head_speed_bracket=(None, 1.5), speed_ratio=2.0, handles=[1], time=3.0,
        time_at_unit_head_speed=4.5, passage=None, sentences=[],
    )  # fmt: skip
    assert dict(lines_of(answer))["head speed bracket"] == "unknown, 1.5 m/s"
