"""The command bench-dragon jobs: the jobs in a data folder, or those of a service at an address."""

from __future__ import annotations

import os
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import orjson
import typer
from rich.table import Table

from app.command import show
from app.files.disk import checked_output, write_whole

if TYPE_CHECKING:
    from app.jobs.places import InFolder, OfService

jobs = typer.Typer(help="Jobs of a data folder or of a service.", no_args_is_help=True, add_completion=False)

Name = Annotated[str, typer.Argument(metavar="JOB", help="The job's name, the last part of its address.")]
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
    found = _at(data, url, token).list()
    if json:
        show.print_json(orjson.dumps({"jobs": found}))
        return
    table = Table(box=None, pad_edge=False)
    for column in ("job", "question", "status", "progress", "asked"):
        table.add_column(column, no_wrap=True)
    for job in found:
        asked = datetime.fromisoformat(job["created"]).astimezone().strftime("%Y-%m-%d %H:%M:%S")
        table.add_row(job["jobID"], job["processID"], job["status"], f"{job['progress']} %", asked)
    show.print_parts(table if found else "No jobs.")


@jobs.command("show")
def show_job(job: Name, data: Data = None, url: Url = "", token: Token = "", json: Json = False) -> None:
    """Status and progress of one job."""
    found = _at(data, url, token).show(job)
    if json:
        show.print_json(orjson.dumps(found))
        return
    table = Table(box=None, show_header=False, pad_edge=False)
    for name, value in found.items():
        if value is not None and name not in ("links", "type", "problem"):
            table.add_row(name.replace("_", " "), str(value))
    show.print_parts(table)


@jobs.command()
def cancel(job: Name, data: Data = None, url: Url = "", token: Token = "") -> None:
    """Cancel an unfinished job, or remove a finished one with its result."""
    print(f"{job}: {_at(data, url, token).cancel(job)}")


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
    found = _at(data, url, token).result(job)
    if output is None:
        with os.fdopen(os.dup(1), "wb") as out:
            out.write(found)
    else:
        write_whole(output, found)
