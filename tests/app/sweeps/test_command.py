"""bench-dragon sweep, run as a user runs it: processes of its own, real kills, real Ctrl-C."""

import re
import signal
import subprocess
import time
import tomllib

import psutil
import pytest

from app.sweeps.shards import parts
from app.sweeps.spec import Spec
from tests.app.test_cli import on_terminal
from tests.conftest import heed_ctrl_c
from tests.support.command import COMMAND, ENVIRONMENT, PATIENCE, run
from tests.support.job_service import is_gone, wait_for
from tests.support.sweeping import answered

SPEC = """
question = "collision_time"
shard_size = 10
[request]
benches = 60
[over]
pitch = { start = 0.42, stop = 0.60, count = 50 }
width = [0.25, 0.30, 0.35, -1.0]
"""
# Four times as long, so that a machine that stands still for a moment does not find it finished.
LONGER = SPEC.replace("shard_size = 10", "shard_size = 40").replace("count = 50", "count = 200")
SHARDS = 20


def sweep(*arguments):
    return run("sweep", *map(str, arguments))


def stopped(spec, folder, stop, workers):
    """Exit code, messages and number of children of the command, stopped when it has written one part more; they end.

    It stands still meanwhile, because to list its children among many processes takes a while.
    """
    before = len(parts(folder)) if folder.is_dir() else 0
    command = [COMMAND, "sweep", "run", str(spec), "--output", str(folder), "--workers", str(workers)]
    process = psutil.Popen(command, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT, preexec_fn=heed_ctrl_c)
    end = time.monotonic() + PATIENCE
    while not (folder.is_dir() and len(parts(folder)) > before) and time.monotonic() < end:
        time.sleep(0.005)
    process.suspend()
    children = process.children()
    stop(process)
    process.resume()
    _, output = process.communicate(timeout=PATIENCE)
    assert before < len(parts(folder)) < SHARDS
    wait_for(lambda: all(is_gone(child.pid) for child in children))
    return process.returncode, output, len(children)


@pytest.mark.thorough
def test_after_ctrl_c_and_a_kill_no_worker_is_left_and_the_sweep_continues_to_the_same_bytes(tmp_path):
    spec = tmp_path / "longer.toml"
    folder = tmp_path / "a"
    spec.write_text(LONGER)
    *interrupted, children = stopped(spec, folder, lambda process: process.send_signal(signal.SIGINT), 2)
    assert interrupted == [130, f"Stopped: the same command continues {folder}\n"]
    assert 1 <= children <= 2  # The second worker may not have begun when the first one has written a part.
    killed, _, children = stopped(spec, folder, psutil.Popen.kill, 1)
    assert killed == (-signal.SIGKILL)
    assert children == 1
    done = sweep("run", spec, "--output", folder, "--workers", 1)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", f"{folder}: 800 designs in {SHARDS} shards\n")
    sweep("compact", folder)
    expected = answered(tmp_path / "undisturbed", Spec.of(tomllib.loads(LONGER))).compact()
    assert (folder / "sweep.parquet").read_bytes() == expected.read_bytes()


def test_a_terminal_shows_a_bar_and_the_map_is_drawn_of_a_value_that_is_chosen(tmp_path):
    spec = tmp_path / "spec.toml"
    folder = tmp_path / "a"
    spec.write_text(SPEC)
    bar = on_terminal(120, "sweep", "run", str(spec), "--output", str(folder), "--workers", "1", stream="stderr")
    assert re.search(r"of 200, .*/s, 0:00:\d\d left", bar)
    drawn = sweep("show", folder, "--output", tmp_path / "map.png", "--value", "head.radius")
    assert drawn.returncode == 0
    assert drawn.stderr == f"{tmp_path / 'map.png'}\n"
    assert (tmp_path / "map.png").read_bytes().startswith(b"\x89PNG")
