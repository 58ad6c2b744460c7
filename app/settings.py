"""Limits of the service and its data folder, read from BENCH_DRAGON_* environment variables."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict

# Where prometheus_client keeps the counts of several processes, which app/service/workers.py sets for those it starts.
SHARED_COUNTS = "PROMETHEUS_MULTIPROC_DIR"
# Where jobs are kept: Settings.data, which all processes of a service share.
DATA = "BENCH_DRAGON_DATA"
# Most processes of one service, about 100 MB each.
WORKERS_MAX = 64


class Settings(BaseSettings):
    """What one process is willing to do for one request, and for how many at once.

    Each field is set by BENCH_DRAGON_ followed by its name in capitals, such as BENCH_DRAGON_BENCHES_MAX.
    """

    model_config = SettingsConfigDict(env_prefix="BENCH_DRAGON_", frozen=True)

    body_bytes_max: int = Field(4_000_000, ge=1, description="Longest request body [bytes]")
    benches_max: int = Field(100_000, ge=1, description="Longest dragon [benches]")
    scanned_benches_max: int = Field(10_000, ge=1, description="Longest dragon whose pitches are scanned [benches]")
    checked_benches_max: int = Field(
        2_000,
        ge=1,
        description="Longest dragon in /check, POST /clearance, /maximum-head-speed and /shortest-turn [benches]",
    )
    drawn_benches_max: int = Field(5_000, ge=1, description="Longest dragon in a figure [benches]")
    cells_max: int = Field(1_000_000, ge=1, description="Largest table: instants x handles")
    workbook_cells_max: int = Field(200_000, ge=1, description="The same for xlsx, which is slow to write")
    poses_max: int = Field(20_000, ge=1, description="Most benches in one /overlaps request")
    pairs_max: int = Field(20_000, ge=1, description="Most overlapping pairs in one /overlaps answer")
    concurrent_max: int = Field(8, ge=1, description="Computations at once in one process; one more gets a 503")
    retry_after: int = Field(1, ge=1, description="Wait that a 503 asks for [s]")
    data: Path | None = Field(
        None, description="Folder of the jobs; none: a temporary one, and they go with the service"
    )
    token: str = Field("", description="Who may ask for jobs says it (Authorization: Bearer); empty: anyone may")
    jobs_max: int = Field(1_000, ge=1, description="Most jobs kept; one more gets a 503")
    jobs_client_max: int = Field(20, ge=1, description="Most unfinished jobs of one client; one more gets a 429")
    jobs_running_max: int = Field(2, ge=1, description="Jobs that run at once; the others wait")
    jobs_bytes_max: int = Field(
        10**10, ge=1, description="Calls and results of all jobs; with more, no job is taken [bytes]"
    )
    jobs_listeners_max: int = Field(100, ge=1, description="Clients that follow a job, for each process")
    job_result_bytes_max: int = Field(10**9, ge=1, description="Longest result of a job [bytes]")
    job_memory_max: int = Field(4 * 2**30, ge=2**28, description="Memory of the process of a job [bytes]")
    job_seconds_max: float = Field(3_600.0, gt=0, description="Longest time that a job may run [s]")
    job_days_max: float = Field(7.0, gt=0, description="How long a finished job is kept [days]")
    cache_seconds: int = Field(86_400, ge=0, description="Cache-Control max-age of an answer [s]")
