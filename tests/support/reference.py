"""The independent numbers of tests/reference, whose README gives their sources."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

REFERENCE = Path(__file__).parents[1] / "reference"


def reference(name: str) -> Any:
    """The content of one file."""
    return json.loads((REFERENCE / f"{name}.json").read_bytes())


def reference_cases(name: str) -> dict[str, dict[str, Any]]:
    """The cases of one file by their names."""
    return {case["name"]: case for case in reference(name)["cases"]}
