"""Claims over HTTP: every value of a claim of core, under its name."""

import orjson
import pytest

from app.wire import claims
from tests.support.asking import json_like
from tests.support.every_kind import CLAIMS


def on_wire(claim):
    model = getattr(claims, type(claim).__name__)
    return model.model_validate(claim)


@pytest.mark.parametrize("name", CLAIMS)
def test_every_value_of_a_claim_is_reported(name):
    assert orjson.loads(on_wire(CLAIMS[name]).to_json()) == json_like(CLAIMS[name])
