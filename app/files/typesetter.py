"""Typesetting in a separate process: python -m app.start app.files.typesetter BYTES

Nothing can stop Typst, and what it has read of a file it keeps. So a process typesets one file after another with low
priority, is killed at the deadline or when the client is gone, and ends once it has needed much memory. Its address
space has a limit, BYTES. The process that asks never imports Typst.

task    a function of this module by its name, and its arguments
answer  its value, or the words of its error
"""

from __future__ import annotations

import os
import pickle
import sys
from contextlib import suppress
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import orjson

from app.processes.limits import AWAITED_NICENESS, end_first, limit_memory, lower_priority
from app.processes.parent import Report, answer_tasks

if TYPE_CHECKING:
    import typst


@cache
def _typst() -> Any:
    """The typesetter. Where it cannot be imported, the first task has the reason as its answer."""
    return import_module("typst")


@cache
def _fonts() -> typst.Fonts:
    """The fonts of this machine, and those that come with matplotlib, which is not imported for them."""
    package = find_spec("matplotlib")
    places = (package.submodule_search_locations if package else None) or ()
    folders = [Path(place) / "mpl-data/fonts/ttf" for place in places]
    fonts: typst.Fonts = _typst().Fonts(include_embedded_fonts=False, font_paths=folders)
    return fonts


def families() -> list[str]:
    """Names of the fonts."""
    return _fonts().families()


def measured(files: Any) -> Any:
    """What the template main.typ says under the label measured. files: content by name"""
    options: dict[str, Any] = {"field": "value", "one": True}  # Typst's types know of no files by their names.
    return orjson.loads(_typst().query(files, "<measured>", font_paths=_fonts(), ignore_system_fonts=True, **options))


def pdf(files: Any) -> bytes:
    """The bytes of a PDF that can be read aloud, of the template main.typ. files: content by name"""
    data: bytes = _typst().compile(
        files, font_paths=_fonts(), ignore_system_fonts=True, timestamp=0, pdf_standards=["ua-1"]
    )
    return data


FUNCTIONS = {function.__name__: function for function in (families, measured, pdf)}


def _answer(task: bytearray, report: Report) -> bytes:
    name, arguments = pickle.loads(task)
    try:
        return pickle.dumps((FUNCTIONS[name](*arguments), ""))
    except MemoryError:
        os.abort()  # as Rust does
    except BaseException as error:  # A panic of Rust is no Exception.
        return pickle.dumps((None, str(error)))


def main() -> None:
    """Typeset files until the parent ends."""
    lower_priority(AWAITED_NICENESS)
    end_first()
    limit_memory(int(sys.argv[1]))
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # Without memory Rust writes its stack there; all else is an answer.
    with suppress(Exception):
        _typst()
    answer_tasks(_answer)
