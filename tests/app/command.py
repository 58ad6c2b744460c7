"""The command bench-dragon, asked in a process of its own each time.

A process needs about a second to start Python and to import the command, and often a tenth of that to answer. So most
runs are forked from one process that has imported it already; everything after the import is theirs: arguments,
folder, standard input, output and error, exit code. Where the start itself matters, a whole new process runs: for any
environment, for a service, and in the tests of signals, terminals and pipes.
"""

from __future__ import annotations

import multiprocessing
import os
import subprocess
import sys
import tempfile
from pathlib import Path

# In every forked process already; tests/app/test_modules_of_a_question.py and tests/app/test_extras.py see what a new
# process imports.
import app.command.main
import core.shapes.engines  # noqa: F401

COMMAND = str(Path(sys.executable).with_name("bench-dragon"))
ENVIRONMENT = {
    name: value for name, value in os.environ.items() if not name.startswith(("BENCH_DRAGON_", "FORCE_COLOR"))
}
PATIENCE = 120.0  # [s]: only against a test that would hang
FORKS = multiprocessing.get_context("forkserver")
FORKS.set_forkserver_preload([__name__])


def run(*arguments: str, text: str | None = None, **environment: str) -> subprocess.CompletedProcess[str]:
    """What a run of the command leaves: exit code, standard output, standard error."""
    if environment or arguments[0] == "serve":
        return subprocess.run(
            [COMMAND, *arguments],
            input=text,
            capture_output=True,
            text=True,
            timeout=PATIENCE,
            env={**ENVIRONMENT, **environment},
        )
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "0").write_text(text or "", encoding="utf-8")
        process = FORKS.Process(target=_answer, args=(arguments, Path.cwd(), folder))
        process.start()
        process.join(PATIENCE)
        if process.exitcode is None:
            process.kill()
            raise subprocess.TimeoutExpired([COMMAND, *arguments], PATIENCE)
        told = [(Path(folder) / name).read_text(encoding="utf-8") for name in ("1", "2")]
        return subprocess.CompletedProcess([COMMAND, *arguments], process.exitcode, *told)


def _answer(arguments: tuple[str, ...], here: Path, folder: str) -> None:
    """The command as its script calls it, with standard input, output and error in files of a folder."""
    for number in (0, 1, 2):
        os.dup2(os.open(f"{folder}/{number}", os.O_RDWR | os.O_CREAT), number)
    sys.stdin = open(0, encoding="utf-8")  # noqa: SIM115
    os.chdir(here)
    os.environ.clear()
    os.environ.update(ENVIRONMENT)
    sys.argv = [COMMAND, *arguments]
    app.command.main.app()
