"""The search of the page tests for a browser, and the message of a run without one."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.support.browser import starts

ROOT = Path(__file__).parents[2]
# Code that hides every installed browser.
WITHOUT = "from tests.support import browser; browser.PLACES = ()"
LEFT_OUT = "tests are left out: no Chrome or Chromium starts here"

pytestmark = pytest.mark.uncompiled


def program(path: Path, says: str, code: int = 0) -> str:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(f"#!/bin/sh\nprintf '%s' '{says}'\nexit {code}\n")
    path.chmod(0o755)
    return str(path)


def bare(folder: Path) -> dict[str, str]:
    """An environment that names no browser."""
    unset = ("CHROME", "EVERY_TEST", "PLAYWRIGHT_BROWSERS_PATH", "XDG_CACHE_HOME")
    kept = {name: value for name, value in os.environ.items() if name not in unset}
    # Plugins of pytest that these tests do not use would take two seconds to load.
    return {**kept, "HOME": str(folder), "PATH": str(folder), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}


@pytest.mark.parametrize(
    ("says", "code", "works"),
    [
        ("Chromium 131.0.6778.85 built on Debian", 0, True),
        ("requires the chromium snap to be installed", 1, False),
        ("Firefox 140", 0, False),
    ],
    ids=["chromium", "stub", "another"],
)
def test_a_browser_is_what_says_that_it_is_one(tmp_path: Path, says: str, code: int, works: bool) -> None:
    assert starts(program(tmp_path / "chromium", says, code)) is works


def test_what_is_missing_is_no_browser(tmp_path: Path) -> None:
    assert not starts(str(tmp_path / "nothing"))


def without_browser(folder: Path, *arguments: str, **more: str) -> subprocess.CompletedProcess[str]:
    """A run of pytest on a machine without a browser, in every process that it starts."""
    (folder / "without_browser.py").write_text(WITHOUT)
    environment = bare(folder) | {"PYTEST_PLUGINS": "without_browser", "PYTHONPATH": f"{folder}:{ROOT}"} | more
    command = [sys.executable, "-m", "pytest", "-q", *arguments]
    return subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)


def test_a_run_without_a_browser_says_once_what_it_leaves_out(tmp_path: Path) -> None:
    done = without_browser(tmp_path, "--collect-only", "tests/page", DEEP="1")
    assert (done.stdout.count(LEFT_OUT), "test_everyone.py" in done.stdout) == (1, False)


def test_where_every_test_must_run_a_missing_browser_is_an_error(tmp_path: Path) -> None:
    # Of modules that import little.
    here = "tests/page/test_browser.py::test_what_is_missing_is_no_browser"
    done = without_browser(tmp_path, "tests/page/test_everyone.py", here, EVERY_TEST="1")
    assert (done.stdout.count(LEFT_OUT), done.returncode) == (1, pytest.ExitCode.USAGE_ERROR)
    assert "passed" not in done.stdout


def got(folder: Path, user: int, *, has_apt: bool = True) -> tuple[str, str, list[str]]:
    """Output of getting a browser: standard output, standard error, and the commands that it ran."""
    # The package of the system brings /usr/bin/chromium; here it goes into the folder of the test.
    installed = "/bin/printf '#!/bin/sh\\necho Chromium 1\\n' >$HOME/chromium; /bin/chmod +x $HOME/chromium"
    script = f"""#!/bin/sh
echo ${{0##*/}} "$@" >>$HOME/log
case "$*" in *"recommends chromium") {installed};; esac
"""
    for name in ("apt-get", "python") if has_apt else ("python",):
        (folder / name).write_text(script)
        (folder / name).chmod(0o755)
    pretend = f"import os, sys; os.geteuid = lambda: {user}; sys.executable = {str(folder / 'python')!r}"
    code = f"{WITHOUT}; {pretend}; browser.main(); print(browser.browser_path())"
    done = subprocess.run([sys.executable, "-c", code], cwd=ROOT, env=bare(folder), capture_output=True, text=True)
    log = folder / "log"
    return done.stdout, done.stderr, log.read_text().splitlines() if log.exists() else []


APT, PLAYWRIGHT = "apt-get install -qq -y --no-install-recommends", "python -m playwright"


@pytest.mark.parametrize(
    ("user", "has_apt", "is_there", "commands"),
    [
        (0, True, True, []),
        (0, True, False, ["apt-get update -qq", f"{APT} chromium", f"{APT} fonts-wqy-microhei"]),
        (1000, False, False, [f"{PLAYWRIGHT} install chromium"]),
        (0, False, False, [f"{PLAYWRIGHT} install chromium", f"{PLAYWRIGHT} install-deps chromium"]),
    ],
    ids=["all is there", "packages of a system", "playwright for a user", "playwright for root"],
)
def test_what_is_missing_is_installed_and_reported_in_one_line(
    user: int, has_apt: bool, is_there: bool, commands: list[str], tmp_path: Path
) -> None:
    program(tmp_path / "fc-list", "Noto Sans CJK SC" if is_there else "")
    if is_there:
        program(tmp_path / "chromium", "Chromium 1")
    result, output, ran = got(tmp_path, user, has_apt=has_apt)
    assert (result == "None\n", output.count("\n"), ran) == (not has_apt, bool(commands), commands)
