"""A pool of processes that answer tasks: dead ones are replaced, and one whose budget is stopped is killed."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, nullcontext
from functools import partial
from threading import Event, Lock, Thread
from types import MappingProxyType

from app.processes.child import Child, ProcessEnded
from core import Budget
from core.kernels import Halted

# Number of processes in a row that may end before they have their task [1]: one may be killed while it waits.
STARTS = 5
# Time between two looks at a budget [s].
LOOK_SECONDS = 0.05


class Pool:
    """Processes that run one module (app.processes.parent.answer_tasks), each with one task at a time.

    Any number of threads may ask for answers; each gets a process that waits, or else a new one.
    """

    def __init__(
        self, module: str, *arguments: str, waiting: int, environment: Mapping[str, str] = MappingProxyType({})
    ) -> None:
        """arguments: of each process; waiting: most processes without a task; environment: further variables"""
        self._start = partial(Child, module, *arguments, environment=environment)
        self._waiting_max = waiting
        self._waiting: list[Child] = []
        self._children: set[Child] = set()
        self._closed = False
        self._lock = Lock()

    @property
    def pids(self) -> list[int]:
        """Ids of the processes."""
        return [child.pid for child in list(self._children)]

    def answer(
        self, task: bytes, budget: Budget | None = None, report: Callable[[bytearray], object] = lambda data: None
    ) -> bytearray:
        """The answer of a process to a task.

        A process that ended before it had the task is replaced; then the task cannot be the cause.
        budget: the process is killed when it is stopped, by any thread; report: called with each report of the process
        raises: Halted; ProcessEnded for a process that died during the task, and for STARTS that ended before it
        """
        for attempt in range(1, STARTS + 1):
            try:
                with self._lent() as child, killed_at_stop(child, budget) if budget else nullcontext():
                    return child.answer(task, report)
            except ProcessEnded as end:
                if budget and budget.stopped:
                    raise Halted(budget) from None
                if end.received or attempt == STARTS:
                    raise
        raise AssertionError

    @contextmanager
    def _lent(self) -> Iterator[Child]:
        """A process without a task; afterwards it waits for the next one, or ends."""
        with self._lock:
            if self._closed:
                raise ProcessEnded(0, False)
            while self._waiting:
                child = self._waiting.pop()
                if child.is_alive:
                    break
                self._end(child)
            else:
                child = self._start()
                self._children.add(child)
        stays = False
        try:
            yield child
            stays = child.stays
        finally:
            with self._lock:
                stays = stays and not self._closed and len(self._waiting) < self._waiting_max
                if stays:
                    self._waiting.append(child)
            if not stays:
                self._end(child)

    def _end(self, child: Child) -> None:
        child.end()
        self._children.discard(child)

    def close(self) -> None:
        """End all processes; who waits for an answer gets ProcessEnded."""
        with self._lock:
            self._closed = True
            children = list(self._children)
        for child in children:
            child.kill()
        for child in children:
            child.end()


@contextmanager
def killed_at_stop(child: Child, budget: Budget) -> Iterator[None]:
    """A context in which the process is killed as soon as the budget is stopped."""
    done = Event()

    def watch() -> None:
        while not done.wait(LOOK_SECONDS):
            if budget.stopped:
                child.kill()
                return

    watcher = Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield
    finally:
        done.set()
        watcher.join()
