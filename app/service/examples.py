"""A request and its true answer for each call, shown in the documentation: examples.json, which `make examples` renews.

A test asks the service for each.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import orjson

FILE = Path(__file__).with_suffix(".json")


@dataclass(frozen=True, slots=True)
class Example:
    """A call with these query parameters and this body gives this answer."""

    answer: Any
    query: dict[str, float] = field(default_factory=dict)
    body: Any = None


# "GET /path" -> its example.
EXAMPLES = {call: Example(**example) for call, example in orjson.loads(FILE.read_bytes()).items()}
