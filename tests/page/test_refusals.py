"""Refusals of the real service on the page: sentences in both languages, with its labels and its units."""

from __future__ import annotations

import ast
import asyncio
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import httpx

from app.service.main import create_app
from app.settings import Settings
from app.wire import claims as wire
from app.wire.problem import DETAIL_MAX
from core.claims.claim import ContactClaim, StrayClaim
from tests.support.every_kind import CLAIMS, SENTENCES
from tests.support.pending import settled

ROOT = Path(__file__).parent.parent.parent
# Latin letters that are not a unit, a name or a symbol, outside of quotes.
ENGLISH = re.compile(
    r"(?<![A-Za-z])(?!GeoJSON|HTTP|TOML|JSON|KMZ?|DXF|DWG|ASCII|XML|name|length|width|overhang)[A-Za-z]{3,}"
)
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")
# Claims in Chinese, as the page words them.
CHINESE = "claims => import('/page/proofs.js').then((one) => claims.map(one.claimInChinese))"
QUOTED = re.compile("“[^”]*”")
# Words that no person should read: names of fields, units in brackets, words for programs.
INSIDE = re.compile(r"[a-z]_[a-z]|\[|\bgot\b|venue|csv|dragon\.\w|path\.\w|POST|header|\bNone\b")
FIELDS = {
    "collision-time": ("pitch", "start_turns", "benches", "head_length", "overhang", "head_speed", "margin", "stray"),
    "maximum-head-speed": ("ratio", "entry_radius", "speed_limit", "turning_diameter"),
}
WRONG = ("x", "", "-1", "1e9", "55cm")
QUERIES = (
    ("collision-time", {"hole": 0.01, "pin": 0.02}),
    ("collision-time", {"start_turns": 2}),
    ("collision-time", {"stray": 0.9}),
    ("collision-time", {"overhang": 1.2, "body_length": 2.2}),
    ("minimum-pitch", {"margin": 1.6}),
    ("minimum-pitch", {"width": 5}),
    ("minimum-pitch", {"benches": 9, "turning_diameter": 200, "start_turns": 1}),
    ("minimum-pitch", {"head_length": 2.2, "overhang": 0.8}),
    ("minimum-pitch", {"start_turns": 1e-9}),
    ("minimum-pitch", {"benches": 100_001}),
    ("tolerance", {"turning_diameter": 0.5}),
    ("clearance", {"start": 0, "stop": 4000, "step": 1}),
    ("clearance", {"start": 0, "stop": 400, "step": 1e-4}),
    ("maximum-head-speed", {"ratio": 50}),
    ("maximum-head-speed", {"entry_radius": 1}),
    ("shortest-turn", {"pitch": 0.5}),
    ("quickest-turn", {"turning_diameter": 7}),
    ("turn-time", {"entry_radius": 2}),
    ("clearance", {"benches": 2}),
    ("minimum-pitch", {"benches": 20, "width": 1.6, "start_turns": 5}),
    ("minimum-pitch", {"unknown": 1}),
)
POINTS = [[-40, 0], [0, 5], [40, 0]]
PATHS = (
    {"points": [[0, 0]]},
    {"points": [[-40, 0], [0, 0], [0, 0], [40, 0]]},
    {"points": [[0, 0], [1, 0]]},
    {"points": [[-40, 0], [0, 0], [1, 1], [0, 2], [-40, 2]]},
    {"points": [[-4e5, 0], [4, 0]]},
    {"points": [[0, 0], [40, 0], [0, 0]], "straight": [0, 1]},
    {"points": [[0, 0], [40, 0], [0, 0]]},
    {"points": [[0.1 * k, 0] for k in range(1001)]},
    {"points": POINTS, "start": 2e6},
    {"points": POINTS, "radius": 0},
    {"points": POINTS, "start": 10},
)
SQUARE = [[-50, -50], [50, -50], [50, 50], [-50, 50], [-50, -50]]
BOW = [[0, 0], [5, 5], [5, 0], [0, 5], [0, 0]]
TABLES = (
    "length,width\n1,2",
    "length,length,width,overhang\n1,1,1,1",
    "length,width,overhang,weight\n1,1,1,1",
    "name,length,width,overhang",
    "name,length,width,overhang\nA,3.41,.3",
    "name,length,width,overhang\nA,341,30,27.5",
    "name,length,width,overhang\nA,x,.3,.2",
    "name,length,width,overhang\nA,1,.3,.7",
    "name,length,width,overhang\n" + 300 * "n" + ",3.41,.3,.275",
)
PASSAGES = (
    [{"speed": 0, "until_s": 5}],
    [{"speed": 0, "until_time": 5}, {"speed": 0, "until_time": 3}],
    [{"speed": 1, "until_s": 5}, {"speed": 1, "until_s": 4}],
    [{"speed": "x", "until_s": 5}],
    [{"speed": 1, "until_time": "y"}],
    [{"speed": 30, "until_s": 5}],
    [{"speed": 1e-5, "until_s": 5}],
    [{"speed": 1}],
)
FILES = (
    b"hello",
    b"",
    b"\x89PNG\r\n",
    b"<kml><a></kml>",
    b"<gpx/>",
    b"<!DOCTYPE a><kml/>",
    b"PK\x03\x04aaaa",
    b"AC1027xxxx",
    b"AutoCAD Binary DXF\r\n",
    b'{"type":"FeatureCollection","features":[]}',
    b'{"type":"LineString","coordinates":[[100,20],[150,30]]}',
    b'{"type":"LineString","coordinates":[[29.11,119.64],[29.12,119.65]]}',
    b"a = [1,\n\nb = 2",
    b'{"type":"Polygon","coordinates":[[[0,0],[5,5],[5,0],[0,5],[0,0]]]}',
    b'{"path":{"kind":"waypoints","points":[[0,0]]}}',
)

EAST = {"dragon": {"benches": 9}, "path": {"kind": "waypoints", "points": [[0, 0], [60, 0]]}}
SPIRAL = {"dragon": {"benches": 9}, "path": {"kind": "spiral"}}
# Wrong performances of several dragons.
DANCES: tuple[dict[str, Any], ...] = (
    {"dances": []},
    {"dances": [EAST], "head_speed": 1.0},
    {"dances": [EAST], "path": EAST["path"]},
    {"dances": [EAST, {"dragon": {"benches": 0}}]},
    {"dances": [EAST, EAST | {"delay": 1e9}]},
    {"dances": [EAST | {"name": "east"}, EAST | {"name": "east"}]},
    {"dances": [SPIRAL, SPIRAL | {"delay": 9000}]},
    {"dances": [EAST], "start": -5},
    {"dances": [EAST], "stop": 500},
    {"dances": [EAST], "start": 500},
    {"dances": [SPIRAL], "stop": 5000},
    {"dances": [{"dragon": {"benches": 90_000}}]},
)


# Gates of SQUARE: off its border, outwards, in a corner, too many. A street of NOTCHED meets it again.
GATES: tuple[list[dict[str, Any]], ...] = (
    [{"point": [0, 0], "heading": 0}],
    [{"point": [-50, 0], "heading": 3}],
    [{"point": [-50, -49.9], "heading": 0}],
    [{"point": [-50, 0], "heading": 0}] * 9,
)
NOTCHED = [[0, 0], [60, 0], [60, 40], [30, 40], [30, 20], [20, 20], [20, 40], [0, 40], [0, 0]]


def feature(name: str, kind: str, coordinates: Any, **properties: Any) -> dict[str, Any]:
    geometry = {"type": kind, "coordinates": coordinates}
    return {"type": "Feature", "properties": {"name": name, **properties}, "geometry": geometry}


SQUARES = (
    [feature("square", "Polygon", [BOW])],
    [feature("square", "Polygon", [SQUARE]), feature("square", "Polygon", [SQUARE])],
    [feature("square", "Polygon", [SQUARE]), feature("stage", "Polygon", [BOW[:3]])],
    [feature("square", "Polygon", [SQUARE]), feature(300 * "n", "Polygon", [SQUARE])],
    [feature("square", "Polygon", [SQUARE]), feature("tree", "Point", [1, 1], radius=5000)],
    [feature("square", "Polygon", [SQUARE]), feature("tree", "Point", [1, 1])],
    [feature("square", "Polygon", [[[x / 10, x % 2 / 10] for x in range(6000)] + [[0, 9], [0, 0]]])],
    [],
)


def late() -> httpx.Response:
    """An answer that takes longer than it may: here a moment, while the service gives it ten seconds."""
    transport = httpx.ASGITransport(create_app(Settings(deadline_seconds=0.2)))

    async def late_answer() -> httpx.Response:
        async with httpx.AsyncClient(transport=transport, base_url="http://here") as client:
            return await client.get("/minimum-pitch", params={"benches": 9, "turning_diameter": 0.01})

    # In this thread the loop of Playwright runs.
    with ThreadPoolExecutor() as other:
        return other.submit(asyncio.run, late_answer()).result()


def refusals(server: str) -> list[dict[str, Any]]:
    """Refusals of the service, and each of their errors: wrong numbers, paths, squares, tables, passages and files."""
    few, octets = {"dragon": {"benches": 9}}, {"Content-Type": "application/octet-stream"}
    with httpx.Client(base_url=server, timeout=60.0) as client:
        wrong = [(call, {name: text}) for call, names in FIELDS.items() for name in names for text in WRONG]
        answers = [client.get(f"/{call}", params={"benches": 9} | query) for call, query in (*wrong, *QUERIES)]
        path = {"kind": "waypoints", "points": POINTS}
        bodies: list[dict[str, Any]] = [few | {"path": {"kind": "waypoints", **one}} for one in PATHS]
        bodies += [few | {"path": path, "passages": one} for one in PASSAGES]
        bodies += [few | {"path": path, "venue": {"type": "FeatureCollection", "features": one}} for one in SQUARES]
        square = {"type": "FeatureCollection", "features": [feature("square", "Polygon", [SQUARE])]}
        origins = [{"latitude": 95, "longitude": 0}, {"latitude": 0, "longitude": -200}]
        bodies += [few | {"path": path, "venue": square | {"origin": one}} for one in origins]
        notched = {"type": "FeatureCollection", "features": [feature("square", "Polygon", [NOTCHED])]}
        again = {"venue": notched, "gates": [{"point": [30, 30], "heading": 0}]}
        empty = {"venue": square | {"features": []}}
        wanted = [few | {"venue": square, "gates": one} for one in GATES] + [few | again, few | empty]
        answers = [*answers, *(client.post("/proposals", json=one) for one in wanted)]
        bodies += [{"dragon": {"csv": one}} for one in TABLES]
        bodies += [few | {"path": path, "start_clock": "7pm"}, {"dragon": {"benches": 400}, "path": path}]
        answers += [client.post("/check", json=body) for body in bodies]
        answers += [client.post("/check", json=one) for one in DANCES]
        answers.append(client.post("/tolerance", json={"dances": [EAST], "turning_diameter": 9}))
        answers.append(client.post("/clearance", json={"dances": [EAST]}))
        answers.append(client.post("/plan", json={"dances": [EAST] * 21}))
        parts = ({"part": "west"}, {"part": 5}, {"dances": None, "part": 0})
        answers += [client.post("/cues", json={"dances": [EAST]} | one) for one in parts]
        answers.append(client.post("/maps.kml", json=few | {"path": path}))
        answers += [client.post("/places", content=data, headers=octets) for data in FILES]
        answers += [client.get("/jobs/" + 48 * "0"), late()]
    entries = [answer.json() for answer in answers if answer.status_code >= 400]
    assert len(entries) > len(answers) - 25  # a few of the wrong texts are right for some field
    return list({words["detail"]: words for one in entries for words in (one, *one["errors"])}.values())


def test_every_refusal_is_a_sentence_in_both_languages(visit: Any, server: str) -> None:
    page = visit("?benches=9")
    result = refusals(server)
    assert len(result) > 100
    script = """async (refusals) => {
      const { learnRefusals, refusalWords, setLanguage } = await import("/page/text.js");
      learnRefusals(await import("/page/refusals.js"));
      return ["zh", "en"].map((one) => setLanguage(one) && refusals.map((told) => refusalWords(told).textContent));
    }"""
    chinese, english = page.evaluate(script, result)
    assert [words for words in chinese if ENGLISH.search(QUOTED.sub("", words)) or not words.endswith("。")] == []
    assert [words for words in english if INSIDE.search(words) or not words.endswith(".")] == []


def test_a_refusal_is_its_template_with_the_values(server: str) -> None:
    for problem in refusals(server):
        values = problem["values"]

        def fill(text: str, values: dict[str, Any] = values) -> str:
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


def test_the_page_knows_only_templates_that_the_program_has(visit: Any) -> None:
    page = visit("?benches=9")
    known = page.evaluate(
        """async () => {
          const { REASONS, RULES, WHOLE } = await import("/page/words/refusals.js");
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


def _is_in(part: str, text: str) -> bool:
    """Whether nearly all pairs of words of a template stand in the texts of the program: some are joined there."""
    words = part.split()
    pairs = [" ".join(words[k : k + 2]) for k in range(max(1, len(words) - 1))]
    return all(word in text for word in words) and sum(pair not in text for pair in pairs) <= 3


def test_every_proof_has_the_chinese_words_of_the_library(visit: Any) -> None:
    claims = {name: claim for name, claim in CLAIMS.items() if isinstance(claim, (ContactClaim, StrayClaim))}
    values = [
        getattr(wire, type(claim).__name__).model_validate(claim).model_dump(mode="json") for claim in claims.values()
    ]
    proofs = visit("?benches=9").evaluate(CHINESE, values)
    assert dict(zip(claims, proofs, strict=True)) == {name: SENTENCES[name][1] for name in claims}


def test_every_proof_of_the_service_has_chinese_words(visit: Any, server: str) -> None:
    paths = [{"kind": "waypoints", "points": POINTS, "start": 20}, {"kind": "turn", "pitch": 1.7}, {"kind": "spiral"}]
    few = [{"speed": 0.5, "until_s": 5}, {"speed": 0, "until_time": 60}, {"speed": 2, "until_time": 61}]
    many = [{"speed": 1, "until_time": 1 + 0.1 * k} for k in range(30)]
    tree = feature("tree", "Point", [0, 5], radius=2)
    venue = {"type": "FeatureCollection", "features": [feature("square", "Polygon", [SQUARE]), tree]}
    mores: tuple[dict[str, Any], ...] = ({}, {"passages": few}, {"passages": many}, {"stray": 0.02}, {"margin": 0.05})
    with httpx.Client(base_url=server, timeout=60.0) as client:
        certificates = []
        for path in paths:
            body = {"dragon": {"benches": 9}, "path": path}
            body |= {"start": -20, "stop": 40} if path["kind"] == "turn" else {}
            for more in mores:
                answer = client.post("/check", json=body | more).raise_for_status().json()["first_contact"]
                certificates.append(answer["certificate"])
            end = {"turning_diameter": 9} if path["kind"] == "spiral" else {}
            for place in ({}, {"venue": venue}) if path is paths[0] else ({},):
                answer = client.post("/tolerance", json=body | end | place).raise_for_status().json()
                certificates.append(answer["certificate"])
    page = visit("?benches=9")
    chinese = page.evaluate(CHINESE, [one["claim"] for one in certificates])
    assert len(set(chinese)) > 15
    assert [words for words in chinese if ENGLISH.search(words)] == []
    numbers = [
        [set(NUMBER.findall(words)) for words in (one["method"], zh)]
        for one, zh in zip(certificates, chinese, strict=True)
    ]
    assert [pair for pair in numbers if not pair[0] <= pair[1]] == []


def test_what_is_asked_in_centimetres_is_refused_in_centimetres(visit: Any) -> None:
    page = visit("?benches=9", failing=True)
    stray = page.locator("#stray")
    error = page.locator("#stray-error")
    for text, words in (
        ("900", "“Stray” must be at most half the chord of body 1 (82.5 cm); it is 900 cm."),
        ("x", "“Stray” must be a number of centimetres, such as 2; you typed “x”."),
        ("9000", "“Stray” must be at most 2500 cm; it is 9000 cm."),
    ):
        stray.fill(text)
        settled(page)
        page.locator("#stray-error", has_text=words).wait_for()
        assert error.inner_text() == words
    stray.fill("2,5")
    settled(page)
    error.wait_for(state="hidden")
    assert stray.input_value() == "2.5"
