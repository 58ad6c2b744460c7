"""Fixtures of the service's tests: one client of the real server."""

from __future__ import annotations

from collections.abc import Iterator

import httpx
import pytest

ANSWER_TIMEOUT = 120.0  # [s]; no test waits this long for an answer that is coming


@pytest.fixture(scope="session")
def client(server: str) -> Iterator[httpx.Client]:
    """Keeps its connections to the real server open."""
    with httpx.Client(base_url=server, timeout=ANSWER_TIMEOUT) as client:
        yield client
