"""The door for assistants, through the client of the SDK: over the standard streams and over HTTP."""

from __future__ import annotations

import base64
import json
import os
import socket
import subprocess
import time
from collections.abc import Awaitable, Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import anyio
import httpx
import pytest
from mcp import Client, MCPError, StdioServerParameters

from app.assistant.guide import PAGES
from app.wire.question import BYTES
from tests.support.command import ROOT, bin_folder
from tests.support.serving import free_port

COMMAND = str(bin_folder() / "bench-dragon")
WORKBOOK = ROOT / "tests" / "reference" / "libreoffice" / "result1.xlsx"
PNG = b"\x89PNG"
PATIENCE = 120.0  # [s]
TOKEN = "a token of this test"

LANE = {"kind": "waypoints", "points": [[30, -30], [30, 30]]}

Calls = Callable[[Client], Awaitable[Any]]


def with_client(server: Any, work: Calls) -> Any:
    async def run() -> Any:
        async with Client(server, read_timeout_seconds=PATIENCE) as client:
            return await work(client)

    with ThreadPoolExecutor(1) as thread:  # in this one the event loop of a browser may run
        return thread.submit(anyio.run, run).result()


def with_door(work: Calls, *options: str, **environment: str) -> Any:
    """Result of work with a client of the command, in its own process."""
    settings = dict(os.environ) | environment
    return with_client(StdioServerParameters(command=COMMAND, args=["mcp", *options], env=settings), work)


def problem_of(result: Any) -> dict[str, Any]:
    assert result.is_error
    problem: dict[str, Any] = result.structured_content
    assert json.loads(result.content[0].text) == problem
    return problem


@contextmanager
def http_door(log: Path, *options: str, **environment: str) -> Iterator[str]:
    """Address of the command over HTTP."""
    port = free_port()
    with log.open("wb") as output:
        words = [COMMAND, "mcp", "--port", str(port), *options]
        process = subprocess.Popen(words, env=dict(os.environ) | environment, stdout=output, stderr=output)
    try:
        while True:
            try:
                socket.create_connection(("127.0.0.1", port)).close()
                break
            except ConnectionRefusedError:
                assert process.poll() is None, log.read_text()
                time.sleep(0.1)
        yield f"http://127.0.0.1:{port}/mcp"
    finally:
        process.terminate()
        process.wait(PATIENCE)


def test_an_assistant_asks_grades_and_looks(client: httpx.Client, tmp_path: Path) -> None:
    """ "When do two benches first touch at a pitch of 0.5 m?", "grade this workbook", and wrong units and sizes."""
    (tmp_path / "mine.xlsx").write_bytes(WORKBOOK.read_bytes())
    outside = tmp_path.parent / "outside.xlsx"
    outside.write_bytes(b"secret")

    file: dict[str, Any] = {"content": WORKBOOK.read_bytes(), "headers": {"Content-Type": BYTES}}
    graded = client.post("/grade?language=en", **file).raise_for_status().json()

    async def work(door: Client) -> None:
        contact = await door.call_tool("collision_time", {"pitch": 0.5})
        assert not contact.is_error
        assert contact.structured_content == client.get("/collision-time?pitch=0.5").json()
        assert json.loads(contact.content[0].text) == contact.structured_content
        route = {"kind": "route", "pieces": [{"kind": "line", "start": [0, 0], "end": [60, 0]}]}
        places = await door.call_tool("trajectory", {"dragon": {"benches": 3}, "path": route, "times": [20]})
        assert len(places.structured_content["x"][0]) == 4
        crossing = {"dances": [{"dragon": {"benches": 3}, "path": path} for path in (route, LANE)]}
        verdict = await door.call_tool("check", crossing)
        assert verdict.structured_content == client.post("/check", json=crossing).json()
        assert verdict.structured_content["failures"][0]["dragons"] == [0, 1]

        by_name = await door.call_tool("grade", {"file": "mine.xlsx", "language": "en"})
        by_content = await door.call_tool(
            "grade", {"content": base64.b64encode(WORKBOOK.read_bytes()).decode(), "language": "en"}
        )
        (of_path,), (of_content,) = (result.structured_content["files"] for result in (by_name, by_content))
        assert of_content == graded["files"][0]
        assert of_path | {"file": of_content["file"]} == of_content

        (picture,) = (await door.call_tool("contact_figure", {"benches": 20})).content
        assert (picture.type, picture.mime_type) == ("image", "image/png")
        assert base64.b64decode(picture.data).startswith(PNG)

        beside = problem_of(await door.call_tool("check", crossing | {"head_speed": 1}))
        assert beside["detail"] == "head_speed must stand in each of the dances, got it beside them"
        centimetres = problem_of(await door.call_tool("collision_time", {"pitch": 55}))
        assert "must be at most 10 m, got 55 m" in centimetres["detail"]
        many = problem_of(await door.call_tool("collision_time", {"benches": 10**9}))
        assert "benches must be at most" in many["detail"]
        unknown = problem_of(await door.call_tool("collision_time", {"pitsch": 1}))
        assert "pitsch" in unknown["detail"]
        large = problem_of(await door.call_tool("trajectory", {}))
        assert large["detail"].startswith("The answer must have at most 100000 characters, got ")

        for name in ("../outside.xlsx", str(outside), "no.xlsx"):
            assert name in problem_of(await door.call_tool("grade", {"file": name}))["detail"]
        neither = problem_of(await door.call_tool("grade", {}))
        assert neither["detail"] == "file or content must be given, and not both."
        for content in ("?", "龙"):
            assert "base64" in problem_of(await door.call_tool("places", {"content": content}))["detail"]
        for name in (".", "a\0b"):
            assert problem_of(await door.call_tool("grade", {"file": name}))["status"] == 404
        for job in ("../healthz", "?", "a/b"):
            assert problem_of(await door.call_tool("job_status", {"job_id": job}))["status"] in (404, 422)
        with pytest.raises(MCPError, match="nothing is no tool of this door; it has trajectory, collision_time"):
            await door.call_tool("nothing", {})

    with_door(work, "--folder", str(tmp_path))


def test_every_question_is_a_tool(client: httpx.Client) -> None:
    """Under its operation id, with the schema of its query or of its body; the twins with a body when wanted."""
    description = client.get("/openapi.json").json()
    calls = {
        operation["operationId"]: operation for path in description["paths"].values() for operation in path.values()
    }
    questions = {name for name, operation in calls.items() if operation["tags"][0] not in ("Jobs", "Service")}

    async def tools(door: Client) -> dict[str, Any]:
        return {tool.name: tool.input_schema for tool in (await door.list_tools()).tools}

    some, every = with_door(tools), with_door(tools, "--twins")
    assert questions <= every.keys()
    assert some.keys() == {name for name in every if not (name.endswith("_of") and name.removesuffix("_of") in every)}
    flat = {parameter["name"] for parameter in calls["collision_time"]["parameters"]}
    assert set(some["collision_time"]["properties"]) == flat
    assert some["collision_time"]["properties"]["pitch"]["maximum"] == 10
    assert "[m]" in some["collision_time"]["properties"]["pitch"]["description"]
    assert set(some["check"]["properties"]) == set(description["components"]["schemas"]["CheckRequest"]["properties"])
    text = json.dumps(every)
    assert "#/components" not in text
    for schema in every.values():
        for name in {word.split('"')[0] for word in json.dumps(schema).split("#/$defs/")[1:]}:
            assert name in schema["$defs"]


def test_without_a_folder_no_file_is_read() -> None:
    refused = problem_of(with_door(lambda door: door.call_tool("grade", {"file": "/etc/hostname"})))
    assert (refused["status"], refused["detail"]) == (
        403,
        "file must be left out: this door reads no files; give the content.",
    )


def test_a_door_of_a_service_with_named_hosts_answers() -> None:
    contact = with_door(lambda door: door.call_tool("collision_time", {}), BENCH_DRAGON_HOSTS="dance.example,[::1]")
    assert contact.structured_content["benches"] == [0, 8]


def test_over_http_the_token_is_that_of_the_assistant(tmp_path: Path) -> None:
    """Over the standard streams it is that of the process, which whoever started it may use."""
    grading = {"content": base64.b64encode(WORKBOOK.read_bytes()).decode()}
    settings = {"BENCH_DRAGON_TOKEN": TOKEN}
    with http_door(tmp_path / "log", **settings) as address:
        contact = with_client(address, lambda door: door.call_tool("collision_time", {"pitch": 0.5}))
        assert contact.structured_content["benches"] == [0, 14]
        refused = problem_of(with_client(address, lambda door: door.call_tool("grade", grading)))
        assert (refused["status"], refused["title"]) == (401, "Unauthorized")
    assert not with_door(lambda door: door.call_tool("grade", grading), **settings).is_error


def test_the_pages_of_the_guide_are_resources() -> None:
    """Where the guide is installed; elsewhere there are none."""

    async def pages(door: Client) -> dict[str, str]:
        listed = (await door.list_resources()).resources
        with pytest.raises(MCPError, match="no page of the guide"):
            await door.read_resource("bench-dragon://guide/../../pyproject")
        return {one.name: (await door.read_resource(str(one.uri))).contents[0].text for one in listed}

    assert with_door(pages) == {path.stem: path.read_text("utf-8") for path in PAGES.glob("*.md")}


def test_wrong_options_are_one_line(tmp_path: Path) -> None:
    file = tmp_path / "a"
    file.write_text("")
    for options, message in [
        (["--port", "99999"], "--port must be from 0 to 65535, got 99999"),
        (["--folder", str(file)], f"--folder must be a folder, got {file}"),
        (["--folder", ""], "--folder must not be an empty name: the current folder is ."),
    ]:
        done = subprocess.run([COMMAND, "mcp", *options], capture_output=True, text=True, timeout=PATIENCE)
        assert (done.returncode, done.stdout, done.stderr) == (2, "", f"Error: {message}\n")
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = str(taken.getsockname()[1])
        done = subprocess.run([COMMAND, "mcp", "--port", port], capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 2
    assert "address already in use" in done.stderr
    assert "Traceback" not in done.stderr
