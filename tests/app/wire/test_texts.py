"""Text of files and bodies: encodings that Windows writes are read, and a refusal says what is wrong."""

import codecs
import random

import pytest

from app.wire.texts import Unfit, Unreadable, json_of, text_of, text_of_cell, text_to_cell, toml_of

DANCE = '{"path": {"pitch": 0.5}, "venue": "广场"}'


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_text_of_windows_is_read(encoding):
    assert json_of(DANCE.encode(encoding)) == {"path": {"pitch": 0.5}, "venue": "广场"}
    assert toml_of('venue = "广场"'.encode(encoding)) == {"venue": "广场"}
    assert text_of("长度".encode(encoding)) == "长度"


def test_utf_16_is_known_by_its_mark_in_either_order():
    assert json_of(codecs.BOM_UTF16_BE + DANCE.encode("utf-16-be")) == json_of(DANCE.encode())


JSON_FAULTS = {
    b'{"a": 1 2}': "is not JSON: Expecting ',' delimiter at character 8",
    b'{"a': "is not JSON: Unterminated string starting at character 1",
    b'{"a": \xff}': "is not text in UTF-8: byte 0xff at position 6",
    b"[" * 100_000: "nests too many objects and lists in one another",
    b"9" * 5000: "has a whole number of more than 4300 digits",
}
# JSON that fits no request.
UNFIT = {
    b'{"p": {"x": 1, "y": 2, "x": 1}}': 'has an object with the name "x" more than once',
    b'{"a": ["x\\u0000y"]}': "has a text with NUL or half of a character, near 'x\\x00y'",
    b'{"\\ud800": 1}': "has a text with NUL or half of a character, near '\\ud800'",
}
TOML_FAULTS = {
    b"a =": "is not TOML: Invalid value (at end of document)",
    b"a = 1\na = 2": "is not TOML: Cannot overwrite a value (at end of document)",
    b"a = " + b"[" * 100_000: "nests too many objects and lists in one another",
    b"a = " + b"[" * 101 + b"]" * 101: "nests objects and lists more than 100 deep",
    b"a." * 20 + b"a = 1": "has a name of more than 20 parts",
    b"['a' . " + b'"\\"b" .c.' * 10 + b"d]": "has a name of more than 20 parts",
    b"a = " + b"9" * 5000: "has a whole number of more than 4300 digits",
    b"a = [{b = 0x" + b"f" * 17 + b"}]": "has a whole number of more than 64 bits",
    b"a = '\xff'": "is not text in UTF-8: byte 0xff at position 5",
}


@pytest.mark.parametrize(
    "read, faults",
    [(json_of, JSON_FAULTS), (json_of, UNFIT), (toml_of, TOML_FAULTS)],
    ids=["JSON", "unfit", "TOML"],
)
def test_an_unreadable_text_is_refused_with_its_fault(read, faults):
    for data, words in faults.items():
        with pytest.raises(Unreadable) as refused:
            read(data)
        assert str(refused.value) == f"the text {words}"
        assert str(refused.value.of("file", "dance.json")) == f"dance.json {words}"
        assert isinstance(refused.value, Unfit) == (faults is UNFIT)


def test_a_whole_character_in_two_escapes_is_text():
    assert json_of(b'{"a": "\\ud83d\\udc09"}') == {"a": "\N{DRAGON}"}


def test_short_names_and_shallow_lists_are_read():
    assert toml_of(b"a." * 19 + b"a = 1")["a"]
    assert toml_of(b'text = "' + b"a.b " * 30 + b'"')
    assert toml_of(b"a = " + b"[" * 99 + b"]" * 99)


@pytest.mark.parametrize(
    "text, cell",
    [
        (" =1+1", "' =1+1"),
        ("x;=HYPERLINK(1)", "x;'=HYPERLINK(1)"),
        ('x;"=1+1;y', "x;'\"=1+1;y"),
        ("x\t@SUM(1)", "x\t'@SUM(1)"),
        ("\u3000=1", "'\u3000=1"),
        ("x, -1", "x, -1"),
        ("Li's", "Li's"),
    ],
)
def test_no_part_of_a_cell_is_a_formula(text, cell):
    assert text_to_cell(text) == cell


def test_every_text_comes_back_from_its_cell():
    chance = random.Random(7)
    for _ in range(20_000):
        text = "".join(chance.choices("'=+-@;\t \r,x\u200b\uff1d", k=chance.randrange(9)))
        cell = text_to_cell(text)
        assert text_of_cell(cell) == text
        assert not any(
            part.strip("\u200b ")[:1] in set("=+-@\uff1d") for part in cell.split(";") if part.strip("\u200b ")
        )
