"""Whether the catalogues have every clause of the refusals that the program raises during the tests."""

import re
from functools import cache
from inspect import currentframe
from pathlib import Path

from babel.messages.pofile import read_po

from core import checks, errors, questions
from core.language import clauses

ROOT = Path(__file__).parent.parent.parent
# A clause with words of its own, beside those of its values.
WORDS = re.compile(r"[A-Za-z]{2}")
VALUES = re.compile(r"\{\w+\}")


@cache
def catalogue() -> set[str]:
    with (ROOT / "core/words/zh_CN.po").open("rb") as file:
        return {message.id for message in read_po(file) if isinstance(message.id, str)}


def watch() -> set[str]:
    """A set that grows by each clause that core or app raises and no catalogue has."""
    missing = set[str]()
    before = errors.BenchDragonError.compose

    def composed(self, field, template, reason, *further):
        before(self, field, template, reason, *further)
        frame = currentframe().f_back
        if frame.f_code.co_name in ("renamed", "with_field"):  # the error was composed before
            return
        while frame.f_code.co_filename in (checks.__file__, errors.__file__, questions.__file__, __file__):
            frame = frame.f_back
        if any(Path(frame.f_code.co_filename).is_relative_to(ROOT / room) for room in ("app", "core")):
            every = clauses(template) + clauses(reason)
            missing.update(one for one in every if WORDS.search(VALUES.sub("", one)) and one not in catalogue())

    errors.BenchDragonError.compose = composed
    return missing
