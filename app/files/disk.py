"""Files that the command reads and writes."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

from app.files.flush import new_file
from app.wire.messages import OBJECT
from app.wire.question import short_json
from app.wire.texts import Unreadable, json_of
from core import InvalidValue
from core.errors import Given


def ending_of(file: Path) -> str:
    """The ending of a name with its point, in lower case; empty for "dance" and, on every Python, for "dance."."""
    return file.suffix.lower().removesuffix(".")


def checked_output(option: str, file: Path, endings: Sequence[str] = ()) -> str:
    """The ending of the file named by an option, checked before any work is done.

    option: its name; endings: the allowed ones in lower case; none: any ending is allowed
    raises: InvalidValue for another ending; OSError if the file cannot be written
    """
    ending = ending_of(file)
    if endings and ending not in endings:
        *most, last = endings
        words = f"{', '.join(most)} or {last}" if most else last
        values = {"got": ending or "no ending", "option": option, "endings": words}
        raise InvalidValue.in_words(option, "--{option} must end in {endings}", **values)
    if file.is_dir():
        raise _refused(errno.EISDIR, file)
    target = file.resolve()
    if not target.parent.is_dir():
        words = "--{option} must be in a folder that exists"
        raise InvalidValue.in_words(option, words, got=str(file), option=option)
    # An existing file may be replaced only by a user who may write both it and its folder.
    touched = [target] if target.exists() else []
    if not touched or target.is_file():
        touched.append(target.parent)
    if not all(os.access(place, os.W_OK) for place in touched):
        raise _refused(errno.EACCES, file)
    return ending


def write_whole(file: Path, data: bytes) -> None:
    """Write a file completely or not at all; an existing file is kept until the new one is complete.

    A temporary file in the same folder then replaces it in one step. A link is followed, an existing file keeps its
    mode, and a device or a pipe is written to directly.
    raises: OSError naming the file
    """
    target = file.resolve()
    try:
        if target.exists() and not target.is_file():
            target.write_bytes(data)
        else:
            with new_file(target.parent, f".{target.name[:100]}-", target) as sink:
                sink.write(data)
    except OSError as error:
        raise _refused(error.errno, file) from error


def _refused(number: int | None, file: Path) -> OSError:
    return OSError(number, os.strerror(number or errno.EIO), str(file))


@cache
def standard_input() -> bytes:
    """All of standard input, also for the second of two figures of its dance."""
    return sys.stdin.buffer.read()


def display_name(file: Path) -> str:
    """The name of a file in a message; - is standard input."""
    return "standard input" if str(file) == "-" else str(file)


def read_json(file: Path) -> dict[str, Any]:
    """The JSON object in a file, or on standard input for -. raises: InvalidValue, OSError"""
    try:
        value = json_of(standard_input() if str(file) == "-" else file.read_bytes())
    except Unreadable as error:
        raise error.of("file", display_name(file)) from error
    if not isinstance(value, dict):
        words = "{file} must hold a JSON object"
        raise InvalidValue.in_words("file", words, got=Given(value, short_json(value)), file=display_name(file))
    return value


def object_words(file: Path) -> str:
    """Word for an object in the format of a file."""
    return "a table" if ending_of(file) == ".toml" else OBJECT
