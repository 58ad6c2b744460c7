"""XML of strangers, read by expat without a tree and without trust.

A document type is refused, so a file can define no entities and cannot grow in memory by them. A tag has a largest
length, because expat keeps all of it and makes a dictionary of its attributes: 1.5 million of them took 1 GB and 60 s
(2026-11-26).
"""

from __future__ import annotations

import codecs
import re
from collections.abc import Callable, Iterable, Mapping
from xml.parsers import expat

from core import InvalidValue
from core.quantities import Given

# Longest tag, comment or instruction [bytes].
TAG_MAX = 200_000
PIECE = 1 << 16
# Deepest nesting of elements.
DEPTH_MAX = 60
NO_MEMORY = 1  # XML_ERROR_NO_MEMORY of expat
DECLARED = re.compile(rb"""<\?xml[^>]{0,200}?\sencoding\s*=\s*["']([\w.:-]{1,40})["']""")
MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
    (b"<\0", "utf-16-le"),
    (b"\0<", "utf-16-be"),
)
# Encodings of map programs, by their names in Python. Others, such as UTF-7, are refused.
ENCODINGS = re.compile(
    r"utf-8|utf-16(-[lb]e)?|ascii|iso8859-\d+|cp(125\d|866|874|932|936|949|950)|koi8-[ru]|"
    r"gb2312|gbk|gb18030|big5(hkscs)?|shift_jis|euc_(jp|kr)|mac-roman"
)
# Programs that write GB2312 and GBK mean the whole of GB 18030, which contains both.
WIDER = {"gb2312": "gb18030", "gbk": "gb18030", "big5": "big5hkscs", "shift_jis": "cp932", "euc_kr": "cp949"}


class LongTag(Exception):
    """A tag, comment or instruction of more than TAG_MAX bytes."""


def new_parser(refuse: Callable[..., object], separator: str, encoding: str | None = None) -> expat.XMLParserType:
    """A parser of expat. refuse: called for a document type; separator: between a namespace and a name

    encoding: of the text, whatever the text declares; None: as it declares
    """
    parser = expat.ParserCreate(encoding, separator)
    parser.StartDoctypeDeclHandler = parser.EntityDeclHandler = refuse
    return parser


def parse(parser: expat.XMLParserType, pieces: Iterable[bytes]) -> None:
    """Parse a document in pieces. raises: LongTag, expat.ExpatError, MemoryError, and what the handlers raise"""
    length = 0
    try:
        for piece in pieces:
            parser.Parse(piece, False)
            length += len(piece)
            # expat stays at the beginning of a tag until it has seen its end.
            if length - parser.CurrentByteIndex > TAG_MAX:
                raise LongTag
        parser.Parse(b"", True)
    except expat.ExpatError as error:
        if error.code == NO_MEMORY:
            raise MemoryError from error
        raise


# State:  `stack`, the names of the open elements; `text` of the innermost one, in pieces.
class Reader:
    """Takes the elements of a document while it is parsed, by their names without a namespace."""

    def __init__(self) -> None:
        self.stack: list[str] = []
        self.text: list[str] = []

    @property
    def around(self) -> str:
        """The innermost open element; empty without one."""
        return self.stack[-1] if self.stack else ""

    def begin(self, name: str, attributes: Mapping[str, str]) -> None:
        """Take the beginning of an element, which is open now."""
        raise NotImplementedError

    def finish(self, name: str, text: str) -> None:
        """Take the end of an element, which is open no more. text: between the last tag and its end"""
        raise NotImplementedError

    def start(self, name: str, attributes: Mapping[str, str], /) -> None:
        local = name.rpartition(" ")[2]
        self.stack.append(local)
        if len(self.stack) > DEPTH_MAX:
            raise InvalidValue("file", "must not nest elements deeper than {most}", most=DEPTH_MAX)
        self.text = []
        self.begin(local, attributes)

    def take(self, text: str, /) -> None:
        self.text.append(text)

    def end(self, name: str, /) -> None:
        self.finish(self.stack.pop(), "".join(self.text).strip())
        self.text = []


def read_document(data: bytes, reader: Reader, fault: str, forbidden: str) -> None:
    """Give the elements and texts of a whole XML document to a reader.

    fault: rule for what is no XML, with {fault} and {line}; forbidden: message for a document type
    raises: InvalidValue at the field `file`, and what the reader raises
    """

    def refuse(*declared: object) -> None:
        raise InvalidValue.in_words("file", forbidden)

    parser = new_parser(refuse, " ", "utf-8")
    parser.buffer_text = True
    parser.StartElementHandler, parser.EndElementHandler = reader.start, reader.end
    parser.CharacterDataHandler = reader.take
    try:
        parse(parser, in_pieces(as_utf8(data)))
    except LongTag as error:
        raise InvalidValue("file", "must not have a tag of more than {most} bytes", got="more", most=TAG_MAX) from error
    except expat.ExpatError as error:
        raise InvalidValue("file", fault, fault=expat.ErrorString(error.code), line=error.lineno) from error


def in_pieces(data: bytes) -> Iterable[bytes]:
    return (data[k : k + PIECE] for k in range(0, len(data), PIECE))


def states_encoding(data: bytes) -> bool:
    """True if the first bytes or the declaration of an XML document state its encoding."""
    return data.startswith(tuple(mark for mark, _ in MARKS)) or DECLARED.match(data[:400]) is not None


def as_utf8(data: bytes) -> bytes:
    """An XML document in UTF-8, from the encoding that its first bytes or its declaration state.

    raises: InvalidValue at the field `file` for an encoding that is not known, and for bytes that are not text in it
    """
    marked = next((coding for mark, coding in MARKS if data.startswith(mark)), None)
    name = marked or _declared(data)
    try:
        text = data.decode(name)
        return data if name in ("utf-8", "ascii") else text.encode()
    except UnicodeError as error:
        place = getattr(error, "start", 0)
        words = "must be text in the encoding that it states, {coding}, got a wrong byte at position {place}"
        raise InvalidValue("file", f"{words}: save it as UTF-8", coding=name, place=place) from error


def _declared(data: bytes) -> str:
    declared = DECLARED.match(data[:400])
    if declared is None:
        return "utf-8"
    stated = declared[1].decode("ascii", "replace")
    try:
        name = codecs.lookup(stated).name
    except LookupError:
        name = ""
    if not ENCODINGS.fullmatch(name):
        raise InvalidValue("file", "must be text in a usual encoding: save it as UTF-8", got=Given(stated, stated))
    # UTF-16 without a mark would have been recognised by its first bytes, so a declaration of it is wrong.
    return "utf-8" if name.startswith("utf-16") else WIDER.get(name, name)
