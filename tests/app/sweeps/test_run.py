"""Runs of a sweep: the state is in the parts alone, and the table is the same after any kill."""

import pytest

from app.sweeps import shards
from app.sweeps.engines import NoAnswer
from app.sweeps.processes import CannotStart, Processes
from app.sweeps.run import missing_shards, run
from app.sweeps.table import Sweep
from tests.support.depth import thorough
from tests.support.odd_questions import INTERRUPTED, LAND, UNANSWERABLE
from tests.support.refused import refused
from tests.support.sweeping import assert_undisturbed, grid_of, spec_of


class Shared(Processes):
    """Processes of several runs, which must not end with the first."""

    def close(self):
        pass


@pytest.fixture(scope="module")
def shared():
    """One process for the runs that need no more, which is replaced when a design kills it."""
    engine = Shared(1)
    yield engine
    Processes.close(engine)


def test_a_run_writes_every_part_removes_what_a_killed_one_left_and_answers_only_what_is_missing(shared, tmp_path):
    spec, folder, first, reports = grid_of(LAND), tmp_path / "a", [], []
    folder.mkdir()
    (folder / ".part-xyz").write_bytes(b"half")
    run(spec, folder, question=LAND, progress=first.append, engine=lambda: shared)
    assert sorted(file.name for file in folder.iterdir()) == [*map(shards.part_name, range(10)), "sweep.json"]
    assert (first[0].designs, first[-1].designs, first[-1].total) == (0, 60, 60)
    assert first[-1].words().endswith("0:00:00 left")
    for shard in (0, 7):
        (folder / shards.part_name(shard)).unlink()
    kept = {file: file.stat().st_mtime_ns for file in folder.glob("part-*")}
    assert missing_shards(folder, spec) == [0, 7]

    def engine():
        assert [report.designs for report in reports] == [48]  # The kept rows are reported before the engine starts.
        return shared

    run(spec, folder, question=LAND, progress=reports.append, engine=engine)
    assert kept == {file: file.stat().st_mtime_ns for file in kept}
    run(spec, folder, question=LAND, engine=pytest.fail)  # Where nothing is missing, none starts.
    assert_undisturbed(folder, spec, LAND)
    run(spec, folder, question=LAND, engine=pytest.fail)  # of the one file of all rows


@pytest.mark.thorough
def test_a_sweep_of_one_shard_starts_one_process(tmp_path):
    engine = Processes(3)
    pids = set()
    run(grid_of(LAND, 6), tmp_path, question=LAND, engine=lambda: engine, progress=lambda _: pids.update(engine.pids))
    assert len(pids) == 1


@pytest.mark.parametrize("question", [INTERRUPTED, *thorough(LAND)], ids=["signal", "exit"])
def test_designs_that_kill_their_process_are_found_and_the_others_answered(shared, question, tmp_path, monkeypatch):
    if question is INTERRUPTED:  # What follows from a death is the same.
        monkeypatch.setattr("app.sweeps.run.DEATHS", 1)
    spec = spec_of(question, {"x": list(range(12, 18))}, request={"y": 2.0, "deadly": [16.0]}, shard_size=2)
    run(spec, tmp_path / "a", question=question, engine=lambda: shared)
    table = Sweep(tmp_path / "a", spec).table(["x", "error.code", "height"]).to_pydict()
    assert table == {
        "x": list(range(12, 18)),
        "error.code": [None, "invalid-value", "internal-error", None, "killed", None],
        "height": [24.0, None, None, 30.0, None, 34.0],
    }


def test_processes_that_cannot_start_end_the_run(tmp_path, monkeypatch):
    (tmp_path / "app").mkdir()
    (tmp_path / "app" / "__init__.py").write_text("raise SystemExit('no such program')")
    monkeypatch.syspath_prepend(str(tmp_path))
    with pytest.raises(CannotStart):
        run(grid_of(LAND, 6), tmp_path / "a", question=LAND, engine=lambda: Processes(1))


def test_what_no_worker_can_answer_ends_the_run_with_the_reason(shared, tmp_path):
    with pytest.raises(NoAnswer, match="ImportError: no such module"):
        run(grid_of(UNANSWERABLE, 6), tmp_path, question=UNANSWERABLE, engine=lambda: shared)


def test_a_folder_of_something_else_is_refused(shared, tmp_path):
    (tmp_path / "letter.txt").write_text("dear")
    with refused("output", folder=str(tmp_path)):
        run(grid_of(LAND, 6), tmp_path, question=LAND)
    run(grid_of(LAND, 6), tmp_path / "a", question=LAND, engine=lambda: shared)
    with refused("output", file="sweep.json"):
        run(grid_of(LAND, 8), tmp_path / "a", question=LAND)
