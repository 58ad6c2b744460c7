"""Specs of sweeps: equal from TOML, JSON and Python, named after their bytes; wrong ones are refused by their field."""

import json
import re
import tomllib

import pytest

from app.sweeps.spec import DESIGNS_MAX, SHARDS_SMALL, Spec
from core import TooLarge
from tests.conftest import ROOT
from tests.support.refused import refused

PAGE = ROOT / "docs" / "sweeps.md"
TOML = """
question = "collision_time"
[request]
margin = 0.05
[over]
pitch = { start = 0.45, stop = 0.6, count = 100 }
benches = [100, 223]
"""
FIELDS = tomllib.loads(TOML)
# The field that each must name, and the fields that are otherwise as above.
WRONG = """
question           {"question": "collision"}
question           {"question": "pitch_scan_of"}
question           {"question": "contact_figure"}
over               {"question": "encounter", "over": {"dances.2.delay": [0]}, "request": {"dances": [{}, {}]}}
pitch              {"question": "collision_time_of"}
pich               {"over": {"pich": [0.5]}}
width              {"request": {"width": -1}}
widht              {"request": {"widht": 1}}
samples            {"over": {"pitch": {"start": 0.4, "stop": 0.6}}}
samples            {"samples": {"count": 10}}
over               {"over": {}}
over.pitch         {"over": {"pitch": []}}
over.path.pitch    {"over": {"path.pitch": []}}
over.pitch         {"over": {"pitch": 0.5}}
over.pitch.start   {"over": {"pitch": {"stop": 1, "count": 3}}}
over.pitch.start   {"over": {"pitch": {"start": "a", "stop": 1, "count": 3}}}
over.pitch.count   {"over": {"pitch": {"start": 0, "stop": 1, "count": 1}}}
over.pitch.scale   {"over": {"pitch": {"start": 1, "stop": 2, "scale": "cubic"}}}
over.pitch.step    {"over": {"pitch": {"start": 0, "stop": 1, "step": 1}}}
samples.count      {"samples": {"count": 0}}
over.pitch         {"over": {"pitch": {"start": -1, "stop": 2, "count": 3, "scale": "log"}}}
over.design        {"over": {"design": [1.0]}}
"""


def changed(**changes):
    return Spec.of(FIELDS | changes)


def test_toml_json_and_python_give_the_same_spec_with_the_same_name(tmp_path):
    (tmp_path / "a.toml").write_text(TOML)
    (tmp_path / "a.json").write_text(json.dumps(FIELDS))
    specs = [Spec.read(tmp_path / "a.toml"), Spec.read(tmp_path / "a.json"), Spec.of(FIELDS)]
    assert specs[0] == specs[1] == specs[2]
    assert len({spec.name for spec in specs}) == 1


def test_another_value_or_another_order_is_another_sweep():
    orders = FIELDS["over"] | {"benches": [100, 222]}, dict(reversed(FIELDS["over"].items()))
    changes = [{}, {"request": {"margin": 0.06}}, {"shard_size": 7}, *({"over": over} for over in orders)]
    assert len({changed(**each).name for each in changes}) == 5


def test_designs_are_all_combinations_cut_into_shards():
    spec = changed(shard_size=30)
    assert spec.designs == 200
    assert spec.shards == 7
    assert [spec.shard(k) for k in (0, 1, 6)] == [(0, 30), (30, 60), (180, 200)]


def test_the_size_of_shards_depends_on_no_clock():
    large, small = (changed(over={"pitch": {"start": 0.4, "stop": 0.6, "count": count}}) for count in (10**6, 640))
    assert large.shard_size == 5000
    assert small.shards == SHARDS_SMALL


def test_cross_checks_are_left_out_unless_they_are_asked_for():
    assert changed().request["cross_check"] == "none"
    assert changed(request={"cross_check": "pair"}).request["cross_check"] == "pair"
    assert "cross_check" not in changed(over={"cross_check": ["none", "pair"]}).request


@pytest.mark.parametrize("row", WRONG.strip().splitlines())
def test_a_wrong_spec_is_refused_by_its_field(row):
    field, changes = row.split(maxsplit=1)
    with refused(field):
        changed(**json.loads(changes))


def test_a_sweep_has_so_many_designs_and_shards_at_most():
    values = {"start": 0.4, "stop": 0.6, "count": DESIGNS_MAX}
    with refused("over", TooLarge, got=2 * DESIGNS_MAX, most=DESIGNS_MAX):
        changed(over={"pitch": values, "benches": [1, 2]})
    with refused("shard_size", TooLarge, got=1, least=100):
        changed(over={"pitch": values}, shard_size=1)


@pytest.mark.parametrize("name, text", [("a.toml", "over = ["), ("a.json", "{")])
def test_text_that_is_not_toml_or_json_is_refused(name, text, tmp_path):
    (tmp_path / name).write_text(text)
    with refused("spec"):
        Spec.read(tmp_path / name)


@pytest.mark.parametrize("spec", re.findall(r"^```toml\n(.*?)^```", PAGE.read_text(), re.DOTALL | re.MULTILINE))
def test_the_specs_in_the_docs_are_valid(spec):
    assert Spec.of(tomllib.loads(spec)).designs in (120, 1000)
