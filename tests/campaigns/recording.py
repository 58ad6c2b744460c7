"""What the program answers: 960 requests over all calls, commands, tables, files and refusals, kept in a folder.

python -m tests.campaigns.recording FOLDER writes them into FOLDER, a value in each line. `make record BEFORE=` shows
what differs from those of another folder.
"""

import contextlib
import hashlib
import io
import json
import random
import re
import shlex
import sys
import tempfile
from itertools import product
from pathlib import Path
from zipfile import ZipFile, is_zipfile

import httpx

from app.questions.registry import CALLS
from app.service.examples import EXAMPLES
from app.wire.question import JSON
from core.language import Language
from tests.campaigns.fuzz import mutant
from tests.support.asking import box
from tests.support.command import run
from tests.support.serving import serving

MUTANTS = 6
SEED = 67
# Calls without an example: figures, files and maps, with a request of few seconds.
DANCE = {"dragon": {"benches": 12}, "path": {"kind": "spiral", "start_turns": 9}}
QUERY = {"benches": 12, "start_turns": 9}
FILM = DANCE | {"height": 90, "seconds": 0.2}
SMALL = {"films": FILM, "contest_kit": {"benches": 5, "films": False, "span": 2, "stop": 20}, "maps": DANCE}
# Files beside which the commands run, and what is asked of each; a line of one word is also asked for its help, with an
# option that is not there, and with values that are refused.
SPIRAL = {"kind": "spiral", "start_turns": 9}
PLACED = box(-20, -20, 20, 20, name="square")
FILES = {
    "dance.json": {"dragon": {"benches": 12}, "path": SPIRAL, "venue": PLACED},
    "two.json": {"dances": [{"dragon": {"benches": 5}, "path": SPIRAL}, {"dragon": {"benches": 5}, "path": SPIRAL}]},
    "square.json": {"venue": PLACED, "dragon": {"benches": 5}},
    "square.geojson": {"type": "FeatureCollection", "features": [PLACED]},
}
COMMANDS = """
trajectory; trajectory --stop 2; trajectory --stop 2 --output a.csv; trajectory --stop 1 --output a.xlsx; clearance
trajectory dance.json --stop 1 --json; trajectory two.json --stop 1; collision-time; collision-time dance.json --json
collision-time --benches 12 --pitch 0.5 --margin 0.05; collision-time --stray 0.05 --json; minimum-pitch
minimum-pitch --json; clearance --stop 20 --step 5; turn; turn --json; shortest-turn; shortest-turn --benches 1
turn-time; turn-time --json; quickest-turn; quickest-turn --benches 5 --json; tolerance; tolerance --benches 9 --json
tolerance-curve; tolerance-curve --benches 8 --samples 3; maximum-head-speed; maximum-head-speed --json
contact-probability; contact-probability --benches 8 --samples 20 --json; envelope; envelope --benches 6 --stop 5
overlaps; overlaps --time 412; overlaps --time 413 --json; paper; paper --json; paper --language zh; encounter
encounter two.json; encounter two.json --json; safe-delay; safe-delay two.json; safe-delay two.json --json; check
check dance.json; check dance.json --json; check two.json; check square.json; check nothing.json; propose
propose square.json; propose square.json --json; cues; cues dance.json --output a.pdf; cues two.json --part 1; crew
crew dance.json; crew dance.json --json; crew dance.json --shift 20 --spares 2; plan; plan dance.json --output a.pdf
maps; maps dance.json --output a.kml; maps dance.json --output a.dxf; places; places square.geojson; grade
places square.geojson --json; grade --collision-time 412.47; grade --pitch 0.4504 --json; grade --speed 1.25; contest
contest kit --no-films --benches 5 --language en; film; film --benches 5 --seconds 0.2 --height 90 --output a.mp4
figures; figures out --kind contact; prove; prove contact --benches 5 --start-turns 5 --output a.json; jobs; jobs list
sweep; sweep run; sweep show; mcp
"""
REFUSED = "--benches=0", "--pitch=0_5", "--head-speed=-1", "--json --margin=nan", "--language=xx"
# What no two runs have in common: digests, jobs, hours, and the folder of the run.
FLEETING = re.compile(r"\b[0-9a-f]{32,}\b|\d{4}-\d\d-\d\dT[\d:.+Z]+|/tmp/\S*|in \d+(\.\d+)? m?s\b")


def requests():
    """Name of each request to the service, and what httpx gets."""
    chance = random.Random(SEED)
    for name, call in CALLS.items():
        question = call.question
        at = f"{call.method} {call.question.path}"
        example = EXAMPLES.get(at)
        is_post = call.method == "POST"
        request = SMALL.get(name, DANCE if is_post else QUERY)
        if example:
            request = example.query or example.body or {}
        languages = (
            [{"language": each.value} for each in Language] if "language" in call.request_type.model_fields else [{}]
        )
        for more, form, ending in product(languages, question.forms, question.formats or [""]):
            path = question.path.replace("{format}", str(ending))
            options = {"json" if is_post else "params": request | more, "headers": {"Accept": form}}
            yield f"{at} {form} {ending} {more}", (call.method, path, options)
        if example:
            for k in range(MUTANTS):
                path, options = mutant(at, chance)
                yield f"{at} mutant {k}", (call.method, path, options)
    for path in ("/openapi.json", "/version", "/mcp", "/jobs", "/sweeps", "/nowhere"):
        yield f"GET {path}", ("GET", path, {})
    listing = {"jsonrpc": "2.0", "id": 1, "method": "tools/list", "params": {}}
    yield "tools", ("POST", "/mcp", {"json": listing, "headers": {"Accept": f"{JSON}, text/event-stream"}})


def commands():
    lines = [line.strip() for line in COMMANDS.replace("\n", ";").split(";") if line.strip()]
    for line in lines:
        if " " not in line:
            lines += [f"{line} {more}" for more in ("--help", "--bogus", *REFUSED)]
    return lines


def readable(data):
    """The parts of an answer that are equal for equal answers: JSON, text, or a digest of each file of an archive."""
    if is_zipfile(io.BytesIO(data)):
        with ZipFile(io.BytesIO(data)) as archive:
            return {name: readable(archive.read(name)) for name in archive.namelist()}
    try:
        text = FLEETING.sub("…", data.decode())
    except UnicodeDecodeError:
        return hashlib.sha256(data).hexdigest()
    try:
        return json.loads(text)
    except ValueError:
        return text.splitlines()


def record(folder):
    """Ask everything, and write one file for each answer."""
    folder.mkdir(parents=True, exist_ok=True)
    with (
        tempfile.TemporaryDirectory() as scratch,
        serving(Path(scratch) / "log", data=scratch, deadline_seconds=600) as service,
    ):
        for name, (method, path, options) in requests():
            answer = httpx.request(method, f"{service.url}{path}", timeout=120.0, **options)
            keep(folder, name, [answer.status_code, answer.headers["content-type"]], {"": answer.content})
    for line, language in product(commands(), Language):
        with tempfile.TemporaryDirectory() as here, contextlib.chdir(here):
            for name, value in FILES.items():
                Path(name).write_text(json.dumps(value))
            done = run(*shlex.split(line), LANG=f"{language.value}_{language.value.upper()}.UTF-8", COLUMNS="120")
            made = {str(file): file.read_bytes() for file in Path().rglob("*") if file.is_file()}
        streams = {"output": done.stdout.encode(), "errors": done.stderr.encode()}
        keep(folder, f"{line} {language.value}", [done.returncode], made | streams)


def keep(folder, name, head, parts):
    file = folder / f"{re.sub(r'[^A-Za-z0-9.=-]+', '_', name)[:150]}.json"
    assert not file.exists(), name
    content = [*head, {part: readable(data) for part, data in parts.items()}]
    file.write_text(json.dumps(content, indent=1, ensure_ascii=False, sort_keys=True))


if __name__ == "__main__":
    (folder,) = sys.argv[1:]
    record(Path(folder))
