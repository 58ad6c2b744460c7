"""Everything that the grader can say has words in both languages."""

import re
from itertools import chain
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
    known = [*speed_errors(of_dance(dance_of(Workbook.RESULT1))), *chain.from_iterable(map(shortcuts, UNITS))]
    for workbook, head in ((Workbook.RESULT1, [[8.25, 0.0]]), (Workbook.RESULT4, [[0.0, 9.0]])):
        known += geometries(dance_of(workbook), np.zeros(1), SheetClues(0, np.array(head), (2.96, 1.75)))
    assert {"equal_arcs_of_turn", "other_start", "central_difference", "time_steps"} <= {one.error for one in known}
    with speaking(language):
        texts = [words.word(f"error_{one.error}", **one.values) for one in known]
    assert [text for text in texts if "{" in text] == []


def test_every_name_in_the_code_has_words():
    used = {name for file in GRADE.glob("*.py") for name in USE_OF_WORDS.findall(file.read_text(encoding="utf-8"))}
    assert len(used) > 20
    used |= {name.replace("error_", "name_", 1) for name in words.WORDS if name.startswith("error_")}
    assert used <= words.WORDS.keys()
