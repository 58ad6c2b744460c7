"""Jobs on the wire: requests for jobs, and their status in the terms of OGC API Processes."""

from __future__ import annotations

import math
from typing import Any

import orjson
from pydantic import BaseModel, ConfigDict, Field

from app.files.tables import ARROW_TYPE, CSV_TYPE, PARQUET_TYPE
from app.jobs.job import Job, JobState
from app.sweeps.spec import Spec
from app.wire.faults import pointer
from app.wire.fields import Answer
from app.wire.problem import Problem
from app.wire.question import JSON
from core.language import Phrases, say

# States of a job, as people read them.
STATES: Phrases = {
    JobState.ACCEPTED: "waits for its turn",
    JobState.RUNNING: "runs",
    JobState.SUCCESSFUL: "done",
    JobState.FAILED: "failed",
    JobState.DISMISSED: "cancelled",
}
EVENTS_TYPE = "text/event-stream"
# Formats of the table of a sweep, the first one by default.
SWEEP_FORMS = (PARQUET_TYPE, CSV_TYPE, JSON, ARROW_TYPE)
SWEEP_EXAMPLE = {
    "question": "collision_time",
    "over": {"pitch": {"start": 0.5, "stop": 0.6, "count": 40}, "width": [0.25, 0.3, 0.35]},
    "request": {"margin": 0.05},
    "accept": "text/csv",
}


class JobRequest(BaseModel):
    """A question to be answered later."""

    model_config = ConfigDict(extra="forbid", strict=True)

    question: str = Field(description="Operation id of the call that answers it, such as collision_time")
    request: dict[str, Any] = Field({}, description="Input of the call: its query parameters, or its body")
    accept: str = Field("*/*", description="Format of the result, as in the header Accept of the call", max_length=200)


class SweepRequest(Spec):
    """One question with values for some of its parameters, as in the file of a sweep."""

    accept: str = Field(
        "*/*",
        description=f"Format of the table, as in a header Accept; with */* the first of {', '.join(SWEEP_FORMS)}",
        max_length=200,
    )


def pointer_in_sweep(field: str, sweep: SweepRequest) -> str:
    """JSON pointer to a field in the request of a sweep: its own, or a parameter of its question.

    >>> pointer_in_sweep("path.pitch", SweepRequest(question="check", over={"path.pitch": [-1]}))
    '/over/path.pitch'
    """
    if field.partition(".")[0] in SweepRequest.model_fields:
        return pointer(field.split("."), sweep.model_dump(mode="json"))
    if over := next((name for name in sweep.over if f"{name}.".startswith(f"{field}.")), ""):
        return f"/over/{over}"
    return f"/request{pointer(field.split('.'), sweep.request)}"


class Link(Answer):
    """A link to a resource of a job.

    href: address
    rel: Target: self, monitor (its events), or results
    type: media type; for results that of the answer
    """

    href: str
    rel: str
    type: str


class JobStatus(Answer):
    """Status of a job, by the names of OGC API Processes.

    jobID: name of the job, with which anyone may see and dismiss it
    type: always process
    processID: operation id of the call that answers
    status: status of the job
    message: the status in words
    sentence: the status for people: also designs, rate and time left of a sweep that runs
    created: time of the request, in ISO 8601
    started: time of its last start
    finished: time of its end, in success or not
    updated: time of the last change
    progress: share of the work that is done, 0 to 100; 0 if the question cannot tell [%]
    rate: average rate of progress [%/s]
    time_left: time left at that rate [s]
    done: answered designs of a sweep; null before the first report, and for other questions
    total: designs of a sweep; null as for done
    problem: reason of a failure, as in a direct answer of the call
    links: addresses of its status, its events and its result
    """

    jobID: str  # noqa: N815
    type: str
    processID: str  # noqa: N815
    status: JobState
    message: str
    sentence: str
    created: str
    started: str | None
    finished: str | None
    updated: str
    progress: int
    rate: float | None
    time_left: float | None
    done: int | None
    total: int | None
    problem: Problem | None
    links: list[Link]


class JobList(Answer):
    """All jobs of this service, the newest first.

    jobs: the newest first
    """

    jobs: list[JobStatus]


def _progress_words(job: Job) -> str:
    """The state of a job; of a sweep that runs also its designs, its rate and the time left."""
    words = [say(STATES[job.state])]
    if job.state is JobState.RUNNING and job.done is not None:
        words.append(say("{done} of {total} designs", done=job.done, total=job.total))
    if job.state is JobState.RUNNING and job.rate and job.total:
        rate = f"{job.rate * job.total / 100:.3g}"
        words.append(say("{rate} per second, {left} s left", rate=rate, left=math.ceil(job.time_left or 0.0)))
    return say(", ").join(words)


def status(job: Job, root: str) -> bytes:
    """A job on the wire. root: path of the service"""
    at = f"{root}/jobs/{job.id}"
    links = [Link(href=at, rel="self", type=JSON)]
    if not job.is_finished:
        links.append(Link(href=f"{at}/events", rel="monitor", type=EVENTS_TYPE))
    if job.state is JobState.SUCCESSFUL and not job.expired:
        links.append(Link(href=f"{at}/result", rel="results", type=job.media_type or JSON))
    own = {"sentence": _progress_words(job), "links": [link.model_dump() for link in links]}
    return orjson.dumps(job.status() | own)
