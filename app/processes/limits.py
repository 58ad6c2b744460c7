"""Limits of a process: its memory, its priority, and the first place to end when the system has no memory left."""

from __future__ import annotations

import contextlib
import os
import re
import sys
from collections.abc import Iterator
from importlib import import_module
from importlib.util import find_spec
from pathlib import Path

from core import TooMuchWork
from core.quantities import Quantity

# Memory in which any file within the other limits can be read [bytes]; address space, so that it also holds for what is
# reserved. A new process takes 240 MB of it (measured 2026-11-26).
READING_MAX = 1_000_000_000
# Linux ends the process with the largest sum of this value and the thousandths of the memory that it has first when
# memory runs out; 1,000 is the largest. In a cgroup of 0.6 GB it ended the processes of the service, each larger than
# that of a job beside it (2026-11-30). A job begins again, and nobody waits for its answer on an open connection.
OOM_SCORE, OOM_SCORE_MAX, OOM_SCORE_JOB = Path("/proc/self/oom_score_adj"), 1_000, 500
STATUS, PEAK = Path("/proc/self/status"), re.compile(rb"VmHWM:\s*(\d+) kB")
# Largest peak of the resident memory of a process that takes another task [bytes]; a new one needs 60 to 110 MB.
SMALL = 256_000_000
# Lower priority of jobs, so that other answers come first (man 2 nice).
NICENESS = 10
# The same for what a person waits for: files that are read, pages that are set, and threads of long computations.
# Beside five of these the loop that takes requests waited for a core for up to 0.4 s, with this value for up to 0.2 s,
# with a load of 13 on two cores (2026-11-29). With 10, a plan of 0.2 MB was not read in 20 s at such a load.
AWAITED_NICENESS = 5


def lower_priority(niceness: int = NICENESS) -> None:
    """Let other answers come before those of this process."""
    if hasattr(os, "nice"):
        os.nice(max(niceness - os.nice(0), 0))  # A thread of a long computation may have started it.


def lower_thread_priority(thread: int) -> None:
    """Let the other threads of this process come before one of them, for good. thread: its native id

    Only Linux has a priority of each thread. That of the first thread, whose id is that of the process, stays.
    """
    if sys.platform == "linux" and thread != os.getpid():
        with contextlib.suppress(OSError):  # a sandbox
            lower = os.getpriority(os.PRIO_PROCESS, os.getpid()) + AWAITED_NICENESS
            if os.getpriority(os.PRIO_PROCESS, thread) < lower:
                os.setpriority(os.PRIO_PROCESS, thread, lower)


def limit_memory(most: int) -> None:
    """Limit the address space of this process [bytes], if the system supports it."""
    if find_spec("resource"):
        resource = import_module("resource")
        resource.setrlimit(resource.RLIMIT_AS, (most, most))


def peak_memory() -> int:
    """Largest resident memory of this process so far [bytes]; 0 where the system does not say it."""
    with contextlib.suppress(OSError):  # getrusage() of Linux also counts the process that started this one.
        line = PEAK.search(STATUS.read_bytes())
        return int(line[1]) * 1024 if line else 0
    if not find_spec("resource"):
        return 0
    resource = import_module("resource")
    peak: int = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return peak * (1 if sys.platform == "darwin" else 1024)


def is_small() -> bool:
    """True if this process never needed much memory, so that the next task finds what it would find in a new one."""
    return 0 < peak_memory() < SMALL


def end_first(score: int = OOM_SCORE_MAX) -> None:
    """Let the system end this process before those with a smaller score when memory runs out."""
    with contextlib.suppress(OSError):  # another system than Linux, or a sandbox
        OOM_SCORE.write_text(str(score))


def too_much_memory(most: int = READING_MAX) -> TooMuchWork:
    """The error for a file whose reading needs more memory than it may take [bytes]."""
    words = "the file must be simpler: reading it takes more than {most} of memory"
    return TooMuchWork.in_words("file", words, most=Quantity(most / 1e6, "MB", 6))


@contextlib.contextmanager
def reading() -> Iterator[None]:
    """A context in which this process may take READING_MAX more memory than it has. raises: TooMuchWork

    For a command, which reads files in its own process.
    """
    end_first()
    try:
        with _within(READING_MAX):
            yield
    except MemoryError as error:
        raise too_much_memory() from error


@contextlib.contextmanager
def _within(more: int) -> Iterator[None]:
    pages = Path("/proc/self/statm")
    if not (find_spec("resource") and pages.exists()):
        yield
        return
    resource = import_module("resource")
    before, hard = resource.getrlimit(resource.RLIMIT_AS)
    taken = int(pages.read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    most = min((one for one in (taken + more, before, hard) if one != resource.RLIM_INFINITY), default=taken + more)
    resource.setrlimit(resource.RLIMIT_AS, (most, hard))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_AS, (before, hard))
