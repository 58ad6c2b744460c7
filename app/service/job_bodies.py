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
from app.wire.fields import measure
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


class Link(BaseModel):
    """A link to a resource of a job."""

    href: str = Field(description="Address")
    rel: str = Field(description="Target: self, monitor (its events), or results")
    type: str = Field(description="Media type; for results that of the answer")


class JobStatus(BaseModel):
    """Status of a job, by the names of OGC API Processes."""

    jobID: str = Field(description="Name of the job, with which anyone may see and dismiss it")  # noqa: N815
    type: str = Field(description="Always process")
    processID: str = Field(description="Operation id of the call that answers")  # noqa: N815
    status: JobState = Field(description="Status of the job")
    message: str = Field(description="The status in words")
    sentence: str = Field(description="The status for people: also designs, rate and time left of a sweep that runs")
    created: str = Field(description="Time of the request, in ISO 8601")
    started: str | None = Field(description="Time of its last start")
    finished: str | None = Field(description="Time of its end, in success or not")
    updated: str = Field(description="Time of the last change")
    progress: int = measure("%", "Share of the work that is done, 0 to 100; 0 if the question cannot tell")
    rate: float | None = measure("%/s", "Average rate of progress")
    time_left: float | None = measure("s", "Time left at that rate")
    done: int | None = Field(
        description="Answered designs of a sweep; null before the first report, and for other questions"
    )
    total: int | None = Field(description="Designs of a sweep; null as for done")
    problem: Problem | None = Field(description="Reason of a failure, as in a direct answer of the call")
    links: list[Link] = Field(description="Addresses of its status, its events and its result")


class JobList(BaseModel):
    """All jobs of this service, the newest first."""

    jobs: list[JobStatus] = Field(description="The newest first")


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
