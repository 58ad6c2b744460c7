"""Example of every call with its true answer, shown in the documentation; `make examples` renews examples.json.

A test asks the service for each of them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import orjson

FILE = Path(__file__).with_suffix(".json")


@dataclass(frozen=True, slots=True)
class Example:
    """Query parameters and body of a call, and its answer; null where that is a file."""

    answer: Any
    query: dict[str, float] = field(default_factory=dict)
    body: Any = None


# "GET /path" -> its example.
EXAMPLES = {call: Example(**example) for call, example in orjson.loads(FILE.read_bytes()).items()}
