"""The parent of this process, as its child meets it: tasks come on standard input, answers go to standard output.

Standard input ends with the parent, even if that is killed. Linux could send a signal in its place (PR_SET_PDEATHSIG),
but sends it when the thread ends that started the child, and never if the parent ends before the child asks for it.
"""

from __future__ import annotations

import os
import signal
from collections.abc import Callable
from functools import partial
from queue import SimpleQueue
from threading import Thread
from typing import NoReturn

from app.processes.limits import is_small
from app.processes.messages import MessageKind, receive, send

# Function that sends a report to the parent while this process works on a task.
Report = Callable[[bytes], object]


def end_group() -> NoReturn:
    """End this process and its children."""
    if hasattr(os, "killpg") and os.getpgid(0) == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


def follow_parent(take: Callable[[bytearray], object] = lambda task: None) -> None:
    """Give each task to a function, in a thread; end this process and its children when the parent has ended."""

    def follow() -> None:
        # Not sys.stdin, because Python cannot end while a thread holds the lock of a file object; a raw file has none.
        with open(0, "rb", buffering=0, closefd=False) as source:
            try:
                while True:
                    take(receive(source)[1])
            finally:  # Whatever stops this thread, nobody else would notice the end of the parent.
                end_group()

    Thread(target=follow, daemon=True).start()


def answer_tasks(answer: Callable[[bytearray, Report], bytes], again: Callable[[], bool] = is_small) -> NoReturn:
    """Answer tasks one after another, until the parent ends this process, or ends itself.

    answer: function of a task, and of a function that sends reports; whatever it prints goes to standard error
    again: called after each task; False: the parent ends this process and starts another one for the next task
    """
    sink = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)
    tasks: SimpleQueue[bytearray] = SimpleQueue()
    follow_parent(tasks.put)

    def tell(kind: MessageKind, data: bytes = b"") -> None:
        try:
            send(sink, kind, data)
        except BrokenPipeError:  # The parent has ended.
            end_group()

    while True:
        task = tasks.get()
        tell(MessageKind.RECEIVED)
        result = answer(task, partial(tell, MessageKind.REPORT))
        del task
        tell(MessageKind.ANSWER if again() else MessageKind.LAST, result)
        del result
