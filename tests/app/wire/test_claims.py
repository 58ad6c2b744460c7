"""Claims over HTTP: every value of a claim of core, under its name."""

from __future__ import annotations

from typing import Any

import orjson
import pytest

from app.wire import claims
from app.wire.question import Answer
from tests.support.asking import json_like
from tests.support.every_kind import CLAIMS


def on_wire(claim: Any) -> Answer:
    model: type[Answer] = getattr(claims, type(claim).__name__)
    return model.model_validate(claim)


@pytest.mark.parametrize("name", CLAIMS)
def test_every_value_of_a_claim_is_reported(name: str) -> None:
    assert orjson.loads(on_wire(CLAIMS[name]).to_json()) == json_like(CLAIMS[name])
