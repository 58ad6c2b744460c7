"""The start of a process: imports without the garbage collector, and none of another program's modules."""

import os
import subprocess
import sys
from functools import partial
from pathlib import Path

import httpx
import pytest

from tests.support.command import ENVIRONMENT, PATIENCE, run
from tests.support.serving import serving


def test_a_module_is_called_with_its_own_arguments(tmp_path):
    code = "import gc, sys\nat_import = gc.isenabled()\ndef main(): print(at_import, gc.isenabled(), sys.argv)\n"
    (tmp_path / "told.py").write_text(code)
    command = [sys.executable, "-m", "app.start", "told", "a", "b"]
    done = subprocess.run(command, env={"PYTHONPATH": str(tmp_path)}, capture_output=True, text=True)
    assert done.stdout == "False True ['told', 'a', 'b']\n"
    assert done.stderr == ""


@pytest.fixture
def other_program(tmp_path, monkeypatch):
    """PYTHONPATH of another program with packages called app and core, in whose folder a user stands."""
    other = tmp_path / "another program"
    library = tmp_path / "library"
    (other / "app").mkdir(parents=True)
    library.mkdir()
    (other / "app" / "__init__.py").write_text("raise ImportError('the app of another program')\n")
    (other / "core.py").write_text("raise ImportError('the core of another program')\n")
    (library / "sitecustomize.py").write_text("import os\nos.environ['LIBRARY'] = 'was imported'\n")
    monkeypatch.chdir(other)
    return os.pathsep.join([".", str(other), str(library), ""])


@pytest.mark.parametrize(
    "words", ["--version", "collision-time --benches 3 --json", "check --benches 3 --json", "no-such-command"]
)
def test_the_command_does_not_import_the_packages_of_another_program(words, other_program):
    done = run(*words.split(), PYTHONPATH=other_program)
    usual = run(*words.split())
    assert (done.returncode, done.stdout, done.stderr) == (usual.returncode, usual.stdout, usual.stderr)


@pytest.mark.thorough
def test_nor_do_the_processes_of_the_service(other_program, tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", other_program)
    with (
        serving(tmp_path / "log", 2, partial(os.chdir, Path.cwd()), data=tmp_path / "data") as service,
        httpx.Client(base_url=service.url, timeout=PATIENCE) as client,
    ):
        square = '{"type": "Polygon", "coordinates": [[[0, 0], [9, 0], [9, 9], [0, 0]]]}'
        client.post("/places", content=square, headers={"Content-Type": "application/geo+json"}).raise_for_status()
        made = client.post("/jobs", json={"question": "collision_time", "request": {"benches": 3}})
        assert '"successful"' in client.get(made.headers["location"] + "/events").text
    assert "Error" not in service.log.read_text()


def test_a_library_of_the_user_is_still_imported(other_program):
    code = "import bench_dragon, os; bench_dragon.leave_out_namesakes(); print(os.environ['LIBRARY'])"
    command = [sys.executable, "-P", "-c", code + "; import app, core"]
    done = subprocess.run(command, env=ENVIRONMENT | {"PYTHONPATH": other_program}, capture_output=True, text=True)
    assert done.stdout == "was imported\n"
    assert done.stderr == ""
