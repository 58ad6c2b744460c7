"""POST /sweeps on the real service: the table has the bytes of an undisturbed sweep after any disturbance."""

import json

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from app.files.tables import ARROW_TYPE, CSV_TYPE, PARQUET_TYPE
from app.sweeps.spec import Spec
from app.wire.problem import PROBLEM_TYPE
from app.wire.question import JSON
from tests.support.job_service import SHORT, JobService, wait_for
from tests.support.serving import sample
from tests.support.sweeping import SPEC, answered, followed

TOKEN = "correct horse"
WIDTHS = {"start": 0.2, "stop": 0.3, "count": 60}
# Some seconds of work, a shard of which is done at once. Progress is reported twice a second, and three kills leave
# more than a second of work (0.045 s a design, 2026-11-27).
LONG_SPEC = {
    "question": "check",
    "over": {"dragon.width": WIDTHS},
    "request": {"dragon": {"benches": 40}},
    "shard_size": 1,
}
# Half a minute of work, for a test that ends it itself.
ENDLESS_SPEC = {"question": "check", "over": {"dragon.width": WIDTHS | {"count": 500}}, "shard_size": 5}
# Status and pointer of the refusal of a sweep of collision_time; what a spec refuses otherwise is in test_spec.py.
WRONG = """
422 /over               {"over": {"pitch": {"start": 0.5, "stop": 1, "count": 501}}}
422 /shard_size         {"over": {"pitch": {"start": 0.5, "stop": 1, "count": 101}}, "shard_size": 1}
422 /over/pitsh         {"over": {"pitsh": [1.0]}}
422 /over/pitch.a       {"over": {"pitch.a": [1.0]}}
422 /request/width      {"over": {"pitch": [1.0]}, "request": {"width": -1}}
422 /over/pitch/stop    {"over": {"pitch": {"start": 1}}}
422 /samples            {"over": {"pitch": {"start": 1, "stop": 2}}}
422 /over               {"over": {"pitch": [%s]}}
422 /question           {"question": "pitch", "over": {"pitch": [1.0]}}
406 /accept             {"over": {"pitch": [1.0]}, "accept": "image/png"}
"""


@pytest.fixture(scope="module")
def service(tmp_path_factory):
    limits = {"sweep_designs_max": 500, "sweep_shards_max": 100, "sweep_processes": 1}
    with JobService(tmp_path_factory.mktemp("sweeps"), token=TOKEN, **limits) as service:
        yield service


def parts(service):
    """The shards of all sweeps: which file each is, and when it was written."""
    result = sorted((service.folder / "sweeps").glob("*/part-*"))
    return {file.name: (file.stat().st_ino, file.stat().st_mtime_ns) for file in result}


def test_the_result_is_the_table_of_the_same_sweep_in_each_form(service, tmp_path):
    """The tests of killed sweeps and of the cluster compare Parquet."""
    expected = answered(tmp_path / "a", Spec.of(SPEC))
    expected.to_csv(tmp_path / "a.csv")
    addresses = {form: service.post(SPEC | {"accept": form}, "/sweeps") for form in (CSV_TYPE, JSON, PARQUET_TYPE)}
    as_parquet = addresses[PARQUET_TYPE]
    status = [service.finished(address) for address in addresses.values()][-1]
    assert [status[name] for name in ("status", "processID", "done", "total")] == ["successful", "sweep", 40, 40]

    def taken(address, form):
        """The form of a result, and its bytes."""
        answer = service.client.get(f"{address}/result", headers={"Accept": form})
        return answer.headers["content-type"].partition(";")[0], answer.content

    # Parquet becomes any other form, and no other form another.
    assert all(taken(as_parquet, form) == taken(address, "*/*") for form, address in addresses.items())
    assert taken(addresses[CSV_TYPE], JSON) == (CSV_TYPE, (tmp_path / "a.csv").read_bytes())
    columns = json.loads(taken(as_parquet, JSON)[1])
    assert columns == expected.table().to_pydict()
    assert columns["error.code"].count("invalid-value") == 10
    with pa.ipc.open_file(taken(as_parquet, ARROW_TYPE)[1]) as arrow:
        assert arrow.read_all().equals(expected.table())
    for form in ("text/html, */*;q=0.8", "image/png"):
        assert taken(as_parquet, form)[0] == PARQUET_TYPE
    wait_for(lambda: not list((service.folder / "sweeps").iterdir()))
    # A table that would take much memory is there as Parquet alone.
    large = pa.table({f"c{k}": np.zeros(200_001) for k in range(10)})
    pq.write_table(large, service.folder / "results" / as_parquet.rpartition("/")[2])
    assert [taken(as_parquet, form)[0] for form in (JSON, "*/*")] == [PROBLEM_TYPE, PARQUET_TYPE]
    service.remove(*addresses.values())


@pytest.mark.thorough
def test_a_sweep_that_is_killed_more_often_than_other_jobs_may_be_goes_on_from_its_shards(service, tmp_path):
    address = service.post(LONG_SPEC, "/sweeps")
    for kill in range(3):
        before = len(parts(service))
        wait_for(lambda before=before: len(parts(service)) > before)
        there = parts(service)
        wait_for(lambda: service.of("child"))
        killed = {child.pid for child in service.of("child") if child.kill() is None}
        if kill == 2:  # The runner has seen the last death, and then all of the service is killed.
            wait_for(lambda killed=killed: {child.pid for child in service.of("child")} - killed)
            service.start_again()
        service.until(address, "running")
        wait_for(lambda: service.of("child"))
        assert there.items() <= parts(service).items()
    status, events = followed(service.client, address)
    assert status["status"] == "successful", status
    done = [event["done"] for event in events]
    assert any(0 < event["done"] < WIDTHS["count"] for event in events if event["rate"])
    assert done == sorted(done)
    assert service.result(address).content == answered(tmp_path / "a", Spec.of(LONG_SPEC)).compact().read_bytes()


@pytest.mark.thorough
def test_a_dismissed_sweep_leaves_no_shard_nor_process_and_others_are_answered_meanwhile(service):
    address = service.post(ENDLESS_SPEC, "/sweeps")
    waits = service.post(ENDLESS_SPEC, "/sweeps")
    wait_for(lambda: parts(service))
    service.done(SHORT)
    wait_for(lambda: sample(service.client.base_url, "bench_dragon_sweep_designs_done") > 0)
    assert sample(service.client.base_url, "bench_dragon_sweep_designs") == 500
    # One sweep at once: the other leaves its place to other jobs.
    assert service.status(waits)["status"] == "accepted"
    # One process answers calls, and one the sweep.
    wait_for(lambda: len(service.of("worker") + service.of("parent")) == 2)
    for job in (waits, address):
        assert service.client.delete(job).json()["status"] == "dismissed"
        assert service.client.delete(job).status_code == 204
    wait_for(lambda: not list((service.folder / "sweeps").iterdir()))
    wait_for(lambda: not service.of("child") and not service.of("worker"))


@pytest.mark.parametrize("row", WRONG.strip().splitlines())
def test_what_is_wrong_is_refused_at_once_by_its_place(service, row):
    status, pointer, wanted = row.replace("%s", "[" * 300 + "]" * 300).split(maxsplit=2)
    answer = service.client.post("/sweeps", json={"question": "collision_time"} | json.loads(wanted))
    assert answer.status_code == int(status)
    assert answer.json()["errors"][0]["pointer"].startswith(pointer)
