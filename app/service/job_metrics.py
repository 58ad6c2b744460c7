"""Metrics of the jobs, read from the store on each request, so that all processes report the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from prometheus_client.core import GaugeMetricFamily
from prometheus_client.registry import Collector

from app.jobs.job import JobState
from app.jobs.keeper import Keeper


class JobMetrics(Collector):
    """Number of jobs in each state, and progress of unfinished sweeps."""

    def __init__(self, keeper: Callable[[], Keeper | str]) -> None:
        """keeper: function that gives the keeper of this process, or the reason why there is none"""
        self._keeper = keeper

    def describe(self) -> list[GaugeMetricFamily]:
        """Empty, because a registry must not ask for the jobs before the service has started."""
        return []

    def collect(self) -> Iterator[GaugeMetricFamily]:
        keeper = self._keeper()
        if isinstance(keeper, str):
            return
        counts, done, total = keeper.store.counts()
        states = GaugeMetricFamily("bench_dragon_jobs", "Jobs that are kept", labels=["state"])
        for state in JobState:
            states.add_metric([state], counts.get(state, 0))
        yield states
        yield GaugeMetricFamily("bench_dragon_sweep_designs", "Designs of unfinished sweeps", value=total)
        yield GaugeMetricFamily("bench_dragon_sweep_designs_done", "Answered designs of unfinished sweeps", value=done)
        shards = sum(1 for _ in keeper.store.sweeps.glob("*/part-*"))
        yield GaugeMetricFamily("bench_dragon_sweep_shards", "Files of unfinished sweeps", value=shards)
