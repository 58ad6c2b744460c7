"""A third language of one file: in it nothing is English that a command prints or a service answers, and no file."""

import io
import json
import re
import shlex
from zipfile import ZipFile

import httpx

from app.files.tables import XLSX_TYPE
from app.service.examples import EXAMPLES
from tests.campaigns.recording import DANCE, FILES
from tests.support.command import run
from tests.support.paper import sheets_of
from tests.support.pseudo import CODE, left
from tests.support.serving import serving

LINES = """
collision-time --benches 12 --margin 0.05 --stray 0.02; collision-time --benches 12 --pitch 2; turn --benches 5; check
minimum-pitch --benches 12; clearance --benches 5 --stop 3; turn-time; tolerance --benches 9; crew dance.json; jobs list
contact-probability --benches 8 --samples 20; envelope --benches 6 --stop 5; overlaps --time 412; check two.json; grade
check dance.json; encounter two.json; places square.geojson; grade --pitch 0.4504; maximum-head-speed --benches 5
trajectory --benches 5 --stop 1; trajectory --benches 5 --stop 1 --output a.xlsx; check nothing.json; grade --speed 1.25
collision-time --bogus; collision-time --benches=0; trajectory --pitch=0_5; minimum-pitch --json --margin=nan; x9
grade --pitch=x; maps dance.json --output a.kml; cues dance.json --output a.pdf; sweep run
jobs show x9; safe-delay two.json; prove x9; trajectory two.json --stop 1; propose square.json
shortest-turn --benches 3; prove turn --benches 3 --start -5 --stop 5 --output a.json
"""
# Texts, and the first parts of lists, that hold words in an answer; elsewhere stand codes, names, units and addresses.
FIELDS = "sentences?|message|method|words|evidence|notes|what|why|summary"
WORDS = re.compile(rf'"(?:{FIELDS})":("(?:[^"\\]|\\.)*"|\["[^\]]*)')
# Calls that answer with a file, and what each is asked, in the first of these forms that it has.
SHORT = DANCE | {"stop": 20, "venue": FILES["dance.json"]["venue"], "language": CODE}
SHEETS = {"plan": SHORT, "cues": SHORT, "crew": SHORT, "safety-sheet": SHORT, "trajectory": DANCE | {"times": [0]}}
FORMS = f"application/pdf, {XLSX_TYPE};q=0.9, */*;q=0.5"


def test_no_command_prints_english(pseudo_house, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, value in FILES.items():
        (tmp_path / name).write_text(json.dumps(value))
    for line in LINES.strip().replace("\n", ";").split(";"):
        done = run(*shlex.split(line), house=pseudo_house, LC_ALL=CODE)
        assert left(done.stdout + done.stderr) == [], line


def text_of(data):
    """The words of paper, of the first sheet of a workbook, of a drawing with its comments, or of a text."""
    if data.startswith(b"%PDF"):
        return "\n".join(sheets_of(data))
    if data.startswith(b"PK"):
        data = ZipFile(io.BytesIO(data)).read("xl/worksheets/sheet1.xml")
    return re.sub("<style.*?</style>|<metadata.*?</metadata>|<(?!!--)[^>]*>", "\n", data.decode(), flags=re.DOTALL)


def test_no_answer_file_or_refusal_of_the_service_is_english(pseudo_house, tmp_path):
    said = []
    with serving(tmp_path / "log", house=pseudo_house, data=tmp_path, deadline_seconds=60) as service:
        client = httpx.Client(base_url=service.url, headers={"Accept-Language": CODE}, timeout=120)
        for call, example in EXAMPLES.items():
            for more in ({}, {"x9": 1}):
                asked = {"json": example.body | more} if example.body else {"params": example.query | more}
                said += WORDS.findall(client.request(*call.split(), **asked).text)
        files = [client.post(name, json=body, headers={"Accept": FORMS}) for name, body in SHEETS.items()]
        kinds = ("trajectory", "contact", "pitch-scan")
        files += [client.get(f"figures/{kind}.svg", params={"benches": 12}) for kind in kinds]
        for file in files:
            said.append(text_of(file.raise_for_status().content))
    assert left("\n".join(said)) == []
