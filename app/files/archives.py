"""ZIP archives of strangers, read without trust in what their directory says.

`zipfile` unpacks bzip2 and LZMA without a largest length, and reads a whole part at the size that the directory states:
706 bytes of bzip2 became 1.6 GB (measured 2026-11-26). So a part is stored or deflated, and it is unpacked in pieces,
up to a limit, until it ends.
"""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Iterator
from copy import copy

# Length of a piece [bytes].
PIECE = 1 << 16
METHODS = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED)
# Bytes that begin an entry of a directory, and bit 0 of the flags of an encrypted part.
ENTRY, ENCRYPTED = b"PK\1\2", 1


class BadArchive(Exception):
    """An archive that is not read. code: broken, encrypted, method, parts or bomb; why: more words on a broken one"""

    def __init__(self, code: str, why: str = "") -> None:
        super().__init__(code, why)
        self.code, self.why = code, why


# What zipfile and zlib raise for broken archives: RuntimeError and NotImplementedError for what they do not support.
BROKEN = (zipfile.BadZipFile, zlib.error, EOFError, OSError, ValueError, RuntimeError, LookupError)


def opened(data: bytes, parts_max: int) -> zipfile.ZipFile:
    """The archive, whose parts are stored or deflated, and not encrypted. raises: BadArchive"""
    # Before the directory is read, because each entry of 46 bytes becomes an object of 600 bytes.
    if data.count(ENTRY) > parts_max:
        raise BadArchive("parts")
    try:
        archive = zipfile.ZipFile(io.BytesIO(data))
    except BROKEN as error:
        raise BadArchive("broken", str(error)) from error
    for part in archive.infolist():
        if part.flag_bits & ENCRYPTED:
            raise BadArchive("encrypted")
        if part.compress_type not in METHODS:
            raise BadArchive("method")
    return archive


def pieces_of(archive: zipfile.ZipFile, part: zipfile.ZipInfo, most: int) -> Iterator[bytes]:
    """A part in pieces, as long as it really is. most: its largest length [bytes]

    raises: BadArchive for a longer part, and for a length other than the directory states
    """
    length, whole = 0, copy(part)
    whole.file_size = most + 2 * PIECE  # zipfile reads no further than this, which is never reached.
    try:
        with archive.open(whole) as source:
            while piece := source.read(PIECE):
                length += len(piece)
                if length > most:
                    raise BadArchive("bomb")
                yield piece
    except BROKEN as error:
        raise BadArchive("broken", str(error)) from error
    if length != part.file_size:
        raise BadArchive("broken", f"{part.file_size} bytes stated, {length} found")
