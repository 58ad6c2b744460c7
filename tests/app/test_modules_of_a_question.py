"""How many modules of ours a question goes through: fewer are quicker to read, and to answer."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

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
        (await client.get("/collision-time?pitch=0.551")).raise_for_status()
        seen.clear()
        sys.setprofile(note)
        (await client.get("/collision-time?pitch=0.552")).raise_for_status()
        sys.setprofile(None)

threading.setprofile(note)
asyncio.run(ask())
print(*sorted(seen))
"""
# Of the edge: what every request passes, the models, dances and paths on the wire, the question's own file, and
# how every question is told, over HTTP or as a job, in its lane and until its deadline, unless its answer is kept.
AT_THE_EDGE = {
    "app.questions.collision_time",
    "app.questions.question",
    "app.service.answers",
    "app.service.lanes",
    "app.service.middleware",
    "app.service.reply",
    "app.service.routes",
    "app.service.watch",
    "app.wire.dances",
    "app.wire.models",
    "app.wire.paths",
}


def test_a_collision_time_goes_through_eleven_modules_of_the_edge() -> None:
    modules = subprocess.check_output([sys.executable, "-c", COUNTED], cwd=ROOT, text=True).split()
    assert "core.contact.search" in modules
    assert {module for module in modules if module.startswith("app")} <= AT_THE_EDGE
