"""The real service with a data folder, and its processes, which a test may kill."""

import contextlib
import os
import signal
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

import httpx
import psutil

from app.files.tables import XLSX_TYPE
from app.questions.registry import CALLS
from tests.conftest import STOP_TIMEOUT, wait_until_live
from tests.support.command import serve
from tests.support.largest import THIN
from tests.support.serving import environment_of, free_port

PATIENCE = 180.0  # [s] for what is coming, also on a busy machine
LOOK = 0.05  # [s] between two looks
# Seconds of work, and within the limits.
LONG = {"question": "trajectory", "request": {"times": {"stop": 400, "step": 1.0}}, "accept": XLSX_TYPE}
# Two or three times as long as the time between two messages about progress.
SCAN = {"question": "pitch_scan", "request": {"samples": 401, "start_turns": 28}}
# Minutes of work, for tests that end it themselves.
ENDLESS = {"question": "minimum_pitch", "request": THIN}
SHORT = {"question": "collision_time", "request": {"pitch": 0.5}}


@dataclass
class Process:
    """One process of the service: what it is, and its number."""

    role: str
    pid: int

    def kill(self):
        with contextlib.suppress(ProcessLookupError):
            os.kill(self.pid, signal.SIGKILL)


class JobService:
    """`bench-dragon serve` on a free port, with this data folder and these settings."""

    def __init__(self, folder, workers=1, **settings):
        self.folder = folder
        self.workers = workers
        self.mark = f"{os.getpid()}-{id(self)}"
        self.environment = environment_of({**settings, "data": folder}) | {"TEST_MARK": self.mark}
        self.port = free_port()
        self.client = httpx.Client(base_url=f"http://127.0.0.1:{self.port}", timeout=PATIENCE)
        if "token" in settings:
            self.client.headers["Authorization"] = f"Bearer {settings['token']}"

    def __enter__(self):
        self.start()
        return self

    def __exit__(self, *_):
        self.stop()
        self.client.close()

    def start(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.log = Path(self.scratch.name) / "service.log"
        self.process = serve(self.port, self.workers, self.environment | {"TMPDIR": self.scratch.name}, self.log)
        wait_until_live(self.process, self.port, self.log)

    def stop(self):
        """Asks the service to end; no process of it may stay."""
        self.process.terminate()
        try:
            self.process.wait(STOP_TIMEOUT)
            wait_for(lambda: not self.processes())
        finally:
            for process in self.processes():
                process.kill()
            self.process.wait()
            self.scratch.cleanup()

    def start_again(self):
        """Kills the first process, which all others follow, and starts the service anew."""
        self.process.kill()
        self.process.wait()
        wait_for(lambda: not self.processes())
        self.start()

    def processes(self):
        """All processes of this service that live, wherever they belong by now."""
        first = self.process.pid
        result = [Process("parent", first)] if self.process.poll() is None else []
        for entry in Path("/proc").iterdir():
            if entry.name.isdigit() and int(entry.name) != first:
                with contextlib.suppress(OSError):
                    if f"TEST_MARK={self.mark}".encode() in (entry / "environ").read_bytes():
                        words = (entry / "cmdline").read_bytes().decode()
                        result.append(Process(self._role(int(entry.name), words), int(entry.name)))
        return result

    def _role(self, pid, words):
        if "app.jobs.work" in words and not _has_job(pid):
            return "spare"
        marks = {"app.jobs.runner": "runner", "app.jobs.work": "child", "resource_tracker": "tracker"}
        return next((role for mark, role in marks.items() if mark in words), "worker")

    def of(self, role):
        return [process for process in self.processes() if process.role == role]

    def post(self, wanted, path="/jobs"):
        """Address of a new job."""
        answer = self.client.post(path, json=wanted)
        assert answer.status_code == 202, answer.text
        return answer.headers["location"]

    def status(self, address):
        while True:
            try:
                return self.client.get(address).raise_for_status().json()
            except httpx.TransportError:  # A process that held the connection was killed.
                assert self.process.poll() is None

    def until(self, address, *states):
        """The status of a job when it is in one of these states."""
        end = time.monotonic() + PATIENCE
        while (status := self.status(address))["status"] not in states:
            assert time.monotonic() < end, status
            time.sleep(LOOK)
        return status

    def finished(self, address):
        return self.until(address, "successful", "failed", "dismissed")

    def done(self, wanted):
        """Address of a new job that is successful by now."""
        address = self.post(wanted)
        assert self.finished(address)["status"] == "successful"
        return address

    def result(self, address):
        return self.client.get(f"{address}/result")

    def remove(self, *addresses):
        for address in addresses:
            while self.client.delete(address).status_code == httpx.codes.OK:
                pass

    def at(self, address):
        """A client at another address of this machine."""
        transport = httpx.HTTPTransport(local_address=address)
        headers = self.client.headers
        return httpx.Client(base_url=self.client.base_url, transport=transport, timeout=PATIENCE, headers=headers)


def _has_job(pid):
    """True if a process for jobs has a job: it opens the store only then."""
    return any("jobs.sqlite" in os.readlink(file) for file in Path(f"/proc/{pid}/fd").iterdir())


def direct(client, wanted):
    """The answer of the call itself, with nothing of jobs."""
    call = CALLS[wanted["question"]]
    values = dict(wanted.get("request", {}))
    path = call.question.path.format(format=values.pop("format", ""))
    headers = {"Accept": wanted.get("accept", "*/*")}
    return client.request(call.method, path, headers=headers, **{"params" if call.method == "GET" else "json": values})


def is_gone(pid):
    """True if the process has ended, whether or not its parent has noticed.

    In a container the first process may be nobody who notices the end of orphans.
    """
    try:
        return psutil.Process(pid).status() == psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return True


def wait_for(claim, patience=PATIENCE):
    """Return when the claim, a function, is true."""
    end = time.monotonic() + patience
    while not claim():
        assert time.monotonic() < end
        time.sleep(LOOK)
