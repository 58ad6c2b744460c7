"""Sweeps on a real Dask cluster of this machine."""

import logging
import socket

import psutil
import pytest

from app.sweeps.engines import NoAnswer
from app.sweeps.run import run
from app.sweeps.table import Sweep
from tests.support.odd_questions import LAND, UNANSWERABLE
from tests.support.serving import free_port
from tests.support.sweeping import assert_undisturbed, grid_of, spec_of


def local_cluster(**options):
    """A scheduler with one worker."""
    from distributed import LocalCluster

    return LocalCluster(1, threads_per_worker=1, dashboard_address=None, silence_logs=logging.ERROR, **options)


@pytest.fixture(scope="module")
def dask():
    """Sweeps on Dask, which takes 30 MB."""
    from app.sweeps import cluster

    return cluster


@pytest.fixture(scope="module")
def address():
    """Address of a scheduler with a worker, both in this process."""
    with local_cluster(protocol="tcp://", processes=False) as cluster:
        yield cluster.scheduler_address


def test_a_cluster_answers_as_this_process_does(tmp_path, address, dask):
    spec = grid_of(LAND)
    run(spec, tmp_path / "a", question=LAND, engine=lambda: dask.Cluster(address))
    assert_undisturbed(tmp_path / "a", spec, LAND)


def test_what_no_worker_can_answer_ends_the_run_with_the_reason(tmp_path, address, dask):
    with pytest.raises(NoAnswer, match=r"workers.* cannot answer: "):
        run(grid_of(UNANSWERABLE), tmp_path, question=UNANSWERABLE, engine=lambda: dask.Cluster(address))


@pytest.mark.thorough
def test_a_local_cluster_answers_and_leaves_no_worker(tmp_path, dask):
    before = set(psutil.Process().children(recursive=True))
    spec = grid_of(LAND)
    reports = []
    run(spec, tmp_path / "a", question=LAND, engine=lambda: dask.Cluster(dask.LOCAL, 1), progress=reports.append)
    assert reports[-1].designs == 60
    assert_undisturbed(tmp_path / "a", spec, LAND)
    left = set(psutil.Process().children(recursive=True)) - before
    assert not [child for child in left if "resource_tracker" not in " ".join(child.cmdline())]


@pytest.mark.thorough
def test_a_design_that_kills_workers_of_a_cluster_is_found_alone(tmp_path, monkeypatch, dask):
    monkeypatch.setattr("app.sweeps.run.DEATHS", 1)  # Processes of this machine find it: test_run.py
    spec = spec_of(LAND, {"x": list(range(6))}, request={"deadly": [2.0]}, shard_size=2)
    # A design is given up as soon as it ends a worker.
    with local_cluster(scheduler_kwargs={"allowed_failures": 0}) as cluster:
        run(spec, tmp_path / "a", question=LAND, engine=lambda: dask.Cluster(cluster.scheduler_address))
    codes = Sweep(tmp_path / "a", spec).table()["error.code"].to_pylist()
    assert codes == [None, None, "killed", None, None, None]


@pytest.mark.parametrize("silent", [False, True], ids=["nobody", "who_never_answers"])
def test_an_address_without_a_scheduler_is_named_and_the_log_says_once_that_a_sweep_waits(
    silent, caplog, monkeypatch, dask
):
    monkeypatch.setattr("app.sweeps.cluster.CONNECT", 0.3)
    with socket.create_server(("127.0.0.1", 0)) as peer:
        address = f"tcp://127.0.0.1:{peer.getsockname()[1] if silent else free_port()}"
        with pytest.raises(dask.NoScheduler, match=address):
            dask.Cluster(address, first=2.0)
    assert [record.getMessage() for record in caplog.records if record.name == "app.sweeps"] == [
        f"No Dask scheduler answers at {address}: the sweep waits for it, for 2 s at most"
    ]


def test_an_address_without_a_scheme_is_tried_before_a_client_waits_for_it(monkeypatch, dask):
    monkeypatch.setattr("app.sweeps.cluster.Client", None)
    with pytest.raises(dask.NoScheduler, match="nonsense"):
        dask.Cluster("nonsense")
