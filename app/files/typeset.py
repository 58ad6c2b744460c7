"""Paper as tagged PDF, set by Typst: a template and data in, the bytes of a file out.

The data are JSON, which the template reads from data.json: no text becomes markup. Pictures in them are SVG. A template
may import paper.typ. Equal data give equal bytes on the same fonts and the same version of Typst, because the file
holds no date.
"""

from __future__ import annotations

import atexit
import pickle
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from signal import SIGABRT
from typing import Any

import orjson

from app.extras import NotTypeset
from app.files.fonts import LATIN, chinese_among, language_of
from app.processes.child import ProcessEnded
from app.processes.pool import Pool
from core import Budget, TooMuchWork
from core.language import Language, say, spoken
from core.quantities import Quantity

# Millimetres in a point of type.
POINT = 25.4 / 72.0
# Characters whose widths are kept.
WIDTHS_MOST = 20_000
# Width of each character in type of 1 pt [pt]; between two others, because a blank alone has none.
WIDTHS = b"""
#let data = json("data.json")
#set text(font: data.fonts, size: 100pt, weight: data.weight)
#context {
  let wide(words) = measure(text(words)).width.pt()
  [#metadata(data.texts.map(one => (wide("|" + one + "|") - wide("||")) / 100)) <measured>]
}
"""
# Memory of a process that typesets [bytes], of address space: the largest plan takes 0.4 GB.
MEMORY_MAX = 1_500_000_000
# The processes that typeset.
typesetting = Pool("app.files.typesetter", str(MEMORY_MAX), waiting=1)
atexit.register(typesetting.close)


def _asked(budget: Budget | None, name: str, *arguments: object) -> Any:
    """The value of a function of app.files.typesetter. raises: Halted once the budget is stopped"""
    if budget:
        budget.look()
    try:
        value, error = pickle.loads(typesetting.answer(pickle.dumps((name, arguments)), budget))
    except ProcessEnded as end:
        if end.code == -SIGABRT:  # So it ends without memory.
            words = "the paper must have fewer pages: setting it takes more than {most} of memory"
            raise TooMuchWork.in_words("dance", words, most=Quantity(MEMORY_MAX / 1e6, "MB", 6)) from None
        value, error = None, str(end)
    if error:
        raise NotTypeset(say("the paper was not set, because the typesetter failed: {why}", why=error))
    return value


@cache
def _families() -> frozenset[str]:
    return frozenset(_asked(None, "families"))


@dataclass(frozen=True)
class Face:
    """Font families in order: a character is set in the first one that has it, or else in any font that has it."""

    families: tuple[str, ...]

    def width(self, words: str, size: float, bold: bool = False) -> float:
        """Width of a text [mm]. size: of its type [pt]"""
        widths = _widths(self.families, bold)
        if new := set(words) - widths.keys():
            if len(widths) > WIDTHS_MOST:
                _widths.cache_clear()  # What is kept here goes on for this text.
            texts = sorted(new)
            data = {"weight": "bold" if bold else "regular", "texts": texts}
            widths.update(zip(texts, measured(WIDTHS, self, data), strict=True))
        return POINT * size * sum(widths[character] for character in words)


@cache
def _widths(families: tuple[str, ...], bold: bool) -> dict[str, float]:
    return {}


def face_for(texts: Iterable[str]) -> Face:
    """A face for these texts beside words in the language that is spoken.

    raises: MissingPackage for Chinese where no font on this machine has its characters
    """
    if language_of(texts) is not Language.CHINESE:
        return Face((LATIN,))
    chinese = chinese_among(_families())
    return Face((chinese, LATIN) if spoken() is Language.CHINESE else (LATIN, chinese))


def _files(template: bytes, face: Face, data: Mapping[str, Any]) -> dict[str, bytes]:
    """A template, what it may import, and its data with the names of the fonts and the language that is spoken."""
    words = orjson.dumps({**data, "fonts": face.families, "language": spoken()})
    return {
        "main.typ": template,
        "paper.typ": files("app.files").joinpath("paper.typ").read_bytes(),
        "data.json": words,
    }


def measured(template: bytes, face: Face, data: Mapping[str, Any], budget: Budget | None = None) -> Any:
    """What a template says under the label measured. raises: Halted once the budget is stopped"""
    return _asked(budget, "measured", _files(template, face, data))


def typeset(template: bytes, face: Face, data: Mapping[str, Any], budget: Budget | None = None) -> bytes:
    """The bytes of a PDF. raises: Halted once the budget is stopped"""
    content: bytes = _asked(budget, "pdf", _files(template, face, data))
    return content
