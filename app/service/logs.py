"""The log of the service: one line for each event, with the name of its request, as text or JSON."""

from __future__ import annotations

import json
import logging
from contextvars import ContextVar
from copy import deepcopy
from typing import Any

from uvicorn.config import LOGGING_CONFIG

# Name of the request that is being answered; empty between requests.
request_id: ContextVar[str] = ContextVar("request_id", default="")


class Named(logging.Filter):
    """Adds the name of the request to a record."""

    def filter(self, record: logging.LogRecord) -> bool:
        name = request_id.get()
        record.request_id, record.of_request = name, f" [{name}]" if name else ""
        return True


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
    config = deepcopy(LOGGING_CONFIG)
    config["filters"] = {"named": {"()": Named}}
    for handler in config["handlers"].values():
        handler["filters"] = ["named"]
    for formatter in config["formatters"].values():
        formatter["fmt"] += "%(of_request)s"
    if in_json:
        config["loggers"]["py.warnings"] = {"handlers": ["default"], "level": "WARNING"}
        config["formatters"] = {name: {"()": JsonLines} for name in config["formatters"]}
    return config
