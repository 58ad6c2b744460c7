"""bench-dragon prove, run as a user runs it: certificates as files, exit codes."""

import json
import math

import pytest

from tests.campaigns.differential import proven_by_second
from tests.support import command
from tests.support.command import said
from tests.support.refusal_rows import assert_refused_in_one_line

FIVE = "--benches 5 --start-turns 6"  # a dragon whose proof takes no time
TWELVE = "--benches 12 --pitch 0.7 --start-turns 5 --turning-diameter 3"
# A dragon whose minimum pitch a fold limits, on a circle of diameter 1.7 m.
FOLDING = (
    "--benches 14 --head-length 2.21 --body-length 1.47 --width 0.06 --overhang 0.12 --turning-diameter 1.7 "
    "--start-turns 5"
)


def run(*arguments, **how):
    return command.run("prove", *arguments, **how)


@pytest.fixture(scope="module")
def certificate(tmp_path_factory):
    path = tmp_path_factory.mktemp("proof") / "five.json"
    text = said("prove", "collision-time", *FIVE.split(), "--output", str(path), aside=None)
    assert "benches 0 and 4 overlap" in text
    return path


def test_a_certificate_is_checked_from_a_file_and_from_standard_input(certificate):
    for file, text in ((str(certificate), None), ("-", certificate.read_text())):
        assert "benches 0 and 4 overlap" in said("prove", "--check", file, text=text)


def test_a_changed_certificate_is_refused(certificate):
    changed = json.loads(certificate.read_text())
    changed["claim"]["time"] += 1.0
    assert_wrong("--check -", "the certificate was changed", text=json.dumps(changed))


def assert_wrong(line, named, **how):
    """The refusal of a claim or a certificate: one line and exit code 1."""
    assert_refused_in_one_line(f"prove {line} -> {named}", 1, "Refused: ", **how)


@pytest.mark.parametrize(
    "text, named",
    [("{}", "format"), ("[]", "it ... list 0"), ('{"x": 1}', "format"), ('{"format": 3}', "versions")],
)
def test_a_malformed_certificate_is_one_line_that_names_the_member(text, named):
    assert_wrong("--check -", f"the certificate is malformed: {named}", text=text)


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


START = "benches 0 and 33 are nearer than 0.2 m at {} + 1e-10 s, within 2e-10 s of the start, so that no time"
SMALL_CIRCLE = "--turning-diameter 4 --benches 11 --start-turns 5"


@pytest.mark.parametrize(
    "line, words",
    [
        (f"collision-time {FIVE} --margin 0.1", "are nearer than 0.1 m at"),
        ("collision-time --margin 0.2", START.format("0")),
        ("collision-time --margin 0.2 --time 1e-11", START.format("1e-11")),
        (f"minimum-pitch {SMALL_CIRCLE} --every-pair", "with 1e-6 m less benches 0 and 7 overlap on the way"),
        (f"minimum-pitch {SMALL_CIRCLE} --margin 0.05", "come nearer to one another than 0.05 m until the head is 2 m"),
        (f"minimum-pitch {FOLDING}", "with 1e-6 m less bench 0 cannot follow so far (it folds)"),
        (f"minimum-pitch {FOLDING} --benches 1", "bench 0 cannot follow so far (it folds)"),
        (f"minimum-pitch {FOLDING} --benches 1 --overhang 0.275", "less the start lies within"),
        ("clear --benches 4", "bench 0 cannot follow any more (it folds) before 432.9179242"),
        (f"clear {FIVE} --stop 20 --margin 0.1", "from 0 s to 20 s."),
        (f"tolerance {TWELVE}", "benches 0 and 6 overlap in a pose with strays below 0.0441376"),
        (f"tolerance {TWELVE} --stray 0.02", "is within 0.02 m of its place and every chord keeps its length"),
        ("turn --benches 14 --start -5 --stop 20", "touch from -5 s to 20 s."),
        ("turn --benches 20 --start -5 --stop 20 --margin 0.34", "nearer than 0.34 m at 13."),
    ],
)
def test_every_claim_is_proven_and_its_certificate_checked(line, words, tmp_path):
    assert_proven(line.split(), words, tmp_path)


def assert_proven(arguments, words, folder):
    """What the command prints: the claim, as the check of its certificate prints it."""
    path = folder / "claim.json"
    text = said("prove", *arguments, "--output", str(path), aside=None)
    assert words in text
    assert said("prove", "--check", str(path)) == text
    return text


def test_a_dance_from_a_file_is_proven_to_its_end(tmp_path):
    file = tmp_path / "dance.toml"
    file.write_text(LINES.format(sweep=3.0))
    words = "the route of 2 pieces (line, arc), joined exactly"
    text = assert_proven(("dance", str(file)), words, tmp_path)
    assert "come nearer to one another than 0.2 m" in text
    assert "and the route ends before" in text
    assert "not part of the proof" not in run("dance", str(file)).stderr
    file.write_text(f"speed_limit = 2.0\n{LINES.format(sweep=3.0)}")
    assert "The speed limit is not part of the proof.\n" in run("dance", str(file)).stderr


# Legs that turn by 40 degrees at a corner, and by 107 degrees with a radius of 1.0 m.
BENT = """
dragon = {{benches = 6}}
path = {{kind = "waypoints", points = [[0, 0], [20, 0], [{x}, {y}]], straight = [0, 1], radius = {radius}}}
"""


@pytest.mark.parametrize("radius, turn", [(0.0, 40.0), (1.0, 107.0)])
def test_a_dance_around_a_bend_is_proven_and_the_second_verifier_agrees(radius, turn, tmp_path):
    file = tmp_path / "dance.toml"
    x, y = 20.0 + 15.0 * math.cos(math.radians(turn)), 15.0 * math.sin(math.radians(turn))
    file.write_text(BENT.format(x=x, y=y, radius=radius))
    words = "where every rear handle goes forwards, less than 87.44 degrees off its bench, and never jumps: no two"
    assert_proven(("dance", str(file)), words, tmp_path)
    certificate = str(tmp_path / "claim.json")
    assert words in said("prove", "--check", certificate, "--dance", str(file))
    for same, other, part in (("dragon = {", "head_speed = 2\ndragon = {", "head speed"), ("20,", "20.5,", "path")):
        (tmp_path / "other.toml").write_text(file.read_text().replace(same, other))
        assert_wrong(f"--check {certificate} --dance {tmp_path}/other.toml", f"the certificate is about another {part}")
    proven, statement = proven_by_second(json.loads((tmp_path / "claim.json").read_text()))
    assert proven
    assert words in statement


@pytest.mark.parametrize(
    "row",
    [
        f"clear {FIVE} -> not proven: benches 0 and 4 overlap when handle 0 is at theta = ",
        f"tolerance {TWELVE} --stray 0.0442 -> not proven: with strays up to 0.0442 m benches 0 and 6 ",
        "turn --margin 1.2 -> benches 0 and ",
        "collision-time --benches 3 --margin 0.01 -> no two benches come nearer than 0.01 m",
        "collision-time --benches 4 -> nothing touches",
        f"collision-time {FIVE} --time 20 -> no two benches overlap at 20 + 1e-10 s",
    ],
)
def test_a_claim_that_is_wrong_is_refused_in_one_line_and_leaves_no_file(row, tmp_path):
    line, words = row.split(" -> ")
    assert_wrong(f"{line} --output {tmp_path}/wrong.json", words)
    assert list(tmp_path.iterdir()) == []


def test_a_dance_along_waypoints_has_no_proof(tmp_path):
    file = tmp_path / "dance.toml"
    file.write_text('dragon = {benches = 3}\npath = {kind = "waypoints", points = [[0, 0], [20, 1], [40, 0]]}\n')
    assert_refused_in_one_line(f"prove dance {file} -> path ... spiral, turn route waypoints")


@pytest.mark.parametrize(
    "row",
    [
        "prove clear --stop 1000 -> stop ... 432.917924",
        "prove turn --start 5 --stop 2 -> stop ... start",
        "prove collision-time --margin -1 -> margin",
        "prove --check x collision-time -> give either a claim to prove or --check FILE",
        "prove --dance x clear -> give --dance FILE with --check FILE",
        "prove --check nowhere.json -> nowhere.json: No such file",
        "prove --check - -> - is not JSON",
        "prove collision-time --output nowhere/proof.json -> --output ... folder",
        "prove collision-time --time nan -> time",
        "prove collision-time --width 30 -> width",
        "prove minimum-pitch --pitch 0 -> pitch",
    ],
)
def test_wrong_usage_gets_exit_code_2(row):
    assert_refused_in_one_line(row, text="{")
