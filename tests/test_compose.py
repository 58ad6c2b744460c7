"""compose.yaml: valid by the Compose specification, and the commands of its services work together."""

import json
import os
import re
import socket
import subprocess
import sys
from pathlib import Path

import httpx
import pytest
import yaml
from compose_spec import PyCompose

from app.settings import Settings
from app.sweeps.spec import Spec
from tests.conftest import ROOT, STOP_TIMEOUT, wait_until_live
from tests.support.depth import thorough
from tests.support.job_service import PATIENCE, wait_for
from tests.support.serving import free_port
from tests.support.sweeping import SPEC, answered, followed

FILE = yaml.safe_load((ROOT / "compose.yaml").read_text(encoding="utf-8"))
SERVICES = FILE["services"]
DOCKERFILE = (ROOT / "Dockerfile").read_text(encoding="utf-8")
BIN = Path(sys.executable).parent
BYTES_MAX = 100_000


def interpolated(text, **variables):
    """A value as Compose fills it: ${NAME:-default}, of which the default counts for an empty variable too."""
    return re.sub(r"\$\{(\w+):-([^}]*)\}", lambda result: variables.get(result[1]) or result[2], text)


def test_it_is_valid_by_the_specification():
    compose = PyCompose.from_json(interpolated(json.dumps(FILE)))
    compose.validate()
    assert sorted(compose.service_names()) == ["scheduler", "service", "worker"]


def every(key):
    """A value of each service."""
    return {name: service.get(key) for name, service in SERVICES.items()}


def test_the_cluster_is_of_its_profile_and_nothing_is_written_but_in_the_volume():
    assert every("profiles") == {"service": None, "scheduler": ["cluster"], "worker": ["cluster"]}
    assert every("volumes") == {"service": ["data:/data"], "scheduler": None, "worker": None}
    assert SERVICES["worker"]["deploy"]["replicas"] == 2
    assert all(service["read_only"] and service["tmpfs"] == ["/tmp"] for service in SERVICES.values())
    for line in ("ARG EXTRAS=service\n", '"/src[${EXTRAS}]"', "BENCH_DRAGON_DATA=/data"):
        assert line in DOCKERFILE


def test_memory_holds_what_files_and_jobs_may_take_on_two_cores():
    gigabytes = int(SERVICES["service"]["mem_limit"].removesuffix("g"))
    settings = Settings()
    workers = 2
    files = workers * settings.readers_max * settings.reader_memory_max
    assert files + workers * settings.bodies_bytes_max + workers * 0.3e9 < gigabytes * 1e9
    assert all(one["pids_limit"] == 512 for one in SERVICES.values())


def test_its_settings_are_settings():
    assert set(SERVICES["service"]["environment"]) <= {f"BENCH_DRAGON_{name.upper()}" for name in Settings.model_fields}


@pytest.mark.parametrize(
    "published, token, runs",
    [
        ("0.0.0.0", "", False),
        *thorough(("", "", True), ("0.0.0.0", "x", True)),
    ],
)
def test_the_port_is_open_to_this_machine_alone_unless_a_token_is_set(published, token, runs, tmp_path):
    [port], names = SERVICES["service"]["ports"], SERVICES["service"]["environment"]
    variables = {"BENCH_DRAGON_PUBLISHED": published, "BENCH_DRAGON_TOKEN": token}
    assert interpolated(port, **variables) == f"{published or '127.0.0.1'}:8000:8000"
    environment = {name: interpolated(text, **variables) for name, text in names.items()}
    here = {"8000": str(free_port()), "0.0.0.0": "127.0.0.1"}
    process = start("service", here, tmp_path, environment)
    log = tmp_path / "service.log"
    try:
        if runs:
            wait_until_live(process, int(here["8000"]), log)
        else:
            assert process.wait(PATIENCE) == 2
            assert "BENCH_DRAGON_PUBLISHED" in log.read_text()
    finally:
        process.terminate()
        process.wait(STOP_TIMEOUT)


def test_the_base_of_the_image_is_named_by_its_digest():
    bases = re.findall(r"^FROM (\S+)(?: AS (\w+))?$", DOCKERFILE, re.MULTILINE)
    [image] = {image for image, _ in bases} - {stage for _, stage in bases}
    assert re.fullmatch(r"python:3\.13-slim-trixie@sha256:[0-9a-f]{64}", image)


def start(name, places, folder, environment):
    """The command of a service, with places of this machine for those inside of the containers."""
    program, *words = SERVICES[name]["command"]
    for place, here in places.items():
        words = [word.replace(place, here) for word in words]
    with (folder / f"{name}.log").open("wb") as log:
        return subprocess.Popen(
            [str(BIN / program), *words], cwd=folder, env=os.environ | environment, stdout=log, stderr=log
        )


def listens(port):
    with socket.socket() as peer:
        return peer.connect_ex(("127.0.0.1", int(port))) == 0


@pytest.fixture
def started(tmp_path):
    """A client of the service, which runs with the scheduler and one worker."""
    scheduler = str(free_port())
    port = str(free_port())
    places = {
        "0.0.0.0": "127.0.0.1",
        "scheduler:": "127.0.0.1:",
        "/tmp": str(tmp_path),
        "8786": scheduler,
        "8000": port,
    }
    variables = {"BENCH_DRAGON_DATA": str(tmp_path / "data"), "BENCH_DRAGON_DASK": f"tcp://127.0.0.1:{scheduler}"}
    variables["BENCH_DRAGON_SWEEP_BYTES_MAX"] = str(BYTES_MAX)
    running = []
    try:
        running += [start(name, places, tmp_path, variables) for name in ("scheduler", "service")]
        wait_for(lambda: listens(scheduler))  # A worker that comes too early tries again only after some seconds.
        running.append(start("worker", places, tmp_path, variables))
        wait_until_live(running[1], int(port), tmp_path / "service.log")
        with httpx.Client(base_url=f"http://127.0.0.1:{port}", timeout=PATIENCE) as client:
            yield client
    finally:
        try:
            for process in running[::-1]:  # one after the other: without its scheduler a worker takes seconds to end
                process.terminate()
                process.wait(STOP_TIMEOUT)
        finally:
            for process in running:
                process.kill()


@pytest.mark.thorough
def test_the_commands_run_and_the_worker_answers_a_sweep_of_the_service_unless_it_takes_too_much_room(
    started, tmp_path
):
    fields = SPEC | {"shard_size": 30}
    address = started.post("/sweeps", json=fields).headers["location"]
    status, events = followed(started, address)
    assert status["status"] == "successful"
    done = [event["done"] for event in events]
    assert done == sorted(done)
    expected = answered(tmp_path / "a", Spec.of(fields)).compact().read_bytes()
    assert started.get(f"{address}/result").content == expected
    assert "Registered to" in (tmp_path / "worker.log").read_text()
    status, _ = followed(started, started.post("/sweeps", json=SPEC | {"shard_size": 1}).headers["location"])
    assert status["status"] == "failed"
    assert status["problem"]["status"] == 413
    assert str(BYTES_MAX) in status["message"]
    wait_for(lambda: not list((tmp_path / "data" / "sweeps").iterdir()))
