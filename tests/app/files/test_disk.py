"""Files of the command: refused before any work, and written completely or not at all."""

import os
import re
from pathlib import Path

import pytest

from app.files.disk import write_whole
from tests.support.command import refusal, run, said
from tests.support.refusal_rows import assert_refused_in_one_line

OLD = b"what stood here before"
NEW = b"what is written now"
# Longest file in the tests of a full disk [bytes].
ROOM = 500
# Each command that writes a file, with its option last.
WRITERS = [
    ("trajectory", "--output", "dance.csv"),
    ("trajectory", "--output", "dance.xlsx"),
    ("check", "examples/paper_dance.toml", "--figure", "dance.svg"),
    ("prove", "collision-time", "--benches", "9", "--time", "412.4738376821", "--output", "dance.proof.json"),
    ("figures", "--kind", "trajectory", "--benches", "20", "FOLDER"),
]
QUICK = [WRITERS[0], WRITERS[2], WRITERS[4]]


def with_target(arguments, folder):
    """The command writing into a folder, and the file."""
    *before, last = arguments
    if last == "FOLDER":
        return [*before, str(folder)], folder / "trajectory.png"
    return [*before, str(folder / last)], folder / last


@pytest.mark.parametrize(
    "row",
    [
        "check missing.toml --figure dance.gif -> --figure must end in ... .svg .png, .gif",
        *(
            f"{' '.join(command)} missing/{file} -> {command[-1]} must be in a folder that exists ... missing/{file}"
            for *command, file in WRITERS[:4]
        ),
    ],
)
def test_what_cannot_be_written_is_refused_before_any_work(row, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert_refused_in_one_line(row)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("arguments", QUICK, ids=" ".join)
def test_a_place_that_cannot_be_written_is_reported_in_one_line(tmp_path, arguments):
    # A folder in which nobody may write, and a folder in the place of the file.
    for folder, fault in (
        (Path("/proc"), "(No such file or directory|Permission denied)"),
        (tmp_path, "Is a directory"),
    ):
        command, file = with_target(arguments, folder)
        if folder == tmp_path:
            file.mkdir()
        assert re.fullmatch(rf"Error: {file}: {fault}\n", refusal(*command))


@pytest.mark.parametrize(
    "arguments",
    [one if one in QUICK else pytest.param(one, marks=pytest.mark.thorough) for one in WRITERS],
    ids=" ".join,
)
def test_a_full_disk_leaves_what_was_there_and_with_room_it_is_replaced_and_keeps_its_mode(tmp_path, arguments):
    command, file = with_target(arguments, tmp_path)
    file.write_bytes(OLD)
    file.chmod(0o640)
    assert refusal(*command, room=ROOM) == f"Error: {file}: File too large\n"
    assert [path.name for path in tmp_path.iterdir()] == [file.name]
    assert file.read_bytes() == OLD
    said(*command, aside=None)
    assert len(file.read_bytes()) > ROOM
    assert file.stat().st_mode & 0o777 == 0o640
    assert [path.name for path in tmp_path.iterdir()] == [file.name]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_a_device_is_written_to_and_never_replaced(tmp_path):
    link = tmp_path / "dance.csv"
    link.symlink_to("/dev/full")
    done = run("trajectory", "--stop", "2", "--output", str(link))
    assert done.returncode == 2
    assert done.stderr == f"Error: {link}: No space left on device\n"
    assert Path("/dev/full").is_char_device()


def test_a_new_file_has_the_mode_that_the_users_mask_leaves(tmp_path):
    before = os.umask(0o027)
    try:
        write_whole(tmp_path / "new", NEW)
    finally:
        os.umask(before)
    assert (tmp_path / "new").stat().st_mode & 0o777 == 0o640


def test_a_link_is_followed(tmp_path):
    (tmp_path / "there").write_bytes(OLD)
    (tmp_path / "here").symlink_to(tmp_path / "there")
    write_whole(tmp_path / "here", NEW)
    assert (tmp_path / "here").is_symlink()
    assert (tmp_path / "there").read_bytes() == NEW


def test_a_long_name_leaves_room_for_the_temporary_one(tmp_path):
    file = tmp_path / ("n" * 250 + ".csv")
    write_whole(file, NEW)
    assert file.read_bytes() == NEW
