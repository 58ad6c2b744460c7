"""XML of strangers: long tags and document types end the reading, and any usual encoding is read."""

import pytest

from app.files.markup import TAG_MAX, LongTag, as_utf8, in_pieces, new_parser, parse
from core import InvalidValue


def texts(data):
    """The text of a document."""
    entries = []

    def refuse(*declared):
        raise ValueError("declared")

    parser = new_parser(refuse, " ", "utf-8")
    parser.CharacterDataHandler = entries.append
    parse(parser, in_pieces(as_utf8(data)))
    return "".join(entries)


def test_long_texts_are_read_and_long_tags_are_not():
    assert len(texts(b"<a>" + b"x" * 10 * TAG_MAX + b"</a>")) == 10 * TAG_MAX
    assert texts(b"<a b='" + b"x" * (TAG_MAX - 100_000) + b"'>y</a>") == "y"
    for long in (
        b"<a b='" + b"x" * 2 * TAG_MAX + b"'/>",
        b"<a " + b" ".join(b'b%d=""' % k for k in range(TAG_MAX)) + b"/>",
        b"<a><!--" + b"-x" * TAG_MAX,
    ):
        with pytest.raises(LongTag):
            texts(long)


NAME = "广场"


@pytest.mark.parametrize("coding", ["GBK", "GB2312", "gb18030", "big5", "UTF-8", "utf-16", "Shift_JIS", "EUC-KR"])
def test_a_declared_encoding_is_read(coding):
    text = {"Shift_JIS": "広場", "EUC-KR": "광장", "big5": "廣場"}.get(coding, NAME)
    assert texts(f'<?xml version="1.0" encoding="{coding}"?><a>{text}</a>'.encode(coding)) == text


@pytest.mark.parametrize("coding", ["utf-16-le", "utf-16-be", "utf-8-sig"])
def test_an_encoding_is_recognised_by_its_first_bytes(coding):
    assert texts(f"<a>{NAME}</a>".encode(coding)) == NAME


@pytest.mark.parametrize("coding", ["utf-7", "punycode", "unicode_escape", "rot13", "base64", "x-own", "idna", "zlib"])
def test_an_unusual_encoding_is_named(coding):
    with pytest.raises(InvalidValue, match=f"must be text in a usual encoding, got {coding}: save it as UTF-8"):
        texts(f"<?xml version='1.0' encoding='{coding}'?><a/>".encode())


def test_bytes_that_are_not_text_in_their_encoding_are_reported():
    with pytest.raises(InvalidValue, match=r"that it states, utf-8, got a wrong byte at position 3: save it as UTF-8"):
        texts(b"<a>\xb9\xe3</a>")
