"""Messages from the process of a job to the runner: lines of JSON on its original standard output."""

from __future__ import annotations

import os
import sys
import time
from typing import Any

import orjson

# Time between two messages about progress [s].
PROGRESS_SECONDS = 0.5


class Reports:
    """Reports to the runner on the original standard output; other prints go to standard error."""

    def __init__(self) -> None:
        self._line = os.fdopen(os.dup(sys.stdout.fileno()), "wb", buffering=0)
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
        self.begin()

    def begin(self) -> None:
        """Begin a job, whose first message about progress is due at once."""
        self._latest = 0.0

    def say(self, **words: Any) -> None:
        self._line.write(orjson.dumps(words) + b"\n")

    def is_due(self) -> bool:
        """True if a message about progress is due; the next one is then due PROGRESS_SECONDS later."""
        due = time.monotonic() - self._latest >= PROGRESS_SECONDS
        if due:
            self._latest = time.monotonic()
        return due

    def share(self, done: float) -> None:
        """Report the share of the work that is done, 0 to 1."""
        if self.is_due():
            self.say(share=float(done))
