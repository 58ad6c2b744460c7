"""A small version of `make fuzz`."""

from __future__ import annotations

from tests.app.fuzz import ask_mutants
from tests.depth import examples

MUTANTS, SEED = examples(35, 150), 1


def test_no_odd_request_gets_an_error_of_the_service(server: str) -> None:
    statuses = ask_mutants(server, MUTANTS, SEED).statuses
    assert statuses.total() == MUTANTS
    assert statuses[200] > MUTANTS // 20, "some of them are harmless"
    assert statuses[422] > MUTANTS // 4
