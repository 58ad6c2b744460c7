"""compose.yaml: valid by the Compose specification, and the commands of its services work together."""

from __future__ import annotations

import json
import os
import re
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
import yaml
from compose_spec import PyCompose

from app.settings import Settings
from tests.app.jobs.test_sweeps import SPEC, followed, undisturbed
from tests.campaigns.sweep_kills import free_port
from tests.conftest import STOP_TIMEOUT, wait_until_live
from tests.support.job_service import LINGER, PATIENCE, wait_for

ROOT = Path(__file__).parent.parent
FILE = yaml.safe_load((ROOT / "compose.yaml").read_text(encoding="utf-8"))
SERVICES = FILE["services"]
BIN = Path(sys.executable).parent
BYTES_MAX = 100_000


def interpolated(text: str, **variables: str) -> str:
    """A value as Compose fills it: ${NAME:-default}, of which the default counts for an empty variable too."""
    return re.sub(r"\$\{(\w+):-([^}]*)\}", lambda result: variables.get(result[1]) or result[2], text)


def test_it_is_valid_by_the_specification() -> None:
    compose = PyCompose.from_json(interpolated(json.dumps(FILE)))
    compose.validate()
    assert sorted(compose.service_names()) == ["scheduler", "service", "worker"]


@pytest.mark.parametrize(
    "wrong", [{"services": {"service": {"read_onli": True}}}, {"services": {}, "volume": {}}], ids=str
)
def test_a_slip_is_no_valid_file(wrong: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="does not start with"):
        PyCompose.from_json(json.dumps(wrong))


def test_the_cluster_is_of_its_profile_and_nothing_is_written_but_in_the_volume() -> None:
    assert {name: one.get("profiles") for name, one in SERVICES.items()} == {
        "service": None,
        "scheduler": ["cluster"],
        "worker": ["cluster"],
    }
    assert SERVICES["worker"]["deploy"]["replicas"] == 2
    assert all(one["read_only"] and one["tmpfs"] == ["/tmp"] for one in SERVICES.values())
    assert {name: one["volumes"] for name, one in SERVICES.items() if "volumes" in one} == {"service": ["data:/data"]}
    dockerfile = (ROOT / "Dockerfile").read_text(encoding="utf-8")
    assert "ARG EXTRAS=service\n" in dockerfile
    assert '"/src[${EXTRAS}]"' in dockerfile
    assert "BENCH_DRAGON_DATA=/data" in dockerfile


def test_memory_holds_what_files_and_jobs_may_take_on_two_cores() -> None:
    gigabytes = int(SERVICES["service"]["mem_limit"].removesuffix("g"))
    settings, workers = Settings(), 2
    files = workers * settings.readers_max * settings.reader_memory_max
    assert files + workers * settings.bodies_bytes_max + workers * 0.3e9 < gigabytes * 1e9
    assert all(one["pids_limit"] == 512 for one in SERVICES.values())
    words = (ROOT / "docs" / "operations.md").read_text(encoding="utf-8")
    assert f"gives the container {gigabytes} GB and 512 processes" in words


def test_its_settings_are_settings() -> None:
    known = {f"BENCH_DRAGON_{name.upper()}" for name in Settings.model_fields}
    assert set(SERVICES["service"]["environment"]) <= known


def test_the_port_is_open_to_this_machine_alone_unless_a_token_is_set(tmp_path: Path) -> None:
    [port], names = SERVICES["service"]["ports"], SERVICES["service"]["environment"]
    assert interpolated(port) == "127.0.0.1:8000:8000"
    for published, token, runs in (("", "", True), ("0.0.0.0", "", False), ("[::]", "", False), ("0.0.0.0", "x", True)):
        variables = {"BENCH_DRAGON_PUBLISHED": published, "BENCH_DRAGON_TOKEN": token}
        assert interpolated(port, **variables).removesuffix(":8000:8000") == (published or "127.0.0.1")
        environment = os.environ | {name: interpolated(text, **variables) for name, text in names.items()}
        here = {"8000": str(free_port()), "0.0.0.0": "127.0.0.1"}
        with (tmp_path / "log").open("wb") as log:
            process = subprocess.Popen(
                command_of("service", here), cwd=tmp_path, env=environment, stdout=log, stderr=log
            )
        try:
            if runs:
                wait_until_live(process, int(here["8000"]), tmp_path / "log")
                continue
            assert process.wait(PATIENCE) == 2
            words = (tmp_path / "log").read_text()
            assert "BENCH_DRAGON_PUBLISHED must be 127.0.0.1 without a token" in words
            assert "set BENCH_DRAGON_TOKEN too" in words
        finally:
            process.terminate()
            process.wait(STOP_TIMEOUT)


def test_the_base_of_the_image_is_named_by_its_digest() -> None:
    bases = re.findall(r"^FROM (\S+)(?: AS (\w+))?$", (ROOT / "Dockerfile").read_text(encoding="utf-8"), re.MULTILINE)
    stages = {stage for _, stage in bases if stage}
    images = [image for image, _ in bases if image not in stages]
    assert len(images) == 1
    assert re.fullmatch(r"python:3\.13-slim-trixie@sha256:[0-9a-f]{64}", images[0])


def command_of(name: str, places: dict[str, str]) -> list[str]:
    """The command of a service, with places of this machine for those inside of the containers."""
    program, *words = SERVICES[name]["command"]
    for place, here in places.items():
        words = [word.replace(place, here) for word in words]
    return [str(BIN / program), *words]


def listens(port: str) -> bool:
    with socket.socket() as peer:
        return peer.connect_ex(("127.0.0.1", int(port))) == 0


@pytest.fixture
def started(tmp_path: Path) -> Iterator[httpx.Client]:
    """A client of the service, which runs with the scheduler and one worker."""
    ports = {"8786": str(free_port()), "8000": str(free_port())}
    places = {"0.0.0.0": "127.0.0.1", "scheduler:": "127.0.0.1:", "/tmp": str(tmp_path), **ports}
    variables = {"BENCH_DRAGON_DATA": str(tmp_path / "data"), "BENCH_DRAGON_DASK": f"tcp://127.0.0.1:{ports['8786']}"}
    variables["BENCH_DRAGON_SWEEP_BYTES_MAX"] = str(BYTES_MAX)
    running: list[subprocess.Popen[bytes]] = []

    def start(name: str) -> subprocess.Popen[bytes]:
        with (tmp_path / f"{name}.log").open("wb") as log:
            running.append(
                subprocess.Popen(
                    command_of(name, places), cwd=tmp_path, env=os.environ | variables, stdout=log, stderr=log
                )
            )
        return running[-1]

    try:
        start("scheduler")
        service = start("service")
        wait_for(lambda: listens(ports["8786"]))  # A worker that comes too early tries again only after some seconds.
        start("worker")
        wait_until_live(service, int(ports["8000"]), tmp_path / "service.log")
        with httpx.Client(base_url=f"http://127.0.0.1:{ports['8000']}", timeout=PATIENCE) as client:
            yield client
    finally:
        try:
            for process in running[::-1]:  # one after the other: without its scheduler a worker takes seconds to end
                process.terminate()
                process.wait(STOP_TIMEOUT)
        finally:
            for process in running:
                process.kill()


def test_the_commands_run_and_the_worker_answers_a_sweep_of_the_service_unless_it_takes_too_much_room(
    started: httpx.Client, tmp_path: Path
) -> None:
    address = started.post("/sweeps", json=SPEC | {"shard_size": 30}).headers["location"]
    status, events = followed(started, address)
    assert status["status"] == "successful"
    assert [status["done"] for status in events] == sorted(status["done"] for status in events)
    result = started.get(f"{address}/result").content
    assert result == undisturbed(tmp_path / "a", SPEC | {"shard_size": 30}).compact().read_bytes()
    assert "Registered to" in (tmp_path / "worker.log").read_text()
    large = started.post("/sweeps", json=SPEC | {"shard_size": 1}).headers["location"]
    status, _ = followed(started, large)
    assert (status["status"], status["problem"]["status"]) == ("failed", 413)
    assert f"the limit is {BYTES_MAX} here" in status["message"]
    wait_for(lambda: not list((tmp_path / "data" / "sweeps").iterdir()), LINGER)
