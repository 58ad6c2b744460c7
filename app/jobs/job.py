"""One job as a value: its progress, in memory and on the wire."""

from __future__ import annotations

from dataclasses import dataclass, fields
from datetime import UTC, datetime
from enum import StrEnum
from typing import Any

import orjson

# Number of random bytes in a job's name, and the pattern of names: hexadecimal, so never like an option in a shell.
ID_BYTES = 24
ID_PATTERN = r"[0-9a-f]{48}"
# Operation id of the call that asks one question for many designs; its jobs keep additional files while they run.
SWEEP = "sweep"


class JobState(StrEnum):
    """Status of a job, by the names of OGC API Processes."""

    ACCEPTED = "accepted"
    RUNNING = "running"
    SUCCESSFUL = "successful"
    FAILED = "failed"
    DISMISSED = "dismissed"


# Why the call and the result of a finished job are removed: its time was over, or newer jobs needed the room.
EXPIRED, GAVE_WAY = 1, 2
UNFINISHED = (JobState.ACCEPTED, JobState.RUNNING)


@dataclass(frozen=True)
class Job:
    """One job. Times are in seconds since 1970.

    progress: 0 to 100; rate: [percent/s]; time_left: [s]; done, total: designs of a sweep
    deaths: number of its processes that died; size: of its result, or of the shards of a sweep [bytes]
    problem: reason of a failure, as in a direct answer
    expired: EXPIRED or GAVE_WAY if its call and result are removed; 0: they are not
    """

    id: str
    question: str
    state: JobState
    created: float
    started: float | None
    finished: float | None
    updated: float
    message: str
    progress: int
    rate: float | None
    time_left: float | None
    done: int | None
    total: int | None
    deaths: int
    media_type: str | None
    size: int
    problem: bytes | None
    expired: int

    @classmethod
    def of(cls, row: tuple[Any, ...]) -> Job:
        """The job in a row whose columns are these fields."""
        values = dict(zip((field.name for field in fields(cls)), row, strict=True))
        return cls(**values | {"state": JobState(values["state"])})

    @property
    def is_finished(self) -> bool:
        return self.state not in UNFINISHED

    def status(self) -> dict[str, Any]:
        """The job on the wire, by the names of OGC API Processes."""
        return {
            "jobID": self.id,
            "type": "process",
            "processID": self.question,
            "status": self.state,
            "message": self.message,
            "created": _instant(self.created),
            "started": _instant(self.started),
            "finished": _instant(self.finished),
            "updated": _instant(self.updated),
            "progress": self.progress,
            "rate": self.rate,
            "time_left": self.time_left,
            "done": self.done,
            "total": self.total,
            "problem": None if self.problem is None else orjson.loads(self.problem),
        }


def _instant(seconds: float | None) -> str | None:
    if seconds is None:
        return None
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


class Full(Exception):
    """The store has as many jobs as it may hold, and none of them may give way.

    seconds: time after which there will be room, as far as is known; infinite if there will be none
    """

    def __init__(self, seconds: float) -> None:
        super().__init__(f"room in {seconds} s")
        self.seconds = seconds


class FullForClient(Full):
    """This client has as many unfinished jobs as it may."""


class KeptByClient(Full):
    """This client keeps as many jobs or bytes as it may, and none of them may give way."""


class FullOfBytes(Full):
    """The calls and results have reached their limit of bytes, and none of them may give way."""
