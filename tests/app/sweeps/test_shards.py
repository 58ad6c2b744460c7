"""Shards: rows of designs good and bad, and files whose bytes depend on nothing else."""

from __future__ import annotations

import json
import os
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

import core
from app.questions.collision_time import CollisionQuery, CollisionTime
from app.questions.registry import CALLS
from app.sweeps.questions import NO_ROWS, QUESTIONS, SweepQuestion, question_of
from app.sweeps.shards import OtherVersion, ShardPiece, checked_part, part_name, parts, write_part
from app.sweeps.spec import Spec
from app.wire.question import Terms
from core import InvalidValue
from tests.support.odd_questions import LAND


def spec_of(question: SweepQuestion, over: dict[str, Any], **more: Any) -> Spec:
    return Spec.of({"question": question.name, "over": over, **more}, question)


def rows(piece: ShardPiece) -> list[dict[str, Any]]:
    result: list[dict[str, Any]] = pa.ipc.open_stream(piece.answer()).read_all().to_pylist()
    return result


def test_each_row_is_the_answer_to_its_request() -> None:
    question = question_of("collision_time")
    spec = spec_of(question, {"pitch": [0.5, 0.55, 1.7], "width": [0.2, 0.3]}, request={"benches": 50})
    for row in rows(ShardPiece.whole(spec, question, 0)) + rows(ShardPiece.whole(spec, question, 1)):
        request = CollisionQuery(pitch=row["pitch"], width=row["width"], benches=50, cross_check="none")
        dance = request.to_dance(50)
        answer = CollisionTime.of(core.first_contact(dance), request, Terms())
        assert (row["outcome"], row["time"]) == (answer.outcome, answer.time)
        assert (row["benches.0"], row["benches.1"]) == (answer.benches or (None, None))
        assert row["certificate.steps"] == answer.certificate.steps
        assert "certificate.method" not in row


def test_a_body_is_swept_by_dotted_names() -> None:
    question = question_of("check")
    spec = spec_of(question, {"path.pitch": [0.5, 0.55], "dragon.width": [0.3]}, request={"dragon": {"benches": 20}})
    row = rows(ShardPiece.whole(spec, question, 1))[0]
    assert (row["path.pitch"], row["verdict"]) == (0.55, "fails")
    assert row["first_contact.time"] == pytest.approx(412.473838, abs=1e-6)
    assert json.loads(row["failures"])[0]["kind"] == "contact"


@pytest.mark.parametrize(
    ("name", "flat", "body"),
    [
        ("collision_time", {"pitch": 0.5, "benches": 40}, {"path.pitch": 0.5, "dragon.benches": 40}),
        ("least_clearance", {"width": 0.2, "benches": 9}, {"dragon": {"width": 0.2, "benches": 9}}),
        ("turn", {"pitch": 1.6}, {"path": {"kind": "turn", "pitch": 1.6}}),
    ],
)
def test_a_question_is_asked_flat_or_as_a_body(name: str, flat: dict[str, Any], body: dict[str, Any]) -> None:
    answers = []
    for request in (flat, body):
        spec = Spec.of({"question": name, "over": {place: [value] for place, value in request.items()}})
        [row] = rows(ShardPiece.whole(spec, spec.asks, 0))
        answers.append({place: value for place, value in row.items() if place not in {*request, "pitch"}})
    assert answers[0] == answers[1]
    assert isinstance(answers[0][spec.asks.map_column], float)


def test_a_refusal_of_core_uses_the_names_of_the_spec() -> None:
    spec = Spec.of({"question": "least_clearance", "over": {"benches": [2]}})
    [row] = rows(ShardPiece.whole(spec, spec.asks, 0))
    assert row["error.message"] == "benches must be at least 3, so that two share no handle, got 2"


BENCH = {"x": 0.0, "y": 0.0, "heading": 0.0, "length": 2.2, "width": 0.3}
# A request, the name of a parameter, a good value and a bad one.
FLAT = ({"benches": 8}, "pitch", 1.7)
BODY = ({"dragon": {"benches": 8}}, "path.pitch", 1.7)
REQUESTS = {
    "collision_time": ({"benches": 8}, "pitch", 0.55),
    "minimum_pitch": ({"benches": 8}, "margin", 0.01),
    "minimum_pitch_of": ({"dragon": {"benches": 8}}, "margin", 0.01),
    "turn": ({}, "pitch", 1.7),
    "turn_of": ({"path": {"kind": "turn"}}, "path.pitch", 1.7),
    "shortest_turn_of": ({"dragon": {"benches": 8}}, "pitch", 1.7),
    "turn_time_of": ({"dragon": {"benches": 8}, "path": {"kind": "turn"}}, "path.pitch", 1.7),
    "quickest_turn_of": ({"dragon": {"benches": 8}}, "pitch", 1.7),
    "maximum_head_speed_of": ({"dragon": {"benches": 8}, "stop": 100.0}, "path.pitch", 1.7),
    "collision_time_of": ({"dragon": {"benches": 8}}, "path.pitch", 0.55),
    "contact_probability": ({"dragon": {"benches": 8}, "samples": 20, "stop": 9.0}, "lateral", 0.01),
    "overlaps": ({"benches": [BENCH] * 3}, "margin", 0.01),
    "safe_delay": (
        {
            "dances": [
                {"dragon": {"benches": 3}, "path": {"kind": "waypoints", "points": [[0, y], [20, y]]}} for y in (0, 9)
            ]
        },
        "margin",
        0.01,
    ),
    "encounter": ({"dances": [{"dragon": {"benches": 8}}, {"dragon": {"benches": 8}}]}, "margin", 0.01),
}


@pytest.mark.parametrize("name", QUESTIONS)
def test_every_question_is_answered_and_refuses_a_bad_design(name: str) -> None:
    body = name.endswith("_of") or name in ("check", "trajectory")
    request, parameter, good = REQUESTS.get(name, BODY if body else FLAT)
    question = question_of(name, [parameter, *request])
    spec = Spec.of({"question": name, "over": {parameter: [good, -1.0]}, "request": request, "shard_size": 2})
    answered, refused = rows(ShardPiece.whole(spec, question, 0))
    assert answered["error.code"] is None, answered
    assert isinstance(answered[question.map_column], float)
    assert refused["error.code"] == "invalid-value"
    assert parameter.rpartition(".")[2] in refused["error.message"]


LANES = [{"dragon": {"benches": 3}, "path": {"kind": "waypoints", "points": [[0, y], [20, y]]}} for y in (0, 9)]
# Questions about several dances, each with columns that only their rows have.
OF_SEVERAL = {
    "check": ["least_clearance.dragons.0", "encounter.outcome"],
    "tolerance": ["dragons", "own"],
    "clearance": ["dragons.1", "benches.1"],
    "trajectory": ["heads", "tails"],
    "least_clearance": ["dragons.0", "at_least"],
}


@pytest.mark.parametrize("name", OF_SEVERAL)
def test_a_question_about_several_dances_has_rows_of_its_own(name: str) -> None:
    spec = Spec.of({
        "question": name,
        "over": {"dances.1.dragon.width": [0.3, 0.5, -1.0]},
        "request": {"dances": LANES},
        "shard_size": 3,
    })  # fmt: skip
    narrow, wide, refused = rows(ShardPiece.whole(spec, spec.asks, 0))
    assert (narrow["error.code"], wide["error.code"], refused["error.code"]) == (None, None, "invalid-value")
    assert narrow.keys() >= set(OF_SEVERAL[name])
    assert isinstance(narrow[spec.asks.map_column], float)
    assert "dances[1].dragon.width" in refused["error.message"]
    if name in ("clearance", "least_clearance"):
        assert narrow[spec.asks.map_column] == pytest.approx(8.7)
        assert wide[spec.asks.map_column] == pytest.approx(8.6)
    assert question_of(name).answer is not question_of(name, ["dances.1.delay"]).answer


def test_a_row_about_one_dance_refuses_several() -> None:
    with pytest.raises(InvalidValue, match='"dances" is unknown here'):
        question_of("check").answer_to({"dances": LANES})


def test_every_call_of_the_service_is_swept_or_has_its_reason() -> None:
    swept, refused = CALLS.keys() & QUESTIONS.keys(), {name for name in CALLS if name.removesuffix("_of") in NO_ROWS}
    assert swept & refused == set()
    assert CALLS.keys() - swept - refused == set(), "app/sweeps/questions.py needs a line of each, or its reason"


def row_of(name: str, request: dict[str, Any], **over: Any) -> Any:
    """The row of a single design."""
    [row] = rows(ShardPiece.whole(spec := Spec.of({"question": name, "over": over, "request": request}), spec.asks, 0))
    return row


def test_the_row_of_a_table_is_what_the_table_says() -> None:
    dance = core.Dance(core.Dragon(benches=30), core.Spiral(0.6))
    times = np.arange(0.0, 301.0)
    table = core.trajectory(dance, times)
    row = row_of("trajectory", {"dragon": {"benches": 30}}, **{"path.pitch": [0.6]})
    assert (row["time"], row["head_x"], row["head_y"]) == (300.0, *table.position[-1, 0])
    assert (row["tail_x"], row["tail_y"], row["tail_speed"]) == (*table.position[-1, -1], table.speed[-1, -1])
    assert (row["least_speed"], row["greatest_speed"]) == (table.speed.min(), table.speed.max())
    profile = core.clearance_profile(dance, times)
    row = row_of("clearance", {"benches": 30}, pitch=[0.6])
    assert row["clearance"] == min(profile.clearance.min(), *(graze.clearance for graze in profile.grazes))
    third = BENCH | {"x": 0.2, "y": 0.1}
    row = row_of("overlaps", {"benches": [BENCH, BENCH | {"y": 9.0}, third]}, margin=[0.0])
    assert (row["pairs"], row["benches.0"], row["benches.1"], row["agree"]) == (1, 0, 2, True)
    assert row["separation"] == pytest.approx(-0.2, abs=1e-12)
    assert row_of("overlaps", {"benches": [BENCH]}, margin=[0.0])["separation"] is None


def test_a_bad_design_is_a_row_with_its_error_and_the_others_are_answered() -> None:
    spec = spec_of(LAND, {"x": [1.0, 13.0, 14.0, 100.5, 2.0], "y": [3.0]}, shard_size=5)
    result = rows(ShardPiece.whole(spec, LAND, 0))
    assert [row["height"] for row in result] == [3.0, None, None, None, 6.0]
    assert [row["error.code"] for row in result] == [None, "invalid-value", "internal-error", "invalid-value", None]
    assert [row["error.message"] for row in result[1:4]] == [
        "x must not be 13 m",
        "ZeroDivisionError: a mistake of ours",
        "x must be at most 100 m, got 100.5 m: lengths are in metres, and 100.5 cm is 1.005 m",
    ]


def test_parameters_of_any_kind_are_columns() -> None:
    spec = spec_of(LAND, {"x": [1, 2], "word": ["a", "b"], "deadly": [[], [5.0]]}, shard_size=8)
    table = pa.ipc.open_stream(ShardPiece.whole(spec, LAND, 0).answer()).read_all()
    assert [str(table.schema.field(name).type) for name in ("x", "word", "deadly")] == ["int64", "string", "string"]
    assert table["deadly"].to_pylist()[:2] == ["[]", "[5.0]"]


def test_a_file_has_the_same_bytes_however_its_shard_was_cut(tmp_path: Path) -> None:
    spec = spec_of(LAND, {"x": {"start": 0, "stop": 30, "count": 31}, "y": [2.0, -1.0]}, shard_size=62)
    whole = ShardPiece.whole(spec, LAND, 0)
    left, right = whole.halves()
    cuts = {"whole": [whole], "halves": [left, right], "uneven": [*left.halves(), right]}
    for name, cut in cuts.items():
        (tmp_path / name).mkdir()
        write_part(tmp_path / name, spec, 0, [piece.answer() for piece in cut])
    assert len({(tmp_path / name / part_name(0)).read_bytes() for name in cuts}) == 1


def test_a_part_of_errors_alone_has_the_columns_of_the_others(tmp_path: Path) -> None:
    spec = spec_of(LAND, {"x": [1.0, 13.0], "y": [2.0]}, shard_size=1)
    for shard in range(2):
        write_part(tmp_path, spec, shard, [ShardPiece.whole(spec, LAND, shard).answer()])
    first, second = (pq.read_schema(tmp_path / part_name(shard)) for shard in range(2))
    assert first.equals(second)
    assert parts(tmp_path) == {0, 1}


def test_a_killed_design_has_the_columns_of_the_others() -> None:
    spec = spec_of(LAND, {"x": [1.0], "y": [2.0]})
    piece = ShardPiece.whole(spec, LAND, 0)
    answered, killed = (pa.ipc.open_stream(data).read_all() for data in (piece.answer(), piece.killed_row()))
    assert answered.schema.equals(killed.schema)
    assert killed["error.code"].to_pylist() == ["killed"]


def test_parts_of_another_sweep_and_broken_files_are_refused(tmp_path: Path) -> None:
    spec, other = spec_of(LAND, {"x": [1.0]}), spec_of(LAND, {"x": [2.0]})
    write_part(tmp_path, other, 0, [ShardPiece.whole(other, LAND, 0).answer()])
    with pytest.raises(InvalidValue, match="belongs to another sweep"):
        checked_part(tmp_path, spec, 0)
    (tmp_path / part_name(0)).write_bytes(b"PAR1 no more")
    with pytest.raises(InvalidValue, match="is not part of a sweep"):
        checked_part(tmp_path, spec, 0)


def test_a_file_that_cannot_be_written_leaves_nothing(tmp_path: Path) -> None:
    spec = spec_of(LAND, {"x": [1.0]})
    (tmp_path / part_name(0)).mkdir()
    with pytest.raises(IsADirectoryError):
        write_part(tmp_path, spec, 0, [ShardPiece.whole(spec, LAND, 0).answer()])
    assert os.listdir(tmp_path) == [part_name(0)]


def test_a_worker_of_another_version_says_so() -> None:
    spec = spec_of(LAND, {"x": [1.0]})
    piece = ShardPiece(spec, LAND, "0.0.1", 0, 0, 1)
    with pytest.raises(OtherVersion, match=r"must be 0\.0\.1 on every worker"):
        pickle.loads(pickle.dumps(piece)).answer()
