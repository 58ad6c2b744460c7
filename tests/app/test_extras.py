"""The plain installation: its functions, and its messages on the others. The packages of all extras are hidden."""

import json
import os
import subprocess
import sys
import tomllib
from functools import cache
from importlib.metadata import packages_distributions

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from app.extras import MODULES
from tests.conftest import ROOT
from tests.test_architecture import printed

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
import app.questions.registry  # Before the forks, each of which would take half a second for it.
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
ANSWERED = """
trajectory --stop 10
collision-time
minimum-pitch
check examples/paper_dance.toml
turn
shortest-turn --benches 20
turn-time --benches 20
quickest-turn --benches 12
maximum-head-speed --benches 20
overlaps --time 412.48
grade --pitch 0.4503
envelope --benches 5 --stop 5
"""
# The extra, its package, and what needs it; no input is read before.
LACKING = """
service  fastapi       serve
figures  matplotlib    figures figures
figures  matplotlib    check no-such-file.toml --figure dance.svg
xlsx     xlsxwriter    trajectory --output dance.xlsx
xlsx     xlsxwriter    grade result2.xlsx
arrow    pyarrow       trajectory --output dance.arrow
dxf      ezdxf         envelope --output ground.dxf
dxf      ezdxf         maps no-such-file.toml --output dance.dxf
paper    typst         plan no-such-file.toml
paper    typst         safety-sheet no-such-file.toml
paper    typst         cues no-such-file.toml
paper    typst         crew no-such-file.toml --output crew.pdf
service  fastapi       mcp
sweep    pyarrow       sweep run no-such-spec.toml --output folder
proof    python-flint  prove collision-time
"""


@pytest.fixture(scope="module")
def bare_install(tmp_path_factory):
    """The command as without any extra."""
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    with subprocess.Popen([sys.executable, "-c", HIDDEN], env=environment, **pipes) as process:

        def answer(*arguments, folder=ROOT):
            text = tmp_path_factory.mktemp("said")
            print(json.dumps([arguments, str(folder), str(text)]), file=process.stdin, flush=True)
            code = int(process.stdout.readline())
            return subprocess.CompletedProcess(arguments, code, *((text / name).read_text() for name in "12"))

        yield answer


@pytest.mark.parametrize("line", ANSWERED.strip().splitlines())
def test_every_question_is_answered_without_an_extra(bare_install, line):
    done = bare_install(*line.split(), "--json")
    assert done.returncode == 0
    assert done.stderr == ""
    assert json.loads(done.stdout)


@pytest.mark.parametrize("row", LACKING.strip().splitlines())
def test_what_needs_an_extra_names_it_in_one_line_and_leaves_nothing(bare_install, row, tmp_path):
    extra, package, *words = row.split()
    (tmp_path / "result2.xlsx").write_bytes(b"PK")
    done = bare_install(*words, folder=tmp_path)
    assert (done.returncode, done.stdout, done.stderr.count("\n")) == (2, "", 1)
    needed = f"needs the package {package}, which is not installed: pip install 'bench-dragon[{extra}]'\n"
    assert done.stderr.endswith(needed)
    assert [path.name for path in tmp_path.iterdir()] == ["result2.xlsx"]


def test_the_command_starts_without_what_only_an_extra_brings():
    names = sorted({*sum(MODULES.values(), ()), *DISPENSABLE})
    code = f"import sys, app.command.main; print(*(name for name in {names} if name in sys.modules))"
    assert printed(code) == ""


def distributions(extra):
    """Names of what an extra installs by itself, also through other extras of ours."""
    entries = set()
    for requirement in map(Requirement, PROJECT["optional-dependencies"][extra]):
        ours = requirement.name == PROJECT["name"]
        for names in map(distributions, requirement.extras) if ours else [{canonicalize_name(requirement.name)}]:
            entries |= names
    return entries


providers = cache(packages_distributions)


def test_every_extra_for_users_is_known_to_the_command():
    assert MODULES.keys() == PROJECT["optional-dependencies"].keys() - {"dev"}


ENGINES = pytest.param("ccd", marks=pytest.mark.engine("Box2D", "ipctk"))


@pytest.mark.parametrize("extra", [ENGINES, *sorted(MODULES.keys() - {"ccd"})])
def test_an_extra_brings_the_modules_that_it_is_asked_for(extra):
    brought = {canonicalize_name(name) for module in MODULES[extra] for name in providers()[module]}
    assert brought == distributions(extra) - DISPENSABLE
