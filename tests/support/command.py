"""The command bench-dragon: run() runs it from Python, the script in bin_folder() from a shell, and serve() starts
`bench-dragon serve`.

A new process takes longer to start Python and to import the command than to answer. So one process imports every
command and is forked for each run; everything after the import is the run's own: arguments, folder, environment,
standard input, output and error, exit code. Where the start itself matters, a whole new process runs: for a service of
several processes, for another path of modules, and in the tests of signals, terminals and pipes.
"""

import atexit
import contextlib
import json
import os
import resource
import select
import shlex
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import traceback
from functools import cache
from importlib import import_module
from pathlib import Path
from pkgutil import walk_packages

from app.extras import MODULES
from app.start import importing

COMMAND = str(Path(sys.executable).with_name("bench-dragon"))
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith("BENCH_DRAGON_")}
ROOT = Path(__file__).parents[2]
PATIENCE = 300.0  # [s]: only against a test that would hang
# Modules that the command imports at their first use: those of the extras, parts of matplotlib and scipy, and engines.
USED = ("dxf", "paper", "proof", "sweep", "xlsx")
LAZY = (
    *("matplotlib.backends.backend_agg", "matplotlib.backends.backend_pdf", "matplotlib.backends.backend_svg"),
    *("fcl", "scipy.interpolate", "scipy.special", "shapely"),
)
# Never imported beforehand: what needs another program, and the compiled loops.
NEVER = ("app.sweeps.cluster", "core.kernels.")
WORDS_MAX = 1 << 17  # of folder, environment and arguments together [bytes]
# The command for a shell: it passes its arguments to the process that forks, and ends with the exit code of the run.
SHELL = """#!/bin/sh
exec {python} -IS {program} "$@"
"""
PROGRAM = """import json, os, socket, sys
with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as peer:
    peer.connect({door!r})
    words = json.dumps([os.getcwd(), dict(os.environ), sys.argv[1:], None]).encode()
    socket.send_fds(peer, [words], [0, 1, 2])
    sys.exit(int(peer.recv(9) or 70))
"""


def run(*arguments, text=None, room=None, house=ROOT, **environment):
    """Result of the command: exit code, standard output, standard error.

    room: longest file that it may write [bytes]; house: the folder with the program
    """
    command = [COMMAND, *arguments]
    if arguments[:1] == ("serve",) or any(name.startswith("PYTHON") for name in environment):
        variables = ENVIRONMENT | environment
        return subprocess.run(command, input=text, capture_output=True, text=True, timeout=PATIENCE, env=variables)
    with contextlib.ExitStack() as stack:
        files = [stack.enter_context(tempfile.TemporaryFile("w+", encoding="utf-8")) for _ in range(3)]
        files[0].write(text or "")
        files[0].seek(0)
        streams = [file.fileno() for file in files]
        with _forked_process(str(Path.cwd()), arguments, ENVIRONMENT | environment, streams, room, house) as peer:
            code = peer.recv(9)
        if not code:
            raise subprocess.TimeoutExpired(command, PATIENCE)
        for file in files:
            file.seek(0)
        return subprocess.CompletedProcess(command, int(code), files[1].read(), files[2].read())


def said(*arguments, aside="", **how):
    """What the command prints when it succeeds. aside: all that stands on standard error; None for anything"""
    done = run(*arguments, **how)
    assert done.returncode == 0
    assert done.stderr == (done.stderr if aside is None else aside)
    return done.stdout


def refusal(*arguments, **how):
    """What stands on standard error when the command refuses, and prints nothing."""
    done = run(*arguments, **how)
    assert done.returncode == 2
    assert done.stdout == ""
    return done.stderr


def _forked_process(folder, arguments, environment, files, room=None, house=ROOT):
    """The connection to a new run, over which its exit code comes."""
    peer = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    peer.connect(f"{bin_folder(house)}/door")
    socket.send_fds(peer, [json.dumps([folder, dict(environment), arguments, room]).encode()], files)
    return peer


class Serving:
    """A running service, with the interface of subprocess.Popen."""

    returncode: int | None = None

    def __init__(self, peer):
        self._peer = peer
        self._signal = signal.SIGKILL
        self.pid = int(peer.recv(9))

    def poll(self):
        with contextlib.suppress(subprocess.TimeoutExpired):
            return self.wait(0.0)
        return None

    def wait(self, timeout=None):
        if self.returncode is None:
            if not select.select([self._peer], [], [], timeout)[0]:
                raise subprocess.TimeoutExpired([COMMAND, "serve"], timeout or 0.0)
            self.returncode = int(self._peer.recv(9) or -self._signal)
            self._peer.close()
        return self.returncode

    def send_signal(self, number):
        if self.poll() is None:
            self._signal = number
            with contextlib.suppress(ProcessLookupError):
                os.kill(self.pid, number)

    def terminate(self):
        self.send_signal(signal.SIGTERM)

    def kill(self):
        self.send_signal(signal.SIGKILL)


Process = Serving | subprocess.Popen[bytes]


def serve(port, workers, environment, log, limit=None, host="127.0.0.1", house=ROOT):
    """`bench-dragon serve`, which writes into a log. limit: called in its process before it starts"""
    words = ["serve", "--host", host, "--port", str(port), "--workers", str(workers)]
    with log.open("wb") as output:
        if limit:
            environment = {**environment, "PYTHONDONTWRITEBYTECODE": "1"}  # as for a run with little room
        if workers > 1 or limit:
            options = {"cwd": ROOT, "env": environment, "preexec_fn": limit}
            return subprocess.Popen([COMMAND, *words], stdout=output, stderr=output, **options)
        with open(os.devnull) as nothing:
            return Serving(
                _forked_process(str(house), words, environment, [nothing.fileno(), *[output.fileno()] * 2], house=house)
            )


def bin_folder(house=ROOT):
    """A folder with the command for a shell, and the door of the process that forks; it ends with this one."""
    return _folder_of(house)


@cache
def _folder_of(house):
    place = Path(tempfile.mkdtemp())
    program = place / "program.py"
    script = place / "bench-dragon"
    program.write_text(PROGRAM.format(door=f"{place}/door"))
    script.write_text(SHELL.format(python=shlex.quote(sys.executable), program=shlex.quote(str(program))))
    script.chmod(0o755)
    with socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET) as door:
        door.bind(f"{place}/door")
        door.listen()
        options = {
            "cwd": house,
            "env": ENVIRONMENT,
            "stdin": subprocess.PIPE,
            "pass_fds": [door.fileno()],
        }
        forks = subprocess.Popen([sys.executable, "-m", "tests.support.command", str(door.fileno())], **options)
    atexit.register(_close, place, forks, os.getpid())
    return place


def _close(place, forks, owner):
    """End the process that forks and remove the folder, but not at the end of a fork of this process."""
    if os.getpid() == owner:
        forks.communicate()
        shutil.rmtree(place)


def main():
    """Fork for each request, until standard input ends, which means that the parent is gone."""
    with importing():  # The collector of a run leaves the imported modules alone.
        commands = import_module("app.command.main")
        core = import_module("core")
        entry = import_module("app.command.entry")
        for name in {name for extra in USED for name in MODULES[extra]} | set(LAZY):
            import_module(name)
        for package in ("core", "app"):
            for room in walk_packages([str(ROOT / package)], f"{package}."):
                if not room.name.startswith(NEVER):
                    import_module(room.name)
        for name in core.__all__:
            getattr(core, name)
        _build(import_module("pydantic").BaseModel)
    sys.modules["__main__"].__package__ = None  # click names the program by its script, not by `python -m`
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # a run that has ended leaves no zombie
    with socket.socket(fileno=int(sys.argv[1])) as door:
        while sys.stdin not in select.select([door, sys.stdin], [], [])[0]:
            peer, _ = door.accept()
            if os.fork() == 0:
                signal.signal(signal.SIGCHLD, signal.SIG_DFL)
                door.close()
                _answer(peer, commands.app, entry)
            peer.close()


def _build(model):
    """Builds the models of app/ below this one, which would be built at their first use."""
    for inner in model.__subclasses__():
        if inner.__module__.startswith("app."):
            inner.model_rebuild()
        _build(inner)


def _answer(peer, app, entry):
    """The command as its script calls it; ends this process."""
    signal.alarm(int(PATIENCE))
    words, files, _, _ = socket.recv_fds(peer, WORDS_MAX, 3)
    here, environment, arguments, room = json.loads(words)
    if arguments[:1] == ["serve"]:
        signal.alarm(0)
        peer.send(str(os.getpid()).encode())
    for number, file in enumerate(files):
        os.dup2(file, number)
        os.close(file)
    # Opened as a new process opens them; output in the buffers of this process is dropped.
    sys.stdin, sys.stdout, sys.stderr = (
        open(number, mode, encoding="utf-8")  # noqa: SIM115
        for number, mode in enumerate(("r", "w", "w"))
    )
    os.chdir(here)
    os.environ.clear()
    os.environ.update(environment)
    sys.argv = [COMMAND, *arguments]
    if room is not None:
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_FSIZE, (room, room))
        # Python 3.11 takes a file of bytecode that was cut off for a whole one.
        sys.dont_write_bytecode = True
    entry.streams.prepare()
    code = 1
    try:
        code = entry.run(app)
    except BaseException:
        traceback.print_exc()
    peer.send(str(code).encode())
    os._exit(0)


if __name__ == "__main__":
    main()
