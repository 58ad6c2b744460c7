"""Messages between a process and its child: a kind, a length, and that number of bytes.

A parent sends a TASK. The child confirms it (RECEIVED), may report while it works (REPORT), and sends one answer:
ANSWER, or LAST if it shall not take another task.
"""

from __future__ import annotations

import struct
from enum import IntEnum
from io import BufferedIOBase, RawIOBase
from typing import IO

HEAD = struct.Struct("<BQ")


class MessageKind(IntEnum):
    """What a message is."""

    TASK, RECEIVED, REPORT, ANSWER, LAST = range(5)


def send(stream: IO[bytes], kind: MessageKind, data: bytes = b"") -> None:
    """Write one message. raises: OSError if nobody reads it"""
    stream.write(HEAD.pack(kind, len(data)))
    stream.write(data)
    stream.flush()


def receive(stream: RawIOBase | BufferedIOBase) -> tuple[MessageKind, bytearray]:
    """Kind and data of the next message. raises: EOFError where the stream ends, also amid a message"""
    kind, length = HEAD.unpack(_read(stream, HEAD.size))
    return MessageKind(kind), _read(stream, length)


def _read(stream: RawIOBase | BufferedIOBase, size: int) -> bytearray:
    data = bytearray(size)
    rest = memoryview(data)
    while rest:
        count = stream.readinto(rest)
        if not count:
            raise EOFError
        rest = rest[count:]
    return data
