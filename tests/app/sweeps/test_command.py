"""bench-dragon sweep, run as a user runs it: processes of its own, real kills, real Ctrl-C."""

from __future__ import annotations

import os
import pty
import shutil
import signal
import subprocess
import time
import tomllib
from collections.abc import Callable
from pathlib import Path

import psutil
import pytest

from app.sweeps.run import begin
from app.sweeps.shards import ShardPiece, parts, write_part
from app.sweeps.spec import Spec
from tests.conftest import heed_ctrl_c
from tests.support.command import COMMAND, ENVIRONMENT, PATIENCE, bin_folder, run
from tests.support.job_service import is_gone, wait_for

SPEC = """
question = "collision_time"
shard_size = 10
[request]
benches = 60
[over]
pitch = { start = 0.42, stop = 0.60, count = 50 }
width = [0.25, 0.30, 0.35, -1.0]
"""
SHARDS = 20
# Four times as long, so that a machine that stands still for a moment does not find it finished.
LONGER = SPEC.replace("shard_size = 10", "shard_size = 40").replace("count = 50", "count = 200")


@pytest.fixture
def spec(tmp_path: Path) -> Path:
    """A sweep of 200 designs, a quarter of which are refused."""
    (tmp_path / "spec.toml").write_text(SPEC)
    return tmp_path / "spec.toml"


def sweep(*arguments: object) -> subprocess.CompletedProcess[str]:
    return run("sweep", *map(str, arguments))


@pytest.fixture(scope="module")
def answered(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder of the sweep, answered in this process and not compacted."""
    spec, folder = Spec.of(tomllib.loads(SPEC)), tmp_path_factory.mktemp("answered")
    begin(folder, spec)
    for shard in range(spec.shards):
        write_part(folder, spec, shard, [ShardPiece.whole(spec, spec.asks, shard).answer()])
    return folder


def table(spec: Path, folder: Path) -> bytes:
    """Bytes of the table of a sweep that was continued and compacted."""
    done = sweep("run", spec, "--output", folder, "--workers", 1)
    assert (done.returncode, done.stdout) == (0, ""), done.stderr
    assert done.stderr == f"{folder}: {Spec.of(tomllib.loads(spec.read_text())).designs} designs in {SHARDS} shards\n"
    assert sweep("compact", folder).returncode == 0
    return (folder / "sweep.parquet").read_bytes()


def stopped(spec: Path, folder: Path, stop: Callable[[psutil.Popen], None], workers: int) -> tuple[int, str]:
    """Exit code and messages of the command, stopped as soon as it has written one part more.

    It stands still meanwhile, because to list its children among many processes takes a while.
    """
    before = len(parts(folder)) if folder.is_dir() else 0
    command = [COMMAND, "sweep", "run", str(spec), "--output", str(folder), "--workers", str(workers)]
    process = psutil.Popen(command, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT, preexec_fn=heed_ctrl_c)
    end = time.monotonic() + PATIENCE
    while not (folder.is_dir() and len(parts(folder)) > before) and time.monotonic() < end:
        time.sleep(0.005)
    process.suspend()
    stop(process)
    process.resume()
    _, output = process.communicate(timeout=PATIENCE)
    assert before < len(parts(folder)) < SHARDS
    return process.returncode, output


def test_after_ctrl_c_and_a_kill_no_worker_is_left_and_the_sweep_continues_to_the_same_bytes(tmp_path: Path) -> None:
    children: list[psutil.Process] = []
    spec = tmp_path / "longer.toml"
    spec.write_text(LONGER)

    def interrupt(process: psutil.Popen) -> None:
        children.extend(process.children())
        process.send_signal(signal.SIGINT)

    def kill(process: psutil.Popen) -> None:
        children.extend(process.children())
        process.kill()

    text = f"Stopped: the same command continues {tmp_path / 'a'}\n"
    assert stopped(spec, tmp_path / "a", interrupt, 2) == (130, text)
    # The second worker may not have begun when the first one has written a part.
    interrupted = len(children)
    assert 1 <= interrupted <= 2
    wait_for(lambda: all(is_gone(child.pid) for child in children))
    assert stopped(spec, tmp_path / "a", kill, 1)[0] == -signal.SIGKILL
    assert len(children) == interrupted + 1
    wait_for(lambda: all(is_gone(child.pid) for child in children))
    assert table(spec, tmp_path / "a") == table(spec, tmp_path / "undisturbed")


def test_a_sweep_is_printed_in_lines_and_drawn(answered: Path, tmp_path: Path) -> None:
    shutil.copytree(answered, tmp_path / "a")
    lines = sweep("show", tmp_path / "a").stdout.splitlines()
    assert lines[0].split() == ["designs", "200", "of", "200"]
    assert lines[1].split() == ["error", "invalid-value", "50"]
    assert lines[2].startswith("least time")
    drawn = sweep("show", tmp_path / "a", "--output", tmp_path / "map.png", "--value", "head.radius")
    assert (drawn.returncode, drawn.stderr) == (0, f"{tmp_path / 'map.png'}\n")
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
    assert sweep("compact", tmp_path / "a", "--csv", tmp_path / "a.csv").returncode == 0
    assert len((tmp_path / "a.csv").read_text().splitlines()) == 201


def test_a_terminal_shows_a_bar_with_rate_and_time_left(spec: Path, tmp_path: Path) -> None:
    parent, child = pty.openpty()
    command = [f"{bin_folder()}/bench-dragon", "sweep", "run", spec, "--output", tmp_path / "a", "--workers", "1"]
    process = subprocess.Popen(command, stderr=child, env=ENVIRONMENT | {"TERM": "xterm", "COLUMNS": "120"})
    os.close(child)
    text = b""
    while True:
        try:
            text += os.read(parent, 65536)
        except OSError:  # Nobody holds the other end any more.
            break
    os.close(parent)
    assert process.wait(PATIENCE) == 0
    assert b"of 200, " in text
    assert b"/s, 0:00:" in text
    assert b" left" in text


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["run", "no-such.toml", "--output", "out"], "no-such.toml: No such file or directory"),
        (["show", "no-such-folder"], "no-such-folder has no sweep: it holds no valid sweep.json"),
        (["show", "no-such-folder", "--output", "map.pdf"], "--output must end in .svg or .png, got .pdf"),
        (["compact", "no-such-folder"], "no-such-folder has no sweep: it holds no valid sweep.json"),
    ],
)
def test_wrong_usage_is_one_line(arguments: list[str], message: str) -> None:
    done = sweep(*arguments)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"Error: {message}\n")
