"""A child process, seen from its parent."""

from __future__ import annotations

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Callable, Mapping
from io import BufferedReader
from types import MappingProxyType
from typing import IO, cast

from app.processes.messages import MessageKind, receive, send
from app.settings import SHARED_COUNTS
from app.start import search_path


class ProcessEnded(Exception):
    """A process ended before it answered its task.

    code: its exit code, or minus the signal; received: True if it had the task, which may be the cause
    """

    def __init__(self, code: int, received: bool) -> None:
        self.code, self.how, self.received = code, cause_of(code), received
        super().__init__(f"a process ended by {self.how} {'during' if received else 'before'} its task")


def cause_of(code: int) -> str:
    """What ended a process. code: its exit code, or minus the signal"""
    return f"signal {-code}" if code < 0 else f"exit code {code}"


class Child:
    """A process that runs a module of this program, and ends with its parent (app.processes.parent).

    It has a session of its own, so signals from the terminal do not reach it, and its children are killed with it.
    stays: True if it takes another task
    """

    def __init__(
        self, module: str, *arguments: str, environment: Mapping[str, str] = MappingProxyType({}), answers: bool = True
    ) -> None:
        """environment: further variables; answers: False if it gets no tasks, and its output goes where ours goes"""
        self.stays = True
        outer = {name: value for name, value in os.environ.items() if name != SHARED_COUNTS}
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "app.start", module, *arguments],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE if answers else None,
            env={**outer, **search_path(), **environment},
            start_new_session=True,
        )

    @property
    def pid(self) -> int:
        return self._process.pid

    @property
    def is_alive(self) -> bool:
        return self._process.poll() is None

    def answer(self, task: bytes, report: Callable[[bytearray], object]) -> bytearray:
        """The answer of the process to a task; it must have answered the last one. raises: ProcessEnded

        report: called with each report that comes before the answer
        """
        received = False
        try:
            send(cast(IO[bytes], self._process.stdin), MessageKind.TASK, task)
            while True:
                kind, data = receive(cast(BufferedReader, self._process.stdout))
                if kind is MessageKind.RECEIVED:
                    received = True
                elif kind is MessageKind.REPORT:
                    report(data)
                else:
                    self.stays = kind is MessageKind.ANSWER
                    return data
        except (EOFError, OSError, ValueError):  # ValueError: another thread has closed the pipes
            self.end()
            raise ProcessEnded(self._process.returncode, received) from None

    def kill(self) -> None:
        """Kill the process and its children; another thread may wait for its answer."""
        if not self.is_alive:
            return  # Another process may have its number by now.
        with contextlib.suppress(ProcessLookupError):
            if hasattr(os, "killpg"):
                os.killpg(self.pid, signal.SIGKILL)
            else:
                self._process.kill()

    def end(self, patience: float = 0.0) -> None:
        """End the process: kill it, unless it ends within this time after its input has closed [s]."""
        if patience:
            self._close(self._process.stdin)
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(patience)
        self.kill()
        self._process.wait()
        self._close(self._process.stdin)
        self._close(self._process.stdout)

    @staticmethod
    def _close(stream: IO[bytes] | None) -> None:
        if stream is not None:
            with contextlib.suppress(OSError):  # A pipe that nobody reads any more cannot be flushed.
                stream.close()
