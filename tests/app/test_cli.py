"""The command, run as a user runs it: a process of its own, real pipes, a real terminal, real signals."""

import contextlib
import fcntl
import json
import os
import pty
import re
import signal
import struct
import subprocess
import termios
from functools import cache

import httpx
import openpyxl
import pytest
import typer
from rich.cells import cell_len
from rich.markup import render

import core
from app.command.main import MODULE_OF, app
from app.questions.registry import QUESTIONS
from app.service.workers import START_SECONDS
from app.settings import Settings
from core.kernels import COMPILED
from core.language import say, speaking
from tests.conftest import ROOT, heed_ctrl_c
from tests.support.command import COMMAND, ENVIRONMENT, PATIENCE, run, said
from tests.support.depth import further, thorough
from tests.support.job_service import wait_for
from tests.support.refusal_rows import assert_refused_in_one_line
from tests.support.serving import sample, serving

# Questions besides figures that commands of another name answer, and two that none does: the page draws with course,
# and a sweep of collision-time over the pitch is the scan. contest has all answers, and grade the table of a class.
OTHERWISE = {"films", "proposals", "contest_kit", "contest_answer", "class_table", "course", "pitch_scan"}


def helps():
    """Every command that has a help, by its words: that of the whole program by none."""
    group = typer.main.get_command(app)
    yield (), group
    for name in group.list_commands(None):
        command = group.get_command(None, name)
        yield (name,), command
        yield from (((name, inner), one) for inner, one in getattr(command, "commands", {}).items())


HELPS = dict(helps())
# One run for all tests that ask the same.
cached_output = cache(said)


def test_times_before_the_dance_warn_on_a_spiral():
    warned = run("trajectory", "--benches", "3", "--pitch", "1.7", "--times", "-100,0", "--json")
    assert warned.returncode == 0
    assert "begins at 0 s" in warned.stderr
    assert "--path turn" in warned.stderr


@pytest.mark.parametrize(
    "row",
    [
        "trajectory -> handle | 223 tail (rear) | speed [m/s] | 300 s | 0.996478",
        "collision-time -> 412.473837682 s | 0, 8 | front-outer corner of bench 0 | judged | all 223 benches",
        "collision-time --cross-check pair -> cross check: FCL | before no, after yes",
        "collision-time --language zh --cross-check pair -> 0 号板凳的前外角 | 交叉检验：分离轴 | 交叉检验：角度和",
        "collision-time --cross-check pair -> only benches 0, 8",
        "collision-time --margin 0.05 -> left out | angle sum | within 0.05 m",
        "collision-time --margin 0.2 -> within 0.2 m from the start on | 0.169278671 m",
        "collision-time --pitch 1.2 --margin 0.05 -> never within 0.05 m",
        "collision-time --benches 3000 -> 119 of 3,000 benches, from 0 to 287: those near the pair",
        "collision-time --pitch 0.25 --start-turns 8 -> contact_at_start |    after yes",
        "collision-time --pitch 0.3 -> overlap by 0.114626613 m",
        "collision-time --pitch 0.8 -> clear | fold | 637.66",
        "collision-time --benches 20 -> First contact",
        "clearance --pitch 0.3 --stop 1 -> [m] | overlap by 0.114626613",
        "overlaps --time 413 -> overlap by 0.0 | 0, 8 | All four engines agree",
        "minimum-pitch -> 0.450337393 m | graze | 0, 19 | every larger pitch | no scan",
    ],
)
def test_tables_for_people_hold_the_numbers_with_their_units(row):
    line, words = row.split(" -> ")
    table = cached_output(*line.split())
    assert [word for word in words.split(" | ") if word not in table] == []


@pytest.mark.parametrize(
    "row",
    [
        "collision-time --pitch 55 -> pitch ... 10 m, 55 m 0.55 m",
        "collision-time --pitch nan -> pitch ... [m], NaN",
        'collision-time --pitch 55cm -> --pitch ... [m], "55cm" 0.55 m',
        "collision-time --pich 0.5 -> --pich is unknown here: did you mean --pitch?",
        "collision-time --stop 5 -> --stop is unknown here: see --help",
        "collision-time --benches 1e3 -> --benches ... whole 1e3",
        "collision-time --cross-check all -> --cross-check ... dragon, pair none, all",
        "trajectory --stop 440 -> stop ... 432.917924228 s, bench 0 440 s",
        "trajectory --decimals 16 -> decimals ... 15, 16",
        "trajectory --step 1e-6 -> instants x handles ... 1000000 67200000224",
        "trajectory --output dance.doc -> --output ... .csv, .xlsx, .arrow .json, .doc",
        "trajectory --output /no/such/dance.csv -> --output ... folder /no/such/dance.csv",
        "overlaps /no/such/file -> /no/such/file: No such file or directory",
        "check -> FILE is missing",
        "sweep run spec.toml -> --output is missing",
        "check dance.toml --margin 1.3 -> --margin is unknown here: see --help",
        "foo -> foo is unknown here: see --help",
        "overlap -> overlap is unknown here: did you mean overlaps?",
        "sweep rum -> rum is unknown here: did you mean run?",
        "--versoin -> --versoin is unknown here: did you mean --version?",
        "serve --port 99999 -> --port ... 0 65535, 99999",
        "serve --port x -> --port ... x",
        "figures --kind x -> --kind ... x",
        "prove -> give either a claim to prove or --check FILE",
        *thorough("minimum-pitch --body-length 0.001 --overhang 0 -> body_length ... benches 0.001 m"),
        "contest '' -> FOLDER must not be an empty name",
        "figures '' -> FILE must not be an empty name",
        "trajectory '' -> FILE must not be an empty name",
        "sweep run spec.toml --output '' -> --output must not be an empty name",
        "sweep run no-such.toml --output out -> no-such.toml",
        "sweep show no-such-folder -> no-such-folder",
        "sweep show no-such-folder --output map.pdf -> --output",
        "sweep compact no-such-folder -> no-such-folder",
        "grade . -> . must hold a file that ends in .xlsx",
        "grade -> give at least one FILE or one number",
        "grade --pitch wide -> pitch ... [m] digits 'wide'",
        "grade --pitch 0_4504 -> pitch ... [m] digits '0_4504'",
        "grade --pitch -1 -> pitch ... 0",
        "grade missing.xlsx -> missing.xlsx: No such file or directory",
        "sweep show '' -> FOLDER must not be an empty name",
        "trajectory --times 0,1 --stop 300 -> --times replaces --stop",
        "trajectory --times 0,1 --start 0 -> --times replaces --start",
        "trajectory --step 1 --times 0,1 -> --times replaces --step",
        "trajectory --times '' -> times[0] ... ''",
        "trajectory --times 0,soon -> times[1] ... 'soon'",
        "trajectory --times 0,nan -> times[1] ... [s], NaN",
        "trajectory --times 0,440 -> times[1] ... 432.917924228 s 440 s",
        "overlaps --time 440 -> time ... 432.917924228 s 440 s",
        "figures . --kind trajectory --time 440 -> time ... 432.917924228 s 440 s",
        "trajectory --times 0,2e6 -> times[1] ... 1000000 s, 2000000 s",
        "trajectory --handles 0,224 -> handles[1] ... 0 223 224",
        "trajectory --handles -1 -> handles[0] ... 0 223 -1",
        "trajectory --handles 0.5 -> handles[0] ... whole '0.5'",
        "trajectory --handles 0 --json -> --handles ... --output --json",
        "trajectory --handles 0 --output a.csv -> --handles ... --output --json",
        "trajectory --json --output a.csv -> --json ... --output",
        "figures out --kind trajectory --turning-diameter 9 -> --turning-diameter ... trajectory",
        "figures out --kind contact --kind trajectory --samples 9 -> --samples ... contact trajectory",
        "figures out --kind pitch-scan --head-speed 1 -> --head-speed ... pitch-scan",
        "film --ratio 3 --output dance.mp4 -> --ratio ... turn --path",
        "envelope --output ground.kml -> --output must end in .geojson, .json or .dxf, got .kml",
        "film --output dance.avi -> --output ... .mp4 .gif, .avi",
        "mcp --folder /dev/null -> --folder must be a folder, got /dev/null",
        "mcp --folder '' -> --folder must not be an empty name",
        "film --bench 223 --output dance.gif -> marked[0] ... 222, 223",
    ],
)
def test_wrong_use_gets_one_line_on_standard_error_and_exit_code_2(row, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert_refused_in_one_line(row)
    assert list(tmp_path.iterdir()) == []


def test_the_limits_are_those_of_the_settings():
    row = "collision-time --benches 11 -> benches ... 10 11"
    assert_refused_in_one_line(row, BENCH_DRAGON_BENCHES_MAX="10")


def test_a_setting_that_cannot_be_is_one_line_that_names_it():
    assert_refused_in_one_line("collision-time -> BENCH_DRAGON_BENCHES_MAX ... many", BENCH_DRAGON_BENCHES_MAX="many")
    assert_refused_in_one_line("serve -> BENCH_DRAGON_DASK ... tcp://", BENCH_DRAGON_DASK="http://foo:8786")


NO_SCHEDULERS = ("foo", "tcp://", "tcp://foo", "tcp://foo:x", "tcp://foo:70000", "http://foo:8786")


@pytest.mark.parametrize(
    "row",
    [
        "BENCHES_MAX 0 -> 1,",
        "SWEEP_PROCESSES 65 -> 64,",
        "JOB_DAYS_MAX 0 -> 0,",
        "JOB_DAYS_MAX {gt} -> number",
        "LOG_JSON maybe -> true or false",
        *(f"DASK {address} -> tcp://scheduler:8786" for address in NO_SCHEDULERS),
    ],
)
def test_the_refusal_of_a_setting_names_its_limit(row, monkeypatch):
    line, limit = row.split(" -> ")
    name, setting = line.split()
    monkeypatch.setenv(f"BENCH_DRAGON_{name}", setting)
    with pytest.raises(core.InvalidValue, match=rf" {re.escape(limit)}.*{re.escape(repr(setting))}") as refused:
        Settings()
    assert refused.value.field == f"BENCH_DRAGON_{name}"


@pytest.mark.parametrize("address", ["", "local", "tcp://10.0.0.1:8786", "scheduler:8786", "tls://[::1]:1"])
def test_an_address_of_a_scheduler_is_a_setting(address, monkeypatch):
    monkeypatch.setenv("BENCH_DRAGON_DASK", address)
    assert Settings().dask == address


def test_a_file_is_in_the_language_that_is_asked_for(tmp_path):
    book = tmp_path / "a.xlsx"
    run("trajectory", "--stop", "1", "--language", "zh", "--output", str(book))
    assert openpyxl.load_workbook(book)["位置"]["A2"].value == "龙头x (m)"


def headings(text):
    """The instants above each table of a trajectory."""
    return [line.split()[1::2] for line in text.splitlines() if line.split()[:1] == ["handle"]]


@pytest.mark.parametrize(
    "row",
    [
        "--stop 300 --step 60 -> 0 60 120 180 240 300 | 7 of 224 handles, 6 of 6 instants",
        "--benches 5 --stop 6 -> 0 1 2 3 4 5 6 | ",
        "--benches 5 --stop 7 -> 0 1 2 4 5 6 7 | ",
        "--times 0,60,120 --handles 51,0,1 -> 0 60 120 | 3 of 224 handles, 3 of 3 instants: --output has all.\n",
        "--times 0,1 -> 0 1 | : --output has all, --handles chooses.\n",
        "--handles 0 --benches 3 --stop 6 -> 0 1 2 3 4 5 6 | : --output has all, --times chooses.\n",
    ],
)
def test_up_to_seven_instants_are_shown_and_what_chooses_more_is_named(row):
    options, _, shown = row.partition(" -> ")
    instants, _, words = shown.partition(" | ")
    table = said("trajectory", *options.split())
    assert headings(table) == [instants.split()] * 3
    assert words in table


def on_terminal(columns, *arguments, stream="stdout", until=None):
    """What a stream of the command shows on a terminal of a width, without colours.

    until: words that are followed by Ctrl-C
    """
    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    streams = dict.fromkeys(("stdout", "stderr"), subprocess.DEVNULL) | {stream: follower}
    streams |= {"env": ENVIRONMENT | {"TERM": "xterm"}, "preexec_fn": heed_ctrl_c}
    with subprocess.Popen([COMMAND, *arguments], **streams) as process:
        os.close(follower)
        seen = b""
        code = 0
        with contextlib.suppress(OSError):  # what reads a terminal without a writer gets an error, not an end of file
            while chunk := os.read(leader, 65_536):
                seen += chunk
                if until and until in seen and not code:
                    process.send_signal(signal.SIGINT)
                    code = 130
        os.close(leader)
        assert process.wait(PATIENCE) == code
    assert b"Traceback" not in seen
    return re.sub(r"\x1b\[[0-9;]*m", "", seen.decode())


@pytest.mark.parametrize("command", further(["collision-time", "paper"], 1))
def test_no_number_is_broken_on_a_narrow_terminal(command):
    narrow, wide = (on_terminal(columns, command) for columns in (40, 200))
    assert max(map(len, narrow.splitlines())) <= 40
    whole = re.findall(r"\d+\.\d+", wide)
    assert len(whole) > 3
    assert set(whole) == set(re.findall(r"\d+\.\d+", narrow))


@pytest.mark.parametrize(
    "row",
    [
        "two_dragons ->   blue：0 号板凳于 217.609538 s 折叠",
        "two_dragons ->   0、4 号板凳",
        "village_square ->   距广场最近 ",
        "crossing_streets ->   14、15、16、17、18、19、20 号把手",
    ],
)
def test_chinese_names_and_lists_of_a_check_are_written_as_people_write_them(row):
    example, words = row.split(" -> ")
    output = run("check", str(ROOT / "examples" / f"{example}.toml"), "--language", "zh").stdout
    assert words in output


@pytest.mark.parametrize("columns", further([80, 41, 120], 1))
def test_a_chinese_sentence_in_a_table_is_whole_at_every_width(columns):
    method = json.loads(said("collision-time", "--language", "zh", "--json"))["certificate"]["method"]
    output = on_terminal(columns, "collision-time", "--language", "zh")
    assert max(map(cell_len, output.splitlines())) <= columns
    assert "".join(method.split()) in "".join(output.split())


def test_as_many_instants_are_shown_as_fit_the_width():
    output = on_terminal(60, "trajectory", "--stop", "300", "--step", "60")
    assert headings(output) == [["0", "120", "300"]] * 3
    assert max(len(line) for line in output.splitlines() if not line.endswith("choose.")) <= 60
    assert "3 of 6 instants" in output.replace("\r\n", " ")


def test_times_that_were_asked_for_are_all_shown_in_as_many_tables_as_they_take_and_handles_in_their_order():
    times = [str(k) for k in range(20)]
    table = said("trajectory", "--benches", "3", "--handles", "2,0,1", "--times", ",".join(times))
    result = headings(table)
    assert [instant for heading in result[: len(result) // 3] for instant in heading] == times
    assert result == result[: len(result) // 3] * 3
    assert re.findall(r"^  (\d+) (?:head|body|tail)", table, re.MULTILINE) == ["2", "0", "1"] * len(result)


@pytest.mark.parametrize("flags", [pytest.param([], marks=pytest.mark.deep), ["--json"]], ids=["table", "json"])
def test_a_reader_that_stops_early_is_no_error(flags):
    with subprocess.Popen(
        [COMMAND, "trajectory", *flags], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT
    ) as process:
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait(PATIENCE) in (0, 1)


@pytest.mark.thorough
@pytest.mark.parametrize(
    "line, words",
    [
        # Ten times as long as the wait before the bar, and most of a minute: all pairs of 223 benches.
        ("film --output dance.mp4", b"film"),
        ("prove collision-time --every-pair --output proof.json", b"%"),
    ],
)
def test_a_long_wait_shows_a_bar_and_ctrl_c_ends_it_cleanly(line, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    seen = on_terminal(80, *line.split(), stream="stderr", until=words)
    assert ("Interrupted: nothing was written." in seen) >= line.startswith("prove")
    assert list(tmp_path.iterdir()) == []


SLOW_START = """import threading, time
start = threading.Thread.start
threading.Thread.start = lambda self: (start(self), time.sleep(2.0 * (self.name == "drawing_0")))
"""


# A library may be where a Ctrl-C comes, and catch it.
CAUGHT = """import contextlib, signal
settle = signal.signal
def caught(number, handler):
    def swallow(*of):
        with contextlib.suppress(KeyboardInterrupt):
            handler(*of)
    return settle(number, swallow if number == signal.SIGINT and callable(handler) else handler)
signal.signal = caught
"""


@pytest.mark.thorough
@pytest.mark.parametrize("disturbed", [SLOW_START, CAUGHT])
def test_ctrl_c_while_a_thread_starts_or_that_is_caught_ends_the_command(disturbed, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sitecustomize.py").write_text(disturbed)
    monkeypatch.setitem(ENVIRONMENT, "PYTHONPATH", str(tmp_path))
    on_terminal(80, "film", "--output", "dance.mp4", stream="stderr", until=b"film")
    assert not (tmp_path / "dance.mp4").exists()


def test_ctrl_c_while_modules_are_imported_ends_without_a_word(tmp_path):
    caught = "try:\n    time.sleep(60)\nexcept BaseException:\n    raise ImportError"
    (tmp_path / "typer.py").write_text(f"import sys, time\nprint('importing', flush=True)\n{caught}")
    process = subprocess.Popen(
        [COMMAND, "--version"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=ENVIRONMENT | {"PYTHONPATH": str(tmp_path)},
        preexec_fn=heed_ctrl_c,
    )
    assert process.stdout.readline() == b"importing\n"
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=PATIENCE) == (b"", b"")
    assert process.returncode == 130


def as_from_a_terminal():
    """In the process of a service: alone in a session, where Ctrl-C reaches all its processes."""
    os.setsid()
    heed_ctrl_c()


@pytest.mark.parametrize("workers", further([1, 2], 1))
def test_serve_replaces_a_process_that_dies_or_hangs_and_keeps_its_counts_and_ctrl_c_ends_it(tmp_path, workers):
    with serving(tmp_path / "log", workers, as_from_a_terminal) as service:

        def all_started(count):
            return service.log.read_text().count("Application startup complete") == count

        def counted(count):
            return sample(service.url, 'bench_dragon_requests_total{path="/readyz",status="200"}') == count

        wait_for(lambda: all_started(workers))
        pids = [int(pid) for pid in re.findall(r"Started server process \[(\d+)\]", service.log.read_text())]
        assert len(pids) == workers
        for k in range(1, 4):
            httpx.get(f"{service.url}/readyz").raise_for_status()
            wait_for(lambda: counted(k))  # noqa: B023 - requests are counted just after their answers
        if workers > 1:
            os.kill(pids[0], signal.SIGKILL)
            wait_for(lambda: all_started(workers + 1))
            assert f"Child process [{pids[0]}] was ended by signal 9" in service.log.read_text()
            assert counted(3)
            os.kill(pids[1], signal.SIGSTOP)
            # It is silent, not slow to start.
            wait_for(lambda: f"[{pids[1]}] died" in service.log.read_text(), 0.5 * START_SECONDS)
            wait_for(lambda: all_started(workers + 2))
            httpx.get(f"{service.url}/readyz").raise_for_status()
        os.killpg(service.process.pid, signal.SIGINT)
        assert service.process.wait(PATIENCE) == 0
        assert "Traceback" not in service.log.read_text()


@pytest.mark.parametrize("workers", further(["1", "2"], 1))
def test_serve_on_a_port_that_is_taken_gets_exit_code_2(server, workers):
    done = run("serve", "--port", server.rpartition(":")[2], "--workers", workers)
    assert done.returncode == 2
    assert "address already in use" in done.stderr.lower()
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("words", HELPS, ids=" ".join)
def test_help_prints_every_description_with_its_unit_and_in_chinese_is_whole_and_has_no_english_sentence(words):
    text = " ".join(said(*words, "--help", COLUMNS="1000").split())
    described = [render(one.help).plain for one in HELPS[words].params if one.help]
    assert [one for one in described if " ".join(one.split()) not in text] == []
    assert ("completion" in text) == (words == ())
    _, usage, *lines = filter(None, said("--language", "zh", *words, "-h", TERM="dumb", COLUMNS="60").splitlines())
    assert "用法： bench-dragon" in usage
    assert re.findall("[A-Za-z]+[,;]? [a-z]+ [a-z]+|Options|Arguments|Commands|default:|required", str(lines)) == []
    assert {*map(cell_len, lines)} == {60}
    text = "".join(line.strip("│ ").rpartition("  ")[2] for line in lines).replace(" ", "")
    with speaking("zh"):
        assert [one for one in described if say(one) == one or say(one).replace(" ", "") not in text] == []


def test_help_names_every_command():
    assert {*MODULE_OF} <= {*said("--help", COLUMNS="100").split()}


def test_every_question_has_its_command():
    commands = {name.replace("-", "_") for name in MODULE_OF}
    without = {name for name in QUESTIONS if not name.endswith("_figure")} - commands
    assert without == OTHERWISE, "app/command/main.py needs a line of it"


def test_the_version_is_one_line():
    slower = "" if COMPILED else ", not compiled: many times slower"
    assert said("--version") == f"bench-dragon {core.__version__}{slower}\n"


def test_the_shell_completes_commands_and_options():
    request = {"_BENCH_DRAGON_COMPLETE": "complete_bash", "COMP_CWORD": "1"}
    assert said(**request, COMP_WORDS="bench-dragon coll").split() == ["collision-time"]
    request["COMP_CWORD"] = "2"
    assert said(**request, COMP_WORDS="bench-dragon collision-time --pit").split() == ["--pitch"]
    request = {"_BENCH_DRAGON_COMPLETE": "complete_zsh", "_TYPER_COMPLETE_ARGS": "bench-dragon collision-time --pit"}
    assert "螺线每转一圈" in said(**request, LC_ALL="zh_CN.UTF-8")


FOLDING = ("trajectory", "--benches", "40", "--pitch", "1.2", "--start-turns", "8")


def test_instants_just_before_a_fold_are_marked_and_the_fold_is_named():
    output = said(*FOLDING, "--times", "0,100,238.2149")
    assert output.count("238.2149 s *") == 3
    assert "100 s *" not in output
    words = " ".join(output.split())
    assert words.endswith(
        "* Just before bench 0 folds, at 238.214985392 s: towards that instant the speeds of handles behind it grow "
        "without bound."
    )
    assert "*" not in said(*FOLDING, "--times", "0,100")


def test_bounds_are_printed_with_all_digits_or_rounded_to_the_safe_side():
    answer = json.loads(cached_output("collision-time", "--json"))
    output = cached_output("collision-time")
    assert f"{answer['time_bracket'][0]!r}, {answer['time_bracket'][1]!r} s" in output
    assert re.search(rf"clear until +{re.escape(repr(answer['certificate']['clear_until']))} s", output)


def test_the_table_on_a_terminal_has_the_decimals_that_are_asked_for():
    done = run("trajectory", "--benches", "3", "--times", "0,100", "--decimals", "2")
    assert re.search(r"0 head +8\.80 +-?\d\.\d\d ", done.stdout)
    assert not re.search(r"\d\.\d{3}", done.stdout)


LOCALES = [
    ({"LANG": "zh_CN.UTF-8"}, None, "zh"),
    ({"LANG": "zh_CN.UTF-8"}, "en", "en"),
    ({"LC_ALL": "C", "LANG": "zh_CN.UTF-8"}, None, "en"),
    ({"LC_MESSAGES": "zh_CN", "LANG": "en_US.UTF-8"}, None, "zh"),
    ({"LANG": "en_US.UTF-8"}, "zh-TW", "zh"),
    ({"LANG": "zh_CN.UTF-8"}, "fr", "en"),
    ({}, None, "en"),
]


@pytest.mark.parametrize("locale, chosen, words", LOCALES)
def test_progress_is_in_the_language_chosen_or_that_of_the_terminal(tmp_path, locale, chosen, words):
    for name in ("a.csv", "b.csv"):
        (tmp_path / name).write_text("1,2\n")
    unset = dict.fromkeys(("LC_ALL", "LC_MESSAGES", "LANG"), "")
    options = ["--language", chosen] if chosen else []
    lines = run("grade", str(tmp_path), *options, **(unset | locale)).stderr.splitlines()
    if chosen == "fr":
        assert lines.pop(0) == "注意：没有语言 'fr' 的文字，以下用英文"
    assert lines == [f"{'评阅：' if words == 'zh' else 'grading: '}{share} %" for share in (50, 100)]
    # So is what is said of a mistake, before all options are read.
    *_, mistake = run("paper", "more", *options, **(unset | locale)).stderr.splitlines()
    assert mistake.startswith("错" if words == "zh" else "E")
