"""A process that answers pieces, one after another: python -m app.sweeps.worker.

It reads them from its standard input and writes answers to its standard output, each as a length and so many bytes of
pickle. The first answer is None: it is ready. It leaves when its input ends, which is also when the process that
started it is gone.
"""

from __future__ import annotations

import gc
import os
import pickle
import queue
import struct
import sys
import threading
from typing import Any, BinaryIO

LENGTH = struct.Struct("<Q")


def send(stream: BinaryIO, value: Any) -> None:
    """Write one value."""
    data = pickle.dumps(value)
    stream.write(LENGTH.pack(len(data)) + data)
    stream.flush()


def receive(stream: BinaryIO) -> bytes:
    """Read the pickle of one value. raises: EOFError where the stream ends"""
    head = stream.read(LENGTH.size)
    if len(head) < LENGTH.size:
        raise EOFError
    (length,) = LENGTH.unpack(head)
    data = stream.read(length)
    if len(data) < length:
        raise EOFError
    return data


def main() -> None:
    """Answer what comes in until nothing does."""
    source, sink = sys.stdin.buffer, os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # What a library prints is no answer.
    from app.sweeps.engines import attempt

    gc.collect()
    gc.freeze()  # What was imported stays, so nobody needs to look through it again and again.
    send(sink, None)
    waiting: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    # A thread of its own reads, so that the end of the input is noticed in the middle of a piece.
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
        except Exception as error:  # The piece is of something that this process cannot import.
            answer = (None, f"{type(error).__name__}: {error}")
        try:
            send(sink, answer)
        except BrokenPipeError:
            os._exit(0)


if __name__ == "__main__":
    main()
