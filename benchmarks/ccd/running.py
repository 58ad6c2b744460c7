"""Engines at work, each in a process of its own: a crash or a hang counts as an answer and does not stop the run."""

from __future__ import annotations

import math
import multiprocessing
import signal
import time
from collections.abc import Iterator, Sequence
from importlib.metadata import PackageNotFoundError
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.ccd.engines import ENGINES, Engine
from benchmarks.ccd.files import ANSWER, ENDS, Shard, load_shard, save
from benchmarks.ccd.march import Undecided
from benchmarks.ccd.motion import Motion, Stage

# Largest processor time and largest elapsed time of one answer [s]; the second allows for a busy machine.
PROCESSOR, PATIENCE = 2.0, 300.0
# touches, travel [m], microseconds of the processor, evaluations, number in ENDS.
Row = tuple[bool, float, float, int, int]
Answers = dict[str, NDArray[Any]]
Installed = dict[str, str]


def installed(engines: Sequence[Engine] = ENGINES) -> Installed:
    """Version of each engine that is installed, by name; those that are not are named on the terminal.

    Each is loaded in a process of its own first, as one that ends its process must not end the run.
    """
    versions = {}
    for engine in engines:
        try:
            versions[engine.name] = engine.version
        except PackageNotFoundError:
            print(f"{engine.name} is left out: the package {engine.package} is not installed", flush=True)
            continue
        process = multiprocessing.get_context("fork").Process(target=engine.made)
        process.start()
        process.join()
        if process.exitcode:
            del versions[engine.name]
            print(f"{engine.name} is left out: the package {engine.package} cannot be loaded", flush=True)
    return versions


def answers(engine: Engine, shard: Shard, first: int = 0) -> Iterator[Row]:
    """The engine's answers to the queries of a shard from one on, in this process."""
    solve = engine.made()
    stages: dict[int, Stage] = {}
    for k in range(first, len(shard)):
        dance, query = int(shard.columns["dance"][k]), shard.query(k)
        if dance not in stages:
            stages = {dance: Stage(shard.dances[dance])}
        motion = Motion(stages[dance], query)
        begun, end = time.thread_time(), ENDS.index("answered")
        touches, at = False, math.nan
        try:
            touches, at = solve(motion)
        except (Undecided, RuntimeError):
            end = ENDS.index("undecided")
        spent = 1e6 * (time.thread_time() - begun)
        yield touches, at * query.span, spent, motion.evaluations, end


def work(connection: Connection, name: str) -> None:
    """The process of one engine: takes the file of a shard and the first query, sends one answer after the other."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for the process that asks
    engine = next(engine for engine in ENGINES if engine.name == name)
    while True:
        try:
            path, first = connection.recv()
        except EOFError:  # the parent has ended
            return
        rows = answers(engine, load_shard(path), first)
        while True:
            signal.setitimer(signal.ITIMER_PROF, PROCESSOR)  # the system ends this process at that time
            row = next(rows, None)
            signal.setitimer(signal.ITIMER_PROF, 0.0)
            if row is None:
                break
            try:
                connection.send(row)
            except BrokenPipeError:  # the parent has ended
                return


class Worker:
    """The process of one engine, started again after a crash or a hang."""

    def __init__(self, name: str) -> None:
        self.name, self.afresh = name, next(engine.afresh for engine in ENGINES if engine.name == name)
        self.process: Any = None

    def start(self) -> None:
        """Begin a new process."""
        self.stop()
        context = multiprocessing.get_context("spawn")
        self.connection, other = context.Pipe()
        self.process = context.Process(target=work, args=(other, self.name), daemon=True)
        self.process.start()
        other.close()

    def stop(self) -> None:
        """End the process."""
        if self.process is not None:
            self.process.kill()
            self.process.join()
            self.process = None

    def answered(self, path: Path, count: int) -> list[Row]:
        """One row for each of the queries in the file of a shard."""
        rows: list[Row] = []
        sent = False
        if self.afresh:
            self.stop()
        while len(rows) < count:
            if self.process is None:
                self.start()
                sent = False
            try:
                if not sent:
                    self.connection.send((path, len(rows)))
                sent = True
                if self.connection.poll(PATIENCE):
                    rows.append(self.connection.recv())
                    continue
                end = "hang"
            except (EOFError, OSError):
                self.process.join(PROCESSOR)
                end = "hang" if self.process.exitcode == -signal.SIGPROF else "crash"
            self.stop()
            rows.append((False, math.nan, math.nan, 0, ENDS.index(end)))
        return rows


def save_answers(path: Path, rows: list[Row]) -> None:
    """Write the answers of one engine to the queries of one shard."""
    columns = zip(*rows, strict=True) if rows else [()] * len(ANSWER)
    save(path, {name: np.array(column, kind) for (name, kind), column in zip(ANSWER.items(), columns, strict=True)})


def answers_path(queries: Path, name: str) -> Path:
    """The file of one engine's answers beside the file of the queries."""
    slug = "".join(letter if letter.isalnum() else "-" for letter in name.lower())
    return queries.with_name(f"{queries.stem.replace('queries', 'answers')}-{slug}.npz")
