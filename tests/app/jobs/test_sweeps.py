"""POST /sweeps on the real service: the table has the bytes of an undisturbed sweep after any disturbance."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from app.files.tables import ARROW_TYPE, CSV_TYPE, PARQUET_TYPE
from app.sweeps.run import begin
from app.sweeps.shards import ShardPiece, write_part
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep
from app.wire.question import JSON
from tests.support.job_service import LINGER, SHORT, JobService, wait_for

TOKEN = "correct horse"
SPEC: dict[str, Any] = {
    "question": "collision_time",
    "over": {"pitch": {"start": 0.42, "stop": 0.60, "count": 10}, "width": [0.25, 0.30, 0.35, -1.0]},
    "request": {"benches": 60},
    "shard_size": 10,
}
# Some seconds of work, a shard of which is done at once. Progress is reported twice a second, and three kills leave
# more than a second of work (0.045 s a design, 2026-11-27).
LONG_SPEC: dict[str, Any] = {
    "question": "check",
    "over": {"dragon.width": {"start": 0.2, "stop": 0.3, "count": 60}},
    "request": {"dragon": {"benches": 40}},
    "shard_size": 1,
}
# Half a minute of work, for a test that ends it itself.
ENDLESS_SPEC: dict[str, Any] = {
    "question": "check",
    "over": {"dragon.width": {"start": 0.2, "stop": 0.3, "count": 500}},
    "shard_size": 5,
}


@pytest.fixture(scope="module")
def service(tmp_path_factory: pytest.TempPathFactory) -> Iterator[JobService]:
    limits = {
        "token": TOKEN,
        "sweep_designs_max": 500,
        "sweep_shards_max": 100,
        "sweep_processes": 1,
    }
    with JobService(tmp_path_factory.mktemp("sweeps"), **limits) as service:
        service.client.headers.update({"Authorization": f"Bearer {TOKEN}"})
        yield service


def undisturbed(folder: Path, spec_fields: dict[str, Any]) -> Sweep:
    """The same sweep, answered in this process."""
    spec = Spec.of(spec_fields)
    begin(folder, spec)
    for shard in range(spec.shards):
        write_part(folder, spec, shard, [ShardPiece.whole(spec, spec.asks, shard).answer()])
    return Sweep(folder, spec)


def parts(service: JobService) -> dict[str, tuple[int, int]]:
    """The shards of all sweeps: which file each is, and when it was written."""
    result = sorted((service.folder / "sweeps").glob("*/part-*"))
    return {file.name: (file.stat().st_ino, file.stat().st_mtime_ns) for file in result}


def followed(client: httpx.Client, address: str) -> tuple[Any, list[Any]]:
    """The last status of a sweep, and all from the first one that says how many designs are done."""
    with client.stream("GET", f"{address}/events") as events:
        lines = [json.loads(line[6:]) for line in events.iter_lines() if line.startswith("data: ")]
    return lines[-1], [status for status in lines if status["done"] is not None]


def metric(service: JobService, name: str) -> float:
    lines = service.client.get("/metrics").text.splitlines()
    return next(float(line.removeprefix(name)) for line in lines if line.startswith(f"{name} "))


def test_the_result_is_the_table_of_the_same_sweep_in_each_form(service: JobService, tmp_path: Path) -> None:
    """The tests of killed sweeps and of the cluster compare Parquet."""
    expected = undisturbed(tmp_path / "a", SPEC)
    expected.to_csv(tmp_path / "a.csv")
    rows = expected.table().to_pylist()
    addresses = {form: service.post(SPEC | {"accept": form}, "/sweeps") for form in (CSV_TYPE, JSON)}
    entries = {}
    for form, address in addresses.items():
        status = service.finished(address)
        assert (status["status"], status["processID"], status["done"], status["total"]) == (
            "successful",
            "sweep",
            40,
            40,
        )
        answer = service.client.get(f"{address}/result")
        assert answer.headers["content-type"].partition(";")[0] == form
        entries[form] = answer.content
    assert entries[CSV_TYPE] == (tmp_path / "a.csv").read_bytes()
    columns = json.loads(entries[JSON])
    assert [dict(zip(columns, row, strict=True)) for row in zip(*columns.values(), strict=True)] == rows
    assert sum(code == "invalid-value" for code in columns["error.code"]) == 10
    wait_for(lambda: not list((service.folder / "sweeps").iterdir()), LINGER)
    as_parquet = service.post(SPEC, "/sweeps")
    assert service.finished(as_parquet)["status"] == "successful"

    def taken(address: str, form: str) -> httpx.Response:
        return service.client.get(f"{address}/result", headers={"Accept": form})

    for form, content in entries.items():
        answer = taken(as_parquet, form)
        assert (answer.headers["content-type"].partition(";")[0], answer.content) == (form, content)
    with pa.ipc.open_file(taken(as_parquet, ARROW_TYPE).content) as arrow:
        assert arrow.read_all().equals(expected.table())
    for form in ("*/*", "text/html, */*;q=0.8", "image/png"):
        assert taken(as_parquet, form).headers["content-type"] == PARQUET_TYPE
    assert taken(addresses[CSV_TYPE], JSON).content == entries[CSV_TYPE]
    # A table that would take much memory is there as Parquet alone.
    large = pa.table({f"c{k}": np.zeros(200_001) for k in range(10)})
    pq.write_table(large, service.folder / "results" / as_parquet.rpartition("/")[2])
    refused = taken(as_parquet, JSON)
    assert (refused.status_code, "take it as Parquet" in refused.json()["detail"]) == (413, True)
    assert taken(as_parquet, "*/*").status_code == 200
    for address in (*addresses.values(), as_parquet):
        assert service.client.delete(address).status_code == 204


def test_a_sweep_that_is_killed_more_often_than_other_jobs_may_be_goes_on_from_its_shards(
    service: JobService, tmp_path: Path
) -> None:
    address = service.post(LONG_SPEC, "/sweeps")
    for kill in range(3):
        before = parts(service)
        wait_for(lambda before=before: len(parts(service)) > len(before))
        there = parts(service)
        wait_for(lambda: service.of("child"))
        killed = service.of("child")
        for process in killed:
            process.kill()
        if kill == 2:  # The runner has seen the last death, and then all of the service is killed.
            wait_for(lambda killed=killed: {one.pid for one in service.of("child")} - {one.pid for one in killed})
            service.process.kill()
            service.process.wait()
            wait_for(lambda: not service.processes(), LINGER)
            service.start()
        wait_for(lambda: service.status(address)["status"] == "running")
        wait_for(lambda: service.of("child"))
        now = parts(service)
        assert {name: now[name] for name in there} == there
    status, events = followed(service.client, address)
    assert status["status"] == "successful", status
    assert any(0 < status["done"] < LONG_SPEC["over"]["dragon.width"]["count"] for status in events if status["rate"])
    assert [status["done"] for status in events] == sorted(status["done"] for status in events)
    expected = undisturbed(tmp_path / "a", LONG_SPEC).compact().read_bytes()
    answer = service.client.get(f"{address}/result")
    assert answer.headers["content-type"] == PARQUET_TYPE
    assert answer.content == expected


def test_a_dismissed_sweep_leaves_no_shard_nor_process_and_others_are_answered_meanwhile(
    service: JobService,
) -> None:
    address, waits = service.post(ENDLESS_SPEC, "/sweeps"), service.post(ENDLESS_SPEC, "/sweeps")
    wait_for(lambda: parts(service))
    assert service.finished(service.post(SHORT))["status"] == "successful"
    wait_for(lambda: metric(service, "bench_dragon_sweep_designs_done") > 0)
    assert metric(service, "bench_dragon_sweep_designs") == 500
    assert metric(service, "bench_dragon_sweep_shards") >= 1
    assert metric(service, 'bench_dragon_jobs{state="running"}') == 1
    # One sweep at once: the other leaves its place to other jobs.
    assert service.status(waits)["status"] == "accepted"
    # One process answers calls, and one the sweep.
    wait_for(lambda: len(service.of("worker") + service.of("parent")) == 2)
    for one in (waits, address):
        assert service.client.delete(one).json()["status"] == "dismissed"
        assert service.client.delete(one).status_code == 204
        assert service.client.get(one).status_code == 404
    wait_for(lambda: not list((service.folder / "sweeps").iterdir()), LINGER)
    wait_for(lambda: not service.of("child") and not service.of("worker"), LINGER)


@pytest.mark.parametrize(
    ("wanted", "status", "pointer", "words"),
    [
        (
            {"over": {"pitch": {"start": 0.5, "stop": 1, "count": 501}}},
            422,
            "/over",
            "designs must be at most 500 here",
        ),
        ({"over": {"pitch": [0.5] * 101}, "shard_size": 1}, 422, "/shard_size", "shards must be at most 100 here, got"),
        ({"over": {"pitsh": [1.0]}}, 422, "/over/pitsh", '"pitsh" is unknown here: did you mean pitch?'),
        ({"over": {"pitch.a": [1.0]}}, 422, "/over/pitch.a", "pitch must be a number [m], got"),
        ({"over": {"pitch": [1.0]}, "request": {"width": -1}}, 422, "/request/width", "width must be at least 0.001 m"),
        ({"over": {"pitch": {"start": 1}}}, 422, "/over/pitch/stop", "stop is missing"),
        ({"over": {"pitch": []}}, 422, "/over/pitch", "pitch must have at least 1 entry, got none"),
        (
            {"over": {"pitch": {"start": 1, "stop": 2, "count": 1}}},
            422,
            "/over/pitch/count",
            "count must be at least 2",
        ),
        ({"over": {"pitch": {"start": 1, "stop": 2}}}, 422, "/samples", "samples must say how to sample pitch"),
        ({"over": {"pitch": [json.loads("[" * 300 + "]" * 300)]}}, 422, "/over", "over must nest objects and lists at"),
        ({"over": {}}, 422, "/over", "over must have at least 1 entry, got none"),
        ({"question": "pitch", "over": {"pitch": [1.0]}}, 422, "/question", "question must be one of collision_time,"),
        ({"over": {"pitch": [1.0]}, "accept": "image/png"}, 406, "/accept", "This call answers application/vnd.apache"),
    ],
    ids=lambda part: part if isinstance(part, str) else None,
)
def test_what_is_wrong_is_refused_at_once_by_its_place(
    service: JobService, wanted: Any, status: int, pointer: str, words: str
) -> None:
    answer = service.client.post("/sweeps", json={"question": "collision_time"} | wanted)
    assert answer.status_code == status
    assert answer.headers["content-type"] == "application/problem+json"
    error = answer.json()["errors"][0]
    assert (error["pointer"][: len(pointer)], error["detail"][: len(words)]) == (pointer, words)


def test_the_token_guards_sweeps(service: JobService) -> None:
    assert service.client.post("/sweeps", json=SPEC, headers={"Authorization": ""}).status_code == 401
