"""The command, run as a user runs it: a process of its own, real pipes, a real terminal, real signals."""

from __future__ import annotations

import contextlib
import csv
import fcntl
import json
import os
import pty
import re
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import time
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import httpx
import openpyxl
import pytest
import typer

import core
from app.command.main import MODULE_OF, app
from app.command.show import print_answer
from app.questions.maximum_head_speed import MaximumHeadSpeed
from app.questions.registry import QUESTIONS
from app.service.workers import SILENT_SECONDS, START_SECONDS
from app.settings import Settings
from core.kernels import COMPILED
from tests.conftest import heed_ctrl_c
from tests.support.command import COMMAND, ENVIRONMENT, PATIENCE, run

# The service, which replaces a process that is silent for so long [s].
SILENT = 2.0
IMPATIENT = (
    sys.executable,
    "-c",
    f"from app.service import workers; workers.SILENT_SECONDS = {SILENT}; from app.command.entry import main; main()",
)
HEALTH_COUNT = 'bench_dragon_requests_total{path="/healthz"'
CROSSED = {
    "benches": [
        {"x": 0.0, "y": 0.0, "heading": 0.0, "length": 2.2, "width": 0.3},
        {"x": 1.0, "y": 0.5, "heading": 1.5, "length": 2.2, "width": 0.3},
    ],
    "chained": False,
}
# Questions besides figures that commands of another name answer, and two that none does: the page draws with course,
# and a sweep of collision-time over the pitch is the scan.
OTHERWISE = {"films", "proposals", "contest_kit", "course", "pitch_scan"}


def answer_of(*arguments: str, **keywords: Any) -> str:
    """Standard output of a run that must succeed without a word on standard error."""
    done = run(*arguments, **keywords)
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def helps() -> Iterator[tuple[tuple[str, ...], Any]]:
    """Every command that has a help, by its words."""
    group: Any = typer.main.get_command(app)
    for name in group.list_commands(None):
        command = group.get_command(None, name)
        yield (name,), command
        yield from (((name, inner), one) for inner, one in getattr(command, "commands", {}).items())


HELPS = dict(helps())
# One run for all tests that ask the same.
cached_output = cache(answer_of)


def served(client: httpx.Client, method: str, target: str, body: object = None) -> Any:
    reply = client.request(method, target, **({} if body is None else {"json": body}))
    assert reply.status_code == httpx.codes.OK, reply.text
    return reply.json()


@pytest.mark.parametrize(
    ("arguments", "method", "target", "body"),
    [
        (["collision-time"], "GET", "/collision-time", None),
        (["collision-time", "--pitch", "0.45"], "GET", "/collision-time?pitch=0.45", None),
        (["collision-time", "--margin", "0.05"], "GET", "/collision-time?margin=0.05", None),
        (["collision-time", "--cross-check", "pair"], "GET", "/collision-time?cross_check=pair", None),
        (["collision-time", "--cross-check", "none"], "GET", "/collision-time?cross_check=none", None),
        (["minimum-pitch"], "GET", "/minimum-pitch", None),
        (["minimum-pitch", "--cross-check", "none"], "GET", "/minimum-pitch?cross_check=none", None),
        (["minimum-pitch", "--turning-diameter", "6"], "GET", "/minimum-pitch?turning_diameter=6", None),
        (["trajectory"], "POST", "/trajectory", {}),
        (
            ["trajectory", "--start", "1", "--stop", "2", "--step", "0.25", "--decimals", "6", "--head-length", "3"],
            "POST",
            "/trajectory",
            {"times": {"start": 1, "stop": 2, "step": 0.25}, "decimals": 6, "dragon": {"head_length": 3}},
        ),
        (["paper"], "GET", "/paper", None),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)  # fmt: skip
def test_json_is_the_answer_of_the_service(
    client: httpx.Client, arguments: list[str], method: str, target: str, body: object
) -> None:
    assert json.loads(cached_output(*arguments, "--json")) == served(client, method, target, body)


def test_overlaps_reads_benches_from_a_file_or_a_pipe(client: httpx.Client, tmp_path: Path) -> None:
    file = tmp_path / "benches.json"
    file.write_text(json.dumps(CROSSED))
    answer = served(client, "POST", "/overlaps", CROSSED)
    assert [one["benches"] for one in answer["overlaps"]] == [[0, 1]]
    assert json.loads(answer_of("overlaps", str(file), "--json")) == answer
    piped = subprocess.run(
        [COMMAND, "overlaps", "-", "--json"],
        input=json.dumps(CROSSED),
        stdout=subprocess.PIPE,
        text=True,
        timeout=PATIENCE,
        env=ENVIRONMENT,
    )
    assert json.loads(piped.stdout) == answer


def test_overlaps_of_the_dance_before_and_after_first_contact() -> None:
    assert json.loads(answer_of("overlaps", "--time", "412.47", "--json"))["overlaps"] == []
    after = json.loads(answer_of("overlaps", "--time", "412.48", "--json"))
    assert [one["benches"] for one in after["overlaps"]] == [[0, 8]]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["trajectory"], ["handle", "223 tail (rear)", "speed [m/s]", "300 s", "0.996478"]),
        (["collision-time"], ["412.473837682 s", "0, 8", "front-outer", "412.473837682"]),
        (["collision-time"], ["judged", "all 223 benches", "before no, after yes"]),
        (["collision-time", "--cross-check", "pair"], ["only benches 0, 8"]),
        (["collision-time", "--margin", "0.05"], ["left out", "angle_sum"]),
        (["collision-time", "--benches", "3000"], ["119 of 3,000 benches, from 0 to 287: those near the pair"]),
        (["collision-time", "--pitch", "0.25", "--start-turns", "8"], ["contact_at_start", "   after yes"]),
        (["collision-time", "--pitch", "0.3"], ["overlap by 0.114626613 m"]),
        (["clearance", "--pitch", "0.3", "--stop", "1"], ["[m]", "overlap by 0.114626613"]),
        (["overlaps", "--time", "413"], ["overlap by 0.0"]),
        (["collision-time", "--pitch", "0.8"], ["clear", "fold", "637.66"]),
        (["minimum-pitch"], ["0.450337393 m", "graze", "0, 19", "every larger pitch", "no scan"]),
        (["overlaps", "--time", "413"], ["0, 8", "All four engines agree"]),
    ],
    ids=lambda value: " ".join(value),
)
def test_tables_for_people_hold_the_numbers_with_their_units(arguments: list[str], words: list[str]) -> None:
    table = cached_output(*arguments)
    assert [word for word in words if word not in table] == []


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (
            "collision-time --pitch 55",
            "pitch must be at most 10 m, got 55 m: lengths are in metres, and 55 cm is 0.55 m",
        ),
        ("collision-time --pitch nan", "pitch must be a finite number [m], got NaN"),
        ("collision-time --pitch -1", "pitch must be at least 0.001 m, got -1 m"),
        ("collision-time --benches 0", "benches must be at least 1, got 0"),
        (
            "minimum-pitch --overhang 1.2",
            "overhang must be less than half of body_length (2.2 m / 2 = 1.1 m), got 1.2 m",
        ),
        ("trajectory --stop 440", "stop must be at most 432.917924228 s, when bench 0 folds, got 440 s"),
        (
            "minimum-pitch --benches 5 --head-length 2.2 --body-length 2.2 --overhang 0.6 --turning-diameter 2",
            (
                "overhang must be less than a quarter of body_length (2.2 m / 4 = 0.55 m), got 0.6 m: "
                "on a straight line, and so on every wide enough spiral, benches 0 and 2 touch: the chord of bench 1 "
                "between them is 1 m, their overhangs 0.6 m and 0.6 m"
            ),
        ),
        ("trajectory --decimals 16", "decimals must be at most 15, got 16"),
        ("trajectory --output dance.doc", "--output must end in .csv, .xlsx, .arrow or .json, got .doc"),
        ("trajectory --output /no/such/dance.csv", "--output must be in a folder that exists, got /no/such/dance.csv"),
        ("overlaps /no/such/file", "/no/such/file: No such file or directory"),
        (
            "collision-time --pitch 55cm",
            '--pitch must be a number [m], got "55cm": lengths are in metres, and 55 cm is 0.55 m',
        ),
        ("collision-time --pich 0.5", "--pich is unknown here: did you mean --pitch?"),
        ("collision-time --stop 5", "--stop is unknown here: see --help"),
        ("collision-time --benches 1e3", "--benches must be a whole number, got 1e3"),
        ("collision-time --cross-check all", "--cross-check must be dragon, pair or none, got all"),
        ("check", "FILE is missing"),
        ("sweep run spec.toml", "--output is missing"),
        ("sweep run", "FILE is missing"),
        ("check dance.toml --margin 1.3", "--margin is unknown here: see --help"),
        ("foo", "foo is unknown here: see --help"),
        ("overlap", "overlap is unknown here: did you mean overlaps?"),
        ("sweep rum", "rum is unknown here: did you mean run?"),
        ("--versoin", "--versoin is unknown here: did you mean --version?"),
        ("serve --port 99999", "--port must be from 0 to 65535, got 99999"),
        ("prove", "give either a claim to prove or --check FILE"),
    ],
)
def test_wrong_values_get_one_line_on_standard_error_and_exit_code_2(line: str, message: str) -> None:
    done = run(*line.split())
    assert (done.returncode, done.stdout, done.stderr) == (2, "", f"Error: {message}\n")


@pytest.mark.parametrize("line", ["contest", "figures", "sweep run spec.toml --output", "sweep show"])
def test_an_empty_name_is_not_the_current_folder(line: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    done = run(*line.split(), "")
    name = "--output" if "--output" in line else "FILE" if line == "figures" else "FOLDER"
    words = f"Error: {name} must not be an empty name: the current folder is .\n"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", words)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("form", [[], pytest.param(["--json"], marks=pytest.mark.deep)], ids=["table", "json"])
def test_a_full_disk_behind_standard_output_is_one_line_and_exit_code_2(form: list[str]) -> None:
    with Path("/dev/full").open("w") as full:
        done = subprocess.run(
            [COMMAND, "collision-time", *form],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            timeout=PATIENCE,
            env=ENVIRONMENT,
        )
    assert (done.returncode, done.stderr) == (2, "Error: standard output: No space left on device\n")


def test_too_much_work_is_refused_before_it_starts() -> None:
    done = run("trajectory", "--step", "1e-6")
    assert (done.returncode, done.stdout) == (2, "")
    assert "instants x handles must be at most 1000000 here, got 67200000224" in done.stderr


def test_too_much_work_before_an_answer_is_reported_with_exit_code_2() -> None:
    done = run("minimum-pitch", "--body-length", "0.001", "--overhang", "0")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(
        "Error: body_length must be larger, or benches fewer, got 0.001 m: their minimum pitch was not found"
    )
    assert done.stderr.endswith(" m\n")


def test_the_limits_are_those_of_the_settings() -> None:
    done = run("collision-time", "--benches", "11", BENCH_DRAGON_BENCHES_MAX="10")
    assert done.returncode == 2
    assert done.stderr == "Error: benches must be at most 10 here, got 11: shorten the dragon\n"


def test_a_setting_that_cannot_be_is_one_line_that_names_it() -> None:
    done = run("collision-time", BENCH_DRAGON_BENCHES_MAX="many")
    assert done.returncode == 2
    assert done.stderr.startswith("Error: BENCH_DRAGON_BENCHES_MAX must be a whole number")
    assert done.stderr.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "setting", "rule"),
    [
        ("BENCHES_MAX", "0", "must be at least 1, got '0'"),
        ("SWEEP_PROCESSES", "65", "must be at most 64, got '65'"),
        ("JOB_DAYS_MAX", "0", "must be more than 0, got '0'"),
        ("JOB_DAYS_MAX", "{gt}", "must be a number, got '{gt}'"),
        ("LOG_JSON", "maybe", "must be true or false, got 'maybe'"),
    ],
)
def test_the_refusal_of_a_setting_names_its_limit(
    name: str, setting: str, rule: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(f"BENCH_DRAGON_{name}", setting)
    with pytest.raises(core.InvalidValue) as refused:
        Settings()
    assert refused.value.message == f"BENCH_DRAGON_{name} {rule}"


NO_SCHEDULER = "BENCH_DRAGON_DASK must be the address of a scheduler, as tcp://scheduler:8786, got "


def test_a_setting_that_cannot_be_is_refused_at_the_start_of_the_service() -> None:
    done = run("serve", BENCH_DRAGON_DASK="http://foo:8786")
    assert (done.returncode, done.stderr) == (2, f"Error: {NO_SCHEDULER}'http://foo:8786'\n")


@pytest.mark.parametrize("address", ["foo", "tcp://", "tcp://foo", "tcp://foo:x", "tcp://foo:70000", "http://foo:8786"])
def test_an_address_without_a_scheduler_is_no_setting(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BENCH_DRAGON_DASK", address)
    with pytest.raises(core.InvalidValue, match=re.escape(f"{NO_SCHEDULER}{address!r}") + "$"):
        Settings()


@pytest.mark.parametrize("address", ["", "local", "tcp://10.0.0.1:8786", "scheduler:8786", "tls://[::1]:1"])
def test_an_address_of_a_scheduler_is_a_setting(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BENCH_DRAGON_DASK", address)
    assert Settings().dask == address


def test_a_file_that_is_not_json_is_named() -> None:
    done = run("overlaps", "-", text="{benches")
    assert done.returncode == 2
    assert done.stderr.startswith("Error: standard input is not JSON: ")


@pytest.mark.parametrize(
    "arguments", [["trajectory", "--pich", "1"], ["dance"], ["serve", "--port", "x"], ["figures", "--kind", "x"]]
)
def test_unknown_words_get_exit_code_2(arguments: list[str]) -> None:
    done = run(*arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("suffix", ["csv", "json", "xlsx", "arrow"])
def test_output_writes_a_file_and_leaves_standard_output_empty(tmp_path: Path, suffix: str) -> None:
    file = tmp_path / f"dance.{suffix}"
    done = run("trajectory", "--stop", "10", "--output", str(file))
    assert (done.returncode, done.stdout) == (0, "")
    assert done.stderr == f"{file}: 224 handles at 11 instants\n"
    assert file.stat().st_size > 10_000  # [bytes]: 224 x 11 numbers and more


def test_output_takes_decimals_and_language(tmp_path: Path) -> None:
    assert run("trajectory", "--stop", "1", "--decimals", "3", "--output", str(tmp_path / "a.csv")).returncode == 0
    rows = list(csv.DictReader((tmp_path / "a.csv").read_text().splitlines()))
    assert (rows[1]["x"], rows[1]["y"]) == ("8.364", "2.827")
    assert run("trajectory", "--stop", "1", "--language", "zh", "--output", str(tmp_path / "a.xlsx")).returncode == 0
    assert openpyxl.load_workbook(tmp_path / "a.xlsx")["位置"]["A2"].value == "龙头x (m)"


def test_figures_writes_the_files_that_were_asked_for(tmp_path: Path) -> None:
    done = run("figures", str(tmp_path / "new"), "--benches", "20", "--samples", "5")
    assert (done.returncode, done.stdout) == (0, "")
    assert sorted(file.name for file in (tmp_path / "new").iterdir()) == [
        "contact.png",
        "pitch-scan.png",
        "trajectory.png",
    ]
    done = run("figures", str(tmp_path / "one"), "--kind", "contact", "--format", "svg", "--benches", "20")
    assert (done.returncode, done.stderr) == (0, f"{tmp_path / 'one' / 'contact.svg'}\n")
    assert b"<svg" in (tmp_path / "one" / "contact.svg").read_bytes()


def headings(text: str) -> list[list[str]]:
    """The instants above each table of a trajectory."""
    return [line.split()[1::2] for line in text.splitlines() if line.split()[:1] == ["handle"]]


def test_up_to_seven_instants_are_shown_and_none_is_dropped_among_them() -> None:
    six = answer_of("trajectory", "--stop", "300", "--step", "60")
    assert headings(six) == [["0", "60", "120", "180", "240", "300"]] * 3
    assert "7 of 224 handles, 6 of 6 instants" in six
    seven = answer_of("trajectory", "--benches", "5", "--stop", "6")
    assert headings(seven) == [["0", "1", "2", "3", "4", "5", "6"]] * 3
    assert (
        headings(answer_of("trajectory", "--benches", "5", "--stop", "7")) == [["0", "1", "2", "4", "5", "6", "7"]] * 3
    )


def on_terminal(columns: int, *arguments: str) -> str:
    """What the command prints on a terminal of a width, without colours."""
    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 40, columns, 0, 0))
    command = [COMMAND, *arguments]
    with subprocess.Popen(command, stdout=follower, stderr=subprocess.DEVNULL, env=ENVIRONMENT) as process:
        os.close(follower)
        seen = b""
        with contextlib.suppress(OSError):  # what reads a terminal without a writer gets an error, not an end of file
            while chunk := os.read(leader, 65_536):
                seen += chunk
        os.close(leader)
        assert process.wait(PATIENCE) == 0
    return re.sub(r"\x1b\[[0-9;]*m", "", seen.decode())


@pytest.mark.parametrize("command", ["collision-time", "paper"])
def test_no_number_is_broken_on_a_narrow_terminal(command: str) -> None:
    narrow, wide = (on_terminal(columns, command) for columns in (40, 200))
    assert max(map(len, narrow.splitlines())) <= 40
    whole = re.findall(r"\d+\.\d+", wide)
    assert len(whole) > 3
    assert set(whole) == set(re.findall(r"\d+\.\d+", narrow))


def test_as_many_instants_are_shown_as_fit_the_width() -> None:
    output = on_terminal(60, "trajectory", "--stop", "300", "--step", "60")
    assert headings(output) == [["0", "120", "300"]] * 3
    assert max(len(line) for line in output.splitlines() if not line.endswith("choose.")) <= 60
    assert "3 of 6 instants" in output.replace("\r\n", " ")


def test_handles_and_times_choose_what_is_shown() -> None:
    output = answer_of("trajectory", "--times", "0,60,120", "--handles", "51,0,1")
    assert headings(output) == [["0", "60", "120"]] * 3
    rows = [line.split()[0] for line in output.splitlines() if re.match(r"  \d+ (head|body)", line)]
    assert rows == ["51", "0", "1"] * 3
    assert output.endswith("3 of 224 handles, 3 of 3 instants: --output has all.\n")
    assert answer_of("trajectory", "--times", "0,1").endswith(": --output has all, --handles chooses.\n")
    assert answer_of("trajectory", "--handles", "0").endswith(": --output has all, --times chooses.\n")


def test_times_that_were_asked_for_are_all_shown_in_as_many_tables_as_they_take() -> None:
    times = [str(k) for k in range(20)]
    result = headings(answer_of("trajectory", "--benches", "3", "--handles", "0", "--times", ",".join(times)))
    assert [instant for heading in result[: len(result) // 3] for instant in heading] == times
    assert result == result[: len(result) // 3] * 3


def test_times_are_the_list_of_the_service(client: httpx.Client) -> None:
    answer = served(client, "POST", "/trajectory", {"times": [0.0, 12.5, 3.0]})
    assert json.loads(answer_of("trajectory", "--times", "0,12.5,3", "--json")) == answer


def test_times_before_the_dance_warn_on_a_spiral_and_belong_to_a_turn(client: httpx.Client) -> None:
    times, few = ["--times", "-100,0", "--json"], ["--benches", "3"]
    warned = run("trajectory", *few, "--pitch", "1.7", *times)
    assert warned.returncode == 0
    assert "begins at 0 s" in warned.stderr
    assert "--path turn" in warned.stderr
    body = {"dragon": {"benches": 3}, "path": {"kind": "turn"}, "times": [-100, 0]}
    answer = served(client, "POST", "/trajectory", body)
    assert json.loads(answer_of("trajectory", *few, "--path", "turn", *times)) == answer


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--times", "0,1", "--stop", "300"], "--times replaces --stop: give one of the two"),
        (["--times", "0,1", "--start", "0"], "--times replaces --start: give one of the two"),
        (["--step", "1", "--times", "0,1"], "--times replaces --step: give one of the two"),
        (["--times", ""], "times[0] must be a number, as in --times 0,1,2, got ''"),
        (["--times", "0,soon"], "times[1] must be a number, as in --times 0,1,2, got 'soon'"),
        (["--times", "0,nan"], "times[1] must be a finite number [s], got NaN"),
        (["--times", "0,2e6"], "times[1] must be at most 1000000 s, got 2000000 s"),
        (["--handles", "0,224"], "handles[1] must be from 0 to 223 for this dragon, got 224"),
        (["--handles", "-1"], "handles[0] must be from 0 to 223 for this dragon, got -1"),
        (["--handles", "0.5"], "handles[0] must be a whole number, as in --handles 0,1,2, got '0.5'"),
        (["--handles", "0", "--json"], "--handles chooses rows of the table: leave it out with --output or --json"),
        (["--handles", "0", "--output", "a.csv"], "--handles chooses rows of the table: leave it out with --output or"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_times_and_handles_that_cannot_be_are_refused(arguments: list[str], words: str) -> None:
    done = run("trajectory", *arguments)
    assert (done.returncode, done.stdout) == (2, "")
    assert words in done.stderr
    assert len(done.stderr.splitlines()) == 1


def test_with_a_margin_the_command_says_within_it_and_the_gap() -> None:
    for command in ("collision-time", "minimum-pitch", "shortest-turn"):
        text = " ".join(answer_of(command, "--benches", "40", "--margin", "0.05").split())
        assert "within 0.05 m" in text
        assert not re.search(r"touch|meet|outcome contact", text)
    text = answer_of("collision-time", "--margin", "0.2")
    assert "within 0.2 m from the start on" in text
    assert re.search(r"gap +0\.169278671 m", text)
    assert "never within 0.05 m" in answer_of("collision-time", "--pitch", "1.2", "--margin", "0.05")
    assert "First contact" in answer_of("collision-time", "--benches", "20")


@pytest.mark.parametrize("flags", [pytest.param([], marks=pytest.mark.deep), ["--json"]], ids=["table", "json"])
def test_a_reader_that_stops_early_is_no_error(flags: list[str]) -> None:
    with subprocess.Popen(
        [COMMAND, "trajectory", *flags], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env=ENVIRONMENT
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        assert process.stderr.read() == b""
        assert process.wait(PATIENCE) in (0, 1)


def test_a_long_wait_shows_a_bar_and_ctrl_c_ends_it_cleanly(tmp_path: Path) -> None:
    leader, follower = pty.openpty()
    # The film takes ten times as long as the wait before the bar.
    arguments = ["film", "--output", str(tmp_path / "dance.mp4")]
    process = subprocess.Popen(
        [COMMAND, *arguments], stdout=subprocess.DEVNULL, stderr=follower, env=ENVIRONMENT, preexec_fn=heed_ctrl_c
    )
    os.close(follower)
    seen = b""
    while b"film" not in seen:
        seen += os.read(leader, 1024)
    process.send_signal(signal.SIGINT)
    # Read on, or a full terminal would hold the process up; without a writer its end is an error, not an end of file.
    with contextlib.suppress(OSError):
        while True:
            seen += os.read(leader, 1024)
    os.close(leader)
    assert process.wait(PATIENCE) == 130
    assert b"Traceback" not in seen
    assert list(tmp_path.iterdir()) == []


def test_ctrl_c_while_modules_are_imported_ends_without_a_word(tmp_path: Path) -> None:
    caught = "try:\n    time.sleep(60)\nexcept BaseException:\n    raise ImportError"
    (tmp_path / "typer.py").write_text(f"import sys, time\nprint('importing', flush=True)\n{caught}")
    process = subprocess.Popen(
        [COMMAND, "--version"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=ENVIRONMENT | {"PYTHONPATH": str(tmp_path)},
        preexec_fn=heed_ctrl_c,
    )
    assert process.stdout is not None
    assert process.stdout.readline() == b"importing\n"
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=PATIENCE) == (b"", b"")
    assert process.returncode == 130


@contextlib.contextmanager
def serving(
    *options: str, program: tuple[str, ...] = (COMMAND,), on_sigint: signal.Handlers = signal.SIG_DFL
) -> Iterator[tuple[subprocess.Popen[str], str, list[str]]]:
    """`bench-dragon serve`, its base URL, and the lines that it wrote up to when all its processes answer.

    on_sigint: what its parent left it to do on Ctrl-C; a shell that starts it in the background has that ignored
    """
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    command = [*program, "serve", "--port", str(port), *options]
    scratch = tempfile.TemporaryDirectory()  # what a killed service leaves behind goes with it
    environment = ENVIRONMENT | {"TMPDIR": scratch.name}
    process = subprocess.Popen(
        command,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.PIPE,
        text=True,
        env=environment,
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, on_sigint),
    )
    assert process.stderr is not None
    lines: list[str] = []
    expected, running = 1, False
    for line in process.stderr:
        lines.append(line)
        running |= f"running on http://127.0.0.1:{port}" in line
        expected = int(match[1]) if (match := re.search(r"in (\d+) processes", line)) else expected
        if running and sum("Application startup complete" in line for line in lines) == expected:
            break
    try:
        yield process, f"http://127.0.0.1:{port}", lines
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        scratch.cleanup()


def becomes(url: str, name: str, expected: float) -> bool:
    """True if a metric, summed over its labels, reaches a value. Requests are counted just after their answers."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        lines = httpx.get(f"{url}/metrics").text.splitlines()
        if sum(float(line.rpartition(" ")[2]) for line in lines if line.startswith(name)) == expected:
            return True
    return False


def starts(process: subprocess.Popen[str]) -> bool:
    """True as soon as one more process of the service answers."""
    assert process.stderr is not None
    return any("Application startup complete" in line for line in process.stderr)


@pytest.mark.parametrize("workers", [1, 2])
def test_serve_answers_replaces_a_process_that_dies_or_hangs_and_keeps_its_counts_and_ctrl_c_ends_it(
    workers: int,
) -> None:
    with serving("--workers", str(workers), program=IMPATIENT) as (process, url, lines):
        pids = [int(one[1]) for line in lines if (one := re.search(r"Started server process \[(\d+)\]", line))]
        assert len(pids) == workers
        for k in range(1, 4):
            assert httpx.get(f"{url}/healthz").json()["status"] == "ok"
            assert becomes(url, HEALTH_COUNT, k)
        if workers > 1:
            os.kill(pids[0], signal.SIGKILL)
            assert starts(process)
            assert becomes(url, HEALTH_COUNT, 3)
            time.sleep(2.0)  # all have answered their parent
            os.kill(pids[1], signal.SIGSTOP)
            stopped = time.monotonic()
            assert process.stderr is not None
            assert any(f"[{pids[1]}] died" in line for line in process.stderr)
            assert SILENT < time.monotonic() - stopped < SILENT_SECONDS < START_SECONDS
            assert starts(process)
            assert httpx.get(f"{url}/healthz").json()["status"] == "ok"
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does
        _, rest = process.communicate(timeout=PATIENCE)
        assert process.returncode == 0
        assert "Traceback" not in rest


def test_a_service_in_the_background_ends_on_sigterm() -> None:
    with serving(on_sigint=signal.SIG_IGN) as (process, url, lines):
        assert sum("Started server process" in line for line in lines) == len(os.sched_getaffinity(0))
        assert httpx.get(f"{url}/healthz").json()["status"] == "ok"
        process.terminate()
        _, rest = process.communicate(timeout=PATIENCE)
        assert process.returncode in (0, -signal.SIGTERM)
        assert "Traceback" not in rest
        assert refuses(url)


def refuses(url: str) -> bool:
    """True if nothing listens there any more. A connection may still be taken and dropped while the last one ends."""
    try:
        httpx.get(f"{url}/healthz")
    except httpx.ConnectError:
        return True
    except httpx.TransportError:
        return False
    return False


@pytest.mark.parametrize("workers", ["1", "2"])
def test_serve_on_a_port_that_is_taken_gets_exit_code_2(server: str, workers: str) -> None:
    done = run("serve", "--port", server.rpartition(":")[2], "--workers", workers)
    assert done.returncode == 2
    assert "address already in use" in done.stderr.lower()
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("words", HELPS, ids=" ".join)
def test_help_prints_every_description_with_its_unit(words: tuple[str, ...]) -> None:
    text = " ".join(answer_of(*words, "--help", COLUMNS="1000").split())
    values = [option.help.replace("\\[", "[") for option in HELPS[words].params if option.help]
    assert [one for one in values if " ".join(one.split()) not in text] == []
    assert "completion" not in text  # `bench-dragon --help` offers it


def test_help_names_every_command_and_unit() -> None:
    assert {*MODULE_OF} <= {*answer_of("--help", COLUMNS="100").split()}
    assert "Radial advance of the spiral per full turn [m]" in answer_of("collision-time", "--help", COLUMNS="120")


def test_every_question_has_its_command() -> None:
    commands = {name.replace("-", "_") for name in MODULE_OF}
    without = {name for name in QUESTIONS if not name.endswith("_figure")} - commands
    assert without == OTHERWISE, "app/command/main.py needs a line of it"


def test_the_version_is_one_line() -> None:
    slower = "" if COMPILED else ", not compiled: many times slower"
    assert answer_of("--version") == f"bench-dragon {core.__version__}{slower}\n"


def test_the_shell_completes_commands_and_options() -> None:
    request = {"_BENCH_DRAGON_COMPLETE": "complete_bash", "COMP_CWORD": "1"}
    assert answer_of(**request, COMP_WORDS="bench-dragon coll").split() == ["collision-time"]
    request["COMP_CWORD"] = "2"
    assert answer_of(**request, COMP_WORDS="bench-dragon collision-time --pit").split() == ["--pitch"]


def test_completion_is_offered_once() -> None:
    assert answer_of("--help", COLUMNS="100").count("--install-completion") == 1


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["check", "dance.json", "--time", "3"], "--time is the instant that --figure draws: give --figure"),
        (["check", "dance.json", "--cross-check", ""], 'cross_check must be "dragon", "pair" or "none", got ""'),
        (["overlaps", "--pitch", "1", "benches.json"], "--pitch describes a dance, and FILE gives the benches"),
        (["overlaps", "--margin=0", "benches.json"], "--margin describes a dance, and FILE gives the benches"),
        (["figures", "out", "--kind", "trajectory", "--samples", "50"], "--samples does not apply to the figure"),
        (["figures", "out", "--kind", "contact", "--kind", "trajectory", "--turning-diameter", "9"],
         "--turning-diameter does not apply to the figure contact or trajectory: leave it out, or draw"),
        (["figures", "out", "--kind", "pitch-scan", "--head-speed", "1"], "--head-speed does not apply to the figure"),
        (["trajectory", "--language", "zh"], "--language applies to the names in an xlsx file: give --output with"),
        (["trajectory", "--language", "en", "--output", "a.csv"], "--language applies to the names in an xlsx file"),
        (["trajectory", "--json", "--output", "a.csv"], "--json prints the answer and --output writes it to a file"),
    ],
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)  # fmt: skip
def test_an_option_that_nothing_uses_is_refused_by_name(arguments: list[str], words: str, tmp_path: Path) -> None:
    (tmp_path / "dance.json").write_text('{"head_speed": 1}')
    (tmp_path / "benches.json").write_text('{"benches": [{"x": 0, "y": 0, "heading": 0, "length": 1, "width": 1}]}')
    files = {"dance.json", "benches.json", "out", "a.csv"}
    done = run(*(str(tmp_path / one) if one in files else one for one in arguments))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"Error: {words}")
    assert len(done.stderr.splitlines()) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["benches.json", "dance.json"]


FOLDING = ("trajectory", "--benches", "40", "--pitch", "1.2", "--start-turns", "8")


def test_instants_just_before_a_fold_are_marked_and_the_fold_is_named() -> None:
    output = answer_of(*FOLDING, "--times", "0,100,238.2149")
    assert output.count("238.2149 s *") == 3
    assert "100 s *" not in output
    words = " ".join(output.split())
    assert words.endswith(
        "* Just before bench 0 folds, at 238.214985392 s: towards that instant the speeds of handles behind it grow "
        "without bound."
    )
    assert "*" not in answer_of(*FOLDING, "--times", "0,100")


def test_bounds_are_printed_with_all_digits_or_rounded_to_the_safe_side() -> None:
    answer = json.loads(cached_output("collision-time", "--json"))
    output = cached_output("collision-time")
    assert f"{answer['time_bracket'][0]!r}, {answer['time_bracket'][1]!r} s" in output
    assert re.search(rf"clear until +{re.escape(repr(answer['certificate']['clear_until']))} s", output)


def test_the_table_on_a_terminal_has_the_decimals_that_are_asked_for() -> None:
    done = run("trajectory", "--benches", "3", "--times", "0,100", "--decimals", "2")
    assert re.search(r"0 head +8\.80 +-?\d\.\d\d ", done.stdout)
    assert not re.search(r"\d\.\d{3}", done.stdout)


def test_an_unknown_end_of_a_bracket_has_no_unit(capsys: pytest.CaptureFixture[str]) -> None:
    answer = MaximumHeadSpeed(
        head_speed=1.5, head_speed_bracket=(None, 1.5), speed_ratio=2.0, handles=[1], time=3.0,
        time_at_unit_head_speed=4.5, passage=None,
    )  # fmt: skip
    print_answer("Maximum head speed", answer, json=False)
    assert re.search(r"head speed bracket +unknown, 1\.5 m/s *\n", capsys.readouterr().out)
