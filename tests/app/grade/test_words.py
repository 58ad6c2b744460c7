"""Everything that the grader can say has words in both languages."""

import re
from pathlib import Path

import numpy as np
import pytest

from app.grade import words
from app.grade.diagnosis import speed_errors
from app.grade.expected import Workbook, dance_of, of_dance
from app.grade.geometry import SheetClues, geometries
from app.grade.shortcuts import UNITS, shortcuts
from core.language import Language, speaking

GRADE = Path(words.__file__).parent
# Names that stand in calls, as in note("empty").
USE_OF_WORDS = re.compile(r'\b(?:note|say)\(\s*"(\w+)"')


@pytest.mark.parametrize("language", Language)
def test_every_known_error_has_words(language):
    heads = {Workbook.RESULT1: [[8.25, 0.0]], Workbook.RESULT4: [[0.0, 9.0]]}
    known = [
        (model.error, model.values)
        for workbook, head in heads.items()
        for model in geometries(dance_of(workbook), np.zeros(1), SheetClues(0, np.array(head), (2.96, 1.75)))
    ]
    known += [(model.error, model.values) for model in speed_errors(of_dance(dance_of(Workbook.RESULT1)))]
    known += [(one.error, one.values) for name in UNITS for one in shortcuts(name)]
    assert {"equal_arcs_of_turn", "other_start", "central_difference", "time_steps"} <= {error for error, _ in known}
    for error, values in known:
        with speaking(language):
            text = words.word(f"error_{error}", **values)
        assert "{" not in text
    codes = {name.removeprefix("error_") for name in words.WORDS if name.startswith("error_")}
    with speaking(language):
        names = {code: words.word(f"name_{code}") for code in codes}
    assert {name.isascii() for name in names.values()} == {language is Language.ENGLISH}


def test_every_name_in_the_code_has_words():
    used = {name for file in GRADE.glob("*.py") for name in USE_OF_WORDS.findall(file.read_text(encoding="utf-8"))}
    assert len(used) > 20
    assert used <= words.WORDS.keys()
