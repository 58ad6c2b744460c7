"""The tools of the door: every call of the service under its operation id, made from the description of the service.

A tool takes the arguments of the call in one object: its query, its path, the fields of its body. A file is given as
its content or by its name in the folder of the door.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any
from urllib.parse import quote

from app.wire.question import BYTES, JSON

# Calls that are not tools: a stream of events, and the probes of operators.
LEFT_OUT = ("job_events", "healthz", "readyz")
SCHEMAS = "#/components/schemas/"
# Where a call offers several formats of a picture, the first one that an assistant can see.
PICTURES = ("png", "svg")
FILE = {
    "file": {"type": "string", "description": "Name of the file in the folder of this door"},
    "content": {
        "type": "string",
        "contentEncoding": "base64",
        "description": "Content of the file, in place of its name",
    },
}


@dataclass(frozen=True)
class ToolCall:
    """A call of the service as a tool.

    name: its operation id; method, path: of the request, the path with {names} in it; query: names of its query
    in_body: whether the arguments beside path and query are the fields of a body; takes_file: whether it is a file
    schema: JSON schema of the arguments; reads_only: whether nothing is kept
    """

    name: str
    title: str
    description: str
    method: str
    path: str
    query: frozenset[str]
    in_body: bool
    takes_file: bool
    schema: dict[str, Any]
    reads_only: bool


def calls_of(description: dict[str, Any], *, twins: bool = False) -> dict[str, ToolCall]:
    """The calls that are tools, by name.

    description: the OpenAPI document of the service
    twins: whether a call with a body is a tool although one with flat arguments asks the same; an assistant reads the
        schemas of all tools, and those of bodies are ten times as long
    """
    schemas = description["components"]["schemas"]
    calls = {}
    for path, operations in description["paths"].items():
        for method, operation in operations.items():
            name = operation["operationId"]
            twin = "get" in operations and name == f"{operations['get']['operationId']}_of"
            if name not in LEFT_OUT and (twins or not twin):
                call = _call_of(path, method.upper(), operation, schemas)
                calls[call.name] = call
    return calls


def _call_of(path: str, method: str, operation: dict[str, Any], schemas: dict[str, Any]) -> ToolCall:
    parameters = [one for one in operation.get("parameters", []) if one["in"] in ("query", "path")]
    properties = {one["name"]: _of_parameter(one, schemas) for one in parameters}
    required = [one["name"] for one in parameters if one.get("required") and "default" not in properties[one["name"]]]
    contents = operation.get("requestBody", {}).get("content", {})
    takes_file = BYTES in contents
    if takes_file:
        properties |= FILE
    elif JSON in contents:
        body = _resolved(contents[JSON]["schema"], schemas)
        properties |= body.get("properties", {})
        required += body.get("required", [])
    schema: dict[str, Any] = {"type": "object", "properties": properties, "additionalProperties": False}
    if required:
        schema["required"] = required
    if definitions := _definitions_in(properties, schemas):
        schema["$defs"] = definitions
    return ToolCall(
        operation["operationId"],
        operation["summary"],
        operation.get("description", operation["summary"]),
        method,
        path,
        frozenset(one["name"] for one in parameters if one["in"] == "query"),
        JSON in contents,
        takes_file,
        _with_local_names(schema),
        method == "GET" or operation["tags"][0] != "Jobs",
    )


def _of_parameter(parameter: dict[str, Any], schemas: dict[str, Any]) -> dict[str, Any]:
    schema = dict(_resolved(parameter["schema"], schemas))
    if parameter.get("description"):
        schema["description"] = parameter["description"]
    pictures = [name for name in PICTURES if name in schema.get("enum", ())]
    return schema | {"default": pictures[0]} if pictures else schema


def _resolved(schema: dict[str, Any], schemas: dict[str, Any]) -> dict[str, Any]:
    """The schema itself where a name stands for it."""
    return schemas[schema["$ref"].removeprefix(SCHEMAS)] if "$ref" in schema else schema


def _names_in(schema: Any) -> Iterator[str]:
    if isinstance(schema, dict):
        if isinstance(schema.get("$ref"), str):
            yield schema["$ref"].removeprefix(SCHEMAS)
        for value in schema.values():
            yield from _names_in(value)
    elif isinstance(schema, list):
        for value in schema:
            yield from _names_in(value)


def _definitions_in(schema: Any, schemas: dict[str, Any]) -> dict[str, Any]:
    """Every named schema that this one needs, directly or by another."""
    waiting, definitions = list(_names_in(schema)), {}
    while waiting:
        if (name := waiting.pop()) not in definitions:
            definitions[name] = schemas[name]
            waiting += _names_in(schemas[name])
    return dict(sorted(definitions.items()))


def _with_local_names(schema: Any) -> Any:
    """The schema with its names in $defs, without words of OpenAPI alone and without titles, which repeat the names."""
    if isinstance(schema, dict):
        kept = {
            name: _with_local_names(value)
            for name, value in schema.items()
            if name != "discriminator" and not (name == "title" and isinstance(value, str))
        }
        if isinstance(kept.get("$ref"), str):
            kept["$ref"] = kept["$ref"].replace(SCHEMAS, "#/$defs/")
        return kept
    return [_with_local_names(value) for value in schema] if isinstance(schema, list) else schema


def path_of(call: ToolCall, arguments: dict[str, Any]) -> str:
    """The path of the request. Arguments in it that are left out take their default."""

    def value(match: re.Match[str]) -> str:
        schema = call.schema["properties"][match[1]]
        return quote(str(arguments.get(match[1], schema.get("default", ""))), safe="", errors="surrogatepass")

    return re.sub(r"\{(\w+)\}", value, call.path)
