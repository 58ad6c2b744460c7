"""Fixtures that several kinds of tests share."""

import gc
import http.client
import json
import os
import random
import shlex
import shutil
import signal
import sys
import time
from ctypes import CDLL
from functools import cache
from importlib.util import find_spec
from pathlib import Path

import pytest

# What a shell may set and programs heed: a test of such a variable sets it itself. All servers are on this machine.
SHELL_VARIABLES = (
    *("COLUMNS", "FORCE_COLOR", "LANG", "LANGUAGE", "LC_ALL", "LC_CTYPE", "LINES", "NO_COLOR", "TERM"),
    *("PYTHONDONTWRITEBYTECODE", "PYTHONIOENCODING", "PYTHONUNBUFFERED", "PYTHONUTF8", "PYTHONWARNINGS"),
    *("all_proxy", "ftp_proxy", "http_proxy", "https_proxy", "no_proxy"),
    *("ALL_PROXY", "FTP_PROXY", "HTTP_PROXY", "HTTPS_PROXY", "NO_PROXY"),
)
_DROPPED = {name: value for name in SHELL_VARIABLES if (value := os.environ.pop(name, None)) is not None}
# Handed on to the other processes of a run.
OUTER = tuple(json.loads(os.environ.setdefault("OUTER_VARIABLES", json.dumps(_DROPPED))).items())
os.environ |= {"LC_ALL": "C.UTF-8", "TERM": "xterm"}

from core import kernels  # noqa: E402
from tests.support import browser, firefox, lock, node, refusals  # noqa: E402
from tests.support.depth import DEEP  # noqa: E402

ROOT = Path(__file__).parent.parent
FLINT_BITS = 53  # precision of python-flint unless it is told another
START_TIMEOUT = 60.0  # longest wait for the first answer [s]; a cold start takes about one
STOP_TIMEOUT = 30.0  # longest wait from the signal to the end [s]; uvicorn lets running computations finish
# Where this is set, a test that cannot run here is an error.
STRICT = "EVERY_TEST" in os.environ
# A number for a random order of the tests, or the word random for any.
SHUFFLE = os.environ.get("SHUFFLE", "")
if SHUFFLE == "random":
    SHUFFLE = os.environ["SHUFFLE"] = str(random.SystemRandom().randrange(10_000))
# Number of tests left out for each reason, and its name in what a process of several reports.
LEFT_OUT_OUTPUT = "left_out"
THOROUGH = "kills, bombs, packages, other machines and further cases: make test-all runs them too"
LEFT_OUT = pytest.StashKey[dict[str, int]]()
NO_DISK = "they mount a small disk, which only root may do: run make test as root"
UNCOMPILED = "they would take hours with uncompiled loops: apt install gcc python3-dev, then make clean test"
NO_CURL = "they run the commands of the documentation as they stand: apt install curl"
NO_NGINX = "they restart services behind a proxy: apt install nginx-light"
NO_CADDY = "they ask a service behind a proxy: apt install caddy"
NO_SYSTEMD = "they check a unit of systemd: apt install systemd"
NO_FONT = "they draw Chinese words, and there is no font for them: apt install fonts-wqy-microhei"
NO_INDEX = "they ask the package index, which does not answer"
NO_ENGINE = "they compare an engine that cannot be had for this machine and its Python: {}"


@pytest.fixture(autouse=True)
def usual_precision():
    """No test computes with the digits that another one asked of python-flint."""
    yield
    if flint := sys.modules.get("flint"):
        flint.ctx.prec = FLINT_BITS


@pytest.fixture(autouse=True, scope="session")
def refusals_without_translation():
    return refusals.watch()


@pytest.fixture(autouse=True)
def every_refusal_is_in_the_catalogues(refusals_without_translation):
    yield
    missing = sorted(refusals_without_translation)
    refusals_without_translation.clear()
    assert not missing, f"no catalogue has {missing}: see .ci/words"


@pytest.fixture(scope="module", autouse=True)
def freed_memory_goes_back(request):
    """What the functions of a module remember ends with its tests, and does not stay with the process."""
    yield
    for function in vars(request.module).values():
        if hasattr(function, "cache_clear") and function.__module__ == request.module.__name__ and not SHUFFLE:
            function.cache_clear()
    if trim := getattr(CDLL(None), "malloc_trim", None):
        trim(0)


def pytest_make_parametrize_id(val):
    """A name for archives, whose bytes hold the time at which they were made: every process names its tests alike."""
    return "archive" if isinstance(val, bytes) and val.startswith(b"PK") else None


def pytest_addoption(parser):
    parser.addoption("--all", action="store_true", help="run the thorough tests too")


def pytest_report_header():
    return f"random order: SHUFFLE={SHUFFLE}" if SHUFFLE else ""


@pytest.hookimpl(trylast=True)  # after -m and -k
def pytest_collection_modifyitems(config, items):
    """Leave the deep tests to `make deep`; leave out what this machine cannot run, in a line for each reason.

    Thorough tests run where they are named: with --all, by their node ids, or by -m.
    """
    if not DEEP:
        config.hook.pytest_deselected(items=[item for item in items if item.get_closest_marker("deep")])
        items[:] = [item for item in items if not item.get_closest_marker("deep")]
    kept = []
    groups = {}
    named = config.getoption("--all") or config.getoption("-m") or any("::" in word for word in config.args)
    for item in items:
        reason = THOROUGH if item.get_closest_marker("thorough") and not named else _why_left_out(item)
        groups.setdefault(reason, []).append(item) if reason else kept.append(item)
    left_out = {reason: len(group) for reason, group in groups.items()}
    _note_left_out(config, left_out)
    if hasattr(config, "workeroutput"):  # a process of several, whose output only the first one can print
        config.workeroutput[LEFT_OUT_OUTPUT] = left_out
    for group in groups.values():
        config.hook.pytest_deselected(items=group)
    if SHUFFLE:  # the same order in every process
        random.Random(SHUFFLE).shuffle(kept)
    items[:] = [] if _lacking(config) else kept


def _lacking(config):
    """Whether the machine lacks what a test needs, where each must be able to run."""
    return STRICT and bool(config.stash.get(LEFT_OUT, {}).keys() - {THOROUGH})


def nginx_path():
    """Path of nginx, which Debian installs where an ordinary user does not look."""
    return shutil.which("nginx", path=f"{os.environ['PATH']}{os.pathsep}/usr/sbin")


@cache
def _has_chinese_font():
    from app.files.fonts import MissingPackage, families  # Most tests do without.
    from core.language import speaking

    try:
        with speaking("zh"):
            families()
    except MissingPackage:
        return False
    return True


# What tests with a mark need: what is true where they can run, and how to get it.
NEEDS = {
    "firefox": (firefox.firefox_path, firefox.MISSING),
    "node": (node.node_path, node.MISSING),
    "chinese_font": (_has_chinese_font, NO_FONT),
    "root": (lambda: os.geteuid() == 0, NO_DISK),
    "curl": (lambda: shutil.which("curl"), NO_CURL),
    "nginx": (nginx_path, NO_NGINX),
    "caddy": (lambda: shutil.which("caddy"), NO_CADDY),
    "systemd": (lambda: shutil.which("systemd-analyze"), NO_SYSTEMD),
    "index": (lambda: lock.index_answers(OUTER), NO_INDEX),
}


def _why_left_out(item):
    """What this machine lacks for the test and how to get it; empty: it runs."""
    if "browser" in getattr(item, "fixturenames", ()) and not browser.browser_path():
        return browser.MISSING
    for mark, (can_run, reason) in NEEDS.items():
        if item.get_closest_marker(mark) and not can_run():
            return reason
    engine = item.get_closest_marker("engine")
    if engine and (missing := [name for name in engine.args if not find_spec(name)]):
        return NO_ENGINE.format(", ".join(missing))
    return "" if kernels.COMPILED or item.get_closest_marker("uncompiled") else UNCOMPILED


def _note_left_out(config, left_out):
    config.stash[LEFT_OUT] = config.stash.get(LEFT_OUT, {}) | left_out


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node):
    """Keep what a process left out: all collect the same tests."""
    _note_left_out(node.config, getattr(node, "workeroutput", {}).get(LEFT_OUT_OUTPUT, {}))


def pytest_sessionfinish(session):
    if _lacking(session.config):
        session.exitstatus = pytest.ExitCode.USAGE_ERROR


@pytest.hookimpl(wrapper=True)
def pytest_collection():
    """Free the garbage collector from the modules and 6,000 tests, all of which stay.

    Going through them again and again takes a third of the processor time of the collection, and then a tenth of
    that of the tests of core.
    """
    gc.disable()
    try:
        return (yield)
    finally:
        gc.freeze()
        gc.enable()
        gc.set_threshold(20_000)


def pytest_terminal_summary(terminalreporter, config):
    failed = [report.nodeid for kind in ("failed", "error") for report in terminalreporter.stats.get(kind, [])]
    if failed:
        terminalreporter.section("to repeat each alone")
        python = Path(sys.executable)
        python = python.relative_to(ROOT) if python.is_relative_to(ROOT) else python
        for name in dict.fromkeys(failed):
            terminalreporter.write_line(f"{python} -m pytest {shlex.quote(name)}")
    for reason, count in config.stash.get(LEFT_OUT, {}).items():
        terminalreporter.write_line(f"{count} tests are left out: {reason}", yellow=True)
    if _lacking(config):
        terminalreporter.write_line("No test ran: where EVERY_TEST is set, each must be able to.", red=True)


@pytest.fixture(scope="session")
def pseudo_house(tmp_path_factory):
    """The folder of the program with a third language."""
    from tests.support.pseudo import house

    return house(tmp_path_factory.mktemp("house"))


@pytest.fixture(scope="session")
def server(tmp_path_factory):
    """Base URL of the real service, in its own process: default settings, but the deadline of a slow machine."""
    from tests.support.serving import serving  # which needs this file

    with serving(tmp_path_factory.mktemp("server") / "server.log", deadline_seconds=40) as service:
        yield service.url


def heed_ctrl_c():
    """preexec_fn of a child that a test interrupts; under a script's `make test &` the child would ignore SIGINT."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


def wait_until_live(process, port, log):
    """Return when /healthz answers 200; fail with the server's log if it cannot start."""
    end = time.monotonic() + START_TIMEOUT
    while process.poll() is None and time.monotonic() < end:
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
        try:
            connection.request("GET", "/healthz")
            if connection.getresponse().status == http.client.OK:
                return
        except OSError:
            time.sleep(0.05)
        finally:
            connection.close()
    process.kill()
    pytest.fail(f"the server did not start:\n{log.read_text()}")
