"""Names and units in messages. For an unknown name only names are suggested that the call itself has at that place."""

from importlib import import_module
from pkgutil import walk_packages

import pytest

import app
from app.wire.fields import extra_of
from app.wire.messages import owners
from app.wire.problem import BYTES_MAX
from app.wire.question import JSON

# What a call is asked -> the place and the sentence of its refusal.
SENTENCES = {
    "collision-time?pich=1": 'pich: "pich" is unknown here: did you mean pitch?',
    "collision-time?entry_radus=1": 'entry_radus: "entry_radus" is unknown here: leave it out',
    "collision-time?turning_diameters=1": 'turning_diameters: "turning_diameters" is unknown here: leave it out',
    "minimum-pitch?turning_diameters=1": (
        'turning_diameters: "turning_diameters" is unknown here: did you mean turning_diameter?'
    ),
    "turn?entry_radus=1": 'entry_radus: "entry_radus" is unknown here: did you mean entry_radius?',
    "turn?head_sped=1": 'head_sped: "head_sped" is unknown here: leave it out',
    "collision-time?start=1": 'start: "start" is unknown here: leave it out',
    "collision-time?pitch=55cm": (
        'pitch: pitch must be a number [m], got "55cm": lengths are in metres, and 55 cm is 0.55 m'
    ),
    "collision-time?width=27.5 cm": (
        'width: width must be a number [m], got "27.5 cm": lengths are in metres, and 27.5 cm is 0.275 m'
    ),
    "collision-time?head_speed=55cm": 'head_speed: head_speed must be a number [m/s], got "55cm"',
    "collision-time?pitch=55in": 'pitch: pitch must be a number [m], got "55in"',
    f"collision-time?pitch={'0' * 3000}55": (
        "pitch: pitch must be at most 10 m, got 55 m: lengths are in metres, and 55 cm is 0.55 m"
    ),
    "collision-time?head_speed=100": (
        "head_speed: head_speed must be at most 20 m/s, got 100 m/s: speeds are in metres per second"
    ),
    "collision-time?pitch=5500": "pitch: pitch must be at most 10 m, got 5500 m: lengths are in metres",
    "collision-time?head_speed=0": "head_speed: head_speed must be at least 0.001 m/s, got 0 m/s",
    f"collision-time?benches={'x' * 100}": (
        f'benches: benches must be a whole number, got "{"x" * 59}... (102 characters)'
    ),
    "collision-time?cross_check=everybody": (
        'cross_check: cross_check must be "dragon", "pair" or "none", got "everybody"'
    ),
    'trajectory {"path": {"pitch": NaN}}': "/path/pitch: pitch must be a finite number [m], got NaN",
    'trajectory {"path": {"pitch": Infinity}}': "/path/pitch: pitch must be a finite number [m], got Infinity",
    'trajectory {"path": {"pitch": -Infinity}}': "/path/pitch: pitch must be a finite number [m], got -Infinity",
    'trajectory {"head_speed": "1"}': '/head_speed: head_speed must be a number [m/s], got "1"',
    'trajectory {"a/b~c": 1}': '/a~1b~0c: "a/b~c" is unknown here: leave it out',
    'trajectory {"time": {}}': '/time: "time" is unknown here: did you mean times?',
    'trajectory {"times": {"stpo": 4}}': '/times/stpo: "stpo" is unknown here: did you mean stop?',
    'turn {"pitch": 1.7}': '/pitch: "pitch" is unknown here: it belongs in path',
    'check {"coordinates": "degrees", "venue": {"type": "Polygon", "coordinates": '
    "[[[120, 95], [121, 95], [121, 96], [120, 95]]]}}": (
        "/venue/coordinates/0/0/1: venue.coordinates[0][0][1] must be at most 90 degrees, got 95 degrees"
    ),
    'check {"times": {}}': '/times: "times" is unknown here: leave it out',
    'check {"path": {"kind": "turn", "entry_radus": 4}}': (
        '/path/entry_radus: "entry_radus" is unknown here: did you mean entry_radius?'
    ),
    'check {"path": {"entry_radus": 4}}': '/path/entry_radus: "entry_radus" is unknown here: leave it out',
    'check {"dragon": {"lengths": [1], "widths": [1], "overhangs": [0], "width": 1}}': (
        '/dragon/width: "width" is unknown here: did you mean widths?'
    ),
    'check {"dragon": {"widhts": 1}}': '/dragon/widhts: "widhts" is unknown here: did you mean width?',
    'check {"path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [1, 0], "stat": 0}]}}': (
        '/path/pieces/0/stat: "stat" is unknown here: did you mean start?'
    ),
    'check {"path": {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [1, 0], "pich": 0}]}}': (
        '/path/pieces/0/pich: "pich" is unknown here: leave it out'
    ),
    'overlaps {"benches": [{"x": 0, "y": 0, "heading": 0, "length": 1, "width": 1, "hedding": 1}]}': (
        '/benches/0/hedding: "hedding" is unknown here: did you mean heading?'
    ),
}


@pytest.mark.parametrize("request_", SENTENCES, ids=lambda one: one[:40])
def test_a_refusal_tells_the_value_the_unit_the_limit_and_what_to_change_from_its_own_place(client, request_):
    call, has_body, rest = request_.partition(" {")
    body = {"content": f"{{{rest}", "headers": {"Content-Type": JSON}} if has_body else {}
    answer = client.request("POST" if body else "GET", f"/{call}", **body)
    assert answer.status_code == 422
    errors = answer.json()["errors"]
    assert [f"{one.get('pointer') or one['name']}: {one['detail']}" for one in errors] == [SENTENCES[request_]]


def test_a_refusal_of_too_many_parameters_speaks_of_no_body(ask):
    answer = ask.send("turn?" + "&".join(f"n{k}=1" for k in range(150)))
    assert answer.status_code == 422
    assert "body" not in answer.text


def test_a_name_has_the_same_unit_in_all_requests():
    """Sentences take the unit from the name, whichever requests this process knows; pieces of a path and entries of a
    list say whose they are."""
    for room in walk_packages(app.__path__, "app."):
        if room.name != "app.sweeps.cluster":
            import_module(room.name)
    units = {}
    for model, before in owners().items():
        for name, field in {} if before else model.model_fields.items():
            units.setdefault(name, set()).add(extra_of(field, "unit"))
    assert {name: result for name, result in units.items() if len(result) > 1} == {}


@pytest.mark.parametrize("text", ["龙" * 500, "\x01" * 300, '"\\' * 300, "{field}"])
def test_a_problem_stays_short_whatever_its_values_hold(ask, text):
    answer = ask.send("trajectory", {f"{k}{text}": 1 for k in range(50)})
    assert answer.status_code == 422
    assert len(answer.content) <= BYTES_MAX
    assert answer.json()["errors"]


def test_a_body_that_cannot_be_read_has_a_template_of_its_own(client):
    problem = client.post("/check", content=b'{"a": 1,}', headers={"Content-Type": JSON}).json()
    assert problem["template"] == "{text} is not JSON"
    assert problem["reason"] == "{why} at character {place}. Send an object such as {}."
    assert problem["values"]["text"]["text"] == "The body"
    assert problem["errors"][0]["pointer"] == ""
