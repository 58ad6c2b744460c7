"""Every question has one answer to the byte: over a query and a body, as a job and from a terminal."""

import pytest

from app.command.main import MODULE_OF
from app.questions.registry import QUESTIONS
from app.service.examples import EXAMPLES
from app.wire.dances import TimeSteps, UniformBody
from app.wire.paths import TurnFields
from tests.support.asking import dance, written
from tests.support.command import said
from tests.support.depth import few

# A value of each parameter of a query that differs from its default and leaves the answer short.
VALUES = {
    "benches": 9,
    "width": 0.25,
    "start_turns": 12,
    "ratio": 1.5,
    "head_speed": 2,
    "turning_diameter": 8.5,
    "margin": 0.05,
    "cross_check": "pair",
    "speed_limit": 1.5,
    "samples": 2,
    "start": 10,
    "stop": 20,
    "step": 5,
    "time": 20,
}
BOTH = {name: question for name, question in QUESTIONS.items() if question.flat and question.body}
TWO = {
    "dances": [
        dance(5, (0, 0), (30, 0), name="east"),
        dance(5, (15, -20), (15, 20), delay=2),
    ]
}
# Each question over a body: its example, and two dances where it takes several.
EXAMPLE_BODIES = {name: example.body for name, example in EXAMPLES.items() if example.body}
BODIES = [
    (question, EXAMPLE_BODIES[at])
    for question in QUESTIONS.values()
    if (at := f"POST {question.path}") in EXAMPLE_BODIES
]
BODIES += [(question, TWO) for question in QUESTIONS.values() if question.several]
# That of turn takes options alone.
COMMANDS = {name: {"proposals": "propose"}.get(name, name.replace("_", "-")) for name in QUESTIONS.keys() - {"turn"}}
BENCHES = {"lengths": [3.41, 2.2, 2.0, 2.2, 1.9, 2.2], "widths": [0.3] * 6, "overhangs": [0.275] * 6}
CROSSING = {"kind": "waypoints", "points": [[0, 0], [30, 0], [36, 5], [30, 10], [24, 5], [24, -20]]}


def label(part):
    return part[0].name + " of several" * (part[1] is TWO) if isinstance(part, tuple) else None


def in_body(question, flat):
    """The body that asks what a query asks."""
    body = {}
    for name, value in flat.items():
        if name in question.body.model_fields:
            body[name] = value
        elif name in UniformBody.model_fields:
            body.setdefault("dragon", {})[name] = value
        elif name in TimeSteps.model_fields:
            body.setdefault("times", {})[name] = value
        else:
            kind = "turn" if issubclass(question.flat, TurnFields) else "spiral"
            body.setdefault("path", {"kind": kind})[name] = value
    return body


def test_only_a_question_without_a_dragon_is_asked_one_way_alone():
    assert [name for name, question in QUESTIONS.items() if question.flat and not question.body] == [
        "paper",
        "contest_answer",
    ]


@pytest.mark.parametrize("question", BOTH.values(), ids=BOTH)
def test_both_ways_of_asking_have_one_answer(client, question):
    flat = {name: VALUES[name] for name in question.flat.model_fields if name in VALUES}
    path = question.path.format(format="svg")
    over_query = client.get(path, params=flat).raise_for_status()
    over_body = client.post(path, json=in_body(question, flat))
    assert over_query.content == over_body.content
    assert over_query.headers["content-type"] == over_body.headers["content-type"]


@pytest.mark.parametrize("question", BOTH.values(), ids=BOTH)
def test_an_empty_body_asks_what_an_empty_query_asks(question):
    flat = question.flat()
    body = question.body()
    shared = question.flat.model_fields.keys() & question.body.model_fields.keys() - {"time"}
    if question.name == "tolerance":  # over a body any dance, to its own end
        shared -= {"turning_diameter"}
    assert {name: getattr(flat, name) for name in shared} == {name: getattr(body, name) for name in shared}


@pytest.mark.parametrize("asked", few(BODIES, 5), ids=label)
def test_a_job_has_the_answer_of_its_call(client, asked):
    path = asked[0].path
    body = asked[1]
    job = client.post(path, json=body, headers={"Prefer": "wait=5, respond-async"})
    assert job.status_code == 202
    assert job.headers["preference-applied"] == "respond-async"
    assert job.json()["processID"].removesuffix("_of") == asked[0].name
    address = job.headers["location"]
    client.get(f"{address}/events").raise_for_status()  # Its events end when it is finished.
    later = client.get(f"{address}/result").raise_for_status()
    at_once = client.post(path, json=body)
    assert later.content == at_once.content
    assert later.headers["content-type"] == at_once.headers["content-type"]


@pytest.mark.parametrize("asked", [one for one in BODIES if COMMANDS.get(one[0].name) in MODULE_OF], ids=label)
def test_a_command_with_a_file_prints_the_answer_of_the_call(ask, tmp_path, asked):
    text = said(COMMANDS[asked[0].name], written(tmp_path, asked[1]), "--json")
    assert text.encode() == ask.file(asked[0].path[1:], asked[1]) + b"\n"


@pytest.mark.parametrize("name", [name for name, question in QUESTIONS.items() if question.several])
def test_several_dances_are_described_beside_one_and_null_stands_for_one(ask, name):
    question = QUESTIONS[name]
    call = question.path[1:]
    operation = ask("openapi.json")["paths"][question.path]["post"]
    schema = operation["responses"]["200"]["content"]["application/json"]["schema"]
    models = [model.__name__ for model in (question.model, question.several) if model]
    assert [one["$ref"].rpartition("/")[2] for one in schema["anyOf"]] == models
    whole = dance(5, (0, 0), (30, 0))
    assert ask.file(call, whole | {"dances": None}) == ask.file(call, whole)
    # The answer is kept by its values, which are the same with a default.
    ask(call, TWO)
    for field in {"dragon", "path", "head_speed", "passages", "beats"} & question.body.model_fields.keys():
        ask.refuses(f"/{field}", call, TWO | {field: question.body().model_dump(mode="json")[field]})


def test_the_first_contact_of_any_dragon_on_any_path_is_that_of_its_check(ask):
    body = EXAMPLE_BODIES["POST /collision-time"]
    answer = ask("collision-time", body)
    assert answer["outcome"] == "contact"
    assert ask("check", body)["first_contact"] == answer
    until = ask("collision-time", body | {"stop": answer["time"] - 9})
    assert until["outcome"] == "clear"
    assert until["end"]["reason"] == "stop"


def test_the_times_of_a_highest_head_speed_are_those_of_the_given_dance(ask):
    """The same stretch of a path has other times at another head speed."""
    body = {"dragon": BENCHES, "path": CROSSING, "speed_limit": 3}
    slow = ask("maximum-head-speed", body | {"start": 20, "stop": 30})
    assert ask("maximum-head-speed", body | {"head_speed": 2, "start": 10, "stop": 15}) == slow


def test_only_what_repeats_itself_may_be_long(ask):
    for call in ("collision-time", "minimum-pitch"):
        ask(call, {"dragon": {"benches": 2_001}, "cross_check": "none"})
    ask.refuses("/dragon/benches 2000", "collision-time", {"dragon": {"benches": 2_001}, "path": {"kind": "turn"}})
    listed = {name: [values[1]] * 2_001 for name, values in BENCHES.items()}
    for call in ("collision-time", "minimum-pitch", "pitch-scan", "shortest-turn", "turn-time", "quickest-turn"):
        ask.refuses("/dragon/lengths", call, {"dragon": listed})
