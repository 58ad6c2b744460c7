"""Text of requests: files and bodies as text, and JSON that states every name of an object once."""

from __future__ import annotations

import codecs
import json
import re
import sys
import tomllib
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any, Self

from app.wire.fields import is_deeper, short_json
from core import InvalidValue
from core.quantities import Given, Value

# Escapes for the character NUL and for halves of characters; a text that holds one is refused.
ESCAPES = re.compile(r"\\u(?:0000|[dD][89a-fA-F])")
# First bytes of workbooks: .xls and encrypted ones; and .xlsx and .ods, which are archives.
OLD_WORKBOOK = bytes.fromhex("d0cf11e0a1b11ae1")
WORKBOOKS = (b"PK", OLD_WORKBOOK)
# Encoding of Chinese versions of Excel.
CHINESE = "gb18030"
NO_TEXT = re.compile("[\0\ud800-\udfff]")
# Deepest nesting of objects and lists, of which no request has ten; pydantic and orjson write 254 (2026-11-27).
DEPTH_MAX = 100
# A name in TOML with more parts than this, as in a."b".c: memory and time to read one grow with the square of them.
NAME_PARTS_MAX = 20
LONG_NAME = re.compile(
    rf"""(?<![\w-])(?:(?:[\w-]++|"(?:[^"\\\n]|\\.)*+"|'[^'\n]*+')[ \t]*+\.[ \t]*+){{{NAME_PARTS_MAX}}}"""
)

# Longest whole number of TOML 1.0, which Python reads without a limit if it is in hexadecimal digits.
INTEGER_BITS = 64

# What a spreadsheet takes for the beginning of a formula (OWASP, CSV injection), perhaps behind blanks and our own
# mark: at the beginning of a text, and behind what separates the entries of a line elsewhere.
FORMULA = "(['\"\\s\u00a0\u200b\u3000\ufeff]*[=+\\-@\t\r\uff1d\uff0b\uff0d\uff20])"
TO_CELL, OF_CELL = f"(^|[;\t]){FORMULA}", f"(^|[;\t])'{FORMULA}"


def text_to_cell(text: str) -> str:
    """A text as an entry of CSV that no spreadsheet runs: with ' before what could be a formula.

    >>> text_to_cell("=1+1"), text_to_cell("Li's"), text_to_cell("'=1"), text_to_cell("x;=1")
    ("'=1+1", "Li's", "''=1", "x;'=1")
    """
    return re.sub(TO_CELL, r"\1'\2", text)


def text_of_cell(cell: str) -> str:
    """The text that text_to_cell() wrote; any other one unchanged.

    >>> text_of_cell("'=1+1"), text_of_cell("'quoted'")
    ('=1+1', "'quoted'")
    """
    return re.sub(OF_CELL, r"\1\2", cell)


class Unreadable(InvalidValue):
    """Bytes that are not text, or text in an unknown form; {text} in the template is the name of what was read."""

    @classmethod
    def that(cls, words: str, reason: str = "", **values: Value) -> Self:
        """words: the rest of the template, such as "is not JSON"."""
        return cls.in_words("text", f"{{text}} {words}", reason=reason, text="the text", **values)

    def of(self, field: str, text: str) -> Self:
        """The same error of a text with this name. field: the parameter that gives it"""
        return self.renamed(lambda _: field, text=text)


class Unfit(Unreadable):
    """JSON that repeats a name, or holds an invalid text."""


def text_of(data: bytes) -> str:
    """Text in UTF-8, or in UTF-16 with a byte order mark, as Windows saves it. raises: Unreadable"""
    marked = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        return data.decode("utf-16" if marked else "utf-8-sig")
    except UnicodeDecodeError as error:
        byte, place = f"{data[error.start]:#04x}", error.start
        reason = "byte {byte} at position {place}"
        raise Unreadable.that("is not text in UTF-8", reason, byte=byte, place=place) from error


def is_workbook(data: bytes) -> bool:
    """True for an archive whose directory names the main part of a workbook (.xlsx)."""
    return data.startswith(b"PK") and b"xl/workbook.xml" in data


def table_of(data: bytes) -> tuple[str, bool]:
    """Text of a table as spreadsheets save it: as text_of(), otherwise in GB 18030, and whether it is that.

    raises: Unreadable, also for a workbook
    """
    if data.startswith(WORKBOOKS):
        raise Unreadable.that("is a workbook", "save its sheet as CSV")
    try:
        return text_of(data), False
    except Unreadable as error:
        with suppress(UnicodeDecodeError):
            text = data.decode(CHINESE)
            if not NO_TEXT.search(text):
                return text, True
        raise error


def json_of(data: bytes) -> Any:
    """The value of JSON. raises: Unreadable"""
    text = text_of(data)
    with _refusing():
        value = json.loads(text, object_pairs_hook=_once)
    if ESCAPES.search(text):
        _refuse_no_text(value)
    return value


def toml_of(data: bytes) -> dict[str, Any]:
    """The values of TOML. raises: Unreadable"""
    text = text_of(data)
    if LONG_NAME.search(text):
        raise Unreadable.that("has a name of more than {most} parts", most=NAME_PARTS_MAX)
    with _refusing():
        value = tomllib.loads(text)
    refuse_deep(value)
    if any(isinstance(one, int) and one.bit_length() > INTEGER_BITS for one in values_in(value)):
        raise Unreadable.that("has a whole number of more than {most} bits", most=INTEGER_BITS)
    return value


def refuse_deep(value: Any) -> None:
    """Refuse objects and lists that nest deeper than DEPTH_MAX, which nothing could write again. raises: Unreadable"""
    if is_deeper(value, DEPTH_MAX):
        raise Unreadable.that("nests objects and lists more than {most} deep", most=DEPTH_MAX)


@contextmanager
def _refusing() -> Iterator[None]:
    try:
        yield
    except Unreadable:
        raise
    except json.JSONDecodeError as error:
        why = error.msg.removesuffix(" at")
        raise Unreadable.that("is not JSON", "{why} at character {place}", why=why, place=error.pos) from error
    except tomllib.TOMLDecodeError as error:
        raise Unreadable.that("is not TOML", "{why}", why=str(error)) from error
    except RecursionError as error:
        raise Unreadable.that("nests too many objects and lists in one another") from error
    except ValueError as error:  # Python reads no longer numbers.
        most = sys.get_int_max_str_digits()
        raise Unreadable.that("has a whole number of more than {most} digits", most=most) from error


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    entries = dict(pairs)
    if len(entries) < len(pairs):
        name = next(name for name, times in Counter(name for name, _ in pairs).items() if times > 1)
        raise Unfit.that("has an object with the name {name} more than once", name=Given(name, short_json(name)))
    return entries


def values_in(value: Any) -> Iterator[Any]:
    """Names, texts, numbers and other single values in objects and lists."""
    left = [value]
    while left:
        one = left.pop()
        if isinstance(one, dict):
            left += [*one, *one.values()]
        elif isinstance(one, list):
            left += one
        else:
            yield one


def _refuse_no_text(value: Any) -> None:
    for one in values_in(value):
        if isinstance(one, str) and NO_TEXT.search(one):
            raise Unfit.that("has a text with NUL or half of a character, near {near}", near=f"{one[:40]!a}")
