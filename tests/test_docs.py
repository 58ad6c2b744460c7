"""README and docs/ are true: links lead to files, claims name tests, Python and commands print what is shown."""

from __future__ import annotations

import doctest
import inspect
import json
import os
import re
import subprocess
import sys
import textwrap
from pathlib import Path
from urllib.parse import urlsplit

import pytest

import core
from app.command.main import MODULE_OF
from app.questions.registry import QUESTIONS
from app.settings import Settings
from tests.support.command import PATIENCE, bin_folder

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
DOORS = ("README.md", "README.zh.md", "CONTRIBUTING.md", "SECURITY.md")
FILES = [*(ROOT / name for name in DOORS), *sorted(DOCS.glob("*.md"))]
PAGES = {path.relative_to(ROOT).as_posix(): path.read_text(encoding="utf-8") for path in FILES}
README_LINES_MOST = 250
WIDTH = "120"  # of the terminal for which the outputs are shown [characters]
# Other processors round the last digit of a sine differently. The time of a least clearance changes most, because the
# clearance is flat there: by up to 1e-8 s; all other numbers change less [s, m, rad, m/s].
ROUNDING = 1e-8

LINKED_TESTS = re.findall(r"\[(test_\w+)\]\(([\w/.]+)\)", PAGES["docs/claims.md"])
LINKS = sorted(
    {
        (page, link)
        for page, text in PAGES.items()
        for link in re.findall(r'(?:\]\(|src=")((?!https?:)[^)"#\s]+)[)"]', text)
    }
)
# Rows of README's table of results: the value, then the command that prints it.
RESULTS = re.findall(r"^\|[^|]+\| ([^|]+) \| `(bench-dragon [^`]+)` \|$", PAGES["README.md"], re.MULTILINE)
NUMBER = re.compile(r"-?\d+\.\d+(?:e-?\d+)?")


def blocks(language: str) -> list[tuple[str, str]]:
    """Every fenced block of a language, also in a list, with its page and line; the first of equal ones."""
    fences = re.compile(rf"^( *)```{language}\n(.*?)^\1```", re.DOTALL | re.MULTILINE)
    places: dict[str, str] = {}
    for page, text in PAGES.items():
        for result in fences.finditer(text):
            places.setdefault(textwrap.dedent(result[2]), f"{page}:{text.count(chr(10), 0, result.start()) + 2}")
    return [(place, block) for block, place in places.items()]


SNIPPETS = blocks("python")
# A kit takes seconds: tests/app/contest/test_kit.py compares these with the one that it writes.
KITS = [block for block in blocks("console") if block[1].startswith("$ bench-dragon contest kit ")]
SESSIONS = [block for block in blocks("console") if block not in KITS]
# The others are sweeps, which tests/app/sweeps/test_spec.py reads.
WISHES = [block for block in blocks("toml") if re.search(r"^(figures|gates) = ", block[1], re.MULTILINE)]
# docs/performances.md asks about its dances by their name in examples/.
SEVERAL = [block for block in blocks("toml") if "[[dances]]" in block[1]]
DANCES = [block for block in blocks("toml") if "[over]" not in block[1] and block not in WISHES + SEVERAL]


def test_readme_is_short() -> None:
    assert PAGES["README.md"].count("\n") < README_LINES_MOST


def test_each_readme_leads_to_the_other_and_the_english_one_to_every_page() -> None:
    assert ("README.zh.md", "README.md") in LINKS
    linked = {link for page, link in LINKS if page == "README.md"}
    assert set(PAGES) - {"README.md", "SECURITY.md"} <= linked


def test_the_map_leads_to_every_page() -> None:
    linked = {f"docs/{link}" for page, link in LINKS if page == "docs/README.md"}
    assert {page for page in PAGES if page.startswith("docs/")} - {"docs/README.md"} <= linked


def test_the_house_is_drawn_as_it_stands() -> None:
    picture = re.search(r"^```\n(core/.*?)^```", PAGES["docs/architecture.md"], re.DOTALL | re.MULTILINE)
    assert picture
    drawn: dict[str, set[str]] = {}
    for line in picture[1].splitlines():
        names = re.findall(r"[\w.]+(?:\.py|/)", re.split(r"(?<=\S)  +", line)[0])
        if not line.startswith(" "):
            drawn[floor := names[0]] = set()
        elif re.match(r"  \S", line):
            drawn[floor] |= set(names)
    assert all((ROOT / floor / name).exists() for floor, names in drawn.items() for name in names)
    rooms = {f"{path.parent.name}/" for path in (ROOT / "core").glob("*/__init__.py")}
    assert drawn["core/"] == rooms | {path.name for path in (ROOT / "core").glob("*.py")} - {"__init__.py"}


def test_every_call_command_and_function_stands_on_its_page() -> None:
    calls = {question.path.partition(".")[0] for question in QUESTIONS.values()}
    assert {call for call in calls if call not in PAGES["docs/http.md"]} == set()
    assert {command for command in MODULE_OF if f"| `{command}" not in PAGES["docs/command.md"]} == set()
    functions = {name for name in core.__all__ if inspect.isfunction(getattr(core, name))}
    assert {name for name in functions if f"`{name}" not in PAGES["docs/library.md"]} == set()


def test_each_claim_names_a_test() -> None:
    rows = [line for line in PAGES["docs/claims.md"].splitlines() if line.startswith("| ")][1:]
    assert len(rows) > 10
    assert all("test_" in row for row in rows)


def test_every_test_that_a_claim_names_exists() -> None:
    texts = {file: (DOCS / file).read_text(encoding="utf-8") for _, file in LINKED_TESTS}
    assert [test for test, file in LINKED_TESTS if not re.search(rf"^def {test}\(", texts[file], re.MULTILINE)] == []


def test_every_link_leads_to_a_file() -> None:
    assert [(page, link) for page, link in LINKS if not (ROOT / page).parent.joinpath(link).exists()] == []


def test_every_limit_of_the_service_stands_with_its_default() -> None:
    rows = re.findall(r"^\| `BENCH_DRAGON_(\w+)` \| (\w+) \|", PAGES["docs/operations.md"], re.MULTILINE)
    stated = {name.lower(): None if value == "none" else json.loads(value) for name, value in rows}
    assert stated == {name: None if value == "" else value for name, value in Settings().model_dump().items()}


@pytest.mark.parametrize(("place", "source"), SNIPPETS, ids=[place for place, _ in SNIPPETS])
def test_python_gives_what_is_printed_below_it(place: str, source: str) -> None:
    values: list[str] = []
    test = doctest.DocTestParser().get_doctest(source, {}, place, place, 0)
    assert len(test.examples) == source.count(">>> ") > 0
    doctest.DocTestRunner().run(test, out=values.append)
    assert "".join(values) == ""


@pytest.mark.parametrize(
    ("place", "session"),
    [
        pytest.param(*each, id=each[0], marks=[pytest.mark.curl] if re.search(r"(\$|\|) curl ", each[1]) else [])
        for each in SESSIONS
    ],
)
def test_a_command_gives_what_is_printed_below_it(place: str, session: str, server: str, tmp_path: Path) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    for turn in re.split(r"^\$ ", session, flags=re.MULTILINE)[1:]:
        lines = turn.splitlines()
        length = next(number for number, line in enumerate(lines, 1) if not line.endswith(("\\", "[")))
        command, expected = "\n".join(lines[:length]), "\n".join(lines[length:])
        done = run(command.replace("localhost:8000", urlsplit(server).netloc), tmp_path)
        assert (done.returncode != 0) is expected.startswith(("Error: ", "Refused: ")), done.stdout
        assert_alike(done.stdout, expected)


@pytest.mark.parametrize(("place", "dance"), DANCES, ids=[place for place, _ in DANCES])
def test_a_dance_that_is_shown_passes_its_check(place: str, dance: str, tmp_path: Path) -> None:
    (tmp_path / "dance.toml").write_text(dance, encoding="utf-8")
    assert run("bench-dragon check dance.toml", tmp_path).stdout.startswith("Passes. ")


@pytest.mark.parametrize(("place", "dances"), SEVERAL, ids=[place for place, _ in SEVERAL])
def test_dances_that_are_shown_are_those_of_an_example(place: str, dances: str) -> None:
    assert [path.name for path in (ROOT / "examples").glob("*.toml") if dances in path.read_text("utf-8")] != []


@pytest.mark.parametrize(("place", "wish"), WISHES, ids=[place for place, _ in WISHES])
def test_a_wish_that_is_shown_has_proposals(place: str, wish: str, tmp_path: Path) -> None:
    (tmp_path / "wish.toml").write_text(wish, encoding="utf-8")
    assert run("bench-dragon propose wish.toml", tmp_path).stdout.startswith("The best ")


@pytest.mark.parametrize(("values", "command"), RESULTS, ids=[command for _, command in RESULTS])
def test_a_result_is_printed_by_the_command_beside_it(values: str, command: str, tmp_path: Path) -> None:
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    printed = run(command, tmp_path).stdout
    for value in NUMBER.findall(values):
        digits = len(value.partition(".")[2])
        assert value in {f"{float(number):.{digits}f}" for number in NUMBER.findall(printed)}, printed


def run(command: str, folder: Path) -> subprocess.CompletedProcess[str]:
    """A command of a shell, with errors among its output, as a reader types it."""
    path = os.pathsep.join([str(bin_folder()), str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = {**os.environ, "PATH": path, "COLUMNS": WIDTH}
    return subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=PATIENCE,
    )


def assert_alike(output: str, expected: str) -> None:
    """The same text and, but for rounding, the same numbers; `...` stands for anything, and spaces do not count."""
    patterns, numbers = [], []
    for part in re.split(r"(\.\.\.|\s+|-?\d+\.\d+(?:e-?\d+)?)", expected.strip()):
        if NUMBER.fullmatch(part):
            numbers.append(float(part))
            patterns.append(f"({NUMBER.pattern})")
        else:
            patterns.append(".*?" if part == "..." else r"\s*" if part.isspace() else re.escape(part))
    match = re.fullmatch("".join(patterns), output.strip(), re.DOTALL)
    assert match, f"expected:\n{expected}\ngot:\n{output}"
    assert list(map(float, match.groups())) == pytest.approx(numbers, rel=0, abs=ROUNDING)
