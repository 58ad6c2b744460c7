"""Names of files that any output can carry.

A ZIP of Windows with Chinese names, unpacked on Linux, leaves names in GBK. Python keeps their bytes as lone
surrogates, which no JSON, CSV or workbook can hold. State: none.
"""

from __future__ import annotations

from contextlib import suppress

from app.grade.words import Note, note

# Encoding of Chinese Windows: GBK and its extensions.
CHINESE = "gb18030"


def readable_name(name: str) -> tuple[str, Note | None]:
    """A name in characters, and a remark if its bytes had to be interpreted. Each folder of it has its own encoding.

    >>> readable_name("class/\\udcc0\\udcee/result1.xlsx")[0]
    'class/李/result1.xlsx'
    >>> readable_name("\\udcff.csv")[0]
    '\\\\xff.csv'
    """
    parts = [_readable(part) for part in name.split("/")]
    codes = [code for _, code in parts if code]
    remark = note("name_escaped" if "name_escaped" in codes else codes[0]) if codes else None
    return "/".join(part for part, _ in parts), remark


def _readable(part: str) -> tuple[str, str]:
    """One part of a path, and the name of the remark on it; empty for a part that is as it was."""
    with suppress(UnicodeEncodeError):
        part.encode()
        return part, ""
    try:
        data = part.encode(errors="surrogateescape")
    except UnicodeEncodeError:  # A surrogate that stands for no byte, as names on Windows may have.
        return part.encode(errors="backslashreplace").decode(), "name_escaped"
    with suppress(UnicodeDecodeError):
        chinese = data.decode(CHINESE)
        if chinese.isprintable():
            return chinese, "name_coded"
    return data.decode(errors="backslashreplace"), "name_escaped"
