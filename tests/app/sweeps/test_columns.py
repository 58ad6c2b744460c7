"""Columns of a table: known from the model of an answer, the same for every part."""

import pytest

from app.questions.check import CheckRequest, check
from app.sweeps.columns import Column, answer_columns, value_type
from app.sweeps.questions import QUESTIONS, question_of
from app.wire.question import Terms
from tests.support.odd_questions import Height


def test_numbers_words_and_pairs_become_columns_and_lists_json():
    columns = answer_columns(Height)
    assert [(column.name, column.kind) for column in columns] == [
        ("height", float), ("side", str), ("around.0", float), ("around.1", float), ("digits", str),
    ]  # fmt: skip
    answer = Height(height=2.0, side=None, around=(1.0, 3.0), digits=[1, 2])
    assert [column.value(answer) for column in columns] == [2.0, None, 1.0, 3.0, "[1,2]"]


@pytest.mark.parametrize("name", QUESTIONS)
def test_what_is_shown_and_what_is_left_out_are_columns(name):
    question = question_of(name)
    columns = answer_columns(question.answer)
    names = {column.name for column in columns}
    assert len(names) == len(columns)
    assert not any("words" in name.split(".") for name in names)
    kept = {column.name for column in answer_columns(question.answer, question.left_out)}
    left_out = {field: [name for name in names if f"{name}.".startswith(f"{field}.")] for field in question.left_out}
    assert all(left_out.values())
    assert names - kept == {name for group in left_out.values() for name in group}


@pytest.mark.parametrize(
    "values, kind",
    [([1, 2], int), ([1, 2.5], float), ([True], bool), (["a"], str), ([{"kind": "spiral"}], str), ([1, "a"], str)],
)
def test_a_list_of_values_has_one_type(values, kind):
    assert value_type(values) is kind


def test_a_column_of_a_list_of_models_is_their_json():
    answer = check(CheckRequest(dragon={"benches": 5}, speed_limit=0.5, cross_check="none"), Terms())
    column = Column("failures", ("failures",), str, as_json=True)
    assert '"kind":"speed"' in column.value(answer)
