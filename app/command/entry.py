"""The entry of the command bench-dragon: Ctrl-C ends it without a traceback, even during its imports."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Callable
from types import FrameType

from app.command import streams
from app.command.interrupts import interrupts
from app.start import importing

INTERRUPTED = 128 + signal.SIGINT  # as shells report a command that Ctrl-C stopped


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
        signal.signal(signal.SIGINT, interrupts.take)
    code = run(app)
    if code == INTERRUPTED:
        # Python would wait for threads that still work, for nobody, and for ever for one whose pool does not know it:
        # concurrent.futures lists a thread after its start.
        os._exit(code)
    sys.exit(code)


def run(app: Callable[[], object]) -> int:
    """Exit code of the command, after everything that it printed is written."""
    try:
        app()
    except KeyboardInterrupt:
        return streams.finish(INTERRUPTED)
    except SystemExit as end:
        return streams.finish(end.code if isinstance(end.code, int) else int(end.code is not None))
    except OSError as error:
        streams.report(error)
        return 2
    return streams.finish(0)
