"""The language that is spoken, and its catalogues."""

import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context

from babel.messages.catalog import Catalog
from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from core.language import Language, Listed, counted, joined, say, speaking, spoken
from tests.conftest import ROOT

CORE = ROOT / "core"


def test_a_sentence_is_in_the_language_that_is_spoken_and_in_english_again_afterwards():
    with speaking("zh"):
        assert (say("bench {bench}", bench=8), counted(2, "{count} whim", "{count} whims")) == (
            "8 号板凳",
            "2 whims",  # a sentence that nobody says has no translation
        )
        with speaking(Language.ENGLISH):
            assert joined(["One.", "", "Two."]) == "One. Two."
        assert joined(["一。", "二。"]) == "一。二。"
        assert str(Listed([3, "b"])) == "3、b"
    assert (spoken(), say("bench {bench}", bench=8), str(Listed([3, "b"]))) == (Language.ENGLISH, "bench 8", "3, b")


def test_a_thread_speaks_the_language_of_its_task():
    with ThreadPoolExecutor(1) as thread, speaking("zh"):
        assert thread.submit(spoken).result() is Language.ENGLISH
        assert thread.submit(copy_context().run, spoken).result() is Language.CHINESE


def test_every_catalogue_is_compiled_as_it_is_written():
    for written in (CORE / "words").glob("*.po"):
        with written.open("rb") as source:
            catalogue = read_po(source)
        with speaking(written.stem.partition("_")[0]):
            plain = [message for message in catalogue if isinstance(message.id, str) and not message.context]
            assert [say(message.id) for message in plain[1:]] == [message.string for message in plain[1:]]


def test_a_further_language_needs_one_file(tmp_path):
    shutil.copytree(CORE, tmp_path / "core", ignore=shutil.ignore_patterns("__pycache__"))
    catalogue = Catalog(locale="eo")
    catalogue.add("bench {bench}", "benko {bench}")
    with (tmp_path / "core/words/eo.po").open("wb") as file:
        write_po(file, catalogue)
    with (tmp_path / "core/words/eo.mo").open("wb") as file:
        write_mo(file, catalogue)
    code = "from core.language import *; print(*Language)\nwith speaking('eo'): print(say('bench {bench}', bench=8))"
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True)
    assert done.stdout.split("\n")[:2] == ["en zh eo", "benko 8"], done.stderr
