"""Files that the command reads and writes."""

from __future__ import annotations

import errno
import os
import sys
from collections.abc import Sequence
from datetime import time
from functools import cache
from pathlib import Path
from typing import Any

from app.files.flush import new_file
from app.wire.messages import OBJECT
from app.wire.question import shown
from app.wire.texts import Unreadable, json_of, table_of, toml_of
from core import InvalidValue
from core.errors import Given, Parameter

# Endings of a file that describes a dance.
DANCE_ENDINGS = (".toml", ".json")


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
        told = {"got": ending or "no ending", "option": option, "endings": words}
        raise InvalidValue.in_words(option, "--{option} must end in {endings}", **told)
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
def _standard_input() -> bytes:
    """All of standard input, also for the second of two figures of its dance."""
    return sys.stdin.buffer.read()


def _name(file: Path) -> str:
    return "standard input" if str(file) == "-" else str(file)


def read_json(file: Path) -> dict[str, Any]:
    """The JSON object in a file, or on standard input for -. raises: InvalidValue, OSError"""
    try:
        found = json_of(_standard_input() if str(file) == "-" else file.read_bytes())
    except Unreadable as error:
        raise error.of("file", _name(file)) from error
    if not isinstance(found, dict):
        words = "{file} must hold a JSON object"
        raise InvalidValue.in_words("file", words, got=Given(found, shown(found)), file=_name(file))
    return found


def read_dance(file: Path) -> dict[str, Any]:
    """Content of a file that describes a dance.

    A venue or a path given as text names a map beside the file, and a dragon given as text names a CSV file.

    raises: InvalidValue, OSError
    """
    ending = ending_of(file)
    if ending not in DANCE_ENDINGS and file.is_file():
        words, endings = "{file} must end in {endings}", " or ".join(DANCE_ENDINGS)
        raise InvalidValue.in_words("file", words, got=ending or "no ending", file=str(file), endings=endings)
    piped = _standard_input() if str(file) == "-" else b""
    if ending != ".toml" and (not piped.strip() or piped.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{")):
        asked = read_json(file)
    else:
        try:
            asked = toml_of(piped or file.read_bytes())
        except Unreadable as error:
            raise error.of("file", _name(file)) from error
    if not asked:
        print(f"{_name(file)} is empty: the answer is for the contest's dance.", file=sys.stderr)
    seen: dict[Path, Any] = {}
    for name in ("venue", "path"):
        if isinstance(asked.get(name), str):
            asked[name] = _drawn(file, name, file.parent / asked[name], seen)
    for place, found in seen.items():
        for note in found.notes:
            print(f"{place}: {note}", file=sys.stderr)
    if isinstance(asked.get("dragon"), str):
        place = file.parent / asked["dragon"]
        try:
            text, is_chinese = table_of(place.read_bytes())
        except OSError as error:
            told = {"file": str(file), "table": str(place), "why": str(error.strerror)}
            raise InvalidValue("dragon", "of {file}: {table}: {why}", **told) from error
        except Unreadable as error:
            raise error.of("dragon", str(place)) from error
        if is_chinese:
            print(f"{place} is not in UTF-8; it was read as GB 18030.", file=sys.stderr)
        asked["dragon"] = {"csv": text}
    if isinstance(clock := asked.get("start_clock"), time):  # TOML has times of day
        asked["start_clock"] = clock.replace(microsecond=0).isoformat()
    return asked


def _drawn(file: Path, name: str, drawing: Path, seen: dict[Path, Any]) -> Any:
    """The venue or the path in a map, which may have been seen before. raises: InvalidValue"""
    from app.maps.geojson import is_of_polygons
    from app.maps.places import read_map  # The import takes 0.1 s, and most dances name no map.

    try:
        if name == "venue" and ending_of(drawing) in (".json", ".geojson"):
            told = read_json(drawing)
            if is_of_polygons(told):  # Unchanged, because its unit may stand beside it.
                return told
        found = seen[drawing] = seen.get(drawing) or read_map(drawing)
    except OSError as error:
        told = {"file": str(file), "drawing": str(drawing), "why": str(error.strerror)}
        raise InvalidValue(name, "of {file}: {drawing}: {why}", **told) from error
    except InvalidValue as error:
        if error.field != "file":
            raise
        words, told = f"{{part}} of {{dance}}: {error.template}", {"part": Parameter(name), "dance": str(file)}
        raise InvalidValue.in_words(name, words, got=error.got, reason=error.reason, **error.values, **told) from error
    part = found.geometry if name == "venue" else found.path
    if part is None:
        told = {"file": str(file), "drawing": str(drawing), "part": name}
        raise InvalidValue(name, "of {file}: {drawing} holds no {part}", **told)
    return part


def object_words(file: Path) -> str:
    """Word for an object in the format of a file."""
    return "a table" if ending_of(file) == ".toml" else OBJECT
