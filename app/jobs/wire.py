"""Jobs on the wire: the request that makes one, and what is told of it, in the words of OGC API Processes."""

from __future__ import annotations

from typing import Any

import orjson
from pydantic import BaseModel, ConfigDict, Field

from app.files.tables import CSV_TYPE, PARQUET_TYPE
from app.jobs.job import Job, JobState
from app.sweeps.spec import Spec
from app.wire.faults import pointer
from app.wire.models import JSON, measure
from app.wire.problem import Problem

EVENTS_TYPE = "text/event-stream"
# Forms of the table of a sweep.
SWEEP_FORMS = (PARQUET_TYPE, CSV_TYPE, JSON)
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
    request: dict[str, Any] = Field({}, description="What the call takes: its query parameters, or its body")
    accept: str = Field("*/*", description="Form of the result, as in the header Accept of the call", max_length=200)


class SweepRequest(Spec):
    """One question over some of its parameters, as the file of a sweep says it."""

    accept: str = Field(
        "*/*",
        description=f"Form of the table, as in a header Accept; the first of {', '.join(SWEEP_FORMS)} if any will do",
        max_length=200,
    )


def pointer_in_sweep(field: str, asked: SweepRequest) -> str:
    """Where a sweep gives a field: its own, or a parameter of its question.

    >>> pointer_in_sweep("path.pitch", SweepRequest(question="check", over={"path.pitch": [-1]}))
    '/over/path.pitch'
    """
    if field.partition(".")[0] in SweepRequest.model_fields:
        return pointer(field.split("."), asked.model_dump(mode="json"))
    if over := next((name for name in asked.over if f"{name}.".startswith(f"{field}.")), ""):
        return f"/over/{over}"
    return f"/request{pointer(field.split('.'), asked.request)}"


class Link(BaseModel):
    """A link to a resource of a job."""

    href: str = Field(description="Address")
    rel: str = Field(description="What is there: self, monitor (its events), or results")
    type: str = Field(description="Media type; of results, that of the answer")


class JobStatus(BaseModel):
    """Status of a job, by the names of OGC API Processes."""

    jobID: str = Field(description="Name of the job; whoever knows it may see and dismiss the job")  # noqa: N815
    type: str = Field(description="Always process")
    processID: str = Field(description="Operation id of the call that answers")  # noqa: N815
    status: JobState = Field(description="How far it is")
    message: str = Field(description="The same in words")
    created: str = Field(description="When it was asked for, in ISO 8601")
    started: str | None = Field(description="When it last began to run")
    finished: str | None = Field(description="When it ended, however it did")
    updated: str = Field(description="When any of this last changed")
    progress: int = measure("%", "Share of the work that is done, 0 to 100; 0 where a question cannot say")
    rate: float | None = measure("%/s", "How fast it goes on average")
    time_left: float | None = measure("s", "Time left at that rate")
    done: int | None = Field(
        description="Designs of a sweep that are answered; null before that, and for other questions"
    )
    total: int | None = Field(description="Designs of a sweep; null as for done")
    problem: Problem | None = Field(description="Why it failed, as the call itself would have answered")
    links: list[Link] = Field(description="Where its status, its events and its result are")


class JobList(BaseModel):
    """All jobs of this service, the newest first."""

    jobs: list[JobStatus] = Field(description="The newest first")


def status(job: Job, root: str) -> bytes:
    """A job on the wire. root: path of the service"""
    at = f"{root}/jobs/{job.id}"
    links = [Link(href=at, rel="self", type=JSON)]
    if not job.is_finished:
        links.append(Link(href=f"{at}/events", rel="monitor", type=EVENTS_TYPE))
    if job.state is JobState.SUCCESSFUL and not job.expired:
        links.append(Link(href=f"{at}/result", rel="results", type=job.media_type or JSON))
    return orjson.dumps(job.status() | {"links": [link.model_dump() for link in links]})
