"""A client beside the page: if the service is busy with the page's questions, it retries after the stated wait."""

import time

import httpx

BUSY = 503
# Longest that the service may be busy [s].
PATIENCE = 60.0
# One for all tests of a process: a new client reads the certificates of the system, which takes 0.04 s. It keeps no
# connection, because a test may end the service at the other end.
CLIENT = httpx.Client(timeout=PATIENCE, limits=httpx.Limits(max_keepalive_connections=0))


def get(url, **how):
    return _request("GET", url, **how)


def post(url, **how):
    return _request("POST", url, **how)


def answer(base, call, body=None, **query):
    """The answer of a service to a body, or to a query."""
    url = f"{base}/{call}"
    return (get(url, params=query) if body is None else post(url, json=body)).raise_for_status().json()


def _request(method, url, **how):
    end = time.monotonic() + PATIENCE
    while True:
        answer = CLIENT.request(method, url, **how)
        if answer.status_code != BUSY or time.monotonic() > end:
            return answer
        time.sleep(float(answer.headers["Retry-After"]))
