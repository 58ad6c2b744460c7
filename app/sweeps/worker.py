"""A process that answers pieces, one after another: python -m app.sweeps.worker.

It reads pieces from standard input and writes answers to standard output, each as a length and that number of bytes of
pickle. The first answer, None, says that it is ready. It ends when its input ends, so also when its parent is gone.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import struct
import subprocess
import sys
import threading
from typing import Any, BinaryIO, cast

from app.start import importing

LENGTH = struct.Struct("<Q")


def send(stream: BinaryIO, value: Any) -> None:
    """Write one value."""
    data = pickle.dumps(value)
    stream.write(LENGTH.pack(len(data)) + data)
    stream.flush()


def receive(stream: BinaryIO) -> bytes:
    """Read the pickle of one value. raises: EOFError at the end of the stream"""
    head = stream.read(LENGTH.size)
    if len(head) < LENGTH.size:
        raise EOFError
    (length,) = LENGTH.unpack(head)
    data = stream.read(length)
    if len(data) < length:
        raise EOFError
    return data


def end(process: subprocess.Popen[bytes], patience: float | None = None) -> None:
    """Kill a process and wait for its end, at most so long [s]."""
    process.kill()
    process.wait(patience)
    for stream in (process.stdin, process.stdout):
        # A pipe that nobody reads any more cannot be flushed.
        with contextlib.suppress(OSError):
            cast(BinaryIO, stream).close()


def main() -> None:
    """Answer pieces until the input ends, or nobody takes an answer any more because the parent was killed."""
    try:
        _answer()
    except BrokenPipeError:
        os._exit(0)


def _answer() -> None:
    source, sink = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # The prints of libraries must not mix with answers.
    with importing():
        from app.sweeps.engines import attempt

    send(sink, None)
    waiting: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    # A separate thread reads, so that the process notices the end of its input even during a piece.
    def read() -> None:
        while True:
            try:
                waiting.put(receive(source))
            except EOFError:
                os._exit(0)

    threading.Thread(target=read, daemon=True).start()
    while True:
        data = waiting.get()
        try:
            answer = attempt(pickle.loads(data))
        except Exception as error:  # This process cannot import something that the piece needs.
            answer = (None, f"{type(error).__name__}: {error}")
        send(sink, answer)


if __name__ == "__main__":
    main()
