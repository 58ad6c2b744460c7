"""The independent numbers of tests/reference, whose README gives their sources."""

import json
from pathlib import Path

REFERENCE = Path(__file__).parents[1] / "reference"


def reference(name):
    """The content of one file."""
    return json.loads((REFERENCE / f"{name}.json").read_bytes())


def reference_cases(name):
    """The cases of one file by their names."""
    return {case["name"]: case for case in reference(name)["cases"]}
