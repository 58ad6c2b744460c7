"""A sweep on a real Dask cluster whose client, workers and scheduler are killed at random, again and again.

python -m tests.campaigns.sweep_kills [DESIGNS [KILLS [SEED]]] compares the compacted table with that of an
undisturbed run.
"""

import os
import random
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import orjson
import psutil

from app.sweeps.processes import Processes
from app.sweeps.run import run
from app.sweeps.shards import parts
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep
from tests.support.command import COMMAND
from tests.support.serving import free_port

ROOT = Path(__file__).parents[2]
# Between two looks at the processes, and the most that a sweep may go on without a new part [s].
LOOK = 0.1
PATIENCE = 300.0
SHARDS = 200
KINDS = ["scheduler", "worker", "client"]
DASK = (sys.executable, "-m", "dask")


class Kept:
    """A process that is started again whenever it ended."""

    def __init__(self, log, *command):
        self._log = log
        self._command = command
        self.start()

    def start(self):
        """Start it."""
        environment = {**os.environ, "PYTHONPATH": str(ROOT)}
        with self._log.open("ab") as log:
            self.process = subprocess.Popen(self._command, stdout=log, stderr=log, env=environment)

    def keep(self):
        """Start it again if it ended."""
        if self.process.poll() is not None:
            self.start()

    def family(self):
        """It and what it started."""
        try:
            parent = psutil.Process(self.process.pid)
            return [parent, *parent.children(recursive=True)]
        except psutil.NoSuchProcess:
            return []

    def end(self):
        """Kill it with all that it started."""
        for process in self.family():
            process.kill()
        self.process.wait()


class KilledCluster:
    """A scheduler on a port of its own and workers, kept alive."""

    def __init__(self, folder, workers=2):
        port = str(free_port())
        self.address = f"tcp://127.0.0.1:{port}"
        none = "--no-dashboard"
        scheduler = (*DASK, "scheduler", "--host", "127.0.0.1", "--port", port, none)
        worker = (*DASK, "worker", self.address, "--nthreads", "1", none, "--death-timeout", "20")
        self.scheduler = Kept(folder / "scheduler.log", *scheduler)
        self.workers = [Kept(folder / f"worker-{k}.log", *worker, "--name", str(k)) for k in range(workers)]

    def keep(self):
        """Start again what ended."""
        for process in (self.scheduler, *self.workers):
            process.keep()

    def end(self):
        """Kill all of it."""
        for process in (self.scheduler, *self.workers):
            process.end()


def disturbed(spec_fields, folder, kills, seed):
    """Run a sweep with the command on a cluster, and kill a number of processes on the way; their number by kind.

    raises: TimeoutError, with the last words of the client
    """
    chance = random.Random(seed)
    killed = Counter[str]()
    (folder / "spec.json").write_bytes(orjson.dumps(spec_fields))
    spec = Spec.of(spec_fields)
    output = folder / "out"
    cluster = KilledCluster(folder)
    sweep = ("run", str(folder / "spec.json"), "--output", str(output), "--dask", cluster.address)
    client = Kept(folder / "client.log", COMMAND, "sweep", *sweep)
    kinds = (KINDS * kills)[:kills]
    chance.shuffle(kinds)
    due = [(k + 1) * spec.shards / (kills + 1) for k in range(kills)]
    seen = 0
    since = time.monotonic()
    try:
        while client.process.poll() != 0:
            client.keep()
            cluster.keep()
            time.sleep(LOOK)
            there = len(parts(output)) if output.is_dir() else 0
            if there > seen:
                seen = there
                since = time.monotonic()
            if time.monotonic() - since > PATIENCE:
                words = (folder / "client.log").read_text()[-2000:]
                raise TimeoutError(f"no new part for {PATIENCE:g} s after {seen} of {spec.shards}, {killed}: {words}")
            if due and there >= due[0]:
                due.pop(0)
                kind = kinds[len(due)]
                victim = {"client": client, "scheduler": cluster.scheduler, "worker": chance.choice(cluster.workers)}
                family = victim[kind].family()
                if family:
                    # For a worker, its nanny or the process that answers.
                    chance.choice(family if kind == "worker" else family[:1]).kill()
                    killed[kind] += 1
    finally:
        client.end()
        cluster.end()
    return killed


def collisions(designs):
    """A sweep of first contacts."""
    over = {"pitch": {"start": 0.45, "stop": 0.6}, "width": {"start": 0.2, "stop": 0.35}}
    size = max(designs // SHARDS, 1)
    return {"question": "collision_time", "over": over, "samples": {"count": designs}, "shard_size": size}


def main(designs=200_000, kills=50, seed=0):
    """Compare a disturbed with an undisturbed run."""
    spec_fields = collisions(designs)
    spec = Spec.of(spec_fields)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        begun = time.monotonic()
        run(spec, folder / "undisturbed", question=spec.asks, engine=Processes)
        quiet = time.monotonic() - begun
        killed = disturbed(spec_fields, folder, kills, seed)
        took = time.monotonic() - begun - quiet
        tables = [Sweep(folder / each, spec).compact().read_bytes() for each in ("undisturbed", "out")]
    print(f"{designs} designs in {spec.shards} shards; kill -9 of {dict(killed)}")
    print(f"{quiet:.0f} s undisturbed, {took:.0f} s disturbed; the tables are alike: {tables[0] == tables[1]}")
    raise SystemExit(tables[0] != tables[1] or killed.total() < kills)


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
