"""Sweeps on a real Dask cluster of this machine."""

from __future__ import annotations

import logging
import socket
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import psutil
import pytest
from distributed import LocalCluster

from app.sweeps.cluster import LOCAL, Cluster, NoScheduler
from app.sweeps.engines import NoAnswer
from app.sweeps.run import Progress, run
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep
from tests.app.sweeps.test_run import compacted, spec_of, undisturbed
from tests.campaigns.sweep_kills import free_port
from tests.support.odd_questions import LAND, UNANSWERABLE


def test_a_local_cluster_answers_as_this_process_does_and_leaves_no_worker(tmp_path: Path) -> None:
    before = {child.pid for child in psutil.Process().children(recursive=True)}
    spec = spec_of(LAND)
    values: list[Progress] = []
    run(spec, tmp_path / "a", question=LAND, engine=lambda: Cluster(LOCAL, 1), progress=values.append)
    assert values[-1].designs == 60
    assert compacted(tmp_path / "a", spec) == undisturbed(tmp_path / "b", spec, LAND)
    left = [child for child in psutil.Process().children(recursive=True) if child.pid not in before]
    assert not [child for child in left if "resource_tracker" not in " ".join(child.cmdline())]


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    """Address of a cluster that gives up a design as soon as it ends a worker."""
    fields: dict[str, Any] = {
        "dashboard_address": None,
        "silence_logs": logging.ERROR,
        "scheduler_kwargs": {"allowed_failures": 0},
    }
    with LocalCluster(n_workers=1, threads_per_worker=1, **fields) as cluster:
        yield cluster.scheduler_address


def test_a_design_that_kills_workers_of_a_cluster_is_found_alone(
    tmp_path: Path, address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("app.sweeps.run.DEATHS", 1)  # Processes of this machine find it: test_run.py
    fields = {"question": LAND.name, "over": {"x": list(range(6))}, "request": {"deadly": [2.0]}, "shard_size": 2}
    spec = Spec.of(fields, LAND)
    run(spec, tmp_path / "a", question=LAND, engine=lambda: Cluster(address))
    rows = Sweep(tmp_path / "a", spec).table(["x", "error.code"]).to_pylist()
    assert [row["x"] for row in rows] == list(range(6))
    assert {row["x"]: row["error.code"] for row in rows if row["error.code"]} == {2: "killed"}


def test_what_no_worker_can_answer_ends_the_run_in_words(tmp_path: Path, address: str) -> None:
    with pytest.raises(NoAnswer, match=r"workers.* cannot answer: "):
        run(spec_of(UNANSWERABLE), tmp_path, question=UNANSWERABLE, engine=lambda: Cluster(address))


def test_an_address_where_nobody_answers_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.sweeps.cluster.CONNECT", 0.3)
    address = f"tcp://127.0.0.1:{free_port()}"
    with pytest.raises(NoScheduler, match=f"no Dask scheduler answers at {address}"):
        Cluster(address)


def test_an_address_without_a_scheme_is_tried_before_a_client_waits_for_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.sweeps.cluster.Client", None)
    with pytest.raises(NoScheduler, match="no Dask scheduler answers at nonsense"):
        Cluster("nonsense")


def test_a_port_that_takes_connections_and_never_answers_is_no_scheduler(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("app.sweeps.cluster.CONNECT", 0.3)
    with socket.create_server(("127.0.0.1", 0)) as silent:
        address = f"tcp://127.0.0.1:{silent.getsockname()[1]}"
        with pytest.raises(NoScheduler, match=f"no Dask scheduler answers at {address}"):
            Cluster(address)
