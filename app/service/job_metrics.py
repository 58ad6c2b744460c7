"""Metrics of the jobs, read from the store on each request, so that all processes report the same."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator

from prometheus_client.core import CounterMetricFamily, GaugeMetricFamily, Metric
from prometheus_client.registry import Collector

from app.jobs.job import JobState
from app.jobs.keeper import Keeper

STORE_FAILED = "1 while the store of the jobs cannot be read, and the other metrics of jobs are missing"


class JobMetrics(Collector):
    """Number of jobs in each state, how full the store is, and progress of unfinished sweeps."""

    def __init__(self, keeper: Callable[[], Keeper | str]) -> None:
        """keeper: function that gives the keeper of this process, or the reason why there is none"""
        self._keeper = keeper

    def describe(self) -> list[Metric]:
        """Empty, because a registry must not ask for the jobs before the service has started."""
        return []

    def collect(self) -> Iterator[Metric]:
        keeper = self._keeper()
        if isinstance(keeper, str):
            return
        try:
            keeper.store.check_file()
            counts = keeper.store.counts()
        except (OSError, sqlite3.Error) as error:  # The other metrics are needed all the more.
            keeper.faults.log(str(error))
            yield GaugeMetricFamily("bench_dragon_jobs_store_failed", STORE_FAILED, value=1)
            return
        yield GaugeMetricFamily("bench_dragon_jobs_store_failed", STORE_FAILED, value=0)
        limits = keeper.settings
        states = GaugeMetricFamily("bench_dragon_jobs", "Jobs that are kept", labels=["state"])
        for state in JobState:
            states.add_metric([state], counts.states.get(state, 0))
        yield states
        shards = sum(1 for _ in keeper.store.sweeps.glob("*/part-*"))
        values = {
            "jobs_kept": ("Jobs that are kept, of all clients", counts.kept),
            "jobs_kept_limit": ("Most jobs that are kept", limits.jobs_max),
            "jobs_kept_of_client": ("Jobs that are kept of the client that has most", counts.of_client),
            "jobs_kept_of_client_limit": ("Most jobs that are kept of one client", limits.jobs_client_kept_max),
            "jobs_bytes": ("Size of the requests and results of all jobs", counts.used),
            "jobs_bytes_limit": ("Size from which older jobs give way", limits.jobs_bytes_max),
            "sweep_designs": ("Designs of unfinished sweeps", counts.total),
            "sweep_designs_done": ("Answered designs of unfinished sweeps", counts.done),
            "sweep_shards": ("Files of unfinished sweeps", shards),
        }
        for name, (words, value) in values.items():
            yield GaugeMetricFamily(f"bench_dragon_{name}", words, value=value)
        words = "Finished jobs whose results gave way to newer jobs"
        yield CounterMetricFamily("bench_dragon_jobs_gave_way", words, value=counts.gave_way)
