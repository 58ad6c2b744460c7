"""The reference contacts, and proofs of them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from core import Dance, Dragon, Spiral
from core.proof import Certificate, prove_collision_time

REFERENCE = Path(__file__).parents[1] / "reference"
CONTACTS = {case["name"]: case for case in json.loads((REFERENCE / "first_contact.json").read_text())["cases"]}
SMALL = CONTACTS["n_5"]


def proof_of(case: dict[str, Any], **changes: Any) -> Certificate:
    """Proof of a reference contact. changes: head_speed, later [s], and arguments of prove_collision_time()"""
    dance = Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"]), changes.pop("head_speed", 1.0))
    return prove_collision_time(dance, case["time"] + changes.pop("later", 0.0), **changes)
