"""The reference contacts, and proofs of them."""

from __future__ import annotations

from typing import Any

import numpy as np

from core import Dance, Dragon, Spiral, first_contact
from core.proof import Certificate, prove_collision_time
from tests.support.reference import reference_cases

CONTACTS = reference_cases("first_contact")
SMALL = CONTACTS["n_5"]


def proof_of(case: dict[str, Any], **changes: Any) -> Certificate:
    """Proof of a reference contact. changes: head_speed, later [s], and arguments of prove_collision_time()"""
    dance = Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"]), changes.pop("head_speed", 1.0))
    return prove_collision_time(dance, case["time"] + changes.pop("later", 0.0), **changes)


def random_contact(seed: int) -> tuple[Dance, float]:
    """A dance of a random dragon given bench by bench, and the time of its first contact [s]."""
    random = np.random.default_rng(seed)
    benches = int(random.integers(4, 12))
    lengths, overhangs = random.uniform(1.2, 3.6, benches), random.uniform(0.0, 0.4, benches)
    dragon = Dragon.of(lengths, random.uniform(0.1, 0.4, benches), overhangs)
    dance = Dance(dragon, Spiral(random.uniform(0.5, 0.8), random.uniform(5.0, 9.0)))
    time = first_contact(dance).time
    assert time is not None
    return dance, time
