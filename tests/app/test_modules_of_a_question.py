"""Number of our modules that a question uses, and of classes that hold a contact: fewer are easier to read."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
# Asks the service in this process, and gives every call and return of a function to note(), in every thread.
ASKED = """
import asyncio, sys, threading, types, httpx
from app.service.main import create_app

seen = {{}}

def ours(name):
    return name.partition(".")[0] in ("app", "core")

{noted}

async def ask():
    transport = httpx.ASGITransport(create_app())
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        (await client.get(sys.argv[1] + "0.551")).raise_for_status()
        seen.clear()
        sys.setprofile(note)
        answer = await client.get(sys.argv[1] + "0.552")
        sys.setprofile(None)
    return answer.raise_for_status().json()

threading.setprofile(note)
answer = asyncio.run(ask())
print(*sorted({told}))
"""
# Every module of ours.
COUNTED = """
def note(frame, event, argument):
    module = frame.f_globals.get("__name__", "")
    if event == "call" and ours(module) and frame.f_code.co_filename[0] != "<":
        seen[module] = True
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

def note(frame, event, argument):
    if event == "return" and ours(frame.f_globals.get("__name__", "")):
        values = [argument, frame.f_locals.get("self"), *(argument if type(argument) is tuple else ())]
        values += [inner for one in values if ours(type(one).__module__) for inner in held(one).values()]
        for value in values:
            if ours(type(value).__module__):
                name = f"{type(value).__module__}.{type(value).__qualname__}"
                seen.setdefault(name, set()).update(pairs(value))
"""
# The classes that hold the pair in contact.
HOLDING = "name for name, known in seen.items() if tuple(answer['benches']) in known"
# What every request passes; the question's own file; the fields of its query; and how it is told, under any load.
EDGE = {
    "app.questions.collision_time",
    "app.questions.question",
    "app.service.load",
    "app.service.middleware",
    "app.service.reply",
    "app.wire.models",
}
# What is asked about, checked and within a budget; and the search, with its claim in words.
SEARCH = {
    "core.budget",
    "core.contact.first_contact",
    "core.contact.search",
    "core.dance",
    "core.errors",
    "core.paths.spiral",
}
# Where everyone is just before and after, and the four engines.
CROSS_CHECK = {
    "core.contact.cross_check",
    "core.motion.trajectory",
    "core.shapes.engines",
    "core.shapes.rectangles",
}


def seen_while_asking(noted: str, told: str, query: str) -> set[str]:
    source = ASKED.format(noted=noted, told=told)
    return set(subprocess.check_output([sys.executable, "-c", source, query], cwd=ROOT, text=True).split())


@pytest.mark.parametrize(("asked", "passed"), [("none", EDGE | SEARCH), ("dragon", EDGE | SEARCH | CROSS_CHECK)])
def test_a_collision_time_goes_through_no_other_modules(asked: str, passed: set[str]) -> None:
    assert seen_while_asking(COUNTED, "seen", f"/collision-time?cross_check={asked}&pitch=") == passed


def test_a_contact_has_three_representations_of_a_march_of_core_and_of_the_answer() -> None:
    assert seen_while_asking(REPRESENTED, HOLDING, "/collision-time?cross_check=dragon&pitch=") == {
        "core.kernels.results.Marched",
        "core.contact.answer.FirstContact",
        "app.questions.collision_time.CollisionTime",
    }
