"""A client beside the page: if the service is busy with the page's questions, it retries after the stated wait."""

from __future__ import annotations

import time
from typing import Any

import httpx

BUSY = 503
# Longest that the service may be busy [s].
PATIENCE = 60.0


def get(url: str, **how: Any) -> httpx.Response:
    return _asked("GET", url, **how)


def post(url: str, **how: Any) -> httpx.Response:
    return _asked("POST", url, **how)


def _asked(method: str, url: str, **how: Any) -> httpx.Response:
    end = time.monotonic() + PATIENCE
    while True:
        answer = httpx.request(method, url, timeout=PATIENCE, **how)
        if answer.status_code != BUSY or time.monotonic() > end:
            return answer
        time.sleep(float(answer.headers["Retry-After"]))
