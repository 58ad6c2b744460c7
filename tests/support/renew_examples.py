"""`make examples`: asks the service, in this process, the requests of the examples and renews their answers."""

import asyncio
import json

import httpx

from app.service.examples import FILE
from app.service.main import create_app
from app.settings import Settings
from app.wire.question import JSON

# Values that fit into a line of so many characters stay on one.
WIDTH = 120
INDENT = 2


async def renewed(examples):
    """The same requests with the answers that the service gives now."""
    transport = httpx.ASGITransport(create_app(Settings()))
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        return {call: request | {"answer": await answer(client, call, request)} for call, request in examples.items()}


async def answer(client, call, request):
    method, path = call.split()
    response = await client.request(method, path, params=request.get("query"), json=request.get("body"))
    response.raise_for_status()
    return response.json() if response.headers["content-type"] == JSON else None


def text(value, used=0, depth=0):
    """JSON; an object or a list that fits into the rest of its line stands on one.

    used: characters of that line before it; depth: objects and lists around it
    """
    line = json.dumps(value, ensure_ascii=False)
    # One for the comma behind it. The file and its calls are always opened.
    if not isinstance(value, (dict, list)) or (depth > 1 and used + len(line) + 1 <= WIDTH):
        return line
    inner = " " * INDENT * (depth + 1)
    outer = " " * INDENT * depth
    names = [json.dumps(name) + ": " for name in value] if isinstance(value, dict) else [""] * len(value)
    parts = value.values() if isinstance(value, dict) else value
    opened = [inner + name + text(part, len(inner + name), depth + 1) for name, part in zip(names, parts, strict=True)]
    left, right = "{}" if isinstance(value, dict) else "[]"
    return "\n".join([left, ",\n".join(opened), outer + right])


if __name__ == "__main__":
    examples = asyncio.run(renewed(json.loads(FILE.read_bytes())))
    FILE.write_text(text(examples) + "\n", encoding="utf-8")
