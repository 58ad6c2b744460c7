"""What uv finds on the package index for the locked versions: nothing is installed."""

import os
import subprocess
import sys
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
UV = Path(sys.executable).with_name("uv")
# Every Python that pyproject.toml names, and the processors of Linux machines.
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
PROCESSORS = ("x86_64", "aarch64")
# Variables of the shell about the way to the index, which the tests drop for themselves.
PROXIES = ("all_proxy", "http_proxy", "https_proxy", "no_proxy")
TIMEOUT = 120.0  # [s] for a lock of a hundred packages, which takes 2 s


def resolved(packages, python, processor, outer):
    """A dry run of an installation from wheels alone. packages: arguments of uv; outer: variables of the shell"""
    command = [str(UV), "pip", "install", "--dry-run", "--no-deps", "--only-binary", ":all:", "--system-certs"]
    machine = ["--python-version", python, "--python-platform", f"{processor}-manylinux_2_28"]
    # An empty folder: what is installed for this Python says nothing about another one.
    target = ["--target", str(ROOT / "build" / "nothing"), "--python", sys.executable]
    return run_with_index([*command, *machine, *target, *packages], outer)


def run_with_index(command, outer, folder=ROOT):
    """A command that may reach the index by the proxies of the shell, in a folder."""
    proxies = {name: value for name, value in outer if name.lower() in PROXIES}
    environment = os.environ | proxies | {"UV_HTTP_TIMEOUT": "20", "UV_HTTP_RETRIES": "1"}
    return subprocess.run(command, capture_output=True, text=True, env=environment, timeout=TIMEOUT, cwd=folder)


@cache
def index_answers(outer):
    """True if uv runs here and gets an answer about a package from the index."""
    if not UV.exists():
        return False
    return resolved(["--refresh", "idna"], PYTHONS[0], PROCESSORS[0], outer).returncode == 0
