"""Files that the command reads and writes."""

from __future__ import annotations

import contextlib
import errno
import os
import sys
import tempfile
import tomllib
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import orjson

from app.files import tables
from app.wire.messages import OBJECT, shown
from core import InvalidValue, Trajectory

# Permissions of a new file, before the user's mask.
NEW_FILE = 0o666
# Endings that trajectory_writer() supports.
TABLE_ENDINGS = (".csv", ".xlsx", ".arrow", ".json")
# Endings of a file that describes a dance.
DANCE_ENDINGS = (".toml", ".json")


def checked_output(option: str, file: Path, endings: Sequence[str] = ()) -> str:
    """The ending of the file named by an option, checked before any work is done.

    option: its name; endings: the allowed ones in lower case; if there are none, any ending is allowed
    raises: InvalidValue for another ending; OSError if the file cannot be written
    """
    ending = file.suffix.lower()
    if endings and ending not in endings:
        *most, last = endings
        words = f"{', '.join(most)} or {last}" if most else last
        raise InvalidValue(option, f"--{option} must end in {words}, got {ending or 'no ending'}")
    if file.is_dir():
        raise _refused(errno.EISDIR, file)
    target = file.resolve()
    if not target.parent.is_dir():
        raise InvalidValue(option, f"--{option} must be in a folder that exists, got {file}")
    # An existing file is written or replaced only if the user may do both.
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
            return
        _replace(target, data)
    except OSError as error:
        raise _refused(error.errno, file) from error


def _replace(target: Path, data: bytes) -> None:
    mask = os.umask(0)
    os.umask(mask)
    mode = target.stat().st_mode & 0o7777 if target.exists() else NEW_FILE & ~mask
    handle, name = tempfile.mkstemp(prefix=f".{target.name[:100]}-", dir=target.parent)
    try:
        with os.fdopen(handle, "wb") as sink:
            os.fchmod(sink.fileno(), mode)
            sink.write(data)
            sink.flush()
            os.fsync(sink.fileno())
        os.replace(name, target)
    except BaseException:
        with contextlib.suppress(FileNotFoundError):
            os.unlink(name)
        raise


def _refused(number: int | None, file: Path) -> OSError:
    return OSError(number, os.strerror(number or errno.EIO), str(file))


def read_json(file: Path) -> dict[str, Any]:
    """The JSON object in a file, or on standard input for -. raises: InvalidValue, OSError"""
    try:
        found = orjson.loads(sys.stdin.buffer.read() if str(file) == "-" else file.read_bytes())
    except orjson.JSONDecodeError as error:
        raise InvalidValue("file", f"{file} is not JSON: {error}") from error
    if not isinstance(found, dict):
        raise InvalidValue("file", f"{file} must hold a JSON object, got {shown(found)}")
    return found


def read_dance(file: Path) -> dict[str, Any]:
    """Content of a file that describes a dance; a venue given as text is the name of a GeoJSON file beside it.

    raises: InvalidValue, OSError
    """
    ending = file.suffix.lower()
    if ending not in DANCE_ENDINGS and file.is_file():
        raise InvalidValue("file", f"{file} must end in {' or '.join(DANCE_ENDINGS)}, got {ending or 'no ending'}")
    if ending != ".toml":
        asked = read_json(file)
    else:
        try:
            asked = tomllib.loads(file.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise InvalidValue("file", f"{file} is not TOML: {error}") from error
    if not asked:
        print(f"{file} gives nothing: this is about the contest's dance.", file=sys.stderr)
    if isinstance(asked.get("venue"), str):
        place = file.parent / asked["venue"]
        try:
            asked["venue"] = read_json(place)
        except OSError as error:
            raise InvalidValue("venue", f"venue of {file}: {place}: {error.strerror}") from error
    return asked


def object_words(file: Path) -> str:
    """What the format of a file calls an object."""
    return "a table" if file.suffix.lower() == ".toml" else OBJECT


def trajectory_writer(suffix: str, decimals: int | None, language: tables.Language) -> Callable[[Trajectory], bytes]:
    """Function that turns a trajectory into the bytes of a file with that suffix."""
    match suffix:
        case ".json":
            return lambda result: tables.trajectory_json(result, decimals=decimals)
        case ".csv":
            return lambda result: tables.trajectory_csv(result, decimals=decimals)
        case ".arrow":
            return lambda result: tables.trajectory_arrow(result, decimals=decimals)
        case ".xlsx":
            return lambda result: tables.trajectory_xlsx(result, decimals=decimals, language=language)
    raise InvalidValue("output", f"--output must end in {', '.join(TABLE_ENDINGS)}, got {suffix or 'no ending'}")
