"""Modules of the page against the program in Python, and against a reader of QR codes."""

import math
import re

import pytest

from app.files.addresses import WORDS, short_form
from app.service.main import create_app
from app.sweeps.columns import answer_columns
from app.sweeps.questions import question_of
from app.wire.benches import bench_table
from core import Dragon
from core.proposal.designs import street_length
from core.proposal.needs import Needs
from tests.support import polite
from tests.support.node import evaluate

pytestmark = pytest.mark.node
TABLES = [
    "name,length,width,overhang\nZhou,3.41,0.3,0.275\nLi,2.2,0.3,0.275\nHe,2,0.3,0.2",
    "length\twidth\toverhang\n3,41\t0,3\t0,275\n\n2,2\t0,3\t0,275",
    'Width [m];NAME;overhang (m);长度\r\n0,3;"a;""b""";0,275;3.41\r\n0,3;;0,275;2,2',
    ' name , length,width,overhang\n"Zhou, Li",3.41, 0.3 ,0.275\n,,,\n O\'Neil,2.2,.3,2e-1',
]
QUESTIONS = ("collision_time", "minimum_pitch", "least_clearance", "shortest_turn", "quickest_turn", "tolerance")


def test_the_page_reads_the_sizes_of_a_table_as_the_service_does():
    read = evaluate("async (tables) => tables.map((await page('read_table.js')).benchesOf)", TABLES)
    wanted = [bench_table(table)._asdict() for table in TABLES]
    assert read == [{name: value for name, value in one.items() if name != "lines"} for one in wanted]


def test_the_page_reads_every_address_of_a_dance_in_its_short_form():
    """All words of the short form, all characters that an address may have, and addresses of others, which stay."""
    words = "".join(word if word.startswith("&") else f"&route={word}" for word in WORDS)
    others = "".join(chr(code) for code in range(33, 127) if chr(code) not in "#&+=?")
    queries = [
        "?route=*0,0_12,5&z",
        f"?{words[1:]}",
        f"?lang=zh&route=00{others}",
        "?benches=20&bench=3",
        "?z=x&walk=1",
    ]
    short = [short_form(f"https://dragon.example/a/{query}") for query in queries]
    read = evaluate("async (queries) => queries.map((await page('short.js')).writtenOut)", [one[25:] for one in short])
    assert [one[25:] == query for one, query in zip(short, queries, strict=True)] == [True, False, False, True, True]
    assert read == [*queries[:4], "?&walk=1"]


def test_every_value_of_a_map_has_its_own_name_in_each_language(server):
    names = set()
    for question in (question_of(name, ["benches"]) for name in QUESTIONS):
        columns = answer_columns(question.answer, question.left_out)
        names |= {one.name for one in columns if one.kind in (int, float) and not one.as_json}
    assert len(names) > 50
    script = """async (names, labels) => {
      const [{ setLanguage, teach }, { columnName }] = await Promise.all(["text.js", "columns.js"].map(page));
      return Object.entries(labels).map(([lang, texts]) => {
        teach(lang, texts);
        setLanguage(lang);
        return names.map(columnName);
      });
    }"""
    labels = {lang: polite.answer(server, f"page/words/{lang}-columns.json") for lang in ("en", "zh")}
    english, chinese = evaluate(script, sorted(names), labels)
    assert [one for one in english if "_" in one] == []
    assert [one for one in chinese if re.search("[a-z]{4}|_", one)] == []
    assert len(set(english)) == len(set(chinese)) == len(names)


def test_a_route_takes_the_numbers_that_the_service_takes():
    schemas = create_app().openapi()["components"]["schemas"]
    known = evaluate("async () => (await page('route.js')).LIMITS")
    for key, schema, name in (
        ("speedLimit", "CheckRequest", "speed_limit"),
        ("pathBegin", "WaypointsPath", "start"),
        ("cornerRadius", "WaypointsPath", "radius"),
    ):
        field = schemas[schema]["properties"][name]
        own = field.get("anyOf", [field])[0]
        assert known[key] == [own["minimum"], own["maximum"]], key


@pytest.mark.parametrize("benches, stray, margin", [(1, 0.0, 0.0), (8, 0.0, 0.0), (24, 0.0, 0.0), (8, 0.05, 1.5)])
def test_the_street_beyond_a_gate_is_as_long_as_the_service_makes_it(benches, stray, margin):
    numbers = {"benches": benches, "stray": stray, "margin": margin, "hole": 0.0, "pin": 0.0}
    numbers |= {"head_length": 3.41, "body_length": 2.2, "overhang": 0.275}
    script = """async (numbers) => {
      const { streetLength } = await page("square.js");
      return streetLength({ get: (name) => String(numbers[name]), extras: () => ({ csv: "" }) });
    }"""
    assert evaluate(script, numbers) == math.ceil(street_length(Needs(Dragon(benches), stray, margin)))
