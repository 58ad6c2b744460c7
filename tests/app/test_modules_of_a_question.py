"""Number of our modules that a question uses, and of classes that hold a contact: fewer are easier to read."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parent.parent.parent
# Asks the service in this process, and gives every call and return of a function to note, in every thread. The first
# request, which imports modules and fills caches, is not noted; the second one asks about another pitch or dragon.
ASKED = """
import asyncio, json, sys, threading, types, httpx
from app.service.main import create_app

seen = {}

def ours(name):
    return name.partition(".")[0] in ("app", "core")

async def ask(first, query, note):
    transport = httpx.ASGITransport(create_app())
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        (await client.get(first)).raise_for_status()
        seen.clear()
        sys.setprofile(note)
        answer = await client.get(query)
        sys.setprofile(None)
    return answer.raise_for_status().json()

def asked(query, note, told):
    threading.setprofile(note)
    answer = asyncio.run(ask("/collision-time?pitch=0.551", "/collision-time?" + query, note))
    return told(answer)
"""
# Every module of ours of which Python code runs; compiled loops are not noted. True if a function runs that is written
# there, false if only constructors run that dataclasses generate, whose file is called <string>.
COUNTED = """
def counted(frame, event, argument):
    module = frame.f_globals.get("__name__", "")
    if event == "call" and ours(module):
        seen[module] = seen.get(module, False) or frame.f_code.co_filename[0] != "<"
"""
# Every class of ours whose objects hold a pair, among all that functions return, that methods belong to, and that these
# hold in turn.
REPRESENTED = """
def held(value):
    kind = type(value)
    found = dict(getattr(value, "__dict__", {}))
    if isinstance(value, tuple):
        found |= zip(getattr(value, "_fields", ()), value)
    for one in kind.__mro__:
        for name, slot in vars(one).items():
            if isinstance(slot, (types.MemberDescriptorType, types.GetSetDescriptorType)) and name[:2] != "__":
                found[name] = getattr(value, name, None)
    return found

def pairs(value):
    fields = held(value)
    listed = [one for one in fields.values() if isinstance(one, (tuple, list)) and len(one) == 2]
    listed.append((fields.get("first"), fields.get("second")))
    return {tuple(one) for one in listed if all(type(k) is int for k in one)}

def represented(frame, event, argument):
    if event == "return" and ours(frame.f_globals.get("__name__", "")):
        values = [argument, frame.f_locals.get("self"), *(argument if type(argument) is tuple else ())]
        values += [inner for one in values if ours(type(one).__module__) for inner in held(one).values()]
        for value in values:
            if ours(type(value).__module__):
                name = f"{type(value).__module__}.{type(value).__qualname__}"
                seen.setdefault(name, set()).update(pairs(value))
"""
# The classes that hold the pair in contact.
HOLDING = """
def holding(answer):
    return [name for name, known in seen.items() if tuple(answer["benches"]) in known]
"""
TOLD = """
found = {
    "none": asked("pitch=0.552&cross_check=none", counted, lambda _: dict(seen)),
    "dragon": asked("pitch=0.553", counted, lambda _: dict(seen)),
    "new dragon": asked("pitch=0.553&width=0.31", counted, lambda _: dict(seen)),
    "near a graze": asked("pitch=0.450337393", counted, lambda _: dict(seen)),
    "represented": asked("pitch=0.554", represented, holding),
}
print(json.dumps(found))
"""
# The question's own file; its lane; what holds for every request; the reply; and the fields of the query.
EDGE = {
    "app.questions.collision_time",
    "app.service.lanes",
    "app.service.middleware",
    "app.service.reply",
    "app.wire.question",
}
# The dance, its checks and the budget; and the search, with its claim in words.
SEARCH = {
    "core.contact.first_contact",
    "core.contact.search",
    "core.dance",
    "core.errors",
    "core.paths.spiral",
}
# The poses just before and after, and the four engines.
CROSS_CHECK = {
    "core.contact.cross_check",
    "core.error_free",
    "core.shapes.engines",
    "core.shapes.rectangles",
}
# A dragon that is not among those kept from the requests before.
NEW_DRAGON = {"core.dragon"}
# A contact so near a graze that doubles do not narrow its bracket: the pair in decimals, on the pieces of the path.
NEAR_GRAZE = {
    "core.contact.decimal_shapes",
    "core.contact.near_graze",
    "core.paths.pieces",
    "core.paths.route",
    "core.sampling",
}
# Modules that contribute only values, made by the constructors of dataclasses.
VALUES = {"core.contact.answer", "core.contact.clearance", "core.paths.frame", "core.paths.path"}
CROSS_CHECK_VALUES = {"core.shapes.overlaps"}


@pytest.fixture(scope="module")
def seen() -> dict[str, Any]:
    """Modules while a question is asked, without and with a cross-check, and classes that hold the contact."""
    source = ASKED + COUNTED + REPRESENTED + HOLDING + TOLD
    return dict(json.loads(subprocess.check_output([sys.executable, "-c", source], cwd=ROOT, text=True)))


@pytest.mark.parametrize(
    ("asked", "passed", "made"),
    [
        ("none", EDGE | SEARCH, VALUES),
        ("dragon", EDGE | SEARCH | CROSS_CHECK, VALUES | CROSS_CHECK_VALUES),
        ("new dragon", EDGE | SEARCH | CROSS_CHECK | NEW_DRAGON, VALUES | CROSS_CHECK_VALUES),
        ("near a graze", EDGE | SEARCH | CROSS_CHECK | NEAR_GRAZE, VALUES | CROSS_CHECK_VALUES),
    ],
    ids=["none", "dragon", "new dragon", "near a graze"],
)
def test_a_collision_time_goes_through_no_other_modules(
    seen: dict[str, Any], asked: str, passed: set[str], made: set[str]
) -> None:
    assert {module for module, written in seen[asked].items() if written} == passed
    assert {module for module, written in seen[asked].items() if not written} == made


def test_a_contact_has_three_representations_of_a_march_of_core_and_of_the_answer(seen: dict[str, Any]) -> None:
    assert set(seen["represented"]) == {
        "core.kernels.results.Marched",
        "core.contact.answer.FirstContact",
        "app.questions.collision_time.CollisionTime",
    }
