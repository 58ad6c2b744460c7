"""How many of some random faults in core, app and the page the tests notice.

python -m tests.campaigns.mutants draw COUNT SEED   makes the list of faults, FAULTS (cosmic-ray; StrykerJS by npm)
python -m tests.campaigns.mutants cover             which test file runs which line, into build/cover.json
python -m tests.campaigns.mutants try [PROCESSES]   puts one fault after another into a clone, runs the tests that run
                                                    its line until the first fails, and prints a table

A fault changes one thing: an operator, a number, a comparison, a block. Draws are uniform over the places where a
tool can change something, in proportion to the weight of core, app and the page; changes of annotations, which Python
never computes, are left out. Faults of the page are tried by all tests of the page, those of compiled loops by the
tests that run a line of core which calls them. A test that fails is repeated without the fault: only if it passes then
has it noticed something. What was found is kept in build/, so that a run goes on after an interruption.
"""

from __future__ import annotations

import ast
import difflib
import json
import os
import queue
import random
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
FAULTS = ROOT / "tests" / "campaigns" / "mutants.json"
COVER = ROOT / "build" / "cover.json"
SHARES = {"core": 0.45, "app": 0.38, "app/page": 0.17}  # of syntax nodes (2026-11-28)
TRIED = ROOT / "build" / "tried.json"
EVERY_DAY, THOROUGH = ["-m", "not thorough"], ["-m", "thorough"]
BATCH = 40.0  # [s] of tests that share a process
SLOWER = 8.0  # [1] a test that takes this many times as long under a fault has noticed it
LEAST = 60.0  # [s] the least time that a file of tests may take
CORES = 2


@dataclass(frozen=True)
class Fault:
    """One change of one file: these lines, the first of which has this number, become those."""

    path: str
    line: int
    kind: str
    before: list[str]
    after: list[str]

    def put_into(self, checkout: Path) -> None:
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


def fault_of(path: str, kind: str, text: str, changed: str) -> Fault | None:
    """The fault that makes `changed` of a file's text; None if it changes nothing."""
    old, new = text.splitlines(keepends=True), changed.splitlines(keepends=True)
    spans = [code for code in difflib.SequenceMatcher(None, old, new, False).get_opcodes() if code[0] != "equal"]
    if not spans:
        return None
    i, j = spans[0][1], spans[0][3]
    end, stop = spans[-1][2], spans[-1][4]
    if end == i:  # only new lines: the line before them names the place
        i, j = i - 1, j - 1
    return Fault(path, i + 1, kind, old[i:end], new[j:stop])


def annotations(path: Path) -> set[tuple[int, int]]:
    """Lines and columns at which some part of an annotation begins."""
    starts: set[tuple[int, int]] = set()
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        for name in ("annotation", "returns"):
            if (note := getattr(node, name, None)) is not None:
                for part in ast.walk(note):
                    if isinstance(part, ast.BinOp):
                        starts.add((part.left.end_lineno or 0, part.left.end_col_offset or 0))
    return starts


def draw_python(room: str, chance: random.Random, place: Path) -> Iterator[Fault]:
    """Faults of the room's Python by cosmic-ray, one at a time and without an end."""
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    config, session = place / "cosmic.toml", place / f"{room}.sqlite"
    config.write_text(
        f'[cosmic-ray]\nmodule-path = ["{room}"]\ntimeout = 60.0\nexcluded-modules = []\ntest-command = "true"\n'
        '[cosmic-ray.distributor]\nname = "local"\n'
    )
    subprocess.run([Path(sys.executable).with_name("cosmic-ray"), "init", config, session], cwd=ROOT, check=True)
    columns = "module_path, operator_name, occurrence, start_pos_row, start_pos_col"
    rows = sqlite3.connect(session).execute(f"select {columns} from mutation_specs order by {columns}").fetchall()
    kept: dict[tuple[str, int, int, str], list[tuple[str, int]]] = {}
    noted = {path: annotations(ROOT / path) for path in {path for path, *_ in rows}}
    for path, operator, occurrence, row, column in rows:
        if not any(row == line and 0 <= column - end <= 1 for line, end in noted[path]):
            kept.setdefault((path, row, column, "_".join(operator.split("_")[:1])), []).append((operator, occurrence))
    sites = sorted(kept)
    chance.shuffle(sites)
    for site in sites:
        operator, occurrence = chance.choice(kept[site])
        text = (ROOT / site[0]).read_text("utf-8")
        changed = mutate_code(text, get_operator(operator)(), occurrence)
        if changed and (fault := fault_of(site[0], operator.partition("/")[2], text, changed)):
            yield fault


def draw_page(chance: random.Random, place: Path) -> Iterator[Fault]:
    """Faults of the page's scripts by StrykerJS."""
    subprocess.run(["npm", "install", "--silent", "--prefix", place, "@stryker-mutator/instrumenter"], check=True)
    script = Path(__file__).with_suffix(".mjs")
    every: list[tuple[str, Any]] = []
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
        if fault := fault_of(path, mutant["mutatorName"], text, text[:start] + mutant["replacement"] + text[end:]):
            yield fault


def draw(count: int, seed: int) -> None:
    """Write FAULTS: so many faults, the same ones for the same seed and tree."""
    print(f"seed {seed}")
    faults: list[Fault] = []
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        for room, share in SHARES.items():
            chance = random.Random(f"{seed} {room}")
            drawn = draw_page(chance, place) if room == "app/page" else draw_python(room, chance, place)
            faults += [fault for fault, _ in zip(drawn, range(round(share * count)), strict=False)]
    FAULTS.write_text(json.dumps([asdict(fault) for fault in faults], indent=1, ensure_ascii=False) + "\n", "utf-8")


# -- cover ---------------------------------------------------------------------------------------------------

COVERAGE = """
[run]
source = core, app
data_file = {data}
context = {file}
dynamic_context = test_function
parallel = true
sigterm = true
patch = subprocess, _exit, fork
disable_warnings = no-data-collected, module-not-measured, module-not-imported
"""


def test_files() -> list[str]:
    """All files of tests, and the modules of core with examples in their docstrings as one entry, `core`."""
    return [*(path.relative_to(ROOT).as_posix() for path in sorted((ROOT / "tests").rglob("test_*.py"))), "core"]


def covered(file: str, place: Path) -> dict[str, Any]:
    """Lines of core and app that the tests of a file run, by test where they run in its process; and its seconds."""
    import coverage

    mine = place / file.replace("/", "-")
    mine.mkdir()
    rc = mine / "rc"
    rc.write_text(COVERAGE.format(data=mine / "data", file=file))
    begin = time.monotonic()
    every = ["--all"] if has_thorough(ROOT) else []
    command = [sys.executable, "-m", "coverage", "run", f"--rcfile={rc}", "-m", "pytest", "-q", *every, file]
    subprocess.run(command, cwd=ROOT, capture_output=True)
    seconds = time.monotonic() - begin
    subprocess.run([sys.executable, "-m", "coverage", "combine", f"--rcfile={rc}", "-q"], cwd=mine, capture_output=True)
    data = coverage.CoverageData(mine / "data")
    data.read()
    lines: dict[str, dict[str, list[int]]] = {}
    for path in data.measured_files():
        name = Path(path).relative_to(ROOT).as_posix()
        for line, contexts in data.contexts_by_lineno(path).items():
            for context in contexts:
                lines.setdefault(name, {}).setdefault(context.partition("|")[2], []).append(line)
    shutil.rmtree(mine)
    return {"seconds": seconds, "lines": lines}


def cover() -> None:
    """Write COVER, one entry for each test file; entries that it has are kept."""
    COVER.parent.mkdir(exist_ok=True)
    known = json.loads(COVER.read_text()) if COVER.exists() else {}
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(CORES) as pool:
        files = [file for file in test_files() if file not in known]
        for file, result in zip(files, pool.map(lambda file: covered(file, Path(folder)), files), strict=True):
            known[file] = result
            print(f"{file}: {result['seconds']:.1f} s", flush=True)
            COVER.write_text(json.dumps(known))


# -- try -----------------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Batch:
    """Tests that one process runs: words for pytest, and how long they take without a fault [s]."""

    words: list[str]
    seconds: float


def functions_of_loops() -> dict[str, set[str]]:
    """For each module of compiled loops the functions of it and of all modules that call it, directly or not."""
    texts = {path.stem: path.read_text("utf-8") for path in (ROOT / "core" / "kernels").glob("*.py")}
    names = {stem: set(re.findall(r"^(?:def|class) (\w+)", text, re.MULTILINE)) for stem, text in texts.items()}
    users = {
        stem: {
            other for other, text in texts.items() if re.search(rf"kernels\.{stem}\b|kernels import .*\b{stem}\b", text)
        }
        for stem in texts
    }
    result: dict[str, set[str]] = {}
    for stem in texts:
        reached, new = {stem}, {stem}
        while new:
            new = {user for one in new for user in users[one]} - reached - {"__init__"}
            reached |= new
        result[stem] = {name for one in reached for name in names[one]}
    return result


def lines_that_call(names: set[str]) -> dict[str, set[int]]:
    """Lines of core outside its loops that name one of these functions of a loop."""
    result: dict[str, set[int]] = {}
    pattern = re.compile(rf"\bkernels\.({'|'.join(sorted(names))})\b")
    for path in (ROOT / "core").rglob("*.py"):
        if path.parent.name != "kernels":
            lines = {k for k, line in enumerate(path.read_text("utf-8").splitlines(), 1) if pattern.search(line)}
            if lines:
                result[path.relative_to(ROOT).as_posix()] = lines
    return result


def tests_for(fault: Fault, known: dict[str, Any]) -> list[Batch]:
    """The tests that may notice a fault, the likely and quick ones first."""
    if fault.path.startswith("app/page/"):
        word = Path(fault.path).stem
        files = [file for file in known if file.startswith("tests/page/")]
        chosen = {file: [file] for file in files}
        near = {file for file in files if word in (ROOT / file).read_text("utf-8") or file.endswith("test_modules.py")}
    else:
        lines = {fault.path: set(range(fault.line, fault.line + max(len(fault.before), 1)))}
        stem = Path(fault.path).stem
        if fault.path.startswith("core/kernels/"):
            lines = lines_that_call(functions_of_loops()[stem])
        chosen = {}
        for file, entry in known.items():
            contexts = {
                context
                for path, wanted in lines.items()
                for context, run in entry["lines"].get(path, {}).items()
                if wanted & set(run)
            }
            if "" in contexts or (contexts and file == "core"):
                chosen[file] = [file]
            elif contexts:
                chosen[file] = sorted({f"{file}::{context.rpartition('.')[2]}" for context in contexts})
        for file in known:
            if fault.path.startswith("core/kernels/") and file.startswith("tests/core/kernels/"):
                chosen[file] = [file]
        mirror = re.compile(rf"test_{re.escape(stem)}\.py$|/{re.escape(Path(fault.path).parent.name)}/")
        near = {file for file in chosen if mirror.search(file)}
    order = sorted(chosen, key=lambda file: (file not in near, known[file]["seconds"]))
    batches: list[Batch] = []
    for file in order:
        last = batches[-1] if batches else None
        if last and last.seconds + known[file]["seconds"] < BATCH:
            batches[-1] = Batch(last.words + chosen[file], last.seconds + known[file]["seconds"])
        else:
            batches.append(Batch(chosen[file], known[file]["seconds"]))
    return batches


def failed_test(checkout: Path, batch: Batch, *options: str) -> str:
    """Name of the first test of a batch that fails; empty if all pass. A run without an end has failed."""
    command = [
        ".venv/bin/python",
        "-m",
        "pytest",
        "-x",
        "-q",
        "--color=no",
        "-p",
        "no:cacheprovider",
        *options,
        *batch.words,
    ]
    with tempfile.TemporaryFile("w+") as output:
        process = subprocess.Popen(command, cwd=checkout, stdout=output, stderr=output, start_new_session=True)
        try:
            code = process.wait(LEAST + SLOWER * batch.seconds)
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.wait()
            return "no end"
        output.seek(0)
        text = output.read()
    if code in (0, 5):  # all pass; none is left of those that were chosen
        return ""
    match = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - .*)?$", text, re.MULTILINE)
    return match[1] if match else "no start"


def compiled(checkout: Path) -> bool:
    """Whether the loops compile; compiles them."""
    command = [".venv/bin/python", "-m", "pip", "install", "--quiet", "--no-build-isolation", "--no-deps", "-e", "."]
    for old in (checkout / "core" / "kernels").glob("*.so"):
        old.touch()
    subprocess.run(command, cwd=checkout, capture_output=True)
    done = subprocess.run([".venv/bin/python", "-c", "from core import kernels; assert kernels.COMPILED"], cwd=checkout)
    return done.returncode == 0


def tried(fault: Fault, checkout: Path, known: dict[str, Any]) -> dict[str, Any]:
    """Who notices a fault: of the tests of every day first, of all others then."""
    begin = time.monotonic()
    batches = tests_for(fault, known)
    fault.put_into(checkout)
    is_loop = fault.path.startswith("core/kernels/")
    result = {"noticed_by": "", "every_day": False}
    try:
        if is_loop and not compiled(checkout):
            return {"noticed_by": "the compiler", "every_day": True, "seconds": time.monotonic() - begin}
        for options in (EVERY_DAY, THOROUGH) if has_thorough(checkout) else ([],):
            for batch in batches:
                if name := failed_test(checkout, batch, *options):
                    result = {"noticed_by": name, "every_day": options is not THOROUGH}
                    break
            if result["noticed_by"]:
                break
    finally:
        subprocess.run(["git", "checkout", "--quiet", "."], cwd=checkout, check=True)
        if is_loop:
            compiled(checkout)
    if "::" in str(result["noticed_by"]) and failed_test(checkout, Batch([str(result["noticed_by"])], LEAST)):
        result["unsure"] = True
    return result | {"seconds": time.monotonic() - begin}


def has_thorough(checkout: Path) -> bool:
    return "thorough:" in (checkout / "pyproject.toml").read_text("utf-8")


def try_all(processes: int) -> None:
    """Try each fault that was not tried yet, in so many clones at once, and print the table."""
    faults = [Fault(**one) for one in json.loads(FAULTS.read_text("utf-8"))]
    known = json.loads(COVER.read_text())
    results = json.loads(TRIED.read_text()) if TRIED.exists() else {}
    clones = [ROOT / "build" / f"clone{k}" for k in range(processes)]
    for clone in clones:
        if not clone.exists():
            subprocess.run(["git", "clone", "--quiet", "--no-local", ROOT, clone], check=True)
            subprocess.run(["make", "test-setup"], cwd=clone, check=True)
    free: queue.SimpleQueue[Path] = queue.SimpleQueue()
    for clone in clones:
        free.put(clone)

    def one(key: str, fault: Fault) -> None:
        clone = free.get()
        try:
            results[key] = tried(fault, clone, known)
        except LookupError:
            results[key] = {"noticed_by": "", "gone": True}
        finally:
            free.put(clone)
        TRIED.write_text(json.dumps(results, indent=1))
        print(key, fault.path, fault.line, fault.kind, results[key], flush=True)

    with ThreadPoolExecutor(processes) as pool:
        keys = [(str(k), fault) for k, fault in enumerate(faults) if str(k) not in results]
        for future in [pool.submit(one, *key) for key in keys]:
            future.result()
    noticed = [result for result in results.values() if result["noticed_by"]]
    every_day = sum(result["every_day"] for result in noticed)
    print(f"{len(results)} faults: {len(noticed)} noticed by all tests, {every_day} by make test")


def main() -> None:
    words = sys.argv[1:]
    if words[:1] == ["draw"]:
        draw(int(words[1]), int(words[2]))
    elif words[:1] == ["cover"]:
        cover()
    elif words[:1] == ["try"]:
        try_all(int(words[1]) if words[1:] else CORES)
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
