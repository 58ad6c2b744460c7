"""Files that the command reads and writes."""

from __future__ import annotations

import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

import orjson

from app import tables
from core import InvalidValue, Trajectory


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
    raise InvalidValue("output", f"--output must end in .csv, .xlsx, .arrow or .json, got {suffix or 'no ending'}")
