"""bench-dragon prove, run as a user runs it: certificates as files, exit codes, a bar, Ctrl-C."""

from __future__ import annotations

import json
import os
import pty
import signal
import subprocess
from pathlib import Path

import pytest

from tests.conftest import heed_ctrl_c
from tests.support import command
from tests.support.command import COMMAND, ENVIRONMENT, PATIENCE

FIVE = ("--benches", "5", "--start-turns", "6")  # a dragon whose proof takes no time
TWELVE = ("--benches", "12", "--pitch", "0.7", "--start-turns", "5", "--turning-diameter", "3")
# A dragon whose minimum pitch a fold limits, on a circle of diameter 1.7 m.
FOLDING = (
    *("--benches", "14", "--head-length", "2.21", "--body-length", "1.47", "--width", "0.06", "--overhang", "0.12"),
    *("--turning-diameter", "1.7", "--start-turns", "5"),
)


def run(*arguments: str, **how: str) -> subprocess.CompletedProcess[str]:
    return command.run("prove", *arguments, **how)


@pytest.fixture(scope="module")
def certificate(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("proof") / "five.json"
    done = run("collision-time", *FIVE, "--output", str(path))
    assert done.returncode == 0, done.stderr
    assert "benches 0 and 4 overlap" in done.stdout
    return path


def test_a_certificate_is_checked_from_a_file_and_from_standard_input(certificate: Path) -> None:
    for done in (run("--check", str(certificate)), run("--check", "-", text=certificate.read_text())):
        assert (done.returncode, done.stderr) == (0, "")
        assert "benches 0 and 4 overlap" in done.stdout


def test_a_changed_certificate_is_refused(certificate: Path) -> None:
    changed = json.loads(certificate.read_text())
    changed["claim"]["time"] += 1.0
    done = run("--check", "-", text=json.dumps(changed))
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "Refused: the certificate was changed after it was made\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{}", "format is missing"),
        ("[]", "it must be an object, got a list of 0"),
        ('{"x": 1}', "format is missing"),
        ('{"format": 3}', "versions is missing"),
    ],
)
def test_a_malformed_certificate_is_one_line_that_names_the_member(text: str, words: str) -> None:
    done = run("--check", "-", text=text)
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == f"Refused: the certificate is malformed: {words}\n"


@pytest.mark.parametrize("name", ["claim", "overlap", "sweeps", "dragon", "precision", "digest"])
def test_a_certificate_without_a_member_is_one_line_that_names_it(certificate: Path, name: str) -> None:
    content = json.loads(certificate.read_text())
    del content[name]
    done = run("--check", "-", text=json.dumps(content))
    assert done.stderr == f"Refused: the certificate is malformed: {name} is missing\n"


def test_a_wrong_claim_is_refused_and_leaves_no_file(tmp_path: Path) -> None:
    done = run("collision-time", *FIVE, "--time", "20", "--output", str(tmp_path / "wrong.json"))
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr == "Refused: no two benches overlap at 20 + 1e-10 s\n"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("time", [(), ("--time", "1e-11")], ids=["searched", "stated"])
def test_a_contact_at_the_start_claims_no_time_before(tmp_path: Path, time: tuple[str, ...]) -> None:
    path = tmp_path / "start.json"
    done = run("collision-time", "--margin", "0.2", *time, "--output", str(path))
    assert done.returncode == 0, done.stderr
    when = "1e-11" if time else "0"
    words = f"benches 0 and 33 are nearer than 0.2 m at {when} + 1e-10 s, within 2e-10 s of the start, so that no time "
    assert f"turns: {words}before is claimed to be clear.\n" in done.stdout
    assert run("--check", str(path)).stdout == done.stdout


def test_a_minimum_pitch_is_proven_and_checked(tmp_path: Path) -> None:
    path = tmp_path / "pitch.json"
    circle = ("--turning-diameter", "4", "--benches", "11", "--start-turns", "5")
    done = run("minimum-pitch", *circle, "--every-pair", "--output", str(path))
    assert done.returncode == 0, done.stderr
    assert "with 1e-6 m less benches 0 and 7 overlap on the way" in done.stdout
    assert run("--check", str(path)).stdout == done.stdout


def test_a_dance_without_contact_has_no_collision_time_to_prove(tmp_path: Path) -> None:
    done = run("collision-time", "--benches", "4", "--output", str(tmp_path / "none.json"))
    assert (done.returncode, done.stderr) == (
        1,
        "Refused: nothing touches, so there is no collision time to prove: prove clear\n",
    )


LINES = """
margin = 0.2
dragon = {{benches = 6}}
[path]
kind = "route"
pieces = [
  {{kind = "line", start = [0, 0], end = [30, 0]}},
  {{kind = "arc", centre = [30, 3], radius = 3, start_angle = -1.5707963267948966, sweep = {sweep}}},
]
"""


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("collision-time", *FIVE, "--margin", "0.1"), "are nearer than 0.1 m at"),
        (("minimum-pitch", "--turning-diameter", "4", "--benches", "11", "--start-turns", "5", "--margin", "0.05"),
         "come nearer to one another than 0.05 m until the head is 2 m from the centre"),
        (("minimum-pitch", *FOLDING), "with 1e-6 m less bench 0 cannot follow so far (it folds)"),
        (("minimum-pitch", *FOLDING, "--benches", "1"), "bench 0 cannot follow so far (it folds)"),
        (("minimum-pitch", *FOLDING, "--benches", "1", "--overhang", "0.275"), "less the start lies within"),
        (("clear", "--benches", "4"), "bench 0 cannot follow any more (it folds) before 432.9179242"),
        (("clear", *FIVE, "--stop", "20", "--margin", "0.1"), "from 0 s to 20 s."),
        (("tolerance", *TWELVE), "benches 0 and 6 overlap in a pose with strays below 0.0441376"),
        (("tolerance", *TWELVE, "--stray", "0.02"), "is within 0.02 m of its place and every chord keeps its length"),
        (("turn", "--benches", "14", "--start", "-5", "--stop", "20"), "touch from -5 s to 20 s."),
        (("turn", "--benches", "20", "--start", "-5", "--stop", "20", "--margin", "0.34"), "nearer than 0.34 m at 13."),
    ],
    ids=[
        "time with a margin", "pitch with a margin", "pitch at a fold", "one bench at a fold", "start at the circle",
        "to the fold", "to a stop", "tolerance", "a stray", "turn", "turn with a margin",
    ],
)  # fmt: skip
def test_every_claim_is_proven_and_its_certificate_checked(
    arguments: tuple[str, ...], words: str, tmp_path: Path
) -> None:
    path = tmp_path / "claim.json"
    done = run(*arguments, "--output", str(path))
    assert done.returncode == 0, done.stderr
    assert words in done.stdout
    assert run("--check", str(path)).stdout == done.stdout


def test_a_dance_from_a_file_is_proven_to_its_end(tmp_path: Path) -> None:
    file, path = tmp_path / "dance.toml", tmp_path / "dance.json"
    file.write_text(LINES.format(sweep=3.0))
    done = run("dance", str(file), "--output", str(path))
    assert done.returncode == 0, done.stderr
    assert "the route of 2 pieces (line, arc), joined exactly" in done.stdout
    assert "come nearer to one another than 0.2 m" in done.stdout
    assert "and the route ends before" in done.stdout
    assert "not part of the proof" not in done.stderr
    file.write_text(f"speed_limit = 2.0\n{LINES.format(sweep=3.0)}")
    assert run("dance", str(file), "--output", str(path)).stderr.startswith(
        "The speed limit is not part of the proof.\n"
    )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("clear", *FIVE), "Refused: not proven: benches 0 and 4 overlap when handle 0 is at theta = "),
        (
            ("tolerance", *TWELVE, "--stray", "0.0442"),
            "Refused: not proven: with strays up to 0.0442 m benches 0 and 6 ",
        ),
        (("turn", "--margin", "1.2"), "Refused: benches 0 and "),
        (
            ("collision-time", "--benches", "3", "--margin", "0.01"),
            "Refused: no two benches come nearer than 0.01 m",
        ),
    ],
)
def test_a_claim_that_is_wrong_is_refused_in_one_line(arguments: tuple[str, ...], words: str, tmp_path: Path) -> None:
    done = run(*arguments, "--output", str(tmp_path / "wrong.json"))
    assert (done.returncode, done.stdout) == (1, "")
    assert done.stderr.startswith(words)
    assert done.stderr.count("\n") == 1
    assert list(tmp_path.iterdir()) == []


def test_a_dance_along_waypoints_has_no_proof(tmp_path: Path) -> None:
    file = tmp_path / "dance.toml"
    file.write_text('dragon = {benches = 3}\npath = {kind = "waypoints", points = [[0, 0], [20, 1], [40, 0]]}\n')
    done = run("dance", str(file))
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr == (
        "Error: path must be a spiral, a turn or a route of lines, arcs and coils for a proof in ball arithmetic, got "
        "waypoints: on such a path a dance is checked in double precision, with bounds on its rounding\n"
    )


@pytest.mark.parametrize(
    ("arguments", "text", "words"),
    [
        (("clear", "--stop", "1000"), None, "stop must be at most 432.917924"),
        (("turn", "--start", "5", "--stop", "2"), None, "stop must be after start"),
        (("collision-time", "--margin", "-1"), None, "margin"),
        ((), None, "either a claim to prove or --check FILE"),
        (("--check", "x", "collision-time"), None, "either a claim to prove or --check FILE"),
        (("--check", "nowhere.json"), None, "nowhere.json: No such file"),
        (("--check", "-"), "{", "is not JSON"),
        (("collision-time", "--output", "nowhere/proof.json"), None, "must be in a folder that exists"),
        (("collision-time", "--time", "nan"), None, "time"),
        (("collision-time", "--width", "30"), None, "width"),
        (("minimum-pitch", "--pitch", "0"), None, "pitch"),
    ],
)
def test_wrong_usage_gets_exit_code_2(arguments: tuple[str, ...], text: str | None, words: str) -> None:
    done = run(*arguments, text=text, COLUMNS="120")
    assert (done.returncode, done.stdout) == (2, "")
    assert words in done.stderr
    assert "Traceback" not in done.stderr


def test_without_flint_the_error_names_the_extra(certificate: Path, tmp_path: Path) -> None:
    (tmp_path / "flint.py").write_text("raise ImportError\n")
    done = run("--check", str(certificate), PYTHONPATH=str(tmp_path))
    assert done.returncode == 2
    assert (
        done.stderr
        == "Error: A proof needs the package python-flint, which is not installed: pip install 'bench-dragon[proof]'\n"
    )


def test_a_bar_shows_and_ctrl_c_ends_the_proof_cleanly(tmp_path: Path) -> None:
    leader, follower = pty.openpty()
    # All pairs of 223 benches in their own right take most of a minute.
    arguments = ["collision-time", "--every-pair", "--output", str(tmp_path / "proof.json")]
    process = subprocess.Popen(
        [COMMAND, "prove", *arguments],
        stdout=subprocess.DEVNULL,
        stderr=follower,
        env=ENVIRONMENT,
        preexec_fn=heed_ctrl_c,
    )
    os.close(follower)
    seen = b""
    while b"%" not in seen:
        seen += os.read(leader, 1024)
    process.send_signal(signal.SIGINT)
    while b"Interrupted: nothing was written." not in seen:
        seen += os.read(leader, 1024)
    assert process.wait(PATIENCE) == 130
    os.close(leader)
    assert b"proof" in seen
    assert b"Traceback" not in seen
    assert list(tmp_path.iterdir()) == []
