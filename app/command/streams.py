"""Standard input, output and error of the command, whatever the caller handed over.

Lines appear in the order in which they are written, also where both streams end in one file or pipe. A character that
the terminal cannot show is escaped. Output that cannot be written ends the command with one line and exit code 2.
"""

from __future__ import annotations

import errno
import os
import sys
from typing import Any

# How a closed stream is opened: what is read is empty, what is printed is an error, messages vanish.
CLOSED = ((0, "stdin", "r", os.O_RDONLY), (1, "stdout", "w", os.O_RDONLY), (2, "stderr", "w", os.O_WRONLY))


def prepare() -> None:
    """Open the streams that the caller closed, and set how the others write."""
    for number, name, mode, flags in CLOSED:
        try:
            os.fstat(number)
        except OSError:
            # The lowest free number is this one. Without it, the next file that is opened would become this stream.
            os.set_inheritable(os.open(os.devnull, flags), True)
            setattr(sys, name, open(number, mode, encoding="utf-8"))  # noqa: SIM115
    for stream in (sys.stdout, sys.stderr):
        reconfigure: Any = getattr(stream, "reconfigure", None)
        if reconfigure:  # not where a caller in Python put a stream of its own
            reconfigure(line_buffering=True, errors="backslashreplace")


def output_fault(error: OSError) -> str:
    """What is wrong with the file that the error names, or with standard output; nothing more is printed then."""
    from app.files.disk import why_not  # Not before there is an error.
    from core.language import say

    if error.filename:
        return f"{error.filename}: {why_not(error)}"
    drop_output()
    why = say("it is closed") if error.errno == errno.EBADF else why_not(error)
    return say("standard output: {why}", why=why)


def report(error: OSError) -> None:
    """Print what is wrong with a file or with standard output."""
    from core.language import say

    print(say("Error: {message}", message=output_fault(error)), file=sys.stderr)


def drop_output() -> None:
    """Let standard output, with what waits to be written, go nowhere, so that nothing fails at the exit."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.close(nowhere)
    sys.stdout.flush()


def finish(code: int) -> int:
    """Write what waits to be written. Returns the exit code: the given one, or 2 if that fails."""
    try:
        sys.stdout.flush()
    except BrokenPipeError:  # The reader has what it wanted.
        drop_output()
    except OSError as error:
        report(error)
        return 2
    return code
