"""Paper set by Typst: what is typed stays text."""

import os
import signal
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

import pytest

from app.extras import MissingPackage, NotTypeset
from app.files.fonts import LATIN, chinese_among
from app.files.typeset import Face, face_for, typeset, typesetting
from core import Budget, TooMuchWork
from core.kernels import Halted
from tests.support.command import run
from tests.support.job_service import wait_for
from tests.support.near import assert_near
from tests.support.paper import pages_of, words_of

TEMPLATE = b"""
#let data = json("data.json")
#set document(title: data.title, date: none)
#set text(font: data.fonts, lang: data.language)
#set page(width: 600mm)
#heading(data.title)
#for one in data.names { par(one) }
"""
NAMES = [
    '#set page(width: 1mm) *bold* _it_ $x^2$ `raw` "q" \\ // c',
    "<label> @ref [link](y) = - + ~ {} ]",
    "\u05e9\u05dc\u05d5\u05dd",
    "x" * 200,
    "\U0001f600",
]
FACE = Face((LATIN,))


def test_what_is_typed_is_text_and_never_markup():
    data = [typeset(TEMPLATE, FACE, {"title": "#1 *night*", "names": NAMES}) for _ in range(2)]
    assert data[0] == data[1]
    (page,) = pages_of(data[0])
    words = words_of(page)
    assert words.startswith("#1 *night*")
    assert [name for name in NAMES if name not in words and name[::-1] not in words] == []
    assert page.pdf.get_metadata_dict()["Title"] == "#1 *night*"


def test_a_template_that_fails_says_why():
    with pytest.raises(NotTypeset, match="the typesetter failed: panicked with: no paper"):
        typeset(b'#panic("no paper")', FACE, {})


def test_a_typesetter_that_fails_is_one_sentence_and_the_file_stays_as_it_was(tmp_path):
    (tmp_path / "typst.py").write_text("raise ImportError('no such library')")
    file = tmp_path / "sheet.pdf"
    file.write_text("as it was")
    for name in ("plan", "cues", "crew", "safety-sheet"):
        words = [name, "examples/village_square.toml", "--output", str(file)]
        ended = run(*words, PYTHONPATH=str(tmp_path))
        assert ended.returncode == 1
        assert file.read_text() == "as it was"
        assert ended.stderr.splitlines()[-1:] == [
            "Error: the paper was not set, because the typesetter failed: no such library"
        ]
        assert "Traceback" not in ended.stderr


def test_a_file_that_needs_too_much_memory_is_refused_in_a_sentence_and_the_next_one_is_set(capfd):
    with pytest.raises(TooMuchWork, match="the paper must have fewer pages: setting it takes more than 1500 MB"):
        typeset(b'#("a" * 2000000000)', FACE, {})
    assert capfd.readouterr() == ("", "")
    assert typeset(TEMPLATE, FACE, {"title": "short", "names": []}).startswith(b"%PDF")


def test_widths_are_those_on_paper():
    """DejaVu Sans: a digit is 0.636 as wide as its type is high, and a blank 0.318."""
    assert_near(FACE.width("0 0", 72.0), 25.4 * 1.59, 0.05)


def test_a_machine_without_a_chinese_font_says_what_to_install():
    assert chinese_among({LATIN, "SimHei", "Noto Sans CJK SC"}) == "Noto Sans CJK SC"
    with pytest.raises(MissingPackage, match="install fonts-wqy-microhei or fonts-noto-cjk"):
        chinese_among({LATIN})
    assert face_for(["Lanterns 🐉", "مهرجان"]) == Face((LATIN,))


def killed():
    """Kill the processes that there are; one that had no task yet is replaced."""
    for pid in typesetting.pids:
        with suppress(ProcessLookupError):
            os.kill(pid, signal.SIGKILL)
    return True


def end_by_budget(budget, long):
    budget.stop()


def end_by_signal(budget, long):
    wait_for(lambda: killed() and long.done())


@pytest.mark.parametrize("end, error", [(end_by_budget, Halted), (end_by_signal, RuntimeError)])
def test_a_file_that_takes_too_long_or_is_killed_is_no_lack_of_memory_and_the_next_one_is_set(end, error):
    budget = Budget()
    with ThreadPoolExecutor() as pool:
        long = pool.submit(typeset, b"#for i in range(30000) { for j in range(30000) {} }", FACE, {}, budget)
        wait_for(lambda: typesetting.pids)
        end(budget, long)
        with pytest.raises(error, match="signal 9" if error is RuntimeError else None):
            long.result()
    assert typeset(TEMPLATE, FACE, {"title": "short", "names": []}).startswith(b"%PDF")
