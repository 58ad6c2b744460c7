"""Shards: rows of designs good and bad, and files whose bytes depend on nothing else."""

import os
import pickle

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import core
from app.questions.registry import CALLS
from app.sweeps.questions import NO_ROWS, QUESTIONS, TrajectoryRow, question_of
from app.sweeps.shards import OtherVersion, ShardPiece, checked_part, part_name, write_part
from app.sweeps.spec import Spec
from tests.support.asking import dance
from tests.support.near import assert_near
from tests.support.odd_questions import LAND
from tests.support.refused import refused
from tests.support.sweeping import answered, spec_of


def table(piece):
    return pa.ipc.open_stream(piece.answer()).read_all()


def rows(name, request, over):
    """The rows of a question of the registry, all in one shard."""
    spec = Spec.of({"question": name, "over": over, "request": request, "shard_size": 100})
    return table(ShardPiece.whole(spec, spec.asks, 0)).to_pylist()


BENCH = {"x": 0.0, "y": 0.0, "heading": 0.0, "length": 2.2, "width": 0.3}
LANES = [dance(3, (0, y), (20, y)) for y in (0, 9)]
FLAT = {"benches": 8}
BODY = {"dragon": {"benches": 8}}
# The request, the name of a parameter and a good value of it, where they are not those of most questions.
REQUESTS = {
    "collision_time": (FLAT, "pitch", 0.55),
    "minimum_pitch": (FLAT, "margin", 0.01),
    "minimum_pitch_of": (BODY, "margin", 0.01),
    "turn": ({}, "pitch", 1.7),
    "turn_of": ({"path": {"kind": "turn"}}, "path.pitch", 1.7),
    "shortest_turn_of": (BODY, "pitch", 1.7),
    "turn_time_of": (BODY | {"path": {"kind": "turn"}}, "path.pitch", 1.7),
    "quickest_turn_of": (BODY, "pitch", 1.7),
    "maximum_head_speed_of": (BODY | {"stop": 100.0}, "path.pitch", 1.7),
    "collision_time_of": (BODY, "path.pitch", 0.55),
    "contact_probability": (BODY | {"samples": 20, "stop": 9.0}, "lateral", 0.01),
    "overlaps": ({"benches": [BENCH] * 3}, "margin", 0.01),
    "safe_delay": ({"dances": LANES}, "margin", 0.01),
    "encounter": ({"dances": [BODY] * 2}, "margin", 0.01),
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_every_question_is_answered_and_refuses_a_bad_design(name):
    has_body = name.endswith("_of") or name in ("check", "trajectory")
    request, parameter, good = REQUESTS.get(name, (BODY, "path.pitch", 1.7) if has_body else (FLAT, "pitch", 1.7))
    good_row, bad_row = rows(name, request, {parameter: [good, -1.0]})
    assert good_row["error.code"] is None, good_row
    assert isinstance(good_row[question_of(name, [parameter, *request]).map_column], float)
    assert bad_row["error.code"] == "invalid-value"
    assert parameter.rpartition(".")[2] in bad_row["error.message"]


@pytest.mark.parametrize(
    "name, column, values",
    [
        ("check", "encounter.outcome", None),
        ("tolerance", "own", None),
        ("clearance", "dragons.1", [8.7, 8.6]),
        ("trajectory", "heads", None),
        ("least_clearance", "at_least", [8.7, 8.6]),
    ],
)
def test_a_question_about_several_dances_has_rows_of_its_own(name, column, values):
    *good_rows, bad_row = rows(name, {"dances": LANES}, {"dances.1.dragon.width": [0.3, 0.5, -1.0]})
    assert all(row[column] is not None for row in good_rows)
    results = [row[question_of(name, ["dances"]).map_column] for row in good_rows]
    assert results == pytest.approx(values or results)
    assert {type(result) for result in results} == {float}
    assert bad_row["error.code"] == "invalid-value"
    assert "dances[1].dragon.width" in bad_row["error.message"]


def test_a_row_about_one_dance_refuses_several():
    with refused("dances"):
        question_of("check").answer_to({"dances": LANES})


def test_every_call_of_the_service_is_swept_or_has_its_reason():
    swept = CALLS.keys() & QUESTIONS.keys()
    reasons = {name for name in CALLS if name.removesuffix("_of") in NO_ROWS}
    assert swept & reasons == set()
    assert CALLS.keys() - swept - reasons == set(), "app/sweeps/questions.py needs a line of each, or its reason"


def test_the_row_of_a_table_is_what_the_table_says():
    dance = core.Dance(core.Dragon(benches=30), core.Spiral(0.6))
    times = np.arange(0.0, 301.0)
    motion = core.trajectory(dance, times)
    head, tail, speed = *motion.position[-1, [0, -1]], motion.speed
    [row] = rows("trajectory", {"dragon": {"benches": 30}}, {"path.pitch": [0.6]})
    numbers = [row[name] for name in TrajectoryRow.model_fields]
    assert numbers == [300.0, *head, *tail, speed[-1, -1], speed.min(), speed.max()]
    profile = core.clearance_profile(dance, times)
    [row] = rows("clearance", {"benches": 30}, {"pitch": [0.6]})
    assert row["clearance"] == min(profile.clearance.min(), *(graze.clearance for graze in profile.grazes))
    benches = [BENCH, BENCH | {"y": 9.0}, BENCH | {"x": 0.2, "y": 0.1}]
    row, alone = (rows("overlaps", {"benches": benches[:count]}, {"margin": [0.0]})[0] for count in (3, 1))
    assert (row["pairs"], row["benches.0"], row["benches.1"], row["agree"]) == (1, 0, 2, True)
    assert_near(row["separation"], -0.2, 1e-12)
    assert alone["separation"] is None


def test_a_file_has_the_same_bytes_however_its_shard_was_cut(tmp_path):
    spec = spec_of(LAND, {"x": {"start": 0, "stop": 30, "count": 31}, "y": [2.0, -1.0]}, shard_size=62)
    whole = ShardPiece.whole(spec, LAND, 0)
    left, right = whole.halves()
    files = set()
    for cut in ([whole], [left, right], [*left.halves(), right]):
        write_part(tmp_path, spec, 0, [piece.answer() for piece in cut])
        files.add((tmp_path / part_name(0)).read_bytes())
    assert len(files) == 1


def test_a_part_of_errors_alone_or_a_killed_design_has_the_columns_of_the_others(tmp_path):
    spec = spec_of(LAND, {"x": [1.0, 13.0], "y": [2.0], "word": ["a"], "deadly": [[]]}, shard_size=1)
    answered(tmp_path, spec, LAND)
    first, second = (pq.read_schema(tmp_path / part_name(shard)) for shard in range(2))
    assert first.equals(second)
    assert [str(first.field(name).type) for name in ("x", "word", "deadly")] == ["double", "string", "string"]
    killed = pa.ipc.open_stream(ShardPiece.whole(spec, LAND, 0).killed_row()).read_all()
    assert killed.schema.equals(first, check_metadata=False)
    assert killed["error.code"].to_pylist() == ["killed"]


def test_parts_of_another_sweep_and_broken_files_are_refused(tmp_path):
    spec = spec_of(LAND, {"x": [1.0]})
    file = tmp_path / part_name(0)
    answered(tmp_path, spec_of(LAND, {"x": [2.0]}), LAND)
    for _ in range(2):
        with refused("folder", file=str(file)):
            checked_part(tmp_path, spec, 0)
        file.write_bytes(b"PAR1 no more")


def test_a_file_that_cannot_be_written_leaves_nothing(tmp_path):
    spec = spec_of(LAND, {"x": [1.0]})
    (tmp_path / part_name(0)).mkdir()
    with pytest.raises(IsADirectoryError):
        write_part(tmp_path, spec, 0, [ShardPiece.whole(spec, LAND, 0).answer()])
    assert os.listdir(tmp_path) == [part_name(0)]


def test_a_worker_of_another_version_says_so():
    piece = ShardPiece(spec_of(LAND, {"x": [1.0]}), LAND, "0.0.1", 0, 0, 1)
    with refused("bench-dragon", OtherVersion, version="0.0.1"):
        pickle.loads(pickle.dumps(piece)).answer()
