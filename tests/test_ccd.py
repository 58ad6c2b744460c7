"""Engines of continuous collision detection on the committed sample, whose truth stands on ball arithmetic alone."""

import importlib
import math
import os
import signal

import numpy as np
import pytest
from flint import arb

from benchmarks.ccd.__main__ import run
from benchmarks.ccd.dances import KINDS
from benchmarks.ccd.engines import ENGINES, Engine
from benchmarks.ccd.files import COLUMNS, ENDS, Shard, load, load_shard, save, save_shard
from benchmarks.ccd.march import least_between
from benchmarks.ccd.motion import Stage
from benchmarks.ccd.pieces import pieces_of
from benchmarks.ccd.queries import CONTACT, EXACT, FAR, GRAZE, dance_queries
from benchmarks.ccd.report import BEGIN, END, PAGE, SAMPLE, SAMPLED, Results, report, score
from benchmarks.ccd.running import Worker, answers, answers_path, installed, save_answers
from benchmarks.ccd.truth import covered, track
from tests.support.depth import some, thorough
from tests.support.near import assert_near

SHARD = load_shard(SAMPLE)
# Largest errors of our own times of contact [s]: the corner comes to a graze of 1e-9 m at 1e-5 m/s, so slowly that what
# doubles leave of its place, 1e-14 m and more, is 1e-9 s and more.
OURS = 1e-9
OURS_AT_GRAZES = 1e-8


def answered(engine, shard, folder):
    """The answers of an engine, read back from the file that a run writes.

    An engine in a new process for every file answers here as this process has it: docs/dragon-ccd.md.
    """
    save_answers(folder / "answers.npz", list(answers(engine, shard)))
    return Results(shard, {engine.name: load(folder / "answers.npz")})


def test_the_sample_has_every_class_kind_and_depth():
    kinds = SHARD.columns["kind"]
    assert len(SHARD) == SAMPLED
    assert all((kinds == kind).sum() > 0.3 * SAMPLED for kind in (CONTACT, GRAZE, FAR))
    assert {record["kind"] for record in SHARD.dances.values()} == set(KINDS)
    depths = np.round(np.log10(np.abs(SHARD.columns["depth"][kinds == GRAZE]))).astype(int)
    assert set(depths) == set(range(-9, -2))
    assert sum(path.stat().st_size for path in SAMPLE.parent.glob("sample.*")) < 400_000


@pytest.mark.parametrize("count", [150, *thorough(len(SHARD))])
def test_our_own_engine_misses_nothing_invents_nothing_and_is_exact(count, tmp_path):
    results = answered(ENGINES[0], SHARD.taken(np.arange(count)), tmp_path)
    result = score(results, "ours", np.ones(count, dtype=bool))
    assert (result.missed, result.invented, result.other) == (0, 0, (0, 0, 0))
    assert max(result.late, result.early) < OURS_AT_GRAZES
    contacts = score(results, "ours", results.queries.columns["kind"] == CONTACT)
    assert max(contacts.late, contacts.early) < OURS


# Not every machine and Python has each of them.
PACKAGES = {"box2d": [pytest.mark.engine("Box2D")], "ipctk": [pytest.mark.engine("ipctk")]}
OTHERS = [pytest.param(one, id=one.name, marks=PACKAGES.get(one.package, [])) for one in ENGINES if one.name != "ours"]


@pytest.mark.thorough
@pytest.mark.parametrize("engine", OTHERS)
def test_every_other_engine_answers_and_keeps_what_it_promises(engine, tmp_path):
    results = answered(engine, SHARD.taken(np.array(some(range(len(SHARD)), 40))), tmp_path)
    everything = np.ones(len(results.queries), dtype=bool)
    result = score(results, engine.name, everything)
    assert result.other == (0, 0, 0)
    if not engine.afresh:  # whose answers do not differ from process to process
        assert score(results, engine.name, results.queries.columns["kind"] == FAR).invented == 0
    if engine.package == "ipctk":  # is early rather than late
        assert result.missed == 0
        assert result.late <= OURS < result.early


@pytest.mark.parametrize("path", KINDS)
@pytest.mark.parametrize("kind, sign", [(CONTACT, 0), (GRAZE, -1), (GRAZE, 1), (FAR, 1)])
def test_the_truth_of_the_sample_is_shown_again_in_balls(kind, sign, path):
    columns = SHARD.columns
    rows = np.flatnonzero((columns["kind"] == kind) & ((sign == 0) | (np.sign(columns["depth"]) == sign)))
    k = next(k for k in rows.tolist() if SHARD.dances[int(columns["dance"][k])]["kind"] == path)
    query = SHARD.query(k)
    stage = Stage(SHARD.dances[int(columns["dance"][k])])
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


@pytest.mark.thorough
def test_queries_of_a_dance_are_the_same_again():
    number = int(SHARD.columns["dance"][0])
    record, known = dance_queries(2026, number)
    rows = np.flatnonzero(SHARD.columns["dance"] == number)
    assert record == SHARD.dances[number]
    assert {SHARD.query(k) for k in rows.tolist()} <= {one.query for one in known}


def absent():
    importlib.import_module("no_such_package")


def test_an_engine_that_cannot_be_loaded_is_named_and_left_out(capsys):
    assert list(installed((Engine("nobody", "no-such-package", "", absent), ENGINES[0]))) == ["ours"]
    assert "nobody" in capsys.readouterr().out


@pytest.mark.thorough
def test_a_crash_and_a_hang_are_rows_of_the_report_and_a_run_continues_where_it_was(tmp_path):
    shard = SHARD.taken(np.arange(0, len(SHARD), 170))
    worker = Worker("ours")
    save_shard(tmp_path / "queries-0000.npz", shard)
    rows = []
    for end in (signal.SIGKILL, signal.SIGPROF):
        worker.start()
        os.kill(worker.process.pid, end)
        rows.append(worker.answered(tmp_path / "queries-0000.npz", len(shard)))
    worker.stop()
    for end, some_rows in zip(("crash", "hang"), rows, strict=True):
        assert [ENDS[row[-1]] for row in some_rows] == [end, *["answered"] * 5]
    fields = {"touches": np.ones(6, dtype=np.int8), "travel": np.arange(6.0)}
    save(kept := answers_path(tmp_path / "queries-0000.npz", "ipctk"), fields)
    run(tmp_path, 0, len(shard), ("ours", "ipctk"))
    assert load(kept)["travel"].tolist() == fields["travel"].tolist()
    save_answers(kept, rows[1])
    (tmp_path / PAGE).write_text(f"{BEGIN}{END}", encoding="utf-8")
    assert "| ours | 0 | 0 | 0 / 0 / 1 |" in report(Results(shard, {"ours": load(kept)}), tmp_path)


def test_scores_count_what_differs_from_the_truth():
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


@pytest.mark.parametrize("start, end, bend, h", [(1.0, 1.0, 8.0, 1.0), (1.0, 3.0, 1.0, 0.5), (2.0, 1.5, 8.0, 2.0)])
def test_the_least_between_two_ends_is_that_of_the_parabola(start, end, bend, h):
    x = np.linspace(0.0, h, 100_001)
    parabola = start + (end - start) * x / h - 0.5 * bend * x * (h - x)
    assert_near(least_between(start, end, bend, h), parabola.min(), 1e-9)
