"""The command bench-dragon jobs: the jobs in a data folder, or those of a service at an address."""

from __future__ import annotations

import os
import re
import time
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import orjson
import typer
from rich.table import Table

from app.command import show
from app.command.usage import Commands
from app.files.disk import checked_output, write_whole
from core import InvalidValue
from core.language import Listed, Phrases, counted, say
from core.quantities import Given

if TYPE_CHECKING:
    from app.jobs.places import InFolder, OfService

jobs = typer.Typer(
    cls=Commands, help="Jobs of a data folder or of a service.", no_args_is_help=True, add_completion=False
)

NAME_HELP = "The job's name, the last part of its address."
# A duration: a number and its unit, each of so many seconds.
SECONDS = {"s": 1.0, "min": 60.0, "h": 3_600.0, "d": 86_400.0}
DURATION = re.compile(rf"(\d{{1,9}}(?:\.\d{{1,9}})?) ?({'|'.join(SECONDS)})")

# Words of the states of a job, and labels of what is known of it.
STATES: Phrases = {
    "accepted": "accepted", "running": "running", "successful": "successful", "failed": "failed",
    "dismissed": "dismissed", "removed": "removed",
}  # fmt: skip
LABELS: Phrases = {
    "jobID": "job", "processID": "question", "status": "status", "message": "message", "created": "created",
    "started": "started", "finished": "finished", "updated": "updated", "progress": "progress", "rate": "rate",
    "time_left": "time left", "done": "done", "total": "total",
}  # fmt: skip

Name = Annotated[str, typer.Argument(metavar="JOB", help=NAME_HELP)]
Data = Annotated[Path | None, typer.Option(help="Data folder of the service; default: BENCH_DRAGON_DATA.")]
Url = Annotated[str, typer.Option(help="Address of a service, such as http://127.0.0.1:8000, in place of a folder.")]
Token = Annotated[str, typer.Option(help="Token of that service.", envvar="BENCH_DRAGON_TOKEN")]
Json = Annotated[bool, typer.Option("--json", help="The service's JSON instead of a table.")]


def _at(data: Path | None, url: str, token: str) -> InFolder | OfService:
    from app.jobs.places import place  # The import takes 60 ms, and no other command needs it.

    return place(data, url, token)


@jobs.command("list")
def list_jobs(data: Data = None, url: Url = "", token: Token = "", json: Json = False) -> None:
    """All jobs, the newest first."""
    listed = _at(data, url, token).list()
    if json:
        show.print_json(orjson.dumps({"jobs": listed}))
        return
    table = Table(box=None, pad_edge=False)
    for column in (say("job"), say("question"), say("status"), say("progress"), say("asked")):
        table.add_column(column, no_wrap=True)
    for job in listed:
        created = datetime.fromisoformat(job["created"]).astimezone().strftime("%Y-%m-%d %H:%M:%S")
        table.add_row(job["jobID"], job["processID"], say(STATES[job["status"]]), f"{job['progress']} %", created)
    show.print_parts(table if listed else say("No jobs."))


@jobs.command("show")
def show_job(job: Name, data: Data = None, url: Url = "", token: Token = "", json: Json = False) -> None:
    """Status and progress of one job."""
    status = _at(data, url, token).show(job)
    if json:
        show.print_json(orjson.dumps(status))
        return
    table = Table(box=None, show_header=False, pad_edge=False)
    for name, value in status.items():
        if value is not None and name not in ("links", "type", "problem", "sentence"):
            table.add_row(say(LABELS.get(name, name)), say(STATES[value]) if name == "status" else str(value))
    show.print_parts(table)


@jobs.command()
def cancel(
    job: Annotated[str | None, typer.Argument(metavar="[JOB]", help=NAME_HELP)] = None,
    every: Annotated[bool, typer.Option("--all", help="All jobs.")] = False,
    older_than: Annotated[
        str, typer.Option(metavar="DURATION", help="All jobs asked for longer ago: 90s, 30min, 12h or 7d.")
    ] = "",
    data: Data = None,
    url: Url = "",
    token: Token = "",
) -> None:
    """Cancel an unfinished job, or remove a finished one with its result; or all jobs, or all old ones."""
    if (job is not None) + every + bool(older_than) != 1:
        raise InvalidValue.in_words("job", "give one of JOB, --all and --older-than")
    before = time.time() - (_seconds(older_than) if older_than else 0.0)
    place = _at(data, url, token)
    if job is not None:
        print(f"{job}: {say(STATES[place.cancel(job)])}")
        return
    counts = place.cancel_all(before)
    dismissed, removed = counts.values()
    words = counted(dismissed, "{count} job dismissed", "{count} jobs dismissed")
    print(Listed([words, counted(removed, "{count} job removed", "{count} jobs removed")]))


def _seconds(text: str) -> float:
    """A duration such as 12h [s]. raises: InvalidValue"""
    match = DURATION.fullmatch(text.strip())
    if match is None:
        rule = "--older-than must be a number with one of the units s, min, h and d, as in 7d"
        raise InvalidValue.in_words("older_than", rule, got=Given(text, text))
    return float(match[1]) * SECONDS[match[2]]


@jobs.command()
def result(
    job: Name,
    output: Annotated[Path | None, typer.Option(help="File for the result; default: standard output.")] = None,
    data: Data = None,
    url: Url = "",
    token: Token = "",
) -> None:
    """Result of a finished job: the same bytes as the service's direct answer."""
    if output is not None:
        checked_output("output", output)
    answer = _at(data, url, token).result(job)
    if output is None:
        with os.fdopen(os.dup(1), "wb") as out:
            out.write(answer)
    else:
        write_whole(output, answer)
