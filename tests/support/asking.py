"""What tests ask of a running service: the JSON of an answer, and where and with which values it refuses."""

import json
from dataclasses import asdict, is_dataclass
from enum import Enum

import numpy as np

from app.wire.problem import PROBLEM_TYPE


def assert_problem(answer, status, expected=None):
    """The answer is a problem of this status.

    expected: place of its first error, a JSON pointer or a name, then words and numbers that its sentence holds
    """
    assert answer.status_code == status, answer.text
    assert answer.headers["content-type"] == PROBLEM_TYPE
    assert answer.headers["cache-control"] == "no-store"
    problem = answer.json()
    assert problem["type"].startswith("urn:problem-type:bench-dragon:")
    assert (problem["status"], bool(problem["title"]), "Traceback" in answer.text) == (status, True, False)
    if expected is not None:
        place, _, words = expected.partition(" ")
        error = problem["errors"][0]
        assert error.get("pointer", error.get("name")) == place, error["detail"]
        assert [word for word in words.split() if word not in error["detail"]] == [], error["detail"]
        assert problem["detail"].startswith(error["detail"][:200])


class Asking:
    """The calls of a service.

    call: path without its first slash, also with a query; body: sent by POST, None for GET; query: its parameters
    """

    def __init__(self, client):
        self.client = client

    def send(self, call, body=None, accept="*/*", **query):
        method = "GET" if body is None else "POST"
        return self.client.request(method, f"/{call}", params=query or None, json=body, headers={"Accept": accept})

    def __call__(self, call, body=None, **query):
        """The JSON of an answer."""
        return self.send(call, body, **query).raise_for_status().json()

    def file(self, call, body=None, accept="*/*", **query):
        """The bytes of an answer."""
        return self.send(call, body, accept, **query).raise_for_status().content

    def refuses(self, expected, call, body=None, **query):
        """Assert that it refuses. expected: as for assert_problem()"""
        assert_problem(self.send(call, body, **query), 422, expected)


def json_like(value):
    """A value of core as JSON has it."""
    if is_dataclass(value) and not isinstance(value, type):
        value = asdict(value)
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, dict):
        return {name: json_like(part) for name, part in value.items()}
    if isinstance(value, tuple | list):
        return [json_like(part) for part in value]
    return value.value if isinstance(value, Enum) else value


def assert_motion(answer, motion):
    """Places and speeds of an answer are those of core."""
    assert np.stack([answer["x"], answer["y"]], axis=-1).tolist() == motion.position.tolist()
    assert answer["speed"] == motion.speed.tolist()


def polygon(*rings, name=None):
    """A polygon of GeoJSON; with a name a feature. Rings that are open are closed."""
    closed = [[*map(list, ring), *([] if ring[0] == ring[-1] else [list(ring[0])])] for ring in rings]
    geometry = {"type": "Polygon", "coordinates": closed}
    return geometry if name is None else {"type": "Feature", "properties": {"name": name}, "geometry": geometry}


def box(left, low, right, high, name=None):
    """A rectangle of GeoJSON with sides along the axes."""
    return polygon([(left, low), (right, low), (right, high), (left, high)], name=name)


def line(*points, **more):
    """A path through waypoints."""
    return {"kind": "waypoints", "points": [list(point) for point in points], **more}


def dance(benches, *points, **more):
    """A uniform dragon on a path through waypoints."""
    return {"dragon": {"benches": benches}, "path": line(*points), **more}


def written(folder, body, name="dance.json"):
    """The name of a file with this body, for the command."""
    (folder / name).write_text(json.dumps(body))
    return str(folder / name)
