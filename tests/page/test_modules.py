"""The modules of the page that need no browser, tried by the test runner of Node.js: one file of tests for each."""

import subprocess
from pathlib import Path

import pytest

from tests.conftest import ROOT
from tests.support.node import PATIENCE, node_path

FILES = sorted((Path(__file__).parent / "modules").glob("*.test.js"))


@pytest.mark.node
@pytest.mark.uncompiled
@pytest.mark.parametrize("file", FILES, ids=[file.name.partition(".")[0] for file in FILES])
def test_a_module_of_the_page_passes_its_tests(file):
    command = [str(node_path()), "--no-warnings", "--test", str(file.relative_to(ROOT))]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)
    assert done.returncode == 0, f"to repeat it: {' '.join(command)}\n{done.stdout}{done.stderr}"
    assert "# tests 0" not in done.stdout
