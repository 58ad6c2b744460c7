"""Reports of the process of a job to the runner, as JSON."""

from __future__ import annotations

import time
from typing import Any

import orjson
from pydantic import BaseModel

from app.processes.parent import Report

# Time between two messages about progress [s].
PROGRESS_SECONDS = 0.5
# Largest part of an answer in an event [bytes].
PART_BYTES = 1 << 16


class Reports:
    """Reports about one job. The first message about progress is due at once."""

    def __init__(self, report: Report) -> None:
        self._report, self._latest = report, 0.0

    def send(self, **values: Any) -> None:
        self._report(orjson.dumps(values))

    def is_due(self) -> bool:
        """True if a message about progress is due; the next one is then due PROGRESS_SECONDS later."""
        due = time.monotonic() - self._latest >= PROGRESS_SECONDS
        if due:
            self._latest = time.monotonic()
        return due

    def part(self, part: BaseModel) -> None:
        """Report a part of the answer, unless it is too long for an event."""
        data = part.model_dump(mode="json")
        if len(orjson.dumps(data)) <= PART_BYTES:
            self.send(part=data)

    def share(self, done: float) -> None:
        """Report the share of the work that is done, 0 to 1."""
        if self.is_due():
            self.send(share=float(done))
