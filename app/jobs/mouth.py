"""What the process of a job tells the runner: lines of JSON on what was its standard output."""

from __future__ import annotations

import os
import sys
import time
from typing import Any

import orjson

# Between two words about progress [s].
PROGRESS_SECONDS = 0.5


class Mouth:
    """Tells the runner what happens, on what was standard output; what others print goes to standard error."""

    def __init__(self) -> None:
        self._line = os.fdopen(os.dup(sys.stdout.fileno()), "wb", buffering=0)
        os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
        self._latest = 0.0

    def say(self, **words: Any) -> None:
        self._line.write(orjson.dumps(words) + b"\n")

    def is_due(self) -> bool:
        """Is it time for a word about progress? If so, the next one is due a while later."""
        due = time.monotonic() - self._latest >= PROGRESS_SECONDS
        if due:
            self._latest = time.monotonic()
        return due

    def share(self, done: float) -> None:
        """So much of the work is done, 0 to 1."""
        if self.is_due():
            self.say(share=float(done))
