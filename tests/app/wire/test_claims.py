"""Claims over HTTP: every value of a claim of core, under its name."""

import orjson
import pytest

from app.wire import claims
from tests.support.asking import json_like
from tests.support.every_kind import CLAIMS


@pytest.mark.parametrize("name", CLAIMS)
def test_every_value_of_a_claim_is_reported(name):
    claim = CLAIMS[name]
    on_wire = getattr(claims, type(claim).__name__).model_validate(claim)
    assert orjson.loads(on_wire.to_json()) == json_like(claim)
