"""The log of the service and its jobs: one line for each event, with the request's name, as text or JSON."""

from __future__ import annotations

import json
import logging
import math
import time
from collections import Counter
from contextvars import ContextVar
from copy import deepcopy
from threading import Lock
from typing import Any

# Name of the current request; empty between requests.
request_id: ContextVar[str] = ContextVar("request_id", default="")


# Longest path or other word of a client in the log [characters].
WORD_MAX = 1_000


def _cut(word: object) -> object:
    """A word of a record, cut where it is too long, with its length."""
    if not isinstance(word, str) or len(word) <= WORD_MAX:
        return word
    return f"{word[:WORD_MAX]}... ({len(word)} characters)"


class RequestName(logging.Filter):
    """Adds the name of the request to a record, and cuts what a client made long."""

    def filter(self, record: logging.LogRecord) -> bool:
        if isinstance(record.args, tuple):
            record.args = tuple(map(_cut, record.args))
        name = request_id.get()
        record.request_id, record.of_request = name, f" [{name}]" if name else ""
        return True


class Faults:
    """Faults that repeat: each is logged when it first comes, and over() logs how often it came.

    words: of the line, with the fault as its argument
    """

    def __init__(self, logger: logging.Logger, words: str) -> None:
        self.logger, self.words = logger, words
        self.last = -math.inf  # time of the last one [s, monotonic]
        self._lock, self._times = Lock(), Counter[str]()

    def log(self, fault: str) -> None:
        with self._lock:
            self.last = time.monotonic()
            self._times[fault] += 1
            if self._times[fault] == 1:
                self.logger.error(self.words, fault)

    def over(self) -> None:
        """Log how often each fault came that came more than once; to call when they have ended."""
        with self._lock:
            for fault, times in self._times.items():
                if times > 1:
                    self.logger.error(f"{self.words} (%d times; it is over)", fault, times)
            self._times.clear()


class JsonLines(logging.Formatter):
    """A record as one JSON object."""

    def format(self, record: logging.LogRecord) -> str:
        line = {
            "time": self.formatTime(record, "%Y-%m-%dT%H:%M:%S%z"),
            "level": record.levelname,
            "logger": record.name,
            "message": record.getMessage(),
            "request_id": getattr(record, "request_id", ""),
        }
        if record.exc_info:
            line["traceback"] = self.formatException(record.exc_info)
        return json.dumps(line, ensure_ascii=False)


def log_config(in_json: bool) -> dict[str, Any]:
    """uvicorn's own configuration of logging, with the names of requests."""
    from uvicorn.config import LOGGING_CONFIG  # The processes of jobs log without uvicorn.

    config = deepcopy(LOGGING_CONFIG)
    config["filters"] = {"named": {"()": RequestName}}
    for handler in config["handlers"].values():
        handler["filters"] = ["named"]
    for formatter in config["formatters"].values():
        formatter["fmt"] += "%(of_request)s"
    if in_json:
        config["loggers"]["py.warnings"] = {"handlers": ["default"], "level": "WARNING"}
        config["formatters"] = {name: {"()": JsonLines} for name in config["formatters"]}
    return config


def log_to_stderr(in_json: bool) -> None:
    """Log a process without a server to standard error, in the form of the service's log."""
    handler = logging.StreamHandler()
    handler.setFormatter(JsonLines() if in_json else logging.Formatter("%(levelname)s:     %(message)s"))
    logging.basicConfig(handlers=[handler], level=logging.INFO)
