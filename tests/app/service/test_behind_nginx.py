"""Two services behind nginx with the configuration of docs/operations.md, restarted one after the other."""

from __future__ import annotations

import re
import subprocess
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import httpx
import pytest

from tests.conftest import ROOT, nginx_path, wait_until_live
from tests.support.job_service import PATIENCE, SHORT, JobService
from tests.support.serving import free_port

CLIENTS = 4
FOLDERS = ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")


def configuration(folder: Path, port: int, services: list[int]) -> str:
    """The configuration that the documentation shows, for these ports and an ordinary user."""
    text = (ROOT / "docs" / "operations.md").read_text()
    match = re.search(r"```\n(upstream dragon .*?)```", text, re.DOTALL)
    assert match, "no configuration of nginx in docs/operations.md"
    http = match[1].replace("listen 80;", f"listen 127.0.0.1:{port};")
    for of_docs, own in zip(("127.0.0.1:8001", "127.0.0.1:8002"), services, strict=True):
        assert of_docs in http
        http = http.replace(of_docs, f"127.0.0.1:{own}")
    paths = "".join(f"{name}_temp_path {folder}/{name};\n" for name in FOLDERS)
    return f"pid {folder}/pid;\nerror_log {folder}/errors;\nevents {{}}\nhttp {{\naccess_log off;\n{paths}{http}}}\n"


@contextmanager
def nginx(folder: Path, services: list[int]) -> Iterator[str]:
    """The address at which nginx passes requests on to these ports."""
    port, file = free_port(), folder / "nginx.conf"
    file.write_text(configuration(folder, port, services))
    program = nginx_path()
    assert program
    words = [program, "-p", folder, "-e", folder / "errors", "-c", file, "-g", "daemon off;"]
    process = subprocess.Popen(words, stderr=subprocess.DEVNULL)
    try:
        wait_until_live(process, port, folder / "errors")
        yield f"http://127.0.0.1:{port}"
    finally:
        process.terminate()
        process.wait(PATIENCE)


class Client(threading.Thread):
    """Asks and makes jobs, one after the other, until it is told to end."""

    def __init__(self, url: str, pitch: float) -> None:
        super().__init__()
        self.url, self.pitch, self.ended = url, pitch, threading.Event()
        self.answers: list[httpx.Response] = []

    def run(self) -> None:
        with httpx.Client(base_url=self.url, timeout=PATIENCE) as client:
            while not self.ended.is_set():
                self.answers.append(client.get("/collision-time", params={"pitch": self.pitch}))
                self.answers.append(client.post("/jobs", json=SHORT))


@pytest.mark.nginx
@pytest.mark.thorough
def test_a_rolling_restart_loses_no_answer_and_no_job(tmp_path: Path) -> None:
    folder = tmp_path / "data"
    with JobService(folder) as one, JobService(folder) as other, nginx(tmp_path, [one.port, other.port]) as url:
        clients = [Client(url, 0.5 + k / 100) for k in range(CLIENTS)]
        for client in clients:
            client.start()
        try:
            for service in (one, other, one):
                before = sum(len(client.answers) for client in clients)
                service.stop()
                service.start()
                assert sum(len(client.answers) for client in clients) > before + CLIENTS
        finally:
            for client in clients:
                client.ended.set()
            for client in clients:
                client.join(PATIENCE)
        answers = [answer for client in clients for answer in client.answers]
        full = [answer for answer in answers if answer.status_code in (429, 503)]
        assert all("Retry-After" in answer.headers for answer in full)
        assert {answer.status_code for answer in answers} - {429, 503} == {200, 202}
        jobs = [answer.headers["location"] for answer in answers if answer.status_code == 202]
        assert {one.finished(job)["status"] for job in jobs} == {"successful"}
