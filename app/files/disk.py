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
from app.wire.fields import short_json
from app.wire.messages import OBJECT
from app.wire.texts import Unreadable, json_of
from core import InvalidValue
from core.language import Listed, Phrases, say
from core.quantities import Given, Parameter

# What systems say of a file that cannot be used.
SYSTEM: Phrases = {
    "ENOENT": "No such file or directory",
    "EACCES": "Permission denied",
    "EEXIST": "File exists",
    "EISDIR": "Is a directory",
    "ENOTDIR": "Not a directory",
    "ENOSPC": "No space left on device",
    "EROFS": "Read-only file system",
    "ENAMETOOLONG": "File name too long",
}


def why_not(error: OSError) -> str:
    """Why a file cannot be used, in the words of the system."""
    return say(error.strerror) if error.strerror else str(error)


def ending_of(file: Path) -> str:
    """The ending of a file's name, as ".csv", in lower case; empty for "dance" and for "dance.".

    Without removesuffix() "dance." would have the ending "." on some versions of Python, and none on others.
    """
    return file.suffix.lower().removesuffix(".")


def checked_output(option: str, file: Path, endings: Sequence[str] = ()) -> str:
    """The ending of the file that an option names. The file is checked here, before any work is done.

    option: its name; endings: the allowed ones, in lower case; empty: any ending is allowed
    raises: InvalidValue for another ending; OSError if the file cannot be written
    """
    ending = ending_of(file)
    if endings and ending not in endings:
        *others, last = endings
        allowed = f"{Listed(others)}{say(' or ')}{last}" if others else last
        words, got = "--{option} must end in {endings}", ending or "no ending"
        raise InvalidValue.in_words(option, words, got=got, option=Parameter(option), endings=allowed)
    if file.is_dir():
        raise _os_error(errno.EISDIR, file)
    target = file.resolve()
    if not target.parent.is_dir():
        words = "--{option} must be in a folder that exists"
        raise InvalidValue.in_words(option, words, got=Given(file, str(file)), option=Parameter(option))
    # write_whole() puts a new file into the folder, in the place of the old one; only a device or a pipe is written to
    # directly. An old file that is read-only must not be replaced either.
    written = [target] if target.exists() else []
    if not written or target.is_file():
        written.append(target.parent)
    if not all(os.access(place, os.W_OK) for place in written):
        raise _os_error(errno.EACCES, file)
    return ending


def write_whole(file: Path, data: bytes) -> None:
    """Write a file completely or not at all; an existing file is kept until the new one is complete.

    The data goes into a temporary file in the same folder, which takes the place of the file in one step. A link is
    followed, an existing file keeps its mode, and a device or a pipe is written to directly.
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
        raise _os_error(error.errno, file) from error


def _os_error(number: int | None, file: Path) -> OSError:
    """The system's error of that number about this file, by the name that the user gave."""
    return OSError(number, os.strerror(number or errno.EIO), str(file))


@cache
def standard_input() -> bytes:
    """All of standard input, kept because it can be read only once and several figures may be of its dance."""
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
    """What a message calls an object in this file: TOML has tables."""
    return "a table" if ending_of(file) == ".toml" else OBJECT
