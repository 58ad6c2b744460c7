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

import orjson

from app.files import tables
from core import InvalidValue, Trajectory

# What a new file may be read and written by, before the user's mask.
NEW_FILE = 0o666
# What trajectory_writer() writes.
TABLE_ENDINGS = (".csv", ".xlsx", ".arrow", ".json")


def checked_output(option: str, file: Path, endings: Sequence[str] = ()) -> str:
    """The ending of a file that an option names, before any work is done for it.

    option: its name; endings: those that it may have, in lower case; any if there are none
    raises: InvalidValue for another ending; OSError where no file can be written
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
    # What is there is written to, or replaced, only by who may do both.
    touched = [target] if target.exists() else []
    if not touched or target.is_file():
        touched.append(target.parent)
    if not all(os.access(place, os.W_OK) for place in touched):
        raise _refused(errno.EACCES, file)
    return ending


def write_whole(file: Path, data: bytes) -> None:
    """The file with these bytes, there whole or not at all: what stood there before is kept until then.

    A temporary file in the same folder takes its place at once. A link is followed, an existing file keeps its mode,
    and what is no file (a device, a pipe) is written to as it is.
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


def read_json(file: Path) -> object:
    try:
        return orjson.loads(sys.stdin.buffer.read() if str(file) == "-" else file.read_bytes())
    except orjson.JSONDecodeError as error:
        raise InvalidValue("file", f"{file} is not JSON: {error}") from error


def read_dance(file: Path) -> object:
    """What a file of a dance holds; a venue given as text is the name of a GeoJSON file beside it."""
    if file.suffix.lower() != ".toml":
        asked = read_json(file)
    else:
        try:
            asked = tomllib.loads(file.read_text(encoding="utf-8"))
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise InvalidValue("file", f"{file} is not TOML: {error}") from error
    if isinstance(asked, dict) and isinstance(asked.get("venue"), str):
        asked["venue"] = read_json(file.parent / asked["venue"])
    return asked


def trajectory_writer(suffix: str, decimals: int | None, language: tables.Language) -> Callable[[Trajectory], bytes]:
    """What turns a trajectory into the bytes of a file with that suffix."""
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
