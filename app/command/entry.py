"""The entry of the command bench-dragon: Ctrl-C ends it without a traceback, even during its imports."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from types import FrameType

from app.command import streams
from app.start import importing


def _leave(number: int, frame: FrameType | None) -> None:
    os._exit(128 + number)  # as shells report a command that a signal stopped


def main() -> None:
    # A shell lets its background jobs ignore SIGINT.
    heeded = signal.getsignal(signal.SIGINT) is signal.default_int_handler
    if heeded:
        # No exception here, because a module that is being imported may catch it or turn it into another one.
        signal.signal(signal.SIGINT, _leave)
    streams.prepare()
    with importing():
        from app.command.main import app

    if heeded:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    sys.exit(run(app))


def run(app: Callable[[], object]) -> int:
    """Exit code of the command, after everything that it printed is written."""
    try:
        app()
    except KeyboardInterrupt:
        return 128 + signal.SIGINT
    except SystemExit as end:
        return streams.finish(end.code if isinstance(end.code, int) else int(end.code is not None))
    except OSError as error:
        print(f"Error: {streams.output_fault(error)}", file=sys.stderr)
        return 2
    return streams.finish(0)
