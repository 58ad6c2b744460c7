"""The entry of the command bench-dragon: Ctrl-C ends it without a traceback, even during its imports."""

from __future__ import annotations

import os
import signal
import sys
from types import FrameType

from app.start import importing


def _leave(number: int, frame: FrameType | None) -> None:
    os._exit(128 + number)  # as shells report a command that a signal stopped


def main() -> None:
    # A shell lets its background jobs ignore SIGINT.
    heeded = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if heeded:
        # No exception here, because a module that is being imported may catch it or turn it into another one.
        signal.signal(signal.SIGINT, _leave)
    with importing():
        from app.command.main import app

    try:
        if heeded:
            signal.signal(signal.SIGINT, signal.default_int_handler)
        app()
    except KeyboardInterrupt:
        sys.exit(128 + signal.SIGINT)
