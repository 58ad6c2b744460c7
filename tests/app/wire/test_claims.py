"""Claims over HTTP: every value of a claim of core, under its name."""

from __future__ import annotations

from typing import Any

import orjson
import pytest

from app.questions.collision_time import CollisionQuery, collision_time
from app.questions.contact_probability import ContactProbabilityRequest, contact_probability
from app.questions.envelope import Envelope, EnvelopeRequest, envelope
from app.questions.tolerance import ToleranceQuery, tolerance
from app.wire import claims
from app.wire.question import Answer, Terms
from tests.support.asking import json_like
from tests.support.every_kind import CLAIMS


def on_wire(claim: Any) -> Answer:
    model: type[Answer] = getattr(claims, type(claim).__name__)
    return model.model_validate(claim)


@pytest.mark.parametrize("name", CLAIMS)
def test_every_value_of_a_claim_is_reported(name: str) -> None:
    assert orjson.loads(on_wire(CLAIMS[name]).to_json()) == json_like(CLAIMS[name])


def test_a_claim_stands_beside_its_sentences_in_every_certificate() -> None:
    few = {"benches": 5}
    contact = collision_time(CollisionQuery(benches=5), Terms())
    assert contact.certificate.claim.clear_until == contact.certificate.clear_until
    strays = tolerance(ToleranceQuery(benches=5), Terms())
    assert strays.certificate.claim.stray == strays.stray
    request = EnvelopeRequest.model_validate({"dragon": few, "stop": 1.0})
    ground = envelope(request, Terms())
    assert isinstance(ground, Envelope)
    assert ground.certificate.claim.excess == ground.excess
    chances = contact_probability(
        ContactProbabilityRequest.model_validate({"dragon": few, "stop": 10.0, "samples": 2}), Terms()
    )
    assert (chances.claim.samples, chances.claim.contacts) == (2, chances.contacts)
