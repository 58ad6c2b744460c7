"""The reference contacts, and proofs of them."""

from functools import cache

import numpy as np
import pytest

from core import Dance, Dragon, Spiral, first_contact, minimum_pitch
from core.errors import ProofRefused
from core.proof import prove_collision_time, prove_minimum_pitch, verify
from tests.support.forgeries import through_json
from tests.support.reference import reference_cases

CONTACTS = reference_cases("first_contact")
SMALL = CONTACTS["n_5"]
GRAZING = {"turning_radius": 3.2, "start_turns": 7.0}
# From this far off a contact on, a claim is refused [s].
OFF = 1e-8


def proof_of(case, **changes):
    """Proof of a reference contact. changes: head_speed, later [s], and arguments of prove_collision_time()"""
    dance = Dance(Dragon(**case["dragon"]), Spiral(case["pitch"], case["start_turns"]), changes.pop("head_speed", 1.0))
    return prove_collision_time(dance, case["time"] + changes.pop("later", 0.0), **changes)


@cache
def small():
    """The certificate of five benches, as read from a file."""
    return through_json(proof_of(SMALL))


@cache
def graze(margin=0.0):
    """The certificate of a minimum pitch at which benches 0 and 12 graze, as read from a file."""
    pitch = minimum_pitch(Dragon(14), **GRAZING, margin=margin).pitch_bracket[1]
    return through_json(prove_minimum_pitch(Dragon(14), pitch, **GRAZING, margin=margin))


def proven_then_only(prove, dance, time, **options):
    """The certificate of a contact, as read from a file, and what it states; nearby times must be refused."""
    assert time is not None
    certificate = through_json(prove(dance, time, **options))
    for wrong in (time - OFF, time + OFF):
        with pytest.raises(ProofRefused):
            prove(dance, wrong, **options)
    return certificate, verify(certificate).statement


def random_contact(seed):
    """A dance of a random dragon given bench by bench, and the time of its first contact [s]."""
    random = np.random.default_rng(seed)
    benches = int(random.integers(4, 12))
    lengths = random.uniform(1.2, 3.6, benches)
    overhangs = random.uniform(0.0, 0.4, benches)
    dragon = Dragon.of(lengths, random.uniform(0.1, 0.4, benches), overhangs)
    dance = Dance(dragon, Spiral(random.uniform(0.5, 0.8), random.uniform(5.0, 9.0)))
    time = first_contact(dance).time
    assert time is not None
    return dance, time
