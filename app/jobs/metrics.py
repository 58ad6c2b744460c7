"""Metrics of the jobs, read from the store when they are asked for, so that all processes say the same."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from prometheus_client.core import GaugeMetricFamily
from prometheus_client.registry import Collector

from app.jobs.job import JobState
from app.jobs.keeper import Keeper


class JobMetrics(Collector):
    """How many jobs are in each state, and how far sweeps are that are not finished."""

    def __init__(self, keeper: Callable[[], Keeper | str]) -> None:
        """keeper: gives the jobs of this process, or why there are none"""
        self._keeper = keeper

    def describe(self) -> list[GaugeMetricFamily]:
        """Nothing: a registry must not ask for the jobs before the service has started."""
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
        yield GaugeMetricFamily("bench_dragon_sweep_designs", "Designs of sweeps that are not finished", value=total)
        yield GaugeMetricFamily("bench_dragon_sweep_designs_done", "Those that are answered", value=done)
        shards = sum(1 for _ in keeper.store.sweeps.glob("*/part-*"))
        yield GaugeMetricFamily("bench_dragon_sweep_shards", "Files of sweeps that are not finished", value=shards)
