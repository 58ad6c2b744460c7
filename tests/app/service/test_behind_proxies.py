"""Services behind nginx and Caddy as docs/operations.md sets them up, and the other configurations that it shows."""

import re
import subprocess
import threading
from contextlib import contextmanager

import httpx
import pytest
import yaml

from tests.conftest import ROOT, nginx_path, wait_until_live
from tests.support.job_service import PATIENCE, SHORT, JobService, wait_for
from tests.support.serving import free_port, serving

CLIENTS = 4
FOLDERS = ("client_body", "proxy", "fastcgi", "uwsgi", "scgi")
SHOWN = re.findall(r"```(?:yaml)?\n(.*?)```", (ROOT / "docs" / "operations.md").read_text("utf-8"), re.DOTALL)


def shown(beginning, **changes):
    """The configuration in the documentation that begins so, with other words in the place of some of its own."""
    [text] = [text for text in SHOWN if text.startswith(beginning)]
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    return text


def addresses_of(services):
    """What stands in the place of the addresses that the documentation shows."""
    return {f"127.0.0.1:800{k}": f"127.0.0.1:{port}" for k, port in enumerate(services, 1)}


@contextmanager
def nginx(folder, services):
    """The address at which nginx passes requests on to these ports, also those below /dragon/"""
    port = free_port()
    file = folder / "nginx.conf"
    changes = {
        "listen 80;": f"listen 127.0.0.1:{port};",
        "    location / {": f"{shown('location /dragon/')}    location / {{",
    }
    http = shown("upstream dragon", **addresses_of(services), **changes)
    paths = "".join(f"{name}_temp_path {folder}/{name};\n" for name in FOLDERS)
    file.write_text(
        f"pid {folder}/pid;\nerror_log {folder}/errors;\nevents {{}}\nhttp {{\naccess_log off;\n{paths}{http}}}\n"
    )
    with running(
        port, folder / "errors", nginx_path(), "-p", folder, "-e", folder / "errors", "-c", file, "-g", "daemon off;"
    ):
        yield f"http://127.0.0.1:{port}"


@contextmanager
def caddy(folder, services):
    """The address at which Caddy passes requests below /dragon/ on to these ports."""
    port = free_port()
    file = folder / "Caddyfile"
    changes = addresses_of(services) | {"dance.example": f"http://127.0.0.1:{port}"}
    file.write_text("{\nadmin off\n}\n" + shown("dance.example", **changes))
    with running(port, folder / "errors", "caddy", "run", "--config", file, "--adapter", "caddyfile"):
        yield f"http://127.0.0.1:{port}"


@contextmanager
def running(port, errors, *words):
    with errors.open("wb") as log:
        process = subprocess.Popen(words, stderr=log, env={"PATH": "/usr/bin", "HOME": str(errors.parent)})
    try:
        wait_until_live(process, port, errors)
        yield
    finally:
        process.terminate()
        process.wait(PATIENCE)


class Client(threading.Thread):
    """Asks and makes jobs, one after the other, until it is told to end."""

    def __init__(self, url, pitch):
        super().__init__()
        self.url = url
        self.pitch = pitch
        self.ended = threading.Event()
        self.answers = []

    def run(self):
        with httpx.Client(base_url=self.url, timeout=PATIENCE) as client:
            while not self.ended.is_set():
                self.answers.append(client.get("/collision-time", params={"pitch": self.pitch}))
                self.answers.append(client.post("/jobs", json=SHORT))


def wait_until_answered(clients):
    """Return when all that was asked until now is answered.

    nginx asks each service once: what one of them has refused must not stand before the other when that one ends.
    """
    counts = [len(client.answers) for client in clients]
    wait_for(lambda: all(len(client.answers) > count for client, count in zip(clients, counts, strict=True)))


@pytest.mark.nginx
@pytest.mark.thorough
def test_a_rolling_restart_loses_no_answer_and_no_job(tmp_path):
    folder = tmp_path / "data"
    with (
        JobService(folder) as one,
        JobService(folder) as other,
        nginx(tmp_path, [one.port, other.port]) as url,
    ):
        clients = [Client(url, 0.5 + k / 100) for k in range(CLIENTS)]
        for client in clients:
            client.start()
        try:
            for service in (one, other, one):
                before = sum(len(client.answers) for client in clients)
                service.stop()
                service.start()
                assert sum(len(client.answers) for client in clients) > before + CLIENTS
                wait_until_answered(clients)
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


PROXIES = [pytest.param(nginx, marks=pytest.mark.nginx), pytest.param(caddy, marks=pytest.mark.caddy)]


@pytest.mark.parametrize("proxy", PROXIES)
def test_under_a_path_of_a_proxy_addresses_are_whole(tmp_path, proxy):
    with (
        serving(tmp_path / "log") as service,
        proxy(tmp_path, [service.address[1]] * 2) as url,
        httpx.Client(base_url=f"{url}/dragon", timeout=PATIENCE) as client,
    ):
        assert client.get("/").status_code == client.get("/page/style.css").status_code == 200
        job = client.post("/jobs", json=SHORT)
        location = job.headers["Location"]
        assert [link["href"].startswith(location) for link in job.json()["links"]] == [True, True]
        assert httpx.get(f"{url}{location}").status_code == 200
        described = client.get("/openapi.json").json()["servers"][0]["url"]
        assert location.rpartition("/")[0] == "/dragon/jobs"
        assert described == "/dragon"


# A setting, the path that the proxy sends, its header, and the Location that follows.
PREFIXES = [
    ("/jobs", "/jobs", "", "/jobs/jobs"),  # the proxy has removed the path, which is the name of a call
    ("/jobs", "/jobs/jobs", "", "/jobs/jobs"),
    ("/dance/2026/", "/jobs", "", "/dance/2026/jobs"),
    ("", "/jobs", "/dragon/", "/dragon/jobs"),
    ("", "/jobs", "//evil.example", "/jobs"),
    ("", "/jobs", "/a b", "/jobs"),
]


@pytest.mark.parametrize("setting, path, header, location", PREFIXES)
def test_a_path_comes_from_the_setting_or_from_a_trusted_proxy(tmp_path, setting, path, header, location):
    with serving(tmp_path / "log", root_path=setting) as service:
        job = httpx.post(f"{service.url}{path}", json=SHORT, headers={"X-Forwarded-Prefix": header})
        assert job.headers["Location"].rpartition("/")[0] == location


def test_a_stranger_has_no_say_in_the_path(tmp_path, monkeypatch):
    monkeypatch.setenv("FORWARDED_ALLOW_IPS", "192.0.2.1")
    with serving(tmp_path / "log") as service:
        job = httpx.post(f"{service.url}/jobs", json=SHORT, headers={"X-Forwarded-Prefix": "/dragon"})
        assert job.headers["Location"].startswith("/jobs/")


@pytest.mark.systemd
def test_the_unit_of_systemd_is_one_and_leaves_few_rights(tmp_path):
    unit = tmp_path / "bench-dragon.service"
    unit.write_text(shown("[Unit]", **{"/opt/bench-dragon/bin/bench-dragon": "/bin/true"}))
    checked = subprocess.run(["systemd-analyze", "verify", unit], capture_output=True, text=True)
    assert checked.returncode == 0
    assert checked.stderr == ""
    rated = subprocess.run(
        ["systemd-analyze", "security", "--offline=true", "--threshold=20", unit], capture_output=True, text=True
    )
    assert rated.returncode == 0, rated.stdout


def test_the_probes_of_kubernetes_ask_what_answers(client):
    probes = yaml.safe_load(shown("securityContext"))
    paths = {name: probe["httpGet"]["path"] for name, probe in probes.items() if "httpGet" in probe}
    assert paths.keys() == {"startupProbe", "readinessProbe", "livenessProbe"}
    assert {client.get(path).status_code for path in paths.values()} == {200}
