"""How many modules of ours a question goes through, and how many classes hold a contact: fewer are easier to read."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent.parent
# Asks the service in this process, every call of a function of ours counted in every thread.
COUNTED = """
import asyncio, sys, threading, httpx
from app.service.main import create_app

seen = set()

def note(frame, event, argument):
    module = frame.f_globals.get("__name__", "")
    if event == "call" and module.partition(".")[0] in ("app", "core") and frame.f_code.co_filename[0] != "<":
        seen.add(module)

async def ask():
    transport = httpx.ASGITransport(create_app())
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        (await client.get(sys.argv[1] + "0.551")).raise_for_status()
        seen.clear()
        sys.setprofile(note)
        (await client.get(sys.argv[1] + "0.552")).raise_for_status()
        sys.setprofile(None)

threading.setprofile(note)
asyncio.run(ask())
print(*sorted(seen))
"""
# Asks it again, and notes every class of ours whose objects hold the pair in contact, among all that functions return,
# that methods belong to, and that these hold in turn.
REPRESENTED = """
import asyncio, sys, threading, types, httpx
from app.service.main import create_app

seen = {}

def ours(name):
    return name.partition(".")[0] in ("app", "core")

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

async def ask():
    transport = httpx.ASGITransport(create_app())
    async with httpx.AsyncClient(transport=transport, base_url="http://service") as client:
        (await client.get(sys.argv[1] + "0.551")).raise_for_status()
        seen.clear()
        sys.setprofile(note)
        answer = await client.get(sys.argv[1] + "0.552")
        sys.setprofile(None)
    pair = tuple(answer.json()["benches"])
    print(*sorted(name for name, known in seen.items() if pair in known))

threading.setprofile(note)
asyncio.run(ask())
"""
# What every request passes; the question's own file; the fields of its dance; and how it is told, under any load.
EDGE = {
    "app.questions.collision_time",
    "app.questions.question",
    "app.service.load",
    "app.service.middleware",
    "app.service.reply",
    "app.wire.dances",
    "app.wire.models",
    "app.wire.paths",
}
# What is asked about, checked and within a budget; and the search, with its claim in words.
SEARCH = {
    "core.budget",
    "core.clock",
    "core.contact.claim",
    "core.contact.first_contact",
    "core.contact.fold",
    "core.contact.search",
    "core.dance",
    "core.dragon",
    "core.errors",
    "core.paths.frame",
    "core.paths.spiral",
    "core.sampling",
    "core.values",
}
# Where everyone is just before and after, and the four engines.
CROSS_CHECK = {
    "core.contact.cross_check",
    "core.motion.trajectory",
    "core.shapes.angle_sum",
    "core.shapes.broad_phase",
    "core.shapes.engines",
    "core.shapes.rectangles",
}


@pytest.mark.parametrize(("asked", "passed"), [("none", EDGE | SEARCH), ("dragon", EDGE | SEARCH | CROSS_CHECK)])
def test_a_collision_time_goes_through_no_other_modules(asked: str, passed: set[str]) -> None:
    query = f"/collision-time?cross_check={asked}&pitch="
    modules = subprocess.check_output([sys.executable, "-c", COUNTED, query], cwd=ROOT, text=True).split()
    assert set(modules) == passed


def test_a_contact_has_three_representations_of_a_march_of_core_and_of_the_answer() -> None:
    query = "/collision-time?cross_check=dragon&pitch="
    classes = subprocess.check_output([sys.executable, "-c", REPRESENTED, query], cwd=ROOT, text=True).split()
    assert set(classes) == {
        "core.kernels.results.Marched",
        "core.contact.first_contact.FirstContact",
        "app.questions.collision_time.CollisionTime",
    }
