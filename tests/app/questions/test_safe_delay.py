"""Safe delays of one dragon, over HTTP and from a terminal."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import httpx
import pytest

from app.maps.dances import read_dance
from app.questions.safe_delay import SafeDelayRequest
from app.settings import Settings
from core import safe_delay
from tests.support.command import run

EXAMPLE = Path(__file__).parents[3] / "examples" / "crossing_streets.toml"


def street(*points: list[float], benches: int = 5) -> dict[str, Any]:
    return {"dragon": {"benches": benches}, "path": {"kind": "waypoints", "points": list(points)}}


CROSSING: dict[str, Any] = {
    "dances": [street([-20, 0], [20, 0]) | {"name": "east"}, street([0, -20], [0, 20]) | {"name": "3"}],
    "least": -60,
    "most": 60,
}


def ask(client: httpx.Client, body: dict[str, Any]) -> Any:
    return client.post("/safe-delay", json=body).raise_for_status().json()


def test_the_delays_are_those_of_core_and_two_dragons_meet_at_others_alone(client: httpx.Client) -> None:
    got = ask(client, CROSSING | {"margin": 0.2})
    performance = SafeDelayRequest.model_validate(CROSSING).to_performance(Settings())
    result = safe_delay(performance, 1, -60.0, 60.0, margin=0.2)
    assert [tuple(one) for one in got["safe"]] == list(result.safe)
    assert len(result.safe) == 2
    assert (got["part"], got["name"], got["first_safe"], got["undecided"]) == (1, "3", -60.0, [])
    assert (got["least"], got["most"], got["margin"], got["stop"]) == (-60.0, 60.0, 0.2, None)
    assert got["marches"] == result.marches

    def outcome(delay: float) -> Any:
        waiting = [CROSSING["dances"][0], CROSSING["dances"][1] | {"delay": delay}]
        return client.post("/encounter", json={"dances": waiting, "margin": 0.2}).raise_for_status().json()["outcome"]

    (_, before), (after, _) = result.safe
    assert [outcome(delay) for delay in (before, after)] == ["clear", "clear"]
    assert [outcome(delay) for delay in (before + 0.02, 0.0, after - 0.02)] == ["contact"] * 3


def test_a_dragon_is_named_by_its_number_or_its_name(client: httpx.Client) -> None:
    second = ask(client, CROSSING)
    assert ask(client, CROSSING | {"part": "3"}) == ask(client, CROSSING | {"part": 1}) == second
    first = ask(client, CROSSING | {"part": "east"})
    assert (first["part"], first) == (0, ask(client, CROSSING | {"part": 0.0}))
    unnamed = [street([-20, 0], [20, 0]), street([0, -20], [0, 20])]
    assert ask(client, CROSSING | {"dances": unnamed, "part": "1"})["safe"] == second["safe"]


def test_a_way_that_is_never_free_has_no_safe_delay(client: httpx.Client) -> None:
    # The first procession ends on the crossing and stands there.
    blocked = [street([-20, 0], [2, 0]), street([0, -20], [0, 20])]
    got = ask(client, {"dances": blocked, "least": 20, "most": 90})
    assert (got["safe"], got["first_safe"], got["undecided"]) == ([], None, [])


WRONG: dict[str, tuple[dict[str, Any], str, str]] = {
    "no dance": ({"dances": []}, "/dances", "dances must have at least 1 entry"),
    "another number": (CROSSING | {"part": 2}, "/part", "part must be a dragon's name, or its number below 2, got 2"),
    "another name": (CROSSING | {"part": "west"}, "/part", "part must be a dragon's name, or its number below 2, got"),
    "no name": (CROSSING | {"part": True}, "/part", "part must be the number of a dragon, in the order of the dances"),
    "half a number": (CROSSING | {"part": 0.5}, "/part", "part must be the number of a dragon, in the order of the da"),
    "the longest first": (CROSSING | {"least": 60}, "/most", "most must be more than least (60 s), got 60 s"),
    "a delay of 1e9": (CROSSING | {"most": 1e9}, "/most", "most must be at most 1000000 s, got 1000000000"),
    "a fold": (
        {"dances": [{}, street([20, -20], [20, 20])]},
        "/stop",
        "stop must be given, before 432.917924 s, when ",
    ),
}


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_value_is_refused_at_its_place(client: httpx.Client, name: str) -> None:
    body, pointer, words = WRONG[name]
    refused = client.post("/safe-delay", json=body)
    assert refused.status_code == 422
    error = refused.json()["errors"][0]
    assert error["pointer"] == pointer
    assert error["detail"].startswith(words)


def test_the_command_says_what_the_service_says(client: httpx.Client, tmp_path: Path) -> None:
    body = read_dance(EXAMPLE, several=True)
    output = run("safe-delay", str(EXAMPLE), "--part", "0", "--margin", "0.3", "--least=-100", "--json")
    request = body | {"part": 0, "margin": 0.3, "least": -100}
    assert output.stdout.encode() == client.post("/safe-delay", json=request).content + b"\n"
    known = ask(client, body)
    lines = run("safe-delay", str(EXAMPLE), "--part", "north").stdout.splitlines()
    assert lines[0].strip() == "Safe delays of north from 0 to 600 s:"
    low, high = map(float, lines[-1 if lines[-1].strip() else -2].split())
    ((first, last),) = known["safe"]
    assert first <= low <= first + 1e-6  # [s]
    assert last - 1e-6 <= high <= last
    file = tmp_path / "blocked.json"
    file.write_text(json.dumps({"dances": [street([-20, 0], [2, 0]), street([0, -20], [0, 20])]}))
    none = run("safe-delay", str(file), "--least", "20", "--most", "90")
    assert none.stdout.strip() == "No delay of dragon 1 from 20 to 90 s is known to be safe."
