"""Promises of the distribution: versions, requirements by system, compiler flags, types, and the lock."""

import re
import runpy
import sys
import sysconfig
import tomllib
from importlib.metadata import version
from itertools import chain
from pathlib import Path

import pytest
from packaging.markers import default_environment
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

import core
from app.service.workers import process_count
from app.settings import WORKERS_MAX
from core.threads import usable_cores
from tests.conftest import ROOT
from tests.support.lock import PYTHONS
from tests.support.refused import refused
from tests.test_architecture import MODULES, importers, printed

SETTINGS = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = SETTINGS["project"]
LOCKS = {path.name: path.read_text(encoding="utf-8").splitlines() for path in ROOT.glob("requirements*.lock")}
# A locked version: the name, the version, and where it is needed; never an address.
LOCKED = re.compile(r"([A-Za-z0-9._-]+)==([0-9][A-Za-z0-9.+!]*)( ; [a-z_]+ [\w .*<>=!'()]+)?")
# Systems on which requirements may differ.
SYSTEMS = {"linux": "Linux", "darwin": "Darwin", "win32": "Windows"}
# In Python's library on POSIX systems alone.
POSIX_ONLY = {"fcntl", "grp", "posix", "pty", "pwd", "resource", "syslog", "termios", "tty"}
# Flags that let a compiler give other digits than the uncompiled files, or than another machine.
OTHER_DIGITS = ("-ffast-math", "-Ofast", "-march", "-mtune", "/fp:fast", "/fp:contract", "/arch")
GCC = "gcc (Debian 12.2.0-14) 12.2.0\nCopyright (C) 2022 Free Software Foundation, Inc.\n"
APPLE = "Apple clang version 16.0.0 (clang-1600.0.26.6)\nTarget: arm64-apple-darwin24.3.0\n"

pytestmark = pytest.mark.uncompiled


def requirements(system, extra=""):
    """Names of what is required on a system, for an extra or without one."""
    environment = default_environment() | {"sys_platform": system, "platform_system": SYSTEMS[system], "extra": extra}
    wanted = map(Requirement, PROJECT["optional-dependencies"][extra] if extra else PROJECT["dependencies"])
    return {each.name for each in wanted if not each.marker or each.marker.evaluate(environment)}


def test_the_version_is_that_of_the_installed_distribution_and_read_only_when_it_is_asked_for():
    assert core.__version__ == version("bench-dragon") == PROJECT["version"]
    assert printed("import sys, core; print('importlib.metadata' in sys.modules); core.__version__") == "False"


@pytest.mark.parametrize("package", ["app", "core"])
def test_types_and_data_go_with_the_package(package):
    patterns = SETTINGS["tool"]["setuptools"]["package-data"].items()
    globs = [(ROOT / name.replace(".", "/")).glob(pattern) for name, group in patterns for pattern in group]
    files = {path for path in (ROOT / package).rglob("*") if path.is_file()}
    data = {path for path in files if path.suffix not in (".py", ".pyc", ".so", ".pyd")}
    assert ROOT / package / "py.typed" in data
    assert data - set(chain(*globs)) == set()


@pytest.mark.parametrize("system", SYSTEMS)
def test_the_plain_installation_is_the_same_on_every_system_and_the_service_takes_uvloop_where_it_is(system):
    names = requirements(system)
    service = requirements(system, "service")
    assert names == requirements("linux")
    assert "numpy" in names
    assert names & {"fastapi", "matplotlib", "starlette", "uvicorn", "uvloop", "XlsxWriter"} == set()
    assert {"fastapi", "uvicorn"} < service
    assert ("uvloop" in service) is (system != "win32")


def locked(*files):
    """Versions in lock files by normalised name."""
    rows = [LOCKED.fullmatch(line) for file in files for line in LOCKS[file] if not line.startswith("#")]
    return {canonicalize_name(row[1]): row[2] for row in rows if row}


def unfit(wanted, versions):
    """Requirements, this distribution's own extras left aside, of which no locked version fits."""
    others = [each for each in map(Requirement, wanted) if each.name != PROJECT["name"]]
    assert others
    return [each for each in others if not each.specifier.contains(versions.get(canonicalize_name(each.name), ""))]


def test_the_digests_are_of_the_versions_in_the_lock():
    lines = re.sub(r" \\\n\s+", " ", (ROOT / "requirements.hashes").read_text(encoding="utf-8")).splitlines()
    digests = dict(line.split(" --hash=", 1) for line in lines)
    assert list(digests) == [line for line in LOCKS["requirements.lock"] if not line.startswith("# ")]
    assert all(re.fullmatch(r"sha256:[0-9a-f]{64}( --hash=sha256:[0-9a-f]{64})*", each) for each in digests.values())


def test_the_locks_hold_a_version_that_fits_of_every_requirement():
    extras = PROJECT["optional-dependencies"]
    groups = SETTINGS["dependency-groups"]
    service = chain(*map(extras.get, ["service", "sweep", "arrow", "dxf", "film", "figures", "xlsx"]))
    assert unfit([*PROJECT["dependencies"], *groups["tools"], *service], locked("requirements.lock")) == []
    every = locked("requirements.lock", "requirements-test.lock", "requirements-ccd.lock")
    assert unfit(chain(*extras.values()), every) == []
    assert unfit(groups["dist"], locked("requirements-dist.lock")) == []


def test_the_service_is_installed_without_what_only_tests_need():
    assert locked("requirements.lock").keys() & {"pytest", "playwright", "hypothesis", "mypy", "dask", "box2d"} == set()


def test_every_python_that_is_named_gets_a_wheel():
    supported = [one.rpartition(" ")[2] for one in PROJECT["classifiers"] if re.search(r":: 3\.\d+$", one)]
    assert supported == list(PYTHONS)
    assert SETTINGS["tool"]["cibuildwheel"]["build"] == [f"cp{one.replace('.', '')}-*" for one in supported]


@pytest.fixture(scope="module")
def build():
    return runpy.run_path(str(ROOT / "setup.py"))


def test_no_flag_changes_a_digit_and_every_compiler_gets_flags_of_its_own_kind(build):
    for compiler, flags in build["FLAGS"].items():
        for_msvc = compiler == "msvc"
        assert [flag for flag in flags if flag.startswith(OTHER_DIGITS)] == []
        assert ("/fp:precise" if for_msvc else "-ffp-contract=off") in flags
        assert {flag[0] for flag in flags} == {"/" if for_msvc else "-"}
        assert any(flag.startswith("-finline-limit") for flag in flags) is (compiler == "gcc")


@pytest.mark.parametrize(
    "kind, says, compiler",
    [
        ("unix", GCC, "gcc"),
        ("mingw32", GCC, "gcc"),
        ("unix", APPLE, "clang"),
        ("unix", "icx 2025.0\n", "clang"),
        ("msvc", "", "msvc"),
    ],
    ids=["gcc", "mingw", "apple", "another", "msvc"],
)
def test_a_compiler_is_known_by_what_it_says(build, kind, says, compiler):
    assert build["family"](kind, [sys.executable, "-c", f"print({says!r})"]) == compiler


def test_without_a_compiler_the_build_goes_on(build):
    assert build["family"]("unix", ["no-such-compiler"]) == "clang"


def test_the_service_has_as_many_processes_as_asked_or_as_cores():
    cores = min(usable_cores(), WORKERS_MAX)
    for platform, query, count in (("linux", 3, 3), ("darwin", 3, 3), ("win32", 1, 1), ("win32", None, 1)):
        assert process_count(query, platform) == count
    assert process_count(None, "linux") == cores
    with refused("workers"):
        process_count(4, "win32")


def test_nothing_is_imported_that_windows_lacks():
    assert importers(POSIX_ONLY, MODULES) == set()


def test_an_editable_install_is_a_path_that_type_checkers_read_unless_its_name_needs_an_encoding():
    (path,) = Path(sysconfig.get_path("purelib")).glob("__editable__.bench_dragon-*.pth")
    assert (path.read_text("utf-8").strip() == str(ROOT)) is str(ROOT).isascii()
