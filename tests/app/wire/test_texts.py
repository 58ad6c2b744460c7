"""Text of files and bodies: encodings that Windows writes are read, and a refusal says what is wrong."""

from __future__ import annotations

import codecs
from collections.abc import Callable
from typing import Any

import pytest

from app.wire.texts import Unfit, Unreadable, json_of, text_of, toml_of

DANCE = '{"path": {"pitch": 0.5}, "venue": "广场"}'


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_text_of_windows_is_read(encoding: str) -> None:
    assert json_of(DANCE.encode(encoding)) == {"path": {"pitch": 0.5}, "venue": "广场"}
    assert toml_of('venue = "广场"'.encode(encoding)) == {"venue": "广场"}
    assert text_of("长度".encode(encoding)) == "长度"


def test_utf_16_is_known_by_its_mark_in_either_order() -> None:
    assert json_of(codecs.BOM_UTF16_BE + DANCE.encode("utf-16-be")) == json_of(DANCE.encode())


@pytest.mark.parametrize(
    ("read", "data", "words"),
    [
        (json_of, b'{"a": 1 2}', "is not JSON: Expecting ',' delimiter at character 8"),
        (json_of, b'{"a', "is not JSON: Unterminated string starting at character 1"),
        (json_of, b'{"a": \xff}', "is not text in UTF-8: byte 0xff at position 6"),
        (json_of, b"[" * 100_000, "nests too many objects and lists in one another"),
        (json_of, b"9" * 5000, "has a whole number of more than 4300 digits"),
        (toml_of, b"a =", "is not TOML: Invalid value (at end of document)"),
        (toml_of, b"a = 1\na = 2", "is not TOML: Cannot overwrite a value (at end of document)"),
        (toml_of, b"a = " + b"[" * 100_000, "nests too many objects and lists in one another"),
        (toml_of, b"a = " + b"9" * 5000, "has a whole number of more than 4300 digits"),
        (toml_of, b"a = '\xff'", "is not text in UTF-8: byte 0xff at position 5"),
    ],
)
def test_an_unreadable_text_is_refused_with_its_fault(read: Callable[[bytes], Any], data: bytes, words: str) -> None:
    with pytest.raises(Unreadable) as refused:
        read(data)
    assert str(refused.value) == f"the text {words}"
    assert str(refused.value.of("file", "dance.json")) == f"dance.json {words}"
    assert not isinstance(refused.value, Unfit)


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b'{"p": {"x": 1, "y": 2, "x": 1}}', 'has an object with the name "x" more than once'),
        (b'{"a": ["x\\u0000y"]}', "has a text with NUL or half of a character, near 'x\\x00y'"),
        (b'{"\\ud800": 1}', "has a text with NUL or half of a character, near '\\ud800'"),
    ],
)
def test_json_that_fits_no_request_is_refused(data: bytes, words: str) -> None:
    with pytest.raises(Unfit) as refused:
        json_of(data)
    assert str(refused.value) == f"the text {words}"
    assert str(refused.value.of("file", "dance.json")) == f"dance.json {words}"


def test_a_whole_character_in_two_escapes_is_text() -> None:
    assert json_of(b'{"a": "\\ud83d\\udc09"}') == {"a": "\N{DRAGON}"}
