"""The door for assistants, through the client of the SDK: over the standard streams and over HTTP."""

import base64
import json
import os
import re
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import anyio
import httpx
import pytest

from app.assistant.guide import PAGES
from app.questions.check import CheckRequest
from app.questions.registry import CALLS
from app.wire.question import BYTES, JSON
from tests.support.asking import dance
from tests.support.command import ROOT, bin_folder
from tests.support.largest import THIN
from tests.support.serving import sample, serving

COMMAND = str(bin_folder() / "bench-dragon")
WORKBOOK = ROOT / "tests" / "reference" / "libreoffice" / "result1.xlsx"
PNG = b"\x89PNG"
PATIENCE = 120.0  # [s]
TOKEN = "a token of this test"
BOOK = WORKBOOK.read_bytes()
CONTENT = {"content": base64.b64encode(BOOK).decode()}


def mcp_error():
    from mcp import MCPError

    return MCPError


def with_client(server, work):
    from mcp import Client  # The SDK takes 40 MB.

    async def run():
        async with Client(server, read_timeout_seconds=PATIENCE) as client:
            return await work(client)

    with ThreadPoolExecutor(1) as thread:  # in this one the event loop of a browser may run
        return thread.submit(anyio.run, run).result()


def with_door(work, *options, **environment):
    """Result of work with a client of the command, in its own process."""
    from mcp import StdioServerParameters

    settings = dict(os.environ) | environment
    return with_client(StdioServerParameters(command=COMMAND, args=["mcp", *options], env=settings), work)


def problem_of(result):
    assert result.is_error
    problem = result.structured_content
    assert json.loads(result.content[0].text) == problem
    return problem


CROSSING = {
    "dances": [dance(3, (0, 0), (60, 0)), dance(3, (30, -30), (30, 30))],
}
# A tool with arguments that are refused, and what the refusal must name.
REFUSED = """
check           {"head_speed": 1, "dances": [{}]}   head_speed
collision_time  {"pitch": 55}                       10 m
collision_time  {"benches": 1000000000}             benches
collision_time  {"pitsch": 1}                       pitsch
trajectory      {}                                  100000 characters
grade           {"file": "../outside.xlsx"}         ../outside.xlsx
grade           {"file": "PARENT/outside.xlsx"}     PARENT/outside.xlsx
grade           {"file": "no.xlsx"}                 no.xlsx
grade           {"file": "."}                       404
grade           {"file": "a\\u0000b"}                404
grade           {}                                  file or content
places          {"content": "?"}                    base64
places          {"content": "龙"}                   base64
job_status      {"job_id": "../healthz"}            404
job_status      {"job_id": "?"}                     404
"""


def test_an_assistant_asks_grades_and_looks(client, tmp_path):
    """ "When do two benches first touch at a pitch of 0.5 m?", "grade this workbook", and wrong units and sizes."""
    (tmp_path / "mine.xlsx").write_bytes(BOOK)
    (tmp_path.parent / "outside.xlsx").write_bytes(b"secret")
    file = {"content": BOOK, "headers": {"Content-Type": BYTES}}
    [graded] = client.post("/grade?language=en", **file).json()["files"]

    async def work(door):
        async def answer(tool, **arguments):
            result = await door.call_tool(tool, arguments)
            assert not result.is_error
            assert json.loads(result.content[0].text) == result.structured_content
            return result.structured_content

        assert await answer("collision_time", pitch=0.5) == client.get("/collision-time?pitch=0.5").json()
        assert await answer("check", **CROSSING) == client.post("/check", json=CROSSING).json()
        assert (await answer("grade", language="en", **CONTENT))["files"] == [graded]
        [by_name] = (await answer("grade", language="en", file="mine.xlsx"))["files"]
        assert by_name | {"file": graded["file"]} == graded
        (picture,) = (await door.call_tool("contact_figure", {"benches": 20})).content
        assert picture.type == "image"
        assert picture.mime_type == "image/png"
        assert base64.b64decode(picture.data).startswith(PNG)
        for row in REFUSED.replace("PARENT", str(tmp_path.parent)).strip().splitlines():
            tool, arguments, words = re.split(" {2,}", row)
            problem = problem_of(await door.call_tool(tool, json.loads(arguments)))
            assert words in f"{problem['status']} {problem['detail']}", row
        with pytest.raises(mcp_error(), match="nothing is no tool of this door; it has trajectory, collision_time"):
            await door.call_tool("nothing", {})

    with_door(work, "--folder", str(tmp_path))


def test_every_question_is_a_tool(client):
    """Under its operation id, with the schema of its query or of its body; the twins with a body when wanted."""
    paths = client.get("/openapi.json").json()["paths"].values()
    calls = {each["operationId"]: each for path in paths for each in path.values()}

    async def tools(door):
        return {tool.name: tool.input_schema for tool in (await door.list_tools()).tools}

    some = with_door(tools)
    every = with_door(tools, "--twins")
    assert CALLS.keys() | {"grade", "places"} <= every.keys()
    assert some.keys() == {name for name in every if not (name.endswith("_of") and name.removesuffix("_of") in every)}
    flat = some["collision_time"]["properties"]
    assert flat.keys() == {parameter["name"] for parameter in calls["collision_time"]["parameters"]}
    assert flat["pitch"]["maximum"] == 10
    assert "[m]" in flat["pitch"]["description"]
    assert some["check"]["properties"].keys() == CheckRequest.model_fields.keys()
    for schema in every.values():
        text = json.dumps(schema)
        assert "#/components" not in text
        assert set(re.findall(r"#/\$defs/(\w+)", text)) <= schema.get("$defs", {}).keys()


def test_over_http_the_token_is_that_of_the_assistant(tmp_path):
    """Over the standard streams it is that of the process, which whoever started it may use."""
    with serving(tmp_path / "log", token=TOKEN) as service:
        address = f"{service.url}/mcp"
        contact = with_client(address, lambda door: door.call_tool("collision_time", {"pitch": 0.5}))
        assert contact.structured_content["benches"] == [0, 14]
        refused = problem_of(with_client(address, lambda door: door.call_tool("grade", CONTENT)))
        assert refused["status"] == 401
        assert sample(service.url, 'bench_dragon_requests_total{path="/grade",status="401"}') == 1.0
    assert not with_door(lambda door: door.call_tool("grade", CONTENT), BENCH_DRAGON_TOKEN=TOKEN).is_error


# A message, and the status and code of its answer.
MESSAGES = [
    ({}, 400, -32602),
    ({"method": "tools/call", "params": {"name": "turn", "arguments": []}}, 200, -32602),
    ({"method": "tools/call", "params": {"name": "nothing"}}, 200, -32602),
    ({"method": "nothing"}, 200, -32601),
]


@pytest.mark.parametrize("message, status, code", MESSAGES)
def test_a_message_that_asks_for_nothing_has_an_error_of_the_protocol(client, message, status, code):
    response = client.post("/mcp", json={"jsonrpc": "2.0", "id": 1, **message}, headers={"Accept": JSON})
    assert response.status_code == status
    assert response.json()["error"]["code"] == code


def test_the_edge_refuses_a_message_as_any_other_request(client):
    call = {"method": "tools/call", "params": {"name": "turn", "arguments": {"x": [0] * 200_000}}}
    assert client.post("/mcp", json=call).json()["values"]["most"]["value"] == 200_000
    assert client.post("/mcp", content=b"{}").status_code == 415
    assert client.get("/mcp").headers["Allow"] == "OPTIONS, POST"


def test_a_computation_ends_with_the_assistant_that_asked_for_it(tmp_path):
    call = {"jsonrpc": "2.0", "id": 1, "method": "tools/call"}
    call["params"] = {"name": "minimum_pitch", "arguments": THIN}
    with serving(tmp_path / "log") as service:
        with suppress(httpx.ReadTimeout):
            httpx.post(f"{service.url}/mcp", json=call, timeout=1.0, headers={"Accept": JSON})
        while not sample(service.url, 'bench_dragon_stopped_total{reason="client gone"}'):
            assert not sample(service.url, 'bench_dragon_stopped_total{reason="deadline"}')
            time.sleep(0.05)
    assert "Traceback" not in service.log.read_text()


def test_a_door_without_a_folder_reads_no_file_and_has_the_pages_of_the_guide():
    """The pages where the guide is installed; elsewhere there are none. Names of hosts are for HTTP alone."""

    async def work(door):
        assert (await door.call_tool("collision_time", {})).structured_content["benches"] == [0, 8]
        refused = problem_of(await door.call_tool("grade", {"file": "/etc/hostname"}))
        assert refused["status"] == 403
        assert "content" in refused["detail"]
        with pytest.raises(mcp_error(), match="no page of the guide"):
            await door.read_resource("bench-dragon://guide/../../pyproject")
        listed = (await door.list_resources()).resources
        return {page.name: (await door.read_resource(str(page.uri))).contents[0].text for page in listed}

    pages = with_door(work, BENCH_DRAGON_HOSTS="dance.example,[::1]")
    assert pages == {path.stem: path.read_text("utf-8") for path in PAGES.glob("*.md")}
