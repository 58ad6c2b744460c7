"""The clearance between several dragons over time: its instants, and the command."""

import json
import math

from app.questions.clearance import ClearanceRequest
from app.settings import Settings
from tests.support.asking import dance, written
from tests.support.command import run

DANCES = [dance(5, (0, 0), (40, 0), name="east"), dance(5, (15, -20), (15, 20), delay=16)]
PERFORMANCE = ClearanceRequest.model_validate({"dances": DANCES}).to_performance(Settings())


def test_what_is_left_out_is_every_whole_second_of_the_performance(ask):
    first = math.ceil(PERFORMANCE.begin)
    last = math.floor(PERFORMANCE.end.time)
    assert first > 0
    for times, known in (({"stop": 40, "step": 8}, range(first, 41, 8)), (None, range(first, last + 1))):
        assert ask("clearance", {"dances": DANCES, "times": times})["time"] == [*known]


def test_the_command_shows_the_grazes_and_takes_its_times_from_the_file_and_the_options(ask, tmp_path):
    body = {"dances": DANCES, "times": {"stop": 40, "step": 8}}
    # A venue is no part of this question.
    done = run("clearance", written(tmp_path, body | {"venue": {"type": "FeatureCollection", "features": []}}))
    assert f"{ask('clearance', body)['grazes'][0]['time']:.9f}" in done.stdout
    file = written(tmp_path, {"dances": DANCES, "start": 20})
    assert json.loads(run("clearance", file, "--json", "--step", "5").stdout)["time"][:2] == [20.0, 25.0]
    assert "stop must not be before start (20 s), got 1 s" in run("clearance", file, "--stop", "1").stderr
