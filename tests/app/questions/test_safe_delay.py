"""Safe delays of one dragon, over HTTP and from a terminal."""

import math

from app.maps.dances import read_dance
from tests.conftest import ROOT
from tests.support.asking import dance
from tests.support.command import run

EXAMPLE = ROOT / "examples" / "crossing_streets.toml"
EAST = dance(5, (-20, 0), (20, 0))
NORTH = dance(5, (0, -20), (0, 20))
CROSSING = {"dances": [EAST | {"name": "east"}, NORTH | {"name": "3"}], "least": -60, "most": 60}


def test_a_dragon_is_named_by_its_number_or_its_name(ask):
    second = ask("safe-delay", CROSSING)
    first = ask("safe-delay", CROSSING | {"part": "east"})
    assert ask("safe-delay", CROSSING | {"part": "3"}) == ask("safe-delay", CROSSING | {"part": 1}) == second
    assert first["part"] == 0
    assert first == ask("safe-delay", CROSSING | {"part": 0.0})
    assert ask("safe-delay", CROSSING | {"dances": [EAST, NORTH], "part": "1"})["safe"] == second["safe"]
    later = ask("safe-delay", CROSSING | {"least": 0})
    assert later["summary"].startswith(f"3 waits {math.ceil(later['first_safe'] * 10) / 10} s before it begins")


def test_the_table_of_the_command_rounds_inwards(ask):
    lines = run("safe-delay", str(EXAMPLE), "--part", "north").stdout.strip().splitlines()
    assert lines[0].strip() == "Safe delays of north from 0 to 600 s:"
    low, high = map(float, lines[-1].split())
    ((first, last),) = ask("safe-delay", read_dance(EXAMPLE, several=True))["safe"]
    assert 0.0 <= low - first <= 1e-6  # [s]
    assert 0.0 <= last - high <= 1e-6
