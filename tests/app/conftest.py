"""Fixtures of the service's tests: clients of real servers, one server for each set of settings."""

import ssl
from contextlib import ExitStack
from functools import cache
from inspect import signature

import httpx
import pytest

from tests.support.asking import Asking
from tests.support.serving import PATIENT, serving

# httpx reads the certificates of all authorities for each client and each httpx.get(), also for http://, which takes
# 18 ms; the tests that ask in a loop did little else.
ssl.create_default_context = cache(ssl.create_default_context)

ANSWER_TIMEOUT = 120.0  # [s]; no test waits this long for an answer that is coming
# The default of all calls of httpx, 5 s, is too short for a cold start of /openapi.json on a slow machine.
signature(httpx.get).parameters["timeout"].default.read = ANSWER_TIMEOUT


@pytest.fixture(scope="session")
def client(server):
    """A client of the real server, which keeps its connections open."""
    with httpx.Client(base_url=server, timeout=ANSWER_TIMEOUT) as client:
        yield client


@pytest.fixture(scope="session")
def ask(client):
    """The calls of the real server."""
    return Asking(client)


@pytest.fixture(scope="session")
def service_with(tmp_path_factory):
    """A function of settings that gives a real server with them, started once for all tests of this process.

    data: True for a folder of its own
    """
    services = {}
    with ExitStack() as stack:

        def service(**settings):
            key = repr(sorted(settings.items()))
            if key not in services:
                folder = tmp_path_factory.mktemp("service")
                own = settings | ({"data": folder / "data"} if settings.get("data") is True else {})
                services[key] = stack.enter_context(serving(folder / "server.log", **own))
            return services[key]

        yield service


@pytest.fixture(scope="session")
def patient(service_with):
    """Base URL of a real server whose answers may take minutes."""
    return service_with(deadline_seconds=PATIENT).url
