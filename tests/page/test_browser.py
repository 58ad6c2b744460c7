"""A run of the page tests on a machine without a browser."""

import os
import subprocess
import sys

import pytest

from tests.conftest import ROOT

# Code of a machine that has none.
WITHOUT = "from tests.support import browser; browser.browser_path = lambda: None"
LEFT_OUT = "tests are left out: no Chrome or Chromium starts here"

pytestmark = pytest.mark.uncompiled


def without_browser(folder, *arguments, **more):
    """A run of pytest on a machine without a browser, in every process that it starts."""
    (folder / "without_browser.py").write_text(WITHOUT)
    kept = {name: value for name, value in os.environ.items() if name != "EVERY_TEST"}
    # Plugins of pytest that these tests do not use would take two seconds to load.
    kept |= {"PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "PYTEST_PLUGINS": "without_browser"}
    command = [sys.executable, "-m", "pytest", "-q", *arguments]
    return subprocess.run(
        command, cwd=ROOT, env={**kept, "PYTHONPATH": f"{folder}:{ROOT}", **more}, capture_output=True, text=True
    )


def test_a_run_without_a_browser_says_once_what_it_leaves_out(tmp_path):
    done = without_browser(tmp_path, "--collect-only", "tests/page", DEEP="1")
    assert (done.stdout.count(LEFT_OUT), "test_everyone.py" in done.stdout) == (1, False)


def test_where_every_test_must_run_a_missing_browser_is_an_error(tmp_path):
    # Of a module that imports little.
    here = "tests/core/test_names.py"
    done = without_browser(tmp_path, "tests/page/test_everyone.py", here, EVERY_TEST="1")
    assert (done.stdout.count(LEFT_OUT), done.returncode) == (1, pytest.ExitCode.USAGE_ERROR)
    assert "passed" not in done.stdout
