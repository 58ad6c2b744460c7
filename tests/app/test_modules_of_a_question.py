"""How many modules of ours a question goes through: fewer are quicker to read, and to answer."""

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
    "core.tolerance.stray",
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
