"""The plain installation: its functions, and its messages on the others. The packages of all extras are hidden."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tomllib
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from importlib.metadata import packages_distributions
from pathlib import Path
from typing import Any

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from app.extras import MODULES

ROOT = Path(__file__).parents[2]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
# Packages of the extra `service` without which it also runs.
DISPENSABLE = {"uvloop"}
# Python's search for modules, but for the ones that are hidden: they are not there, as before any extra. For each line
# of standard input a run is forked: its arguments, its folder, and the folder for what it says.
HIDDEN = f"""
import contextlib, json, os, sys
from importlib.machinery import PathFinder

class Plain(PathFinder):
    @classmethod
    def find_spec(cls, name, path=None, target=None):
        hidden = name.partition(".")[0] in {sorted({*sum(MODULES.values(), ())})}
        return None if hidden else super().find_spec(name, path, target)

sys.meta_path[:] = [Plain if finder is PathFinder else finder for finder in sys.meta_path]
sys.argv[0] = "bench-dragon"
import core
from app.command.main import app
for name in core.__all__:
    with contextlib.suppress(core.BenchDragonError):
        getattr(core, name)
for line in sys.stdin:
    arguments, here, said = json.loads(line)
    if os.fork() == 0:
        for number in (1, 2):
            os.dup2(os.open(said + "/" + str(number), os.O_WRONLY | os.O_CREAT), number)
        os.chdir(here)
        sys.argv[1:] = arguments
        app()
    print(os.waitstatus_to_exitcode(os.wait()[1]), flush=True)
"""
Install = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture(scope="module")
def bare_install(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Install]:
    """The command as without any extra."""
    pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    with subprocess.Popen([sys.executable, "-c", HIDDEN], env=environment, **pipes) as process:

        def answer(*arguments: str, folder: Path = ROOT) -> subprocess.CompletedProcess[str]:
            text = tmp_path_factory.mktemp("said")
            print(json.dumps([arguments, str(folder), str(text)]), file=process.stdin, flush=True)
            code = int(process.stdout.readline()) if process.stdout else 1
            return subprocess.CompletedProcess(arguments, code, *((text / name).read_text() for name in "12"))

        yield answer


@pytest.mark.parametrize(
    "line",
    [
        "trajectory --stop 10",
        "collision-time",
        "minimum-pitch",
        "check examples/paper_dance.toml",
        "turn",
        "shortest-turn --benches 20",
        "turn-time --benches 20",
        "quickest-turn --benches 12",
        "maximum-head-speed --benches 20",
        "overlaps --time 412.48",
        "grade --pitch 0.4503",
        "envelope --benches 5 --stop 5",
    ],
)
def test_every_question_is_answered_without_an_extra(bare_install: Install, line: str) -> None:
    done = bare_install(*line.split(), "--json")
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("serve", "serve needs the package fastapi, which is not installed: pip install 'bench-dragon[service]'"),
        (
            "figures figures",
            "A figure needs the package matplotlib, which is not installed: pip install 'bench-dragon[figures]'",
        ),
        (
            "check no-such-file.toml --figure dance.svg",
            "--figure needs the package matplotlib, which is not installed: pip install 'bench-dragon[figures]'",
        ),
        (
            "trajectory --output dance.xlsx",
            "xlsx needs the package xlsxwriter, which is not installed: pip install 'bench-dragon[xlsx]'",
        ),
        (
            "trajectory --output dance.arrow",
            "Arrow needs the package pyarrow, which is not installed: pip install 'bench-dragon[arrow]'",
        ),
        (
            "envelope --output ground.dxf",
            "DXF needs the package ezdxf, which is not installed: pip install 'bench-dragon[dxf]'",
        ),
        (
            "maps no-such-file.toml --output dance.dxf",
            "DXF needs the package ezdxf, which is not installed: pip install 'bench-dragon[dxf]'",
        ),
        (
            "plan no-such-file.toml",
            "A plan needs the package matplotlib, which is not installed: pip install 'bench-dragon[figures]'",
        ),
        (
            "cues no-such-file.toml",
            "A card on paper needs the package matplotlib, which is not installed: pip install 'bench-dragon[figures]'",
        ),
        (
            "crew no-such-file.toml --output crew.pdf",
            "A timeline needs the package matplotlib, which is not installed: pip install 'bench-dragon[figures]'",
        ),
        ("mcp", "mcp needs the package mcp, which is not installed: pip install 'bench-dragon[mcp]'"),
        (
            "sweep run no-such-spec.toml --output folder",
            "sweep needs the package pyarrow, which is not installed: pip install 'bench-dragon[sweep]'",
        ),
        (
            "prove collision-time",
            "A proof needs the package python-flint, which is not installed: pip install 'bench-dragon[proof]'",
        ),
    ],
)
def test_what_needs_an_extra_names_it_in_one_line_and_leaves_nothing(
    bare_install: Install, line: str, message: str, tmp_path: Path
) -> None:
    done = bare_install(*line.split(), folder=tmp_path)
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"Error: {message}\n")
    assert list(tmp_path.iterdir()) == []


def test_a_workbook_is_graded_with_the_extra_only(bare_install: Install, tmp_path: Path) -> None:
    (tmp_path / "result2.xlsx").write_bytes(b"PK")
    done = bare_install("grade", "result2.xlsx", folder=tmp_path)
    words = "A workbook needs the package xlsxwriter, which is not installed: pip install 'bench-dragon[xlsx]'"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"Error: {words}\n")


def test_the_command_starts_without_what_only_an_extra_brings() -> None:
    names = sorted({*sum(MODULES.values(), ()), *DISPENSABLE})
    code = f"import sys, app.command.main; print(*(name for name in {names} if name in sys.modules))"
    loaded = subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True)
    assert loaded.split() == []


def distributions(extra: str) -> set[str]:
    """Names of what an extra installs by itself, also through other extras of ours."""
    entries: set[str] = set()
    for requirement in map(Requirement, PROJECT["optional-dependencies"][extra]):
        inner = [distributions(other) for other in requirement.extras]
        entries |= set().union(*inner) if requirement.name == PROJECT["name"] else {canonicalize_name(requirement.name)}
    return entries


@cache
def providers() -> Mapping[str, list[str]]:
    return packages_distributions()


def test_every_extra_for_users_is_known_to_the_command() -> None:
    assert set(MODULES) == set(PROJECT["optional-dependencies"]) - {"dev"}


ENGINES = pytest.param("ccd", marks=pytest.mark.engine("Box2D", "ipctk"))


@pytest.mark.parametrize("extra", [ENGINES, *sorted(MODULES.keys() - {"ccd"})])
def test_an_extra_brings_the_modules_that_it_is_asked_for(extra: str) -> None:
    brought = {canonicalize_name(name) for module in MODULES[extra] for name in providers()[module]}
    assert brought == distributions(extra) - DISPENSABLE
