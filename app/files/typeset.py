"""Paper as tagged PDF, set by Typst: a template and data in, the bytes of a file out.

The data are JSON, which the template reads from data.json: no text becomes markup. Pictures in them are SVG. Equal data
give equal bytes on the same fonts and the same version of Typst, because the file holds no date.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from contextlib import suppress
from ctypes import CDLL
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import orjson
import typst

from app.files.fonts import LATIN, chinese_among, language_of
from app.files.turns import Turns
from core import Budget
from core.language import Language, spoken

# Millimetres in a point of type.
POINT = 25.4 / 72.0
# One file at a time, because each takes as much memory as it has pages. Typst lets other threads of Python go on.
in_turn = Turns("typesetting")
# Number of files for which Typst keeps parts that may be used again.
FILES_KEPT = 10
# Characters whose widths are kept.
WIDTHS_MOST = 20_000
# Width of each character in type of 1 pt [pt]; between two others, because a blank alone has none.
MEASURE = b"""
#let data = json("data.json")
#set text(font: data.fonts, size: 100pt, weight: data.weight)
#context {
  let wide(words) = measure(text(words)).width.pt()
  [#metadata(data.texts.map(one => (wide("|" + one + "|") - wide("||")) / 100)) <widths>]
}
"""


@cache
def _fonts() -> typst.Fonts:
    """The fonts of this machine, and those that come with matplotlib, which is not imported for them."""
    package = find_spec("matplotlib")
    places = (package.submodule_search_locations if package else None) or ()
    folders = [Path(place) / "mpl-data/fonts/ttf" for place in places]
    return typst.Fonts(include_embedded_fonts=False, font_paths=folders)


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
            data = {"fonts": self.families, "weight": "bold" if bold else "regular", "texts": sorted(new)}
            files: Any = {"main.typ": MEASURE, "data.json": orjson.dumps(data)}
            options: dict[str, Any] = {"field": "value", "one": True}
            measured = typst.query(files, "<widths>", font_paths=_fonts(), ignore_system_fonts=True, **options)
            widths.update(zip(sorted(new), orjson.loads(measured), strict=True))
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
    chinese = chinese_among(_fonts().families())
    return Face((chinese, LATIN) if spoken() is Language.CHINESE else (LATIN, chinese))


def typeset(template: bytes, face: Face, data: Mapping[str, Any], budget: Budget | None = None) -> bytes:
    """The bytes of a PDF. The template also gets the names of the fonts and the code of the language that is spoken.

    raises: Halted once the budget is stopped; what has begun goes on for nobody
    """
    content = orjson.dumps({**data, "fonts": face.families, "language": spoken()})
    files = {"main.typ": template, "data.json": content}

    def compiled() -> bytes:
        try:
            return _compiled(files)
        except BaseException as error:  # A panic of Rust is no Exception, and ends a thread that does not expect it.
            raise RuntimeError(f"the file was not typeset: {error}") from error

    try:
        return in_turn(compiled, budget)
    finally:
        in_turn.after(_forget)


def _compiled(files: Any) -> bytes:  # Typst's types know of no files by their names.
    data: bytes = typst.compile(files, font_paths=_fonts(), ignore_system_fonts=True, timestamp=0)
    return data


def _forget() -> None:
    """Give back what Typst keeps of files, up to 60 MB of each: it forgets what FILES_KEPT files did not use."""
    for _ in range(FILES_KEPT + 1):
        _compiled({"main.typ": b""})
    with suppress(AttributeError, OSError, TypeError):  # Only the C library of GNU keeps freed memory for itself.
        CDLL(None).malloc_trim(0)
