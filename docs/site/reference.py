"""Pages of the reference: all public names of core, and all calls of the service, from their own descriptions."""

from __future__ import annotations

import enum
import inspect
from collections import defaultdict
from types import ModuleType
from typing import Any

import core
from core import proof

# Page, its title, and the rooms of core whose public names stand on it.
ROOMS = {
    "dance": ("The dance", ("core.dragon", "core.dance", "core.passages", "core.course", "core.venue")),
    "paths": ("Paths", ("core.paths",)),
    "motion": ("Where everyone is, and how fast", ("core.motion", "core.extremes")),
    "contact": ("Contact and clearance", ("core.contact",)),
    "judgement": ("The verdict on a dance", ("core.judgement", "core.failures")),
    "design": ("Design: pitches and turns", ("core.design",)),
    "tolerance": ("Tolerance", ("core.tolerance",)),
    "people": ("The people of a dance", ("core.people",)),
    "performance": ("Several dragons", ("core.performance", "core.safe_delay")),
    "proposal": ("Proposals for a square", ("core.proposal",)),
    "ground": ("Ground that benches sweep", ("core.ground",)),
    "shapes": ("Rectangles and overlaps", ("core.shapes",)),
    "claims": ("What certificates claim", ("core.claims",)),
    "proof": ("Certificates in ball arithmetic", ("core.proof",)),
    "errors": ("Errors, limits and budgets", ("core.errors", "core.quantities", "core.kernels")),
}
# Names of types that are made of others, and so of no room.
ALIASES = {"Piece": "paths", "Certificate": "proof"}


def _page_of(module: str) -> str:
    for page, (_, rooms) in ROOMS.items():
        if any(module == room or module.startswith(room + ".") for room in rooms):
            return page
    raise LookupError(f"{module} has public names, and no page of docs/site/reference.py is for it")


def _entry(module: ModuleType, name: str) -> str:
    value = getattr(module, name)
    qualified = f"{module.__name__}.{name}"
    if inspect.isclass(value):
        members = "" if issubclass(value, Exception) else "\n:members:\n:exclude-members: __new__, __init__"
        kind = "autoexception" if issubclass(value, Exception) else "autoclass"
        if issubclass(value, enum.Enum):
            members += "\n:undoc-members:"
        return f".. {kind}:: {qualified}".replace("\n", "\n   ") + members.replace("\n", "\n   ")
    if inspect.isfunction(value):
        return f".. autofunction:: {qualified}"
    return f".. py:data:: {qualified}\n   :type: {value}"


def library_pages() -> dict[str, str]:
    """Pages of the library in reStructuredText by name: first the functions, then the classes, each by name.

    raises: LookupError for a public name whose room has no page
    """
    names: dict[str, list[tuple[bool, str, ModuleType]]] = defaultdict(list)
    for module, public in ((core, core.__all__), (proof, proof.__all__)):
        for name in public:
            value = getattr(module, name)
            page = ALIASES.get(name) or _page_of(value.__module__)
            names[page].append((not inspect.isfunction(value), name, module))
    pages = {}
    for page, (title, _) in ROOMS.items():
        entries = [_entry(module, name) for _, name, module in sorted(names[page], key=lambda entry: entry[:2])]
        pages[page] = "\n\n".join([f"{title}\n{'=' * len(title)}", *entries]) + "\n"
    return pages


def _kind(schema: dict[str, Any]) -> str:
    """Type of a value in a word or a few, with links to the named ones."""
    if "$ref" in schema:
        name = schema["$ref"].rsplit("/", 1)[1]
        return f"[{name}](#{_anchor(name)})"
    if "const" in schema:
        return f"`{schema['const']!r}`"
    if "enum" in schema:
        return ", ".join(f"`{value}`" for value in schema["enum"])
    for word in ("anyOf", "oneOf"):
        if word in schema:
            return " or ".join(dict.fromkeys(_kind(choice) for choice in schema[word]))
    if schema.get("type") == "array":
        return f"list of {_kind(schema.get('items', {}))}"
    return str(schema.get("type", "any value"))


def _limits(schema: dict[str, Any]) -> str:
    signs = {"minimum": "≥", "exclusiveMinimum": ">", "maximum": "≤", "exclusiveMaximum": "<"}
    limits = [f"{sign} {schema[word]:g}" for word, sign in signs.items() if word in schema]
    lengths = {"maxItems": "items", "maxLength": "characters"}
    return ", ".join([*limits, *(f"≤ {schema[word]} {what}" for word, what in lengths.items() if word in schema)])


def _anchor(name: str) -> str:
    return "schema-" + "".join(letter if letter.isalnum() else "-" for letter in name.lower())


def _row(*cells: str) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |"


def _table(rows: list[tuple[str, dict[str, Any], bool]]) -> str:
    """rows: name, schema and whether it is required"""
    lines = [_row("name", "type", "limits", "default", "meaning"), _row("---", "---", "---", "---", "---")]
    for name, schema, required in rows:
        default = "required" if required else f"`{schema['default']}`" if schema.get("default") is not None else ""
        lines.append(_row(f"`{name}`", _kind(schema), _limits(schema), default, schema.get("description", "")))
    return "\n".join(lines)


def _schema(name: str, schema: dict[str, Any]) -> str:
    parts = [f"({_anchor(name)})=\n### {name}", schema.get("description", "")]
    if properties := schema.get("properties"):
        required = set(schema.get("required", ()))
        parts.append(_table([(field, value, field in required) for field, value in properties.items()]))
    else:
        parts.append(f"{_kind(schema)}".capitalize())
    return "\n\n".join(part for part in parts if part)


def _call(path: str, method: str, operation: dict[str, Any]) -> str:
    parts = [f"### {method.upper()} {path}", operation.get("description", operation["summary"])]
    if parameters := operation.get("parameters"):
        rows = []
        for parameter in parameters:
            schema = {"description": parameter.get("description", ""), **parameter["schema"]}
            rows.append((parameter["name"], schema, parameter.get("required", False)))
        parts.append(_table(rows))
    for medium, content in operation.get("requestBody", {}).get("content", {}).items():
        parts.append(f"Body, `{medium}`: {_kind(content.get('schema', {}))}")
    for status, response in operation["responses"].items():
        contents = [
            f"`{medium}` {_kind(content['schema']) if content.get('schema') else ''}".strip()
            for medium, content in response.get("content", {}).items()
        ]
        forms = f": {', '.join(contents)}" if contents else ""
        parts.append(f"- **{status}** {response.get('description', '')}{forms}")
    lists = "\n".join(part for part in parts if part.startswith("- "))
    return "\n\n".join([*(part for part in parts if not part.startswith("- ")), lists])


def http_pages(description: dict[str, Any]) -> dict[str, str]:
    """Pages of the service in Markdown by name: one for each kind of call, and one for all bodies and answers.

    description: the OpenAPI document of the service
    """
    calls: dict[str, list[str]] = defaultdict(list)
    for path, operations in description["paths"].items():
        for method, operation in operations.items():
            calls[operation["tags"][0]].append(_call(path, method, operation))
    text = (
        "# HTTP reference\n\nFrom the description of the service, `/openapi.json`. "
        "Lengths are in metres, angles in radians, times in seconds.\n"
    )
    for tag in description["tags"]:
        text += "\n\n".join(["", f"## {tag['name']}", tag.get("description", ""), *calls.pop(tag["name"], [])]) + "\n"
    if calls:
        raise LookupError(f"calls without a described kind: {sorted(calls)}")
    schemas = [_schema(name, schema) for name, schema in sorted(description["components"]["schemas"].items())]
    return {"http-reference": "\n\n".join([text, "## Bodies and answers", *schemas]) + "\n"}
