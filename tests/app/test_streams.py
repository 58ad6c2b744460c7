"""Standard input, output and error of the command: full, closed, in one file, on a terminal of few characters."""

import subprocess

import pytest

from tests.support.command import COMMAND, ENVIRONMENT, PATIENCE
from tests.support.depth import thorough

pytestmark = pytest.mark.uncompiled

# Short answers of every kind: JSON; help of the command and of one question, a table, the version.
MORE = ("--help", "turn --help", "trajectory --benches 3 --times 0", "--version", "")
COMMANDS = ("collision-time --benches 3 --json", *thorough(*MORE))


def shell(command, **environment):
    """A new process of the command with redirections as in a shell."""
    words = ["bash", "-c", f'"$0" {command}', COMMAND]
    return subprocess.run(words, env=ENVIRONMENT | environment, capture_output=True, timeout=PATIENCE)


@pytest.mark.parametrize("command", COMMANDS)
@pytest.mark.parametrize("output, fault", [("/dev/full", "No space left on device"), ("&-", "it is closed")])
def test_a_full_disk_or_a_closed_standard_output_is_one_line(command, output, fault):
    done = shell(f"{command} >{output}")
    assert done.returncode == 2
    assert done.stderr.decode() == f"Error: standard output: {fault}\n"


def test_closed_messages_vanish_and_closed_input_is_empty():
    assert shell("collision-time --pitch 0 2>&-").returncode == 2
    done = shell("overlaps - <&-")
    assert done.returncode == 2
    assert done.stderr.count(b"\n") == 1
    assert b"standard input is not JSON" in done.stderr


def test_a_file_that_is_opened_later_does_not_become_the_closed_standard_output(tmp_path):
    table = tmp_path / "table.csv"
    shell(f"trajectory --benches 3 --times 0 --output {table} >&-")
    assert table.read_bytes().startswith(b"time,")


def test_what_is_written_first_stands_first_in_a_common_file(tmp_path):
    # The note about the file comes before the answer, the refusal of the second file after the answer to the first.
    (tmp_path / "empty.toml").write_text("")
    one = tmp_path / "one"
    shell(f"check {tmp_path / 'empty.toml'} >{one} 2>&1")
    lines = one.read_text(encoding="utf-8").splitlines()
    assert lines[0] == f"{tmp_path / 'empty.toml'} is empty: the answer is for the contest's dance."
    assert len(lines) > 1


LINES = ("turn --json", "places {folder}/龙.geojson", "grade --language zh --pitch 0.45", "check {folder}/龙.toml")


@pytest.mark.parametrize("encoding", ["ascii", "gbk"])
@pytest.mark.parametrize("command", ["grade {folder}/龙.csv", *thorough(*LINES)])
def test_what_a_terminal_cannot_show_is_escaped(command, encoding, tmp_path):
    ring = "[[0, 0], [9, 0], [9, 9], [0, 0]]"
    (tmp_path / "龙.geojson").write_text(f'{{"type": "Polygon", "coordinates": [{ring}]}}', encoding="utf-8")
    (tmp_path / "龙.csv").write_text("板凳,é\n1,2\n", encoding="utf-8")
    (tmp_path / "龙.toml").write_text('[dragon]\nbenches = 2\nnames = ["龙 é", "b"]\n', encoding="utf-8")
    done = shell(command.format(folder=tmp_path), PYTHONIOENCODING=encoding)
    assert (done.returncode, b"Traceback" in done.stderr) == (0, False), done.stderr
    assert done.stdout


def test_a_terminal_of_gbk_gets_its_own_characters():
    assert "正确".encode("gbk") in shell("grade --language zh --pitch 0.45", PYTHONIOENCODING="gbk").stdout
