"""Safe delays of one dragon, over HTTP and from a terminal."""

import math

from app.maps.dances import read_dance
from tests.conftest import ROOT
from tests.support.asking import dance, written
from tests.support.command import run

EXAMPLE = ROOT / "examples" / "crossing_streets.toml"
EAST = dance(5, (-20, 0), (20, 0))
NORTH = dance(5, (0, -20), (0, 20))
CROSSING = {"dances": [EAST | {"name": "east"}, NORTH | {"name": "3"}], "least": -60, "most": 60}
# The first procession ends on the crossing and stands there.
BLOCKED = {"dances": [dance(5, (-20, 0), (2, 0)), NORTH], "least": 20, "most": 90}


def test_a_dragon_is_named_by_its_number_or_its_name(ask):
    second = ask("safe-delay", CROSSING)
    first = ask("safe-delay", CROSSING | {"part": "east"})
    assert ask("safe-delay", CROSSING | {"part": "3"}) == ask("safe-delay", CROSSING | {"part": 1}) == second
    assert first["part"] == 0
    assert first == ask("safe-delay", CROSSING | {"part": 0.0})
    assert ask("safe-delay", CROSSING | {"dances": [EAST, NORTH], "part": "1"})["safe"] == second["safe"]
    later = ask("safe-delay", CROSSING | {"least": 0})
    assert later["summary"].startswith(f"3 waits {math.ceil(later['first_safe'] * 10) / 10} s before it begins")


def test_a_way_that_is_never_free_has_no_safe_delay(ask, tmp_path):
    got = ask("safe-delay", BLOCKED)
    assert (got["safe"], got["first_safe"], got["undecided"]) == ([], None, [])
    none = run("safe-delay", written(tmp_path, {"dances": BLOCKED["dances"]}), "--least", "20", "--most", "90")
    assert none.stdout.startswith("No delay of dragon 1 from 20 to 90 s is known to be safe: the dragons")


def test_the_table_of_the_command_rounds_inwards(ask):
    lines = run("safe-delay", str(EXAMPLE), "--part", "north").stdout.strip().splitlines()
    assert lines[0].strip() == "Safe delays of north from 0 to 600 s:"
    low, high = map(float, lines[-1].split())
    ((first, last),) = ask("safe-delay", read_dance(EXAMPLE, several=True))["safe"]
    assert 0.0 <= low - first <= 1e-6  # [s]
    assert 0.0 <= last - high <= 1e-6
