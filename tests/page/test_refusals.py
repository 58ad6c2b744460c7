"""Refusals of the real service in the words of the page: sentences in both languages, with its labels."""

import ast
import asyncio
import io
import json
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import ezdxf
import httpx
import pytest

from app.service.main import create_app
from app.settings import Settings
from app.wire.problem import DETAIL_MAX
from tests.conftest import ROOT
from tests.support.node import chinese_texts, evaluate

pytestmark = pytest.mark.node

# Latin letters that are not a unit, a name or a symbol, outside of quotes.
ENGLISH = re.compile(
    r"(?<![A-Za-z])(?!GeoJSON|HTTP|TOML|JSON|KMZ?|DXF|DWG|ASCII|XML|name|length|width|overhang)[A-Za-z]{3,}"
)
QUOTED = re.compile("“[^”]*”")
# Words that no person should read: names of fields, units in brackets, words for programs.
INSIDE = re.compile(r"[a-z]_[a-z]|\[|\bgot\b|venue|csv|dragon\.\w|path\.\w|POST|header|\bNone\b")
# Requests that the service refuses, one a line: [query], [path, body in JSON], or [path, text of a file in Latin-1].
# Wrong numbers, paths, gates, squares, tables, passages and files, one after another; then several dragons.
REQUESTS = Path(__file__).with_name("wrong_requests.jsonl")
COMB = [[x / 10, x % 2 / 10] for x in range(6000)]


def late():
    """An answer that takes longer than it may: here a moment, while the service gives it ten seconds."""
    transport = httpx.ASGITransport(create_app(Settings(deadline_seconds=0.2)))

    async def late_answer():
        async with httpx.AsyncClient(transport=transport, base_url="http://here") as client:
            return await client.get("/minimum-pitch", params={"benches": 9, "turning_diameter": 0.01})

    # In this thread the loop of Playwright runs.
    with ThreadPoolExecutor() as other:
        return other.submit(asyncio.run, late_answer()).result()


def refusals(server):
    """Refusals of the service, and each of their errors."""
    octets = {"Content-Type": "application/octet-stream"}
    comb = {"type": "Polygon", "coordinates": [[*COMB, [0, 9], [0, 0]]]}
    points = [[0.1 * k, 0] for k in range(1001)], [[-40, 0], [0, 5], [40, 0]]
    ways = ({"path": {"kind": "waypoints", "points": one}} for one in points)
    long = [way | more for way, more in zip(ways, ({}, {"venue": comb}), strict=True)]
    with httpx.Client(base_url=server, timeout=60.0) as client:

        def answered(path, body=None):
            if isinstance(body, str):
                return client.post(path, content=body.encode("latin-1"), headers=octets)
            return client.post(path, json=body) if body is not None else client.get(path)

        answers = [answered(*json.loads(line)) for line in REQUESTS.read_text("utf-8").splitlines()]
        answers += [late(), *(client.post("/check", json=body) for body in long)]
    entries = [answer.json() for answer in answers if answer.status_code >= 400]
    assert len(entries) > len(answers) - 25  # a few of the wrong texts are right for some field
    return list({words["detail"]: words for one in entries for words in (one, *one["errors"])}.values())


@pytest.fixture(scope="module")
def refused(server):
    return refusals(server)


WORDS = """async (refusals, texts) => {
  const [{ refusalIn }, { sayIn, teach }] = await Promise.all(["refusals.js", "text.js"].map(page));
  teach("zh", texts);
  const say = { zh: (...all) => sayIn("zh", ...all), en: (...all) => sayIn("en", ...all) };
  return ["zh", "en"].map((one) => refusals.map((each) => refusalIn(each, one === "zh", say[one]).textContent));
}"""


def test_every_refusal_is_a_sentence_in_both_languages(refused):
    assert len(refused) > 100
    chinese, english = evaluate(WORDS, refused, chinese_texts())
    assert [words for words in chinese if ENGLISH.search(QUOTED.sub("", words)) or not words.endswith("。")] == []
    assert [words for words in english if INSIDE.search(words) or not words.endswith(".")] == []


def test_a_map_of_which_all_is_hidden_is_refused_in_both_languages(server):
    document = ezdxf.new()
    document.layers.add("PLAN").off()
    document.modelspace().add_line((0, 0), (9, 0), dxfattribs={"layer": "PLAN"})
    text = io.StringIO()
    document.write(text)
    place = "<visibility>0</visibility><Point><coordinates>9,48</coordinates></Point>"
    files = text.getvalue(), f"<kml><Placemark>{place}</Placemark></kml>"
    octets = {"Content-Type": "application/octet-stream"}
    problems = [httpx.post(f"{server}/places", content=one.encode(), headers=octets).json() for one in files]
    assert evaluate(WORDS, problems, chinese_texts()) == [
        ["图纸中的图形全部隐藏（1 LINE）：请显示所在的图层。", "文件中的图形全部隐藏：请设为可见。"],
        [
            "All that the drawing holds is hidden: 1 LINE. Show its layers.",
            "All that the file holds is hidden: 1 point. Make it visible.",
        ],
    ]


def test_a_refusal_is_its_template_with_the_values(refused):
    for problem in refused:
        values = problem["values"]

        def fill(text, values=values):
            return re.sub(r"\{(\w+)\}", lambda word: values[word[1]]["text"] if word[1] in values else word[0], text)

        value_in_words = f", got {problem['got']['text']}" if "got" in problem else ""
        whole = (
            fill(problem["template"]) + value_in_words + (f": {fill(problem['reason'])}" if "reason" in problem else "")
        )
        rest = problem["detail"].removeprefix(whole)
        assert not rest or rest.startswith((" (and ", ". Ask for it as a job")) or len(whole) > DETAIL_MAX, problem
        # A template is the same for all values: it holds none of them.
        for value in (*values.values(), *([problem["got"]] if "got" in problem else [])):
            assert "parameter" in value or len(value["text"]) < 4 or value["text"] not in problem["template"], problem


def test_the_page_knows_only_templates_that_the_program_has():
    known = evaluate(
        """async () => {
          const { REASONS, RULES, WHOLE } = await page("words/refusals.js");
          return [REASONS, RULES, WHOLE].flatMap(Object.keys);
        }"""
    )
    assert len(known) > 100
    files = [file for room in ("app", "core") for file in (ROOT / room).rglob("*.py")]
    nodes = (node for file in files for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))))
    text = "\n".join(str(node.value) for node in nodes if isinstance(node, ast.Constant))
    own = ("within ", "HTTP ")
    gaps = re.compile(r"\{\w+\}|: | \(\w+\)$")
    parts = ((key, part.strip()) for key in known if not key.startswith(own) for part in gaps.split(key))
    assert [(key, part) for key, part in parts if len(part) > 2 and not _is_in(part, text)] == []


def _is_in(part, text):
    """Whether nearly all pairs of words of a template stand in the texts of the program: some are joined there."""
    words = part.split()
    pairs = [" ".join(words[k : k + 2]) for k in range(max(1, len(words) - 1))]
    return all(word in text for word in words) and sum(pair not in text for pair in pairs) <= 3
