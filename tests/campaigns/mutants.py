"""How many of some random faults in core, app and the page the tests notice: make mutants.

python -m tests.campaigns.mutants draw COUNT SEED   makes the list of faults, FAULTS (cosmic-ray; StrykerJS by npm)
python -m tests.campaigns.mutants try               puts one fault after another into a clone, and prints a table

A fault changes one thing: an operator, a number, a comparison, a block. Draws are uniform over the places where a
tool can change something, in proportion to the weight of core, app and the page; changes of annotations, which Python
never computes, are left out. A fault is tried by the tests of its module and its room, then by all tests that run its
line, those of every day first, until one fails; faults of the page by all tests of the page. A test that fails is
repeated without the fault: only if it passes then has it noticed something. What is known is kept in build/mutants, so
that a run goes on after an interruption.
"""

import ast
import difflib
import json
import os
import random
import re
import signal
import sqlite3
import subprocess
import sys
import tempfile
from dataclasses import asdict, dataclass
from functools import cache
from itertools import islice, starmap
from pathlib import Path

ROOT = Path(__file__).parents[2]
FAULTS = Path(__file__).with_suffix(".json")
CLONE = ROOT / "build" / "mutants" / "clone"
TRIED = ROOT / "build" / "mutants" / "tried.json"
COVERED = CLONE / ".coverage"
SHARES = {"core": 0.45, "app": 0.38, "app/page": 0.17}  # of syntax nodes (2026-11-28)
STRYKER = "@stryker-mutator/instrumenter@9.6.1"
EVERY_DAY = "not thorough"
THOROUGH = "thorough"
# Longest time of the tests of one fault [s]: a fault may make a search endless.
MOST = 1_800.0
# A run without what a test needs has another reason to fail.
PYTEST = (".venv/bin/python", "-m", "pytest", "-x", "-q", "--color=no", "-p", "no:cacheprovider", "-n", "2")


@dataclass(frozen=True)
class Fault:
    """One change of one file: these lines, the first of which has this number, become those."""

    path: str
    line: int
    kind: str
    before: list[str]
    after: list[str]

    def put_into(self, checkout):
        """Change the file. raises: LookupError where the lines stand there no more"""
        file = checkout / self.path
        lines = file.read_text("utf-8").splitlines(keepends=True) if file.exists() else []
        size = len(self.before)
        starts = [k for k in range(len(lines)) if lines[k : k + size] == self.before]
        if not starts:
            raise LookupError(self.path)
        start = min(starts, key=lambda k: abs(k + 1 - self.line))
        file.write_text("".join([*lines[:start], *self.after, *lines[start + size :]]), "utf-8")


# -- draw ----------------------------------------------------------------------------------------------------


def fault_of(path, kind, text, changed):
    """The fault that makes `changed` of a file's text; None if it changes nothing."""
    old = text.splitlines(keepends=True)
    new = changed.splitlines(keepends=True)
    spans = [code for code in difflib.SequenceMatcher(None, old, new, False).get_opcodes() if code[0] != "equal"]
    if not spans:
        return None
    i = spans[0][1]
    j = spans[0][3]
    end = spans[-1][2]
    stop = spans[-1][4]
    if end == i:  # only new lines: the line before them names the place
        i, j = i - 1, j - 1
    return Fault(path, i + 1, kind, old[i:end], new[j:stop])


def annotations(path):
    """Lines and columns at which some part of an annotation begins."""
    starts = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        for name in ("annotation", "returns"):
            if (note := getattr(node, name, None)) is not None:
                for part in ast.walk(note):
                    if isinstance(part, ast.BinOp):
                        starts.add((part.left.end_lineno or 0, part.left.end_col_offset or 0))
    return starts


def draw_python(room, chance, place):
    """Faults of the room's Python by cosmic-ray, one at a time and without an end."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    config = place / "cosmic.toml"
    session = place / f"{room}.sqlite"
    config.write_text(
        f'[cosmic-ray]\nmodule-path = ["{room}"]\ntimeout = 60.0\nexcluded-modules = []\ntest-command = "true"\n'
        '[cosmic-ray.distributor]\nname = "local"\n'
    )
    subprocess.run([Path(sys.executable).with_name("cosmic-ray"), "init", config, session], cwd=ROOT, check=True)
    columns = "module_path, operator_name, occurrence, start_pos_row, start_pos_col"
    rows = sqlite3.connect(session).execute(f"select {columns} from mutation_specs order by {columns}").fetchall()
    kept = {}
    noted = {path: annotations(ROOT / path) for path in {path for path, *_ in rows}}
    for path, operator, occurrence, row, column in rows:
        if not any(row == line and 0 <= column - end <= 1 for line, end in noted[path]):
            kept.setdefault((path, row, column, "_".join(operator.split("_")[:1])), []).append((operator, occurrence))
    sites = sorted(kept)
    chance.shuffle(sites)
    for site in sites:
        operator, occurrence = chance.choice(kept[site])
        text = (ROOT / site[0]).read_text("utf-8")
        if changed := mutate_code(text, get_operator(operator)(), occurrence):
            yield site[0], operator.partition("/")[2], text, changed


def draw_page(chance, place):
    """Faults of the page's scripts by StrykerJS."""
    subprocess.run(["npm", "install", "--silent", "--prefix", place, STRYKER], check=True)
    script = Path(__file__).with_suffix(".mjs")
    every = []
    for file in sorted((ROOT / "app" / "page").rglob("*.js")):
        made = subprocess.run(["node", script, file], cwd=place, capture_output=True, text=True, check=True)
        every += [(file.relative_to(ROOT).as_posix(), mutant) for mutant in json.loads(made.stdout)]
    chance.shuffle(every)
    for path, mutant in every:
        text = (ROOT / path).read_text("utf-8")
        lines = text.splitlines(keepends=True)
        start, end = (
            sum(map(len, lines[: at["line"]])) + at["column"]
            for at in (mutant["location"]["start"], mutant["location"]["end"])
        )
        yield path, mutant["mutatorName"], text, text[:start] + mutant["replacement"] + text[end:]


def draw(count, seed):
    """Write FAULTS: so many faults, the same ones for the same seed and tree."""
    print(f"seed {seed}")
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        for room, share in SHARES.items():
            chance = random.Random(f"{seed} {room}")
            drawn = draw_page(chance, place) if room == "app/page" else draw_python(room, chance, place)
            faults += islice(filter(None, starmap(fault_of, drawn)), round(share * count))
    FAULTS.write_text(json.dumps([asdict(fault) for fault in faults], indent=1, ensure_ascii=False) + "\n", "utf-8")


# -- try -----------------------------------------------------------------------------------------------------


def run(*words, **options):
    return subprocess.run(words, cwd=CLONE, capture_output=True, text=True, **options)


def prepare():
    """A clone of the last commit with its tests, and which of them run which lines."""
    if not CLONE.exists():
        subprocess.run(["git", "clone", "--quiet", "--no-local", ROOT, CLONE], check=True)
        run("make", "test-setup", check=True)
        run("make", "--silent", ".venv/mutants", check=True)
    if not COVERED.exists():
        (CLONE / ".coveragerc").write_text("[run]\npatch = subprocess\nsource = core, app\n")
        words = ("-n", "3", "--all", "--cov", "--cov-context=test", "--cov-report=")
        run(".venv/bin/python", "-m", "pytest", "-q", *words)


def near(fault):
    """Files of tests that are named as the module of a fault, that import it, or that stand in its room."""
    path = Path(fault.path)
    room = path.parent.name
    stem = path.stem
    files = {file.relative_to(CLONE).as_posix(): file for file in sorted((CLONE / "tests").rglob("test_*.py"))}
    if room == "page" or "page" in path.parts:
        word = re.compile(rf"\b{re.escape(stem)}\b|import node")
        return [name for name, file in files.items() if "/page/" in name and word.search(file.read_text("utf-8"))]
    named = [name for name in files if name.endswith(f"/test_{stem}.py")]
    words = re.compile(rf"\b{room}\.{stem}\b|from [\w.]*\b{room} import [^\n]*\b{stem}\b")
    uses = [name for name, file in files.items() if "/page/" not in name and words.search(file.read_text("utf-8"))]
    beside = [name for name in files if name.startswith(f"tests/{path.parent}/")]
    return list(dict.fromkeys([*named, *uses, *beside]))


@cache
def coverage_of(path):
    """The tests that run each line of a module; an empty name stands for those that run it in another process."""
    import coverage

    data = coverage.CoverageData(COVERED)
    data.read()
    return data.contexts_by_lineno(str(CLONE / path))


def covering(fault):
    """All tests that may notice a fault."""
    if "page/" in fault.path:
        return ["tests/page"]
    lines = range(fault.line, fault.line + max(len(fault.before), 1))
    tests = {test.partition("|")[0] for line in lines for test in coverage_of(fault.path).get(line, ["", "core"])}
    if "core/kernels" in fault.path:  # what is compiled has no lines
        return ["tests", "core"]
    if "" in tests:
        tests = tests - {""} | {"tests/app", "tests/page"}
    return sorted(test for test in tests if test.partition("[")[0].partition("::")[0] not in tests - {test})


def failing(tests, kind):
    """The first of the tests of a kind that fails; empty if all pass. A run without an end has failed."""
    with tempfile.TemporaryFile("w+") as output:
        words = [*PYTEST, "-m", kind, *tests]
        process = subprocess.Popen(words, cwd=CLONE, stdout=output, stderr=output, start_new_session=True)
        try:
            code = process.wait(MOST)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            return "no end"
        output.seek(0)
        match = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", output.read(), re.MULTILINE)
    if code in (0, 5):  # all pass; none is left of those that were chosen
        return ""
    return match[1] if match else "no start"


def compiled():
    """Whether the loops compile."""
    for file in (CLONE / "core" / "kernels").glob("*.so"):
        file.unlink()
    run(".venv/bin/python", "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-deps", "-e", ".")
    return run(".venv/bin/python", "-c", "from core import kernels; assert kernels.COMPILED").returncode == 0


def tried(fault):
    """Who notices a fault, and whether this is a test of every day."""
    is_loop = "core/kernels" in fault.path
    try:
        fault.put_into(CLONE)
    except LookupError:
        return {"gone": True}
    result = {"noticed_by": ""}
    try:
        if is_loop and not compiled():
            return {"noticed_by": "the compiler", "every_day": True}
        for kind in (EVERY_DAY, THOROUGH):
            for tests in (near(fault), covering(fault)):
                if tests and not result["noticed_by"]:
                    result = {"noticed_by": failing(tests, kind), "every_day": kind == EVERY_DAY}
    finally:
        run("git", "checkout", "--quiet", ".", check=True)
        if is_loop:
            compiled()
    if "::" in result["noticed_by"] and failing([result["noticed_by"]], ""):
        result["unsure"] = True  # it fails without the fault too
    return result


def try_all():
    """Try each fault that was not tried yet, and print the table."""
    prepare()
    results = json.loads(TRIED.read_text()) if TRIED.exists() else {}
    for key, row in enumerate(json.loads(FAULTS.read_text("utf-8"))):
        if str(key) not in results:
            fault = Fault(**row)
            results[str(key)] = tried(fault)
            TRIED.write_text(json.dumps(results, indent=1))
            print(key, fault.path, fault.line, fault.kind, results[str(key)], flush=True)
    noticed = [result for result in results.values() if result.get("noticed_by")]
    gone = sum("gone" in result for result in results.values())
    every_day = sum(result["every_day"] for result in noticed)
    print(f"{len(results) - gone} faults: {len(noticed)} noticed by all tests, {every_day} by make test; {gone} gone")


def main():
    match sys.argv[1:]:
        case ["draw", count, seed]:
            draw(int(count), int(seed))
        case ["try"]:
            try_all()
        case _:
            sys.exit(__doc__)


if __name__ == "__main__":
    main()
