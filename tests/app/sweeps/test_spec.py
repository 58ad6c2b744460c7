"""Specs of sweeps: equal from TOML, JSON and Python, named after their bytes; wrong ones are refused with a message."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest

from app.sweeps.spec import DESIGNS_MAX, SHARDS_SMALL, Range, Spec, with_values
from core import BenchDragonError

PAGE = Path(__file__).parents[3] / "docs" / "sweeps.md"
TOML = """
question = "collision_time"
[request]
margin = 0.05
[over]
pitch = { start = 0.45, stop = 0.6, count = 100 }
benches = [100, 223]
"""
FIELDS: dict[str, Any] = {
    "question": "collision_time",
    "request": {"margin": 0.05},
    "over": {"pitch": {"start": 0.45, "stop": 0.6, "count": 100}, "benches": [100, 223]},
}


def changed(**changes: Any) -> dict[str, Any]:
    return FIELDS | changes


def test_toml_json_and_python_give_the_same_spec_with_the_same_name(tmp_path: Path) -> None:
    (tmp_path / "a.toml").write_text(TOML)
    (tmp_path / "a.json").write_text(json.dumps(FIELDS))
    specs = [Spec.read(tmp_path / "a.toml"), Spec.read(tmp_path / "a.json"), Spec.of(FIELDS)]
    assert specs[0] == specs[1] == specs[2]
    assert len({spec.canonical() for spec in specs}) == len({spec.name for spec in specs}) == 1


def test_another_value_or_another_order_is_another_sweep() -> None:
    others = [
        Spec.of(changed(request={"margin": 0.06})),
        Spec.of(changed(over=dict(reversed(FIELDS["over"].items())))),
        Spec.of(changed(shard_size=7)),
        Spec.of(changed(over=FIELDS["over"] | {"benches": [100, 222]})),
    ]
    assert len({spec.name for spec in [Spec.of(FIELDS), *others]}) == 5


def test_designs_are_all_combinations_cut_into_shards() -> None:
    spec = Spec.of(changed(shard_size=30))
    assert (spec.designs, spec.shards) == (200, 7)
    assert [spec.shard(k) for k in (0, 1, 6)] == [(0, 30), (30, 60), (180, 200)]


def test_the_size_of_shards_depends_on_no_clock() -> None:
    assert Spec.of(changed(over={"pitch": Range(start=0.4, stop=0.6, count=10**6).model_dump()})).shard_size == 5000
    assert Spec.of(changed(over={"pitch": Range(start=0.4, stop=0.6, count=640).model_dump()})).shards == SHARDS_SMALL


def test_cross_checks_are_left_out_unless_they_are_asked_for() -> None:
    assert Spec.of(FIELDS).request["cross_check"] == "none"
    assert Spec.of(changed(request={"cross_check": "pair"})).request["cross_check"] == "pair"
    assert "cross_check" not in Spec.of(changed(over={"cross_check": ["none", "pair"]})).request


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"question": "collision"}, "question must be one of collision_time, minimum_pitch"),
        ({"question": "pitch_scan_of"}, "question pitch_scan_of cannot be swept, because it is a sweep itself"),
        (
            {"question": "contact_figure"},
            "question contact_figure cannot be swept, because its answer is a picture",
        ),
        ({"question": "collision_time_of"}, '"pitch" is unknown here: it belongs in path'),
        ({"over": {"pich": [0.5]}}, '"pich" is unknown here: did you mean pitch?'),
        ({"request": {"width": -1}}, "width must be at least 0.001 m, got -1 m"),
        ({"request": {"widht": 1}}, '"widht" is unknown here: did you mean width?'),
        ({"over": {"pitch": {"start": 0.4, "stop": 0.6}}}, "samples must say how to sample pitch"),
        ({"samples": {"count": 10}}, "samples needs a range without a count, and there is none"),
        (
            {"over": {"pitch": {"start": 0.4, "stop": 0.6, "count": DESIGNS_MAX}, "benches": [1, 2]}},
            "at most 100000000",
        ),
        (
            {"over": {"pitch": {"start": 0.4, "stop": 0.6, "count": 10**7}}, "shard_size": 1},
            "at least 10 for 10000000 designs, got 1",
        ),
        ({"over": {}}, "over"),
        ({"over": {"pitch": []}}, "over.pitch must have at least 1 entry, got none"),
        ({"over": {"path.pitch": []}}, "path.pitch must have at least 1 entry, got none"),
        ({"over": {"pitch": 0.5}}, "over.pitch must be a JSON object or a list of values, got 0.5"),
        ({"over": {"pitch": {"stop": 1, "count": 3}}}, "over.pitch.start is missing"),
        ({"over": {"pitch": {"start": "a", "stop": 1, "count": 3}}}, 'over.pitch.start must be a number, got "a"'),
        ({"over": {"pitch": {"start": 0, "stop": 1, "count": 1}}}, "over.pitch.count must be at least 2, got 1"),
        (
            {"over": {"pitch": {"start": 1, "stop": 2, "scale": "cubic"}}},
            'over.pitch.scale must be "linear" or "log", got "cubic"',
        ),
        ({"over": {"pitch": {"start": 0, "stop": 1, "step": 1}}}, "over.pitch.step is unknown here: leave it out"),
        ({"samples": {"count": 0}}, "samples.count must be at least 1, got 0"),
        (
            {"over": {"pitch": {"start": -1, "stop": 2, "count": 3, "scale": "log"}}},
            "start and stop must be positive on a log scale",
        ),
    ],
)
def test_a_wrong_spec_is_refused_in_words(changes: dict[str, Any], message: str) -> None:
    with pytest.raises(BenchDragonError) as refused:
        Spec.of(changed(**changes))
    assert message in refused.value.message


def test_a_bad_value_of_a_varied_parameter_is_a_design_like_any_other() -> None:
    assert Spec.of(changed(over={"pitch": [-1.0, 0.5]})).designs == 2


@pytest.mark.parametrize(("name", "text"), [("a.toml", "over = ["), ("a.json", "{")])
def test_text_that_is_not_toml_or_json_is_refused(name: str, text: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    with pytest.raises(BenchDragonError, match=f"is not {name[2:].upper()}"):
        Spec.read(tmp_path / name)


def test_values_are_placed_into_a_copy() -> None:
    base = {"path": {"kind": "spiral"}, "margin": 0}
    result = with_values(base, {"path.pitch": 0.5, "dragon.width": 0.2, "margin": 1})
    assert result == {"path": {"kind": "spiral", "pitch": 0.5}, "dragon": {"width": 0.2}, "margin": 1}
    assert base == {"path": {"kind": "spiral"}, "margin": 0}


@pytest.mark.parametrize("spec", re.findall(r"^```toml\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE))
def test_the_specs_in_the_docs_are_valid(spec: str) -> None:
    assert Spec.of(tomllib.loads(spec)).designs in (120, 1000)
