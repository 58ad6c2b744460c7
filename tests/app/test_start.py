"""The start of a process: imports without the garbage collector, which works again afterwards."""

from __future__ import annotations

import gc
import subprocess
import sys
from pathlib import Path

import pytest

from app.start import importing


def test_the_garbage_collector_rests_during_imports_and_leaves_what_they_made_alone() -> None:
    before = gc.get_freeze_count()
    with importing():
        assert not gc.isenabled()
        made = [[] for _ in range(1000)]
    assert gc.isenabled()
    assert gc.get_freeze_count() >= before + len(made)


def test_it_works_again_after_an_import_that_fails() -> None:
    with pytest.raises(ModuleNotFoundError), importing():
        raise ModuleNotFoundError
    assert gc.isenabled()


def test_a_module_is_called_with_its_own_arguments(tmp_path: Path) -> None:
    code = "import gc, sys\nat_import = gc.isenabled()\ndef main(): print(at_import, gc.isenabled(), sys.argv)\n"
    (tmp_path / "told.py").write_text(code)
    command = [sys.executable, "-m", "app.start", "told", "a", "b"]
    done = subprocess.run(command, env={"PYTHONPATH": str(tmp_path)}, capture_output=True, text=True)
    assert (done.stdout, done.stderr) == ("False True ['told', 'a', 'b']\n", "")
