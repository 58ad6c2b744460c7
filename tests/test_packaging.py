"""Promises of the distribution: versions, requirements by system, compiler flags, types, and the lock."""

from __future__ import annotations

import ast
import re
import runpy
import subprocess
import sys
import tomllib
from collections.abc import Iterable
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
from packaging.markers import default_environment
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import core
from app.service.workers import process_count
from app.settings import WORKERS_MAX, usable_cores
from core import InvalidValue
from tests.support.lock import PYTHONS

ROOT = Path(__file__).parent.parent
SETTINGS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = SETTINGS["project"]
LOCKS = {path.name: path.read_text(encoding="utf-8").splitlines() for path in ROOT.glob("requirements*.lock")}
# A locked version: the name, the version, and where it is needed; never an address.
LOCKED = re.compile(r"([A-Za-z0-9._-]+)==([0-9][A-Za-z0-9.+!]*)( ; [a-z_]+ [\w .*<>=!'()]+)?")
BUILD = runpy.run_path(str(ROOT / "setup.py"))
# Systems on which requirements may differ.
SYSTEMS = {"linux": "Linux", "darwin": "Darwin", "win32": "Windows"}
# In Python's library on POSIX systems alone.
POSIX_ONLY = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "syslog", "termios", "tty"}
# Flags that let a compiler give other digits than the uncompiled files, or than another machine.
OTHER_DIGITS = ("-ffast-math", "-Ofast", "-march", "-mtune", "/fp:fast", "/fp:contract", "/arch")
GCC = "gcc (Debian 12.2.0-14) 12.2.0\nCopyright (C) 2022 Free Software Foundation, Inc.\n"
APPLE = "Apple clang version 16.0.0 (clang-1600.0.26.6)\nTarget: arm64-apple-darwin24.3.0\n"

pytestmark = pytest.mark.uncompiled


def requirements(system: str, extra: str = "") -> set[str]:
    """Names of what is required on a system, for an extra or without one."""
    environment = {**default_environment(), "sys_platform": system, "platform_system": SYSTEMS[system]}
    wanted = map(Requirement, PROJECT["optional-dependencies"][extra] if extra else PROJECT["dependencies"])
    return {one.name for one in wanted if not one.marker or one.marker.evaluate({**environment, "extra": extra})}


def test_the_version_is_that_of_the_installed_distribution() -> None:
    assert core.__version__ == version("bench-dragon") == PROJECT["version"]


def test_asking_for_the_version_alone_reads_it() -> None:
    code = "import sys, core; print('importlib.metadata' in sys.modules); core.__version__"
    assert subprocess.check_output([sys.executable, "-c", code], cwd=ROOT, text=True) == "False\n"


@pytest.mark.parametrize("package", ["app", "core"])
def test_types_and_data_go_with_the_package(package: str) -> None:
    package_data = SETTINGS["tool"]["setuptools"]["package-data"]
    folders = {ROOT / name.replace(".", "/"): patterns for name, patterns in package_data.items()}
    packaged = {path for folder, patterns in folders.items() for pattern in patterns for path in folder.glob(pattern)}
    files = {path for path in (ROOT / package).rglob("*") if path.is_file()}
    data = {path for path in files if path.suffix not in (".py", ".pyc", ".so", ".pyd")}
    assert ROOT / package / "py.typed" in data
    assert data - packaged == set()


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_plain_installation_is_the_same_on_every_system(system: str) -> None:
    names = requirements(system)
    assert names == requirements("linux")
    assert "numpy" in names
    assert names & {"fastapi", "matplotlib", "starlette", "uvicorn", "uvloop", "XlsxWriter"} == set()


@pytest.mark.parametrize(("system", "has_uvloop"), [("linux", True), ("darwin", True), ("win32", False)])
def test_the_service_takes_uvloop_where_there_is_one(system: str, has_uvloop: bool) -> None:
    names = requirements(system, "service")
    assert {"fastapi", "uvicorn"} < names
    assert ("uvloop" in names) is has_uvloop


def locked(*files: str) -> dict[str, str]:
    """Versions in lock files by normalised name."""
    rows = [LOCKED.fullmatch(line) for file in files for line in LOCKS[file] if not line.startswith("#")]
    return {canonicalize_name(row[1]): row[2] for row in rows if row}


def unfit(wanted: Iterable[Requirement], versions: dict[str, str]) -> list[Requirement]:
    """Requirements, this distribution's own extras left aside, of which no locked version fits."""
    others = [one for one in wanted if one.name != PROJECT["name"]]
    assert others
    return [one for one in others if not one.specifier.contains(versions.get(canonicalize_name(one.name), ""))]


@pytest.mark.parametrize("file", LOCKS)
def test_a_lock_names_packages_and_versions_only(file: str) -> None:
    assert [line for line in LOCKS[file] if not line.startswith("# ") and not LOCKED.fullmatch(line)] == []


def test_the_digests_are_of_the_versions_in_the_lock() -> None:
    lines = re.sub(r" \\\n\s+", " ", (ROOT / "requirements.hashes").read_text(encoding="utf-8")).splitlines()
    digests = dict(line.split(" --hash=", 1) for line in lines)
    assert list(digests) == [line for line in LOCKS["requirements.lock"] if not line.startswith("# ")]
    assert all(re.fullmatch(r"sha256:[0-9a-f]{64}( --hash=sha256:[0-9a-f]{64})*", each) for each in digests.values())


def test_the_locks_hold_a_version_that_fits_of_every_requirement() -> None:
    extras, groups = PROJECT["optional-dependencies"], SETTINGS["dependency-groups"]
    service = [*PROJECT["dependencies"], *groups["tools"]]
    for extra in ("service", "sweep", "arrow", "dxf", "film", "figures", "xlsx"):
        service += extras[extra]
    assert unfit(map(Requirement, service), locked("requirements.lock")) == []
    every = locked("requirements.lock", "requirements-test.lock", "requirements-ccd.lock")
    assert unfit([one for group in extras.values() for one in map(Requirement, group)], every) == []
    assert unfit(map(Requirement, groups["dist"]), locked("requirements-dist.lock")) == []


def test_the_service_is_installed_without_what_only_tests_need() -> None:
    assert locked("requirements.lock").keys() & {"pytest", "playwright", "hypothesis", "mypy", "dask", "box2d"} == set()


def test_every_python_that_is_named_gets_a_wheel() -> None:
    supported = [one.rpartition(" ")[2] for one in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", one)]
    assert supported == list(PYTHONS)
    assert SETTINGS["tool"]["cibuildwheel"]["build"] == [f"cp{one.replace('.', '')}-*" for one in supported]


@pytest.mark.parametrize("compiler", BUILD["FLAGS"])
def test_no_flag_changes_a_digit(compiler: str) -> None:
    flags = BUILD["FLAGS"][compiler]
    assert [flag for flag in flags if flag.startswith(OTHER_DIGITS)] == []
    assert "/fp:precise" in flags if compiler == "msvc" else "-ffp-contract=off" in flags


@pytest.mark.parametrize("compiler", BUILD["FLAGS"])
def test_every_compiler_gets_flags_of_its_own_kind(compiler: str) -> None:
    flags = BUILD["FLAGS"][compiler]
    assert {flag[0] for flag in flags} == {"/" if compiler == "msvc" else "-"}
    assert any(flag.startswith("-finline-limit") for flag in flags) is (compiler == "gcc")


@pytest.mark.parametrize(
    ("kind", "says", "compiler"),
    [
        ("unix", GCC, "gcc"),
        ("mingw32", GCC, "gcc"),
        ("unix", APPLE, "clang"),
        ("unix", "icx 2025.0\n", "clang"),
        ("msvc", "", "msvc"),
    ],
    ids=["gcc", "mingw", "apple", "another", "msvc"],
)
def test_a_compiler_is_known_by_what_it_says(kind: str, says: str, compiler: str) -> None:
    speaks = [sys.executable, "-c", f"print({says!r})"]
    assert BUILD["family"](kind, speaks) == compiler


def test_without_a_compiler_the_build_goes_on() -> None:
    assert BUILD["family"]("unix", ["no-such-compiler"]) == "clang"


@pytest.mark.parametrize(
    ("platform", "query", "count"),
    [
        ("linux", 3, 3),
        ("darwin", 3, 3),
        ("win32", 1, 1),
        ("win32", None, 1),
        ("linux", None, min(usable_cores(), WORKERS_MAX)),
    ],
)
def test_the_service_has_as_many_processes_as_asked_or_as_cores(platform: str, query: int | None, count: int) -> None:
    assert process_count(query, platform) == count


def test_on_windows_several_processes_are_refused_with_the_reason() -> None:
    with pytest.raises(InvalidValue, match="--workers must be 1 on Windows, where the service is one process, got 4"):
        process_count(4, "win32")


def test_cores_are_counted_where_the_system_has_no_affinity() -> None:
    code = "import os; del os.sched_getaffinity; from app.settings import usable_cores; print(usable_cores())"
    assert int(subprocess.check_output([sys.executable, "-c", code], cwd=ROOT)) >= 1


def imported(tree: ast.AST) -> set[str]:
    """First parts of all imported names."""
    nodes: list[Any] = [node for node in ast.walk(tree) if isinstance(node, (ast.Import, ast.ImportFrom))]
    names = [[node.module] if isinstance(node, ast.ImportFrom) else [one.name for one in node.names] for node in nodes]
    return {name.partition(".")[0] for group in names for name in group if name}


def test_nothing_is_imported_that_windows_lacks() -> None:
    files = [path for package in ("app", "core") for path in (ROOT / package).rglob("*.py")]
    assert len(files) > 50
    assert {path for path in files if imported(ast.parse(path.read_text(encoding="utf-8"))) & POSIX_ONLY} == set()
