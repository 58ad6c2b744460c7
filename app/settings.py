"""Limits of the service, read from BENCH_DRAGON_* environment variables."""

from __future__ import annotations

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict

# Where prometheus_client keeps the counts of several processes, which app/service/workers.py sets for those it starts.
SHARED_COUNTS = "PROMETHEUS_MULTIPROC_DIR"
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
    query_bytes_max: int = Field(8_000, ge=1, description="Longest query [bytes]")
    parts_max: int = Field(200_000, ge=1, description="Most objects and lists in one request body")
    cheap_max: int = Field(8, ge=1, description="Computations of up to 0.1 s at once in one process; more get a 503")
    heavy_max: int = Field(4, ge=1, description="Longer computations at once in one process; more get a 503")
    workbooks_max: int = Field(1, ge=1, description="Workbooks written at once in one process; more get a 503")
    large_bodies_max: int = Field(4, ge=1, description="Bodies over 64 kB read at once in one process; more get a 503")
    retry_after: int = Field(1, ge=1, description="Shortest wait that a 503 asks for [s]")
    head_seconds: float = Field(10.0, gt=0, description="Longest time to send the head of a request [s]")
    body_seconds: float = Field(60.0, gt=0, description="Longest time to send a body [s]")
    stalled_seconds: float = Field(30.0, gt=0, description="Longest time without taking more of an answer [s]")
    grace_seconds: int = Field(10, ge=0, description="Longest wait for running computations after SIGTERM [s]")
    log_json: bool = Field(False, description="Log one JSON object a line")
    compressed_bytes_min: int = Field(
        1_000_000, ge=0, description="Shortest answer that is sent as gzip to who takes it [bytes]; 0: none is"
    )
    cache_seconds: int = Field(86_400, ge=0, description="Cache-Control max-age of an answer [s]")
