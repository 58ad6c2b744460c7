"""Run a sweep into a folder: submit the shards whose files are missing, and write each when it is complete.

A folder has the spec in sweep.json and one Parquet file for each shard. It holds the whole state, so a stopped or
killed run continues when it is started again.
"""

from __future__ import annotations

import time
from collections import deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from datetime import timedelta
from pathlib import Path

from app.sweeps import shards
from app.sweeps.engines import WINDOW, SweepEngine
from app.sweeps.processes import Processes
from app.sweeps.questions import SweepQuestion
from app.sweeps.shards import ShardPiece
from app.sweeps.spec import Spec
from core import InvalidValue
from core.language import say

SPEC_FILE = "sweep.json"
TABLE_FILE = "sweep.parquet"
# Longest time between two reports of the progress [s].
TICK = 0.5
# Number of dead processes after which their single design counts as the cause: fewer may have been killed by hand.
DEATHS = 3


@dataclass(frozen=True, slots=True)
class Progress:
    """Progress of a run.

    designs: number answered; total: number in the sweep; rate: designs per second in this run, 0 before the first
    left: time for the others at that rate [s]
    """

    designs: int
    total: int
    rate: float
    left: float | None

    def words(self) -> str:
        """Designs, rate and time left, in words."""
        if self.left is None:
            return say("{run.designs} of {run.total}, {run.rate:.0f}/s", run=self)
        left = timedelta(seconds=round(self.left))
        return say("{run.designs} of {run.total}, {run.rate:.0f}/s, {left} left", run=self, left=left)


@dataclass(slots=True)
class _Shard:
    """A shard in progress: the answers of its pieces by their first design, and the number of unanswered pieces."""

    out: int = 1
    rows: dict[int, bytes] = field(default_factory=dict)


class _Run:
    """The missing shards, and those in progress."""

    def __init__(self, folder: Path, spec: Spec, question: SweepQuestion, missing: Iterator[int], total: int) -> None:
        self.folder, self.spec, self.question, self.missing = folder, spec, question, missing
        self.ready: deque[ShardPiece] = deque()
        self.aside: list[ShardPiece] = []
        self.under_way: dict[int, _Shard] = {}
        self.deaths: dict[int, int] = {}
        self.begun = time.monotonic()
        self.answered_here, self.designs, self.total = 0, total, spec.designs

    def next_piece(self) -> ShardPiece | None:
        """The next piece to submit: from shards in progress first, then from new ones."""
        if self.ready:
            return self.ready.popleft()
        shard = next(self.missing, None)
        if shard is None:
            return None
        self.under_way[shard] = _Shard()
        return ShardPiece.whole(self.spec, self.question, shard)

    def take(self, piece: ShardPiece, rows: bytes) -> None:
        """Keep the rows of a piece; the last piece of a shard writes its file."""
        shard = self.under_way[piece.shard]
        shard.rows[piece.start] = rows
        shard.out -= 1
        self.designs += piece.stop - piece.start
        self.answered_here += piece.stop - piece.start
        if not shard.out:
            pieces = [rows for _, rows in sorted(shard.rows.items())]
            shards.write_part(self.folder, self.spec, piece.shard, pieces)
            del self.under_way[piece.shard]

    def died(self, piece: ShardPiece, alone: bool) -> None:
        """A process died while it answered a piece: halve the piece until the design that killed it is found."""
        if not alone:
            self.aside.append(piece)
        elif piece.stop - piece.start > 1:
            self.under_way[piece.shard].out += 1
            self.ready.extendleft(reversed(piece.halves()))
        else:
            self.deaths[piece.start] = self.deaths.get(piece.start, 0) + 1
            if self.deaths[piece.start] < DEATHS:
                self.ready.appendleft(piece)
            else:
                self.take(piece, piece.killed_row())

    def progress(self) -> Progress:
        """Progress of the run."""
        rate = self.answered_here / max(time.monotonic() - self.begun, 1e-9)
        return Progress(self.designs, self.total, rate, (self.total - self.designs) / rate if rate else None)

    def through(self, engine: SweepEngine, report: Callable[[Progress], None]) -> None:
        """Answer all missing designs with an engine, then close it."""
        out = 0
        try:
            while True:
                room = WINDOW * engine.workers - out
                while room > 0 and (piece := self.next_piece()) is not None:
                    engine.submit(piece)
                    out, room = out + 1, room - 1
                report(self.progress())
                if not out:
                    return
                for done in engine.wait(TICK):
                    out -= 1
                    if done.rows is None:
                        self.died(done.piece, engine.alone)
                    else:
                        self.take(done.piece, done.rows)
        finally:
            engine.close()


def begin(folder: Path, spec: Spec) -> None:
    """Create the folder of a sweep, or check that it belongs to this sweep. raises: InvalidValue, OSError"""
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / SPEC_FILE
    if not file.exists():
        if any(not other.name.startswith(shards.TEMPORARY) for other in folder.iterdir()):
            words = "{folder} has files but no sweep: name an empty or a new folder"
            raise InvalidValue.in_words("output", words, folder=str(folder))
        shards.write_durably(file, spec.canonical())
    elif file.read_bytes() != spec.canonical():
        words = "{folder} has another sweep, or one of another version, as {file} says: name a new folder"
        raise InvalidValue.in_words("output", words, folder=str(folder), file=SPEC_FILE)


def missing_shards(folder: Path, spec: Spec) -> list[int]:
    """The shards without a file."""
    if (folder / TABLE_FILE).exists():
        return []
    there = shards.parts(folder)
    return [shard for shard in range(spec.shards) if shard not in there]


def run(
    spec: Spec,
    folder: Path,
    *,
    question: SweepQuestion,
    engine: Callable[[], SweepEngine] = Processes,
    progress: Callable[[Progress], None] = lambda progress: None,
) -> None:
    """Answer every design that has no row in the folder yet.

    engine: function that starts the engine; not called if nothing is missing
    progress: called before the engine starts, which takes seconds, and then at least every TICK
    raises: InvalidValue, OSError, and the errors of the engine; after KeyboardInterrupt the next run continues
    """
    begin(folder, spec)
    missing = missing_shards(folder, spec)
    if not missing:
        return
    done = spec.designs - sum(stop - start for start, stop in map(spec.shard, missing))
    running = _Run(folder, spec, question, iter(missing), done)
    progress(running.progress())
    running.through(engine(), progress)
    if running.aside:
        # A design that shared a process may not be the cause of its death, so these designs are answered alone.
        running.ready.extend(running.aside)
        running.aside.clear()
        running.through(Processes(), progress)
    for left in folder.glob(f"{shards.TEMPORARY}*"):
        left.unlink(missing_ok=True)
