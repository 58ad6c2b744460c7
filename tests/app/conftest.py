"""Fixtures of the service's tests: one client of the real server."""

from __future__ import annotations

import ssl
from collections.abc import Iterator
from functools import cache
from inspect import signature

import httpx
import pytest

from tests.support.serving import serving

# httpx reads the certificates of all authorities for each client and each httpx.get(), also for http://, which takes
# 18 ms; the tests that ask in a loop did little else.
ssl.create_default_context = cache(ssl.create_default_context)

ANSWER_TIMEOUT = 120.0  # [s]; no test waits this long for an answer that is coming
# The default of all calls of httpx, 5 s, is too short for a cold start of /openapi.json on a slow machine.
signature(httpx.get).parameters["timeout"].default.read = ANSWER_TIMEOUT


@pytest.fixture(scope="session")
def client(server: str) -> Iterator[httpx.Client]:
    """A client of the real server, which keeps its connections open."""
    with httpx.Client(base_url=server, timeout=ANSWER_TIMEOUT) as client:
        yield client


@pytest.fixture(scope="session")
def patient(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Base URL of a real server whose answers may take minutes."""
    with serving(tmp_path_factory.mktemp("patient") / "server.log", deadline_seconds=600) as service:
        yield service.url
