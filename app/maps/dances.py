"""Files that describe a dance, with the maps and tables that they name."""

from __future__ import annotations

import sys
from datetime import time
from pathlib import Path
from typing import Any

from app.files.disk import display_name, ending_of, read_json, standard_input, why_not
from app.processes.limits import reading
from app.wire.benches import bench_table
from app.wire.texts import Unreadable, is_workbook, table_of, toml_of
from core import Budget, InvalidValue
from core.language import say
from core.quantities import Parameter

# Endings of a file that describes a dance.
DANCE_ENDINGS = (".toml", ".json")


def read_dance(file: Path, *, several: bool = False) -> dict[str, Any]:
    """Content of a file that describes a dance, or if the question takes several, the dances of several dragons.

    A venue or a path given as text names a map beside the file, and a dragon given as text names a table: CSV or .xlsx.

    raises: InvalidValue, OSError
    """
    ending = ending_of(file)
    if ending not in DANCE_ENDINGS and file.is_file():
        words, endings = "{file} must end in {endings}", say(" or ").join(DANCE_ENDINGS)
        raise InvalidValue.in_words("file", words, got=ending or "no ending", file=str(file), endings=endings)
    piped = standard_input() if str(file) == "-" else b""
    if ending != ".toml" and (not piped.strip() or piped.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"{")):
        with reading():
            request = read_json(file)
    else:
        try:
            with reading():
                request = toml_of(piped or file.read_bytes())
        except Unreadable as error:
            raise error.of("file", display_name(file)) from error
    if "dances" in request and not several:
        why = "give a file with dragon and path, or ask about several, as check and encounter do"
        words = "{file} holds the dances of several dragons, and this question is about one"
        raise InvalidValue.in_words("dances", words, reason=why, file=display_name(file))
    if not request:
        print(f"{display_name(file)} is empty: the answer is for the contest's dance.", file=sys.stderr)
    seen: dict[Path, Any] = {}
    parts = {"": request} | _parts(request)
    for before, part in parts.items():
        for name in ("path",) if before else ("venue", "path"):
            if isinstance(part.get(name), str):
                part[name] = _drawn(file, before + name, file.parent / part[name], seen)
    for place, drawing in seen.items():
        for note in drawing.notes:
            print(f"{place}: {note}", file=sys.stderr)
    for before, part in parts.items():
        if isinstance(part.get("dragon"), str):
            part["dragon"] = {"csv": _table(file, f"{before}dragon", file.parent / part["dragon"])}
    for name in ("start_clock", "begin_clock"):
        if isinstance(clock := request.get(name), time):  # TOML has times of day
            request[name] = clock.replace(microsecond=0).isoformat()
    return request


def _parts(request: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """The dances of several dragons, by the beginning of their places, such as "dances.0."."""
    dances = request.get("dances")
    entries = enumerate(dances if isinstance(dances, list) else ())
    return {f"dances.{k}.": part for k, part in entries if isinstance(part, dict)}


def _table(file: Path, field: str, table: Path) -> str:
    """The benches of a CSV file or a workbook that a dance names at a field, as CSV. raises: InvalidValue"""
    try:
        data = table.read_bytes()
        text, notes = _of_workbook(data) if is_workbook(data) else _of_text(data)
        bench_table(text).to_dragon()
    except OSError as error:
        values = {"file": str(file), "table": str(table), "why": why_not(error)}
        raise InvalidValue(field, "of {file}: {table}: {why}", **values) from error
    except Unreadable as error:
        raise error.of(field, str(table)) from error
    except InvalidValue as error:
        words, inner = f"{{table}}: {error.template}", {**error.values}
        raise InvalidValue.in_words(
            field, words, got=error.got, reason=error.reason, **inner, table=str(table)
        ) from error
    for note in notes:
        print(f"{table}{note}", file=sys.stderr)
    return text


def _of_text(data: bytes) -> tuple[str, list[str]]:
    text, is_chinese = table_of(data)
    return text, [" is not in UTF-8; it was read as GB 18030."] if is_chinese else []


def _of_workbook(data: bytes) -> tuple[str, list[str]]:
    """The benches of a workbook, and notes. raises: InvalidValue"""
    from app.maps.benches import benches_of  # The import takes time, and most dances name no workbook.

    with reading():
        text, notes = benches_of(data, Budget())
    return text, [f": {note}" for note in notes]


def _drawn(file: Path, field: str, drawing: Path, seen: dict[Path, Any]) -> Any:
    """The venue or the path in a map, which may have been seen before. field: its place; raises: InvalidValue"""
    # The import takes 0.1 s, and most dances name no map.
    from app.maps.geojson import is_of_polygons
    from app.maps.places import read_map

    name = field.rpartition(".")[2]
    try:
        if name == "venue" and ending_of(drawing) in (".json", ".geojson"):
            values = read_json(drawing)
            if is_of_polygons(values):  # Unchanged, because its unit may stand beside it.
                return values
        parts = seen[drawing] = seen.get(drawing) or read_map(drawing)
    except OSError as error:
        values = {"file": str(file), "drawing": str(drawing), "why": why_not(error)}
        raise InvalidValue(field, "of {file}: {drawing}: {why}", **values) from error
    except InvalidValue as error:
        if error.field != "file":
            raise
        words, values = f"{{part}} of {{dance}}: {error.template}", {"part": Parameter(field), "dance": str(file)}
        raise InvalidValue.in_words(
            field, words, got=error.got, reason=error.reason, **error.values, **values
        ) from error
    part = parts.geometry if name == "venue" else parts.path
    if part is None:
        values = {"file": str(file), "drawing": str(drawing), "part": name}
        raise InvalidValue(field, "of {file}: {drawing} holds no {part}", **values)
    return part
