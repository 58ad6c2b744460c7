"""Runs of a sweep: the state is in the parts alone, and the table is the same after any kill."""

from __future__ import annotations

import random
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import psutil
import pytest

from app.sweeps import shards
from app.sweeps.engines import NoAnswer
from app.sweeps.processes import CannotStart, Processes
from app.sweeps.questions import SweepQuestion
from app.sweeps.run import Progress, missing_shards, run
from app.sweeps.spec import Spec
from app.sweeps.table import Sweep
from core import InvalidValue
from tests.support.odd_questions import INTERRUPTED, LAND, SLOW, UNANSWERABLE


class Shared(Processes):
    """Processes of several runs, which must not end with the first."""

    def close(self) -> None:
        pass


@pytest.fixture(scope="module")
def shared() -> Iterator[Shared]:
    """One process for the runs that need no more, which is replaced when a design kills it."""
    engine = Shared(1)
    yield engine
    Processes.close(engine)


def spec_of(question: SweepQuestion, designs: int = 60, shard_size: int = 6, **request: Any) -> Spec:
    over = {"x": list(map(float, range(designs // 2))), "y": [1.0, 2.0]}
    return Spec.of({"question": question.name, "over": over, "request": request, "shard_size": shard_size}, question)


def compacted(folder: Path, spec: Spec) -> bytes:
    return Sweep(folder, spec).compact().read_bytes()


def undisturbed(folder: Path, spec: Spec, question: SweepQuestion) -> bytes:
    """The table of a sweep answered in this process."""
    folder.mkdir()
    for shard in range(spec.shards):
        shards.write_part(folder, spec, shard, [shards.ShardPiece.whole(spec, question, shard).answer()])
    return compacted(folder, spec)


def test_a_run_writes_every_part_and_says_how_far_it_is(shared: Shared, tmp_path: Path) -> None:
    spec, reports = spec_of(LAND), list[Progress]()
    run(spec, tmp_path / "a", question=LAND, progress=reports.append, engine=lambda: shared)
    assert sorted(file.name for file in (tmp_path / "a").iterdir()) == [
        *(shards.part_name(shard) for shard in range(10)),
        "sweep.json",
    ]
    assert (reports[0].designs, reports[-1].designs, reports[-1].total) == (0, 60, 60)
    assert reports[-1].rate > 0.0
    assert reports[-1].words.endswith("0:00:00 left")
    assert compacted(tmp_path / "a", spec) == undisturbed(tmp_path / "b", spec, LAND)


def test_only_what_is_missing_is_answered_again(shared: Shared, tmp_path: Path) -> None:
    spec, reports = spec_of(LAND), list[Progress]()
    run(spec, tmp_path / "a", question=LAND, engine=lambda: shared)
    removed = [tmp_path / "a" / shards.part_name(shard) for shard in (0, 7)]
    kept = {file: file.stat().st_mtime_ns for file in (tmp_path / "a").glob("part-*") if file not in removed}
    for file in removed:
        file.unlink()
    assert missing_shards(tmp_path / "a", spec) == [0, 7]

    def engine() -> Processes:
        assert [one.designs for one in reports] == [48]  # The kept rows are reported before the engine starts.
        return shared

    run(spec, tmp_path / "a", question=LAND, progress=reports.append, engine=engine)
    assert kept == {file: file.stat().st_mtime_ns for file in kept}
    assert compacted(tmp_path / "a", spec) == undisturbed(tmp_path / "b", spec, LAND)


def test_a_complete_folder_starts_no_engine(shared: Shared, tmp_path: Path) -> None:
    spec = spec_of(LAND, 6)
    run(spec, tmp_path / "a", question=LAND, engine=lambda: shared)

    def none() -> Processes:
        pytest.fail("nothing is missing")

    run(spec, tmp_path / "a", question=LAND, engine=none)
    Sweep(tmp_path / "a", spec).compact()
    run(spec, tmp_path / "a", question=LAND, engine=none)


def test_a_sweep_of_one_shard_starts_one_process(tmp_path: Path) -> None:
    engine, pids = Processes(3), set[int]()
    run(spec_of(LAND, 6), tmp_path, question=LAND, engine=lambda: engine, progress=lambda _: pids.update(engine.pids))
    assert len(pids) == 1


def test_killed_workers_change_no_byte_and_no_process_is_left(tmp_path: Path) -> None:
    spec, engines, chance = spec_of(SLOW, 80, 10), list[Processes](), random.Random(5)
    killed, pids = [], set[int]()

    def engine() -> Processes:
        engines.append(Processes(2))
        return engines[-1]

    def kill(progress: Progress) -> None:
        alive = [pid for one in engines for pid in one.pids]  # none yet just after the engine has begun
        pids.update(alive)
        if alive and len(killed) < 2 and progress.designs >= 20 * len(killed):
            killed.append(chance.choice(alive))
            psutil.Process(killed[-1]).kill()

    run(spec, tmp_path / "a", question=SLOW, progress=kill, engine=engine)
    assert len(set(killed)) == 2
    assert len(pids) == 4
    assert not [pid for pid in pids if psutil.pid_exists(pid)]
    quick = replace(SLOW, ask=LAND.ask)
    assert compacted(tmp_path / "a", spec) == undisturbed(tmp_path / "b", spec, quick)


@pytest.mark.parametrize("question", [pytest.param(LAND, marks=pytest.mark.deep), INTERRUPTED], ids=["exit", "signal"])
def test_designs_that_kill_their_process_are_found_and_the_others_answered(
    shared: Shared, question: SweepQuestion, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if question is INTERRUPTED:  # What follows from a death is the same.
        monkeypatch.setattr("app.sweeps.run.DEATHS", 1)
    fields = {"question": question.name, "over": {"x": list(range(12, 18))}, "request": {"y": 2.0, "deadly": [16.0]}}
    spec = Spec.of(fields | {"shard_size": 2}, question)
    run(spec, tmp_path / "a", question=question, engine=lambda: shared)
    rows = Sweep(tmp_path / "a", spec).table().to_pylist()
    assert [row["x"] for row in rows] == list(range(12, 18))
    errors = {row["x"]: row["error.code"] for row in rows if row["error.code"]}
    assert errors == {13: "invalid-value", 14: "internal-error", 16: "killed"}
    assert [row["height"] for row in rows] == [24.0, None, None, 30.0, None, 34.0]


def test_processes_that_cannot_start_end_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "app").mkdir()
    (tmp_path / "app" / "__init__.py").write_text("raise SystemExit('no such program')")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(CannotStart, match="processes in a row ended before they were ready"):
        run(spec_of(LAND, 6), tmp_path / "a", question=LAND, engine=lambda: Processes(1))


def test_what_no_worker_can_answer_ends_the_run_in_words(shared: Shared, tmp_path: Path) -> None:
    with pytest.raises(NoAnswer, match="workers cannot answer: ImportError: no such module"):
        run(spec_of(UNANSWERABLE, 6), tmp_path, question=UNANSWERABLE, engine=lambda: shared)


def test_no_process_is_left_of_an_interrupted_run(tmp_path: Path) -> None:
    engine, pids = Processes(2), list[int]()

    def stop(progress: Progress) -> None:
        if progress.designs:
            pids.extend(engine.pids)
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(spec_of(SLOW, 100), tmp_path / "a", question=SLOW, engine=lambda: engine, progress=stop)
    assert len(pids) == 2
    assert not [pid for pid in pids if psutil.pid_exists(pid)]
    assert shards.parts(tmp_path / "a")


def test_a_folder_of_something_else_is_refused(shared: Shared, tmp_path: Path) -> None:
    (tmp_path / "letter.txt").write_text("dear")
    with pytest.raises(InvalidValue, match="has files but no sweep"):
        run(spec_of(LAND, 6), tmp_path, question=LAND)
    run(spec_of(LAND, 6), tmp_path / "a", question=LAND, engine=lambda: shared)
    with pytest.raises(InvalidValue, match="has another sweep, or one of another version"):
        run(spec_of(LAND, 8), tmp_path / "a", question=LAND)


def test_what_a_killed_run_left_half_written_is_removed(shared: Shared, tmp_path: Path) -> None:
    spec = spec_of(LAND, 6)
    (tmp_path / ".part-xyz").write_bytes(b"half")
    run(spec, tmp_path, question=LAND, engine=lambda: shared)
    assert sorted(file.name for file in tmp_path.iterdir()) == ["part-000000.parquet", "sweep.json"]
