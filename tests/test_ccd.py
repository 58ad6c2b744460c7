"""Engines of continuous collision detection on the committed sample, whose truth stands on ball arithmetic alone."""

from __future__ import annotations

import faulthandler
import importlib
import math
import os
import signal
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from flint import arb

from benchmarks.ccd.__main__ import main, run
from benchmarks.ccd.dances import KINDS, dance_of
from benchmarks.ccd.engines import ENGINES, Engine
from benchmarks.ccd.files import COLUMNS, ENDS, Shard, load, load_shard, save, save_shard
from benchmarks.ccd.march import least_between
from benchmarks.ccd.motion import Stage
from benchmarks.ccd.pieces import pieces_of
from benchmarks.ccd.queries import CONTACT, EXACT, FAR, GRAZE, SAMPLES, dance_queries
from benchmarks.ccd.report import BEGIN, END, PAGE, SAMPLE, SAMPLED, Results, by_depth, report, score
from benchmarks.ccd.running import Worker, answers, answers_path, installed, save_answers
from benchmarks.ccd.series import Expansion
from benchmarks.ccd.truth import covered, track
from core import Spiral
from core.proof.paths import chain_on, recorded_path
from tests.support.depth import some

SHARD = load_shard(SAMPLE)
EVERYTHING = np.ones(len(SHARD), dtype=bool)
# Queries of the sample that the other engines answer.
OTHERS = SHARD.taken(np.array(some(range(len(SHARD)), 40)))
# Largest errors of our own times of contact [s]: the corner comes to a graze of 1e-9 m at 1e-5 m/s, so slowly that what
# doubles leave of its place, 1e-14 m and more, is 1e-9 s and more.
OURS, OURS_AT_GRAZES = 1e-9, 1e-8
# Largest difference of two computations in balls of the same point [m].
SAME = 1e-11


def part(count: int) -> Shard:
    """A number of queries spread over the sample."""
    return SHARD.taken(np.linspace(0, len(SHARD) - 1, count).astype(int))


def engines(chosen: Callable[[Engine], bool]) -> list[Any]:
    """Names of engines as parameters; those that not every machine and Python has carry a mark."""
    marks = {"box2d": [pytest.mark.engine("Box2D")], "ipctk": [pytest.mark.engine("ipctk")]}
    return [pytest.param(one.name, marks=marks.get(one.package, [])) for one in ENGINES if chosen(one)]


class AnswersOfEngines(dict[str, Results]):
    """The answers of each engine to the sample, once a test wants them, read back from the files that a run writes."""

    def __init__(self, folder: Path) -> None:
        super().__init__()
        self.folder = folder

    def __missing__(self, name: str) -> Results:
        # An engine in a new process for every file answers here as this process has it: docs/dragon-ccd.md.
        engine = next(engine for engine in ENGINES if engine.name == name)
        shard = SHARD if name == "ours" else OTHERS
        save_answers(self.folder / "answers.npz", list(answers(engine, shard)))
        self[name] = Results(shard, {name: load(self.folder / "answers.npz")})
        return self[name]


@pytest.fixture(scope="module")
def results(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Results]:
    return AnswersOfEngines(tmp_path_factory.mktemp("answers"))


def test_the_sample_has_every_class_kind_and_depth() -> None:
    kinds = SHARD.columns["kind"]
    assert len(SHARD) == SAMPLED
    assert all((kinds == kind).sum() > 0.3 * SAMPLED for kind in (CONTACT, GRAZE, FAR))
    assert {record["kind"] for record in SHARD.dances.values()} == set(KINDS)
    depths = np.round(np.log10(np.abs(SHARD.columns["depth"][kinds == GRAZE]))).astype(int)
    assert set(depths) == set(range(-9, -2))
    assert sum(path.stat().st_size for path in SAMPLE.parent.glob("sample.*")) < 400_000


def test_contacts_lie_anywhere_between_the_instants_at_which_distances_were_looked_at() -> None:
    columns = SHARD.columns
    for kind in (CONTACT, GRAZE):
        rows = (columns["kind"] == kind) & np.isfinite(columns["low"])
        steps = columns["high"][rows] / columns["span"][rows] * (SAMPLES - 1)
        quarters = np.bincount((4.0 * (steps % 1.0)).astype(int), minlength=4)
        assert (quarters > 0.15 * rows.sum()).all()


@pytest.mark.engine("Box2D", "ipctk")
def test_every_engine_is_installed() -> None:
    assert list(installed()) == [engine.name for engine in ENGINES]


def test_our_own_engine_misses_nothing_invents_nothing_and_is_exact(results: dict[str, Results]) -> None:
    result = score(results["ours"], "ours", EVERYTHING)
    assert (result.missed, result.invented, result.other) == (0, 0, (0, 0, 0))
    assert max(result.late, result.early) < OURS_AT_GRAZES
    contacts = score(results["ours"], "ours", SHARD.columns["kind"] == CONTACT)
    assert max(contacts.late, contacts.early) < OURS


@pytest.mark.parametrize("name", engines(lambda engine: engine.afresh))
def test_an_engine_whose_answers_differ_from_process_to_process_answers_all_the_same(
    name: str, results: dict[str, Results]
) -> None:
    assert (results[name].answers[name]["end"] == ENDS.index("answered")).all()


@pytest.mark.parametrize("name", engines(lambda engine: not engine.afresh))
def test_every_engine_answers_and_sees_far_corners_as_clear(name: str, results: dict[str, Results]) -> None:
    request = results[name]
    rows = np.ones(len(request.queries), dtype=bool)
    assert score(request, name, rows).other == (0, 0, 0)
    assert score(request, name, request.queries.columns["kind"] == FAR).invented == 0


@pytest.mark.parametrize("name", engines(lambda engine: engine.package == "ipctk"))
def test_ipctk_keeps_its_promise_to_be_early_rather_than_late(name: str, results: dict[str, Results]) -> None:
    result = score(results[name], name, np.ones(len(results[name].queries), dtype=bool))
    assert result.missed == 0
    assert result.late <= OURS < result.early


def test_the_truth_of_the_sample_is_shown_again_in_balls() -> None:
    decided = 0
    for kind, sign in ((CONTACT, 0), (GRAZE, -1), (GRAZE, 1), (FAR, 1)):
        columns = SHARD.columns
        rows = np.flatnonzero((columns["kind"] == kind) & ((sign == 0) | (np.sign(columns["depth"]) == sign)))
        for k in rows[:: max(1, len(rows) // 2)][:2].tolist():
            query, stage = SHARD.query(k), Stage(SHARD.dances[int(columns["dance"][k])])
            last = max(query.corner_bench, query.edge_bench) + 1
            seen = track(covered(stage, pieces_of(stage), query.place, query.span, last), query, stage)
            low, high, depth = (columns[name][k].item() for name in ("low", "high", "depth"))
            if math.isfinite(low):
                assert seen.clear(arb(query.margin), 0.0, low)
                assert seen.within(arb(query.margin), high)
                assert not seen.clear(arb(query.margin), 0.0, high)
            else:
                assert seen.clear(arb(query.margin + depth * (1.0 - EXACT) - 1e-14), 0.0, query.span)
                assert not seen.clear(arb(query.margin + depth * (1.0 + 2.0 * EXACT) + 1e-13), 0.0, query.span)
            decided += 1
    assert decided == 8


@pytest.mark.parametrize("kind", ["spiral", "turn", "arcs"])
def test_handles_lie_where_the_proofs_of_this_library_have_them(kind: str) -> None:
    record = next(record for record in SHARD.dances.values() if record["kind"] == kind)
    stage, dance, count = Stage(record), dance_of(record), 6
    chain = chain_on(dance.dragon, recorded_path(dance.path), 0.0)
    spiral = isinstance(dance.path, Spiral)
    travel = 0.5 * (max(dance.begin, 0.0) + dance.end.time) + 0.123
    place = float(stage.search.place - travel)
    expansion = Expansion(stage, pieces_of(stage), place, 0.005, count)
    for shift in (0.0, 0.004):
        way = arb(stage.search.place if not spiral else chain.arc(chain.start)) - (arb(place) - arb(shift))
        pose = chain.pose_at(0, chain.place_after(way if spiral else -(arb(place) - arb(shift))))
        pose.grow_to(count)
        points = [expansion.handles[k].point for k in range(count + 1)]
        own = [
            (sum(p.x[k] * arb(shift) ** k for k in range(12)), sum(p.y[k] * arb(shift) ** k for k in range(12)))
            for p in points
        ]
        for k in range(1, count + 1):  # distances of handles: the frame of a spiral's pose turns with its head
            ours = ((own[k][0] - own[0][0]) ** 2 + (own[k][1] - own[0][1]) ** 2).sqrt()
            assert abs(float(ours) - float(abs(pose.points[k] - pose.points[0]))) < SAME


def test_queries_of_a_dance_are_the_same_again() -> None:
    number = int(SHARD.columns["dance"][0])
    record, known = dance_queries(2026, number)
    rows = np.flatnonzero(SHARD.columns["dance"] == number)
    assert record == SHARD.dances[number]
    assert {SHARD.query(k) for k in rows.tolist()} <= {one.query for one in known}


def test_a_missing_engine_is_named_and_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    absent = Engine("nobody", "no-such-package", "", lambda: importlib.import_module("no_such_package"))
    assert list(installed((ENGINES[0], absent))) == ["ours"]
    assert capsys.readouterr().out == "nobody is left out: the package no-such-package is not installed\n"


def abort() -> None:
    """Ends its process without a word: what pytest would print of it is expected here."""
    faulthandler.disable()
    os.abort()


def test_an_engine_that_ends_its_process_when_it_is_loaded_is_left_out(capsys: pytest.CaptureFixture[str]) -> None:
    assert list(installed((Engine("abrupt", "numpy", "", abort), ENGINES[0]))) == ["ours"]
    assert capsys.readouterr().out == "abrupt is left out: the package numpy cannot be loaded\n"


def test_a_crash_and_a_hang_are_rows_and_a_run_continues_where_it_was(tmp_path: Path) -> None:
    shard, worker = part(6), Worker("ours")
    save_shard(tmp_path / "queries-0000.npz", shard)
    rows = []
    for end in (signal.SIGKILL, signal.SIGPROF):
        worker.start()
        os.kill(worker.process.pid, end)
        rows.append(worker.answered(tmp_path / "queries-0000.npz", len(shard)))
    worker.stop()
    assert [ENDS[row[-1]] for row in rows[0]] == ["crash", *["answered"] * 5]
    assert [ENDS[row[-1]] for row in rows[1]] == ["hang", *["answered"] * 5]
    fields = {"touches": np.ones(6, dtype=np.int8), "travel": np.arange(6.0)}
    save(kept := answers_path(tmp_path / "queries-0000.npz", "ipctk"), fields)
    run(tmp_path, 0, len(shard), ("ours", "ipctk"))
    assert load(kept)["travel"].tolist() == fields["travel"].tolist()
    assert load(answers_path(tmp_path / "queries-0000.npz", "ours"))["end"].tolist() == [0] * 6


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        (["--queries", "0"], "argument --queries: must be a whole number of at least 1, got 0"),
        (["--seed", "-1"], "argument --seed: must be a whole number of at least 0, got -1"),
        (
            ["--docs", "nowhere"],
            "--docs must be a folder with dragon-ccd.md, the page that gets the tables, got nowhere",
        ),
        (
            ["--only-report", "--folder", "nothing"],
            "--folder has no answered queries of the seed 2026: nothing/seed-2026",
        ),
    ],
)
def test_bad_input_of_a_run_is_one_line(
    arguments: list[str], text: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr("sys.argv", ["benchmarks.ccd", *arguments])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 2
    assert capsys.readouterr().err.splitlines()[-1] == f"python -m benchmarks.ccd: error: {text}"


def test_an_interrupted_run_says_that_the_same_command_continues(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("benchmarks.ccd.__main__.run", interrupted)
    monkeypatch.setattr("sys.argv", ["benchmarks.ccd", "--folder", str(tmp_path)])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 128 + signal.SIGINT
    kept = f"interrupted: the answers so far are in {tmp_path}/seed-2026, and the same command continues\n"
    assert capsys.readouterr().err == kept


def test_an_engine_that_hangs_at_every_query_is_a_row_of_the_report(tmp_path: Path) -> None:
    shard = SHARD.taken(np.flatnonzero(SHARD.columns["depth"] == -1e-3)[:3])
    save_answers(tmp_path / "box2d.npz", [(False, math.nan, math.nan, 0, ENDS.index("hang"))] * len(shard))
    save_answers(tmp_path / "ours.npz", list(answers(ENGINES[0], shard)))
    (tmp_path / PAGE).write_text(f"{BEGIN}{END}", encoding="utf-8")
    results = Results(shard, {"ours": load(tmp_path / "ours.npz"), "Box2D": load(tmp_path / "box2d.npz")})
    page = report(results, tmp_path)
    assert "| Box2D | 0 | 0 | 0 / 0 / 3 | 0 | 0 | 0 | 0 (0) | 0 |" in page
    assert {"ccd-time.png", "ccd-depth.png"} <= {path.name for path in tmp_path.iterdir()}


def test_scores_count_what_differs_from_the_truth() -> None:
    columns = dict.fromkeys(COLUMNS, np.zeros(5)) | {"kind": np.full(5, GRAZE), "depth": np.full(5, 1e-3)}
    columns |= {"low": np.array([0.1, 0.1, 0.1, np.nan, np.nan]), "high": np.array([0.2, 0.2, 0.2, np.nan, np.nan])}
    fields = {
        "touches": np.array([1, 1, 0, 1, 0]),
        "travel": np.array([0.15, 0.5, np.nan, 0.3, np.nan]),
        "microseconds": np.array([1.0, 2.0, 3.0, 4.0, np.nan]),
        "evaluations": np.arange(5),
        "end": np.array([0, 0, 0, 0, ENDS.index("hang")]),
    }
    results = Results(Shard({}, columns), {"one": fields})
    result = score(results, "one", np.ones(5, dtype=bool))
    assert (result.missed, result.invented, result.other, result.early) == (1, 1, (0, 0, 1), 0.0)
    assert result.late == pytest.approx(0.3)
    assert result.microseconds[0] == 2.5
    assert by_depth(results)[-2:] == ["| one | 1 / 1 |", "| *of contacts / clear* | 3 / 2 |"]


@pytest.mark.parametrize(
    ("start", "end", "bend", "h"), [(1.0, 1.0, 8.0, 1.0), (1.0, 3.0, 1.0, 1.0), (2.0, 1.5, 8.0, 1.0)]
)
def test_the_least_between_two_ends_is_that_of_the_parabola(start: float, end: float, bend: float, h: float) -> None:
    x = np.linspace(0.0, h, 100_001)
    parabola = start + (end - start) * x / h - 0.5 * bend * x * (h - x)
    assert least_between(start, end, bend, h) == pytest.approx(parabola.min(), abs=1e-9)
