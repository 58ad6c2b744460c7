"""Values of core in the description of the service: named as its users know them, described as their docstrings say."""

from __future__ import annotations

import json
from inspect import cleandoc
from typing import Any

import core
from app.wire.fields import described_field

# What values of core are called here, where their names differ from those in Python.
NAMES = {
    "ContactCheck": "PairCheck",
    "DanceSummary": "ClaimedDance",
    "DragonSummary": "ClaimedDragon",
    "HeadState": "Head",
    "PartSummary": "ClaimedPart",
    "Passage": "ClaimedPassage",
    "PathSummary": "ClaimedPath",
    "PerformanceEnd": "EncounterEnd",
    "RunEnd": "End",
}


def with_values(schema: dict[str, Any]) -> dict[str, Any]:
    """A description of the service with all that is known of the values of core in it."""
    names: dict[str, str] = {}
    for long, model in schema["components"]["schemas"].items():
        name = long.rpartition("__")[2]  # pydantic writes modules before a name that requests have too
        kind = getattr(core, name, None)
        if isinstance(kind, type) and [*model.get("properties", {})] == [*getattr(kind, "__match_args__", "?")]:
            names[long] = model["title"] = NAMES.get(name, name)
            _describe(model, kind)
        else:
            names[long] = name
    text = json.dumps(schema)
    for long, name in names.items():
        text = text.replace(f'schemas/{long}"', f'schemas/{name}"')
    result: dict[str, Any] = json.loads(text)
    result["components"]["schemas"] = {names[long]: model for long, model in result["components"]["schemas"].items()}
    return result


def _describe(model: dict[str, Any], kind: type) -> None:
    model["description"] = cleandoc(kind.__doc__ or "").partition("\n\n")[0].replace("\n", " ")
    model["required"] = list(model["properties"])
    for name, field in model["properties"].items():
        field.pop("default", None)
        if known := described_field(name, kind):
            extra = known.json_schema_extra if isinstance(known.json_schema_extra, dict) else {}
            field |= {"description": known.description} | extra
