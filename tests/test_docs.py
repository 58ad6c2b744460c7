"""README and docs/ are true: links lead to files, claims name tests, Python and commands print what is shown."""

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
import core.proof
from app.command.main import MODULE_OF
from app.questions.registry import QUESTIONS
from app.settings import Settings
from tests.conftest import ROOT
from tests.support.command import PATIENCE, bin_folder
from tests.support.near import assert_near

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


def blocks(language):
    """Every fenced block of a language, also in a list, with its page and line; the first of equal ones."""
    fences = re.compile(rf"^( *)```{language}\n(.*?)^\1```", re.DOTALL | re.MULTILINE)
    places = {}
    for page, text in PAGES.items():
        for result in fences.finditer(text):
            places.setdefault(textwrap.dedent(result[2]), f"{page}:{text.count(chr(10), 0, result.start()) + 2}")
    return [(place, block) for block, place in places.items()]


SNIPPETS = blocks("python")
# A kit takes seconds: tests/app/contest/test_kit.py compares these with the one that it writes.
KITS = [block for block in blocks("console") if block[1].startswith("$ bench-dragon contest kit ")]
SESSIONS = [block for block in blocks("console") if block not in KITS]
# The others are sweeps, which tests/app/sweeps/test_spec.py reads.
WISH = re.compile(r"^(figures|gates) = ", re.MULTILINE)
WISHES = [block for block in blocks("toml") if WISH.search(block[1])]
# docs/performances.md asks about its dances by their name in examples/.
SEVERAL = [block for block in blocks("toml") if "[[dances]]" in block[1]]
DANCES = [block for block in blocks("toml") if "[over]" not in block[1] and block not in WISHES + SEVERAL]


def linked(page):
    """The files to which a page leads, from the root."""
    folder = (ROOT / page).parent
    return {os.path.relpath(folder / link, ROOT) for other, link in LINKS if other == page}


def test_readme_is_short_and_each_readme_leads_to_the_other_and_the_english_one_to_every_page():
    assert PAGES["README.md"].count("\n") < README_LINES_MOST
    assert "README.md" in linked("README.zh.md")
    assert PAGES.keys() - {"README.md", "SECURITY.md"} <= linked("README.md")
    # And the map to every page.
    assert {page for page in PAGES if page.startswith("docs/")} - {"docs/README.md"} <= linked("docs/README.md")


def test_every_call_command_and_function_stands_on_its_page():
    calls = {question.path.partition(".")[0] for question in QUESTIONS.values()}
    functions = {f"`{name}" for name in core.__all__ if inspect.isfunction(getattr(core, name))}
    commands = {f"| `{command}" for command in MODULE_OF}
    for page, names in (("http", calls), ("command", commands), ("library", functions)):
        assert {name for name in names if name not in PAGES[f"docs/{page}.md"]} == set()


def test_the_reference_has_an_example_for_every_public_name_of_the_library():
    public = [getattr(module, name) for module in (core, core.proof) for name in module.__all__]
    # Certificate and Piece are made of other types; pytest runs the examples.
    described = [value for value in public if inspect.isclass(value) or inspect.isfunction(value)]
    assert [value for value in described if ">>> " not in (value.__doc__ or "")] == []
    assert len(described) == len(public) - 2


def test_the_gallery_has_twenty_small_pictures_each_above_its_code():
    pictures = re.findall(r"\]\((gallery/\w+\.png)\)\n\n```python\n", PAGES["docs/gallery.md"])
    assert {path.relative_to(DOCS).as_posix() for path in DOCS.glob("gallery/*")} == set(pictures)
    assert len(pictures) == 20
    assert all((DOCS / picture).stat().st_size < 60_000 for picture in pictures)


def test_each_claim_names_a_test_and_all_these_exist():
    rows = [line for line in PAGES["docs/claims.md"].splitlines() if line.startswith("| ")][1:]
    assert len(rows) > 10
    assert all("test_" in row for row in rows)
    for test, file in LINKED_TESTS:
        assert f"def {test}(" in (DOCS / file).read_text(encoding="utf-8")


def test_every_link_leads_to_a_file():
    assert [(page, link) for page, link in LINKS if not (ROOT / page).parent.joinpath(link).exists()] == []


def test_every_limit_of_the_service_stands_with_its_default():
    rows = re.findall(r"^\| `BENCH_DRAGON_(\w+)` \| (\w+) \|", PAGES["docs/operations.md"], re.MULTILINE)
    stated = {name.lower(): "" if value == "none" else json.loads(value) for name, value in rows}
    defaults = Settings().model_dump()
    assert stated == {name: "" if value is None else value for name, value in defaults.items()}


# The pages whose commands every run tries; those of the others take a minute.
SLOW = re.compile(r"sweeps|gallery")
QUICK = ("README", "docs/command.md", "docs/http.md", "docs/performances.md", "docs/jobs.md")


def of_each(blocks):
    """A case for each block, named by its place."""
    cases = []
    for place, text in blocks:
        marks = [pytest.mark.curl] if re.search(r"(\$|\|) curl ", text) else []
        is_quick = place.startswith(QUICK) or (text.startswith(">>> ") and not SLOW.search(place))
        marks += [] if is_quick else [pytest.mark.thorough]
        cases.append(pytest.param(text, marks=marks, id=place))
    return pytest.mark.parametrize("text", cases)


@pytest.fixture
def folder(tmp_path):
    """A folder from which examples/ is seen as from the root."""
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    return tmp_path


@of_each(SNIPPETS)
def test_python_gives_what_is_printed_below_it(text):
    values = []
    test = doctest.DocTestParser().get_doctest(text, {}, "docs", "docs", 0)
    assert len(test.examples) == text.count(">>> ") > 0
    doctest.DocTestRunner().run(test, out=values.append)
    assert "".join(values) == ""


@of_each(SESSIONS)
def test_a_command_gives_what_is_printed_below_it(text, server, folder):
    for turn in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        lines = turn.splitlines()
        length = next(number for number, line in enumerate(lines, 1) if not line.endswith(("\\", "[")))
        command = "\n".join(lines[:length])
        expected = "\n".join(lines[length:])
        done = run(command.replace("localhost:8000", urlsplit(server).netloc), folder)
        assert (done.returncode != 0) is expected.startswith(("Error: ", "Refused: ")), done.stdout
        assert_alike(done.stdout, expected)


@of_each(DANCES + WISHES)
def test_a_dance_that_is_shown_passes_its_check_and_a_wish_has_proposals(text, folder):
    (folder / "shown.toml").write_text(text, encoding="utf-8")
    if WISH.search(text):
        assert run("bench-dragon propose shown.toml", folder).stdout.startswith("The best ")
    else:
        assert run("bench-dragon check shown.toml", folder).stdout.startswith("Passes. ")


@of_each(SEVERAL)
def test_dances_that_are_shown_are_those_of_an_example(text):
    assert [path.name for path in (ROOT / "examples").glob("*.toml") if text in path.read_text("utf-8")] != []


@pytest.mark.parametrize("values, command", RESULTS, ids=[command for _, command in RESULTS])
def test_a_result_is_printed_by_the_command_beside_it(values, command, folder):
    printed = run(command, folder).stdout
    for value in NUMBER.findall(values):
        digits = len(value.partition(".")[2])
        assert value in {f"{float(number):.{digits}f}" for number in NUMBER.findall(printed)}, printed


def run(command, folder):
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


def assert_alike(output, expected):
    """The same text and, but for rounding, the same numbers; `...` stands for anything, and spaces do not count."""
    patterns = []
    numbers = []
    for part in re.split(r"(\.\.\.|\s+|-?\d+\.\d+(?:e-?\d+)?)", expected.strip()):
        if NUMBER.fullmatch(part):
            numbers.append(float(part))
            patterns.append(f"({NUMBER.pattern})")
        else:
            patterns.append(".*?" if part == "..." else r"\s*" if part.isspace() else re.escape(part))
    match = re.fullmatch("".join(patterns), output.strip(), re.DOTALL)
    assert match, f"expected:\n{expected}\ngot:\n{output}"
    assert_near(list(map(float, match.groups())), numbers, ROUNDING)
