"""Old names of questions about several dances: they ask the question about one, and warn."""

import pytest

import core
from core.old_names import NEW
from tests.support.public_calls import CALLS, PERFORMANCE


def test_old_names_of_questions_about_several_dances_ask_the_question_about_one_and_warn():
    for old, new in NEW.items():
        with pytest.warns(DeprecationWarning, match=rf"{new}\(\), which takes a Performance too"):
            question = getattr(core, old)
        query = {name: value for name, value in CALLS[getattr(core, new)].items() if name not in ("dance", "dragon")}
        first = (0,) if new == "bench_cues" else ()
        assert repr(question(PERFORMANCE, *first, **query)) == repr(getattr(core, new)(PERFORMANCE, **query))
