"""A small version of `make fuzz`."""

import httpx
import pytest

from tests.campaigns.fuzz import ask_mutants
from tests.campaigns.fuzz_files import ask_files, readers_over
from tests.support.depth import examples

MUTANTS = examples(60, 150)
FILES = examples(80, 400)
SEED = 1


def test_no_odd_request_gets_an_error_of_the_service(server):
    statuses = ask_mutants(server, MUTANTS, SEED).statuses
    assert statuses.total() == MUTANTS
    assert statuses[200] > MUTANTS // 40, "some of them are harmless"
    assert statuses[422] > MUTANTS // 4


@pytest.mark.thorough
def test_no_damaged_file_gets_an_error_of_the_service(server):
    statuses = ask_files(server, FILES, SEED).statuses
    assert statuses.total() == FILES
    assert statuses[200] > FILES // 10, "some of them are harmless"
    assert statuses[422] > FILES // 5
    assert readers_over(httpx.get(f"{server}/metrics").text, 1e9) == 0
