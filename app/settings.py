"""Limits of the service and its data folder, read from BENCH_DRAGON_* environment variables."""

from __future__ import annotations

import os
import re
from difflib import get_close_matches
from ipaddress import ip_address
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, ValidationError
from pydantic_core import PydanticCustomError

from core.errors import InvalidValue
from core.quantities import Given, Quantity

# Variable with the folder where prometheus_client adds up the counts of all processes; app/service/workers.py sets it.
SHARED_COUNTS = "PROMETHEUS_MULTIPROC_DIR"
PREFIX = "BENCH_DRAGON_"
# Environment variable of Settings.data, the folder of jobs, which all processes of a service share.
DATA = f"{PREFIX}DATA"
# Largest number of processes of one service; each takes about 100 MB.
WORKERS_MAX = 64
# Address of a Dask scheduler, its port in group 1; "local" is a cluster of this machine.
SCHEDULER = re.compile(r"(?:(?:tcp|tls|ucx|wss?)://)?(?:[\w.-]+|\[[\da-fA-F:.]+\]):(\d{1,5})|local|")
PORT_MAX = 65535


def _scheduler(address: str) -> str:
    match = SCHEDULER.fullmatch(address)
    if match is None or not 1 <= int(match[1] or 1) <= PORT_MAX:
        raise PydanticCustomError("rule", "must be the address of a scheduler, as tcp://scheduler:8786")
    return address


# Path under which a proxy shows the service.
ROOT_PATH = re.compile(r"(/[A-Za-z0-9._~-]+)*")


def _root_path(path: str) -> str:
    """The path without a slash at its end."""
    path = path.rstrip("/")
    if not ROOT_PATH.fullmatch(path):
        raise PydanticCustomError("rule", "must be a path of letters, digits, '.', '_', '~' and '-', as /dance")
    return path


# A host name or an address, without a port.
HOST_NAME = re.compile(r"[a-z0-9]([a-z0-9.-]*[a-z0-9])?|\[[0-9a-f:.]+\]")


def _hosts(names: str) -> str:
    """The names without spaces, in lower case."""
    known = [name.strip().lower().rstrip(".") for name in names.split(",")]
    if not all(map(HOST_NAME.fullmatch, known)):
        raise PydanticCustomError(
            "rule", "must be names of hosts without ports, as dance.example,192.0.2.7,[2001:db8::7]"
        )
    return ",".join(known)


def part(slots: int, most: int | None) -> int:
    """Number of slots that one client may take: `most`, or without it all but one; of one slot that one.

    >>> part(4, None), part(2, None), part(1, None), part(4, 2), part(2, 8)
    (3, 1, 1, 2, 2)
    """
    return max(slots - 1, 1) if most is None else min(most, slots)


def refuse_open_port(settings: Settings) -> None:
    """raises: InvalidValue if the port of a container is open to other machines without a token"""
    if not settings.published or settings.token:
        return
    try:
        is_open = not ip_address(settings.published.strip("[]")).is_loopback
    except ValueError:
        is_open = settings.published != "localhost"
    if is_open:
        rule = "BENCH_DRAGON_PUBLISHED must be 127.0.0.1 without a token, so that strangers make no jobs"
        advice = "set BENCH_DRAGON_TOKEN too"
        raise InvalidValue.in_words("published", rule, got=Given(settings.published), reason=advice)


def unknown_variables() -> list[str]:
    """A message for each BENCH_DRAGON_* environment variable that is not a setting, such as a misspelt one.

    Such a variable is not an error: Kubernetes gives a program variables that begin with the name of its service.
    """
    known = [PREFIX + name.upper() for name in Settings.model_fields]
    messages = []
    for name in sorted(set(os.environ) - set(known)):
        if name.startswith(PREFIX):
            meant = "".join(f"; did you mean {one}?" for one in get_close_matches(name, known, 1, 0.8))
            messages.append(f"The environment variable {name} is not a setting and has no effect{meant}")
    return messages


# What a variable must be, by pydantic's type of fault.
LIMITS = ("gt", "ge", "le")
RULES = {
    "int_parsing": "must be a whole number",
    "int_from_float": "must be a whole number",
    "float_parsing": "must be a number",
    "finite_number": "must be a finite number",
    "bool_parsing": "must be true or false",
    "greater_than": "must be more than {gt}",
    "greater_than_equal": "must be at least {ge}",
    "less_than_equal": "must be at most {le}",
}


class Settings(BaseModel):
    """Limits of one process for a single request and for requests at the same time.

    Each field is read from a variable: BENCH_DRAGON_ and its name in capitals, such as BENCH_DRAGON_BENCHES_MAX.
    """

    model_config = ConfigDict(frozen=True, defer_build=True)

    def __init__(self, **values: Any) -> None:
        """raises: InvalidValue naming the variable"""
        # pydantic-settings does the same, but its import takes a fifth of a cold command (measured 2026-11-22).
        variables = {name: PREFIX + name.upper() for name in type(self).model_fields}
        # An empty variable counts as unset, because compose.yaml passes an unset variable on as an empty one.
        from_environment = {name: os.environ[key] for name, key in variables.items() if os.environ.get(key)}
        try:
            super().__init__(**from_environment | values)
        except ValidationError as error:
            first = error.errors()[0]
            name = variables[str(first["loc"][0])]
            limits = {word: Quantity(limit, "", 6) for word, limit in first.get("ctx", {}).items() if word in LIMITS}
            rule = RULES.get(first["type"], "{why}")
            raise InvalidValue(name, rule, got=Given(first["input"]), why=first["msg"], **limits) from error

    body_bytes_max: int = Field(4_000_000, ge=1, description="Longest request body [bytes]")
    grade_bytes_max: int = Field(20_000_000, ge=1, description="Longest file in POST /grade [bytes]")
    grade_seconds: float = Field(60.0, gt=0, description="Longest grading of one file [s]")
    places_bytes_max: int = Field(20_000_000, ge=1, description="Longest map in POST /places [bytes]")
    places_seconds: float = Field(20.0, gt=0, description="Longest reading of one map [s]")
    readers_max: int = Field(
        2, ge=1, description="Files of /grade and /places read at once by one process; further ones get 503"
    )
    readers_client_max: int | None = Field(
        None,
        ge=1,
        description="Files of one client read at once by one process; further ones get 429; default: all slots but one",
    )
    reader_memory_max: int = Field(
        1_000_000_000, ge=2**29, description="Address space of a process that reads a file [bytes]"
    )
    benches_max: int = Field(100_000, ge=1, description="Longest dragon [benches]")
    scanned_benches_max: int = Field(10_000, ge=1, description="Longest dragon whose pitches are scanned [benches]")
    checked_benches_max: int = Field(
        2_000,
        ge=1,
        description="Longest dragon that is searched bench by bench [benches]: in all questions but trajectory, "
        "collision_time, minimum_pitch, pitch_scan and GET /clearance; in these, except the trajectory, if the dragon "
        "is not uniform or the path is no spiral",
    )
    performed_benches_max: int = Field(
        10_000, ge=1, description="Most benches of all dragons of a performance [benches]"
    )
    drawn_benches_max: int = Field(5_000, ge=1, description="Longest dragon in a figure [benches]")
    film_megapixels_max: int = Field(
        4_000, ge=1, description="Largest film: millions of pixels of all frames; 20 s at 1080p have 1,244"
    )
    samples_max: int = Field(100_000, ge=1, description="Most samples of one contact probability")
    cells_max: int = Field(1_000_000, ge=1, description="Largest table: instants x handles")
    workbook_cells_max: int = Field(200_000, ge=1, description="Largest xlsx table, which is slow to write")
    poses_max: int = Field(20_000, ge=1, description="Largest number of benches in one /overlaps request")
    pairs_max: int = Field(20_000, ge=1, description="Largest number of overlapping pairs in one /overlaps answer")
    query_bytes_max: int = Field(8_000, ge=1, description="Longest query [bytes]")
    parts_max: int = Field(200_000, ge=1, description="Most objects and lists in one request body")
    cheap_max: int = Field(
        8, ge=1, description="Computations of up to 0.1 s at once in one process; further ones get 503"
    )
    heavy_max: int = Field(5, ge=1, description="Longer computations at once in one process; further ones get 503")
    heavy_client_max: int | None = Field(
        None,
        ge=1,
        description="Longer computations at once of one client in one process; further ones get 429; default: all "
        "slots but one",
    )
    workbooks_max: int = Field(1, ge=1, description="Workbooks written at once in one process; further ones get 503")
    bodies_bytes_max: int = Field(
        200_000_000, ge=1, description="Bodies held at once in one process [bytes]; further large ones get 503"
    )
    large_bodies_max: int = Field(
        4, ge=1, description="Bodies over 64 kB read at once in one process; further ones get 503"
    )
    retry_after: int = Field(1, ge=1, description="Shortest wait that a 503 asks for [s]")
    deadline_seconds: float = Field(10.0, gt=0, description="Longest computation of one answer [s]; jobs take longer")
    head_seconds: float = Field(10.0, gt=0, description="Longest time to send the head of a request [s]")
    body_seconds: float = Field(60.0, gt=0, description="Longest time to send a body [s]")
    stalled_seconds: float = Field(30.0, gt=0, description="Longest time without taking more of an answer [s]")
    grace_seconds: int = Field(10, ge=0, description="Longest wait for running computations after SIGTERM [s]")
    log_json: bool = Field(False, description="Log one JSON object a line")
    compressed_bytes_min: int = Field(
        1_000_000, ge=0, description="Shortest answer sent as gzip to clients that accept it [bytes]; 0: never gzip"
    )
    kept_bytes_max: int = Field(
        32_000_000, ge=0, description="Memory for the latest answers in one process [bytes]; 0: none"
    )
    cache_seconds: int = Field(86_400, ge=0, description="Cache-Control max-age of an answer [s]")
    data: Path | None = Field(
        None, description="Folder of the jobs; default: a temporary folder, removed when the service ends"
    )
    token: str = Field(
        "", description="Token that jobs and uploads must carry (Authorization: Bearer); empty: none needed"
    )
    hosts: Annotated[str, AfterValidator(_hosts)] = Field(
        "", description="Names and addresses under which the service answers, with commas between; empty: under any"
    )
    root_path: Annotated[str, AfterValidator(_root_path)] = Field(
        "", description="Path under which a proxy shows the service, as /dance; empty: none"
    )
    published: str = Field(
        "",
        description="Address at which a container publishes the port of the service; another one than that of this "
        "machine itself needs a token; empty: unknown",
    )
    jobs_max: int = Field(
        1_000, ge=1, description="Largest number of jobs kept; the oldest of who has most give way to further ones"
    )
    jobs_client_max: int = Field(20, ge=1, description="Unfinished jobs of one client; further requests get 429")
    jobs_client_kept_max: int = Field(
        200, ge=1, description="Jobs of one client that are kept; its oldest give way to further ones"
    )
    jobs_client_bytes_max: int = Field(
        25 * 10**8, ge=1, description="Size of the requests and results of the jobs of one client [bytes]"
    )
    jobs_running_max: int = Field(3, ge=1, description="Jobs that run at once; the others wait")
    jobs_running_client_max: int | None = Field(
        None, ge=1, description="Jobs of one client that run at once; default: all slots but one"
    )
    jobs_bytes_max: int = Field(
        10**10, ge=1, description="Size of the requests and results of all jobs; the oldest give way [bytes]"
    )
    jobs_listeners_max: int = Field(100, ge=1, description="Clients that follow a job, for each process")
    job_result_bytes_max: int = Field(10**9, ge=1, description="Largest result of a job [bytes]")
    job_memory_max: int = Field(4 * 2**30, ge=2**28, description="Memory of the process of a job [bytes]")
    job_seconds_max: float = Field(3_600.0, gt=0, description="Longest run of a job [s]")
    sweep_designs_max: int = Field(1_000_000, ge=1, description="Most designs of one sweep")
    sweep_shards_max: int = Field(10_000, ge=1, description="Most files of one sweep while it runs")
    sweep_bytes_max: int = Field(
        10**9, ge=1, description="Size of the files of one sweep while it runs; beyond it the sweep fails [bytes]"
    )
    sweep_seconds_max: float = Field(86_400.0, gt=0, description="Longest run of a sweep [s]")
    sweeps_running_max: int = Field(1, ge=1, description="Sweeps among the jobs that run at once; the others wait")
    sweep_processes: int | None = Field(
        None, ge=1, le=WORKERS_MAX, description="Processes that answer a sweep; default: one for each core"
    )
    dask: Annotated[str, AfterValidator(_scheduler)] = Field(
        "", description="Scheduler of a Dask cluster that answers sweeps; empty: processes of this machine"
    )
    job_days_max: float = Field(7.0, gt=0, description="Time for which a finished job is kept [days]")
