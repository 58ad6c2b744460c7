"""The font of a picture, which has every character of its words, so that no character becomes an empty box."""

from __future__ import annotations

import logging
import os
import re
from collections.abc import Collection, Iterable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cache
from pathlib import Path

from app.extras import MissingPackage
from app.files.scratch import temporary
from core.language import Language, phrase, say, speaking, spoken

# Font families with the characters of simplified Chinese; those made for it come first.
CHINESE = (
    "Noto Sans CJK SC", "Source Han Sans SC", "Source Han Sans CN", "WenQuanYi Micro Hei", "WenQuanYi Zen Hei",
    "Microsoft YaHei", "PingFang SC", "Hiragino Sans GB", "SimHei", "Heiti SC", "Droid Sans Fallback",
    "Noto Sans CJK JP",
)  # fmt: skip
# Variable with the folder of matplotlib, where its list of fonts is.
LIST_FOLDER = "MPLCONFIGDIR"
# The font that comes with matplotlib: Latin letters, digits and mathematical signs.
LATIN = "DejaVu Sans"
# Characters that only a Chinese font has: not emoji, whose planes lie between those of Chinese.
CHINESE_CHARACTER = re.compile("[\u2e80-\ud7ff\uf900-\ufaff\ufe30-\ufe4f\uff00-\uffef\U00020000-\U0003ffff]")
# Sentences of pictures, whose characters a Chinese font must have.
TRIED = (
    phrase("First contact: {time:.6f} s, head at radius {radius:.6f} m"),
    phrase("speed of the handle [m/s]"),
    phrase("bench {bench}"),
)


def families() -> tuple[str, ...]:
    """Font families for the language that is spoken, in order: a character is drawn in the first one that has it.

    raises: MissingPackage for Chinese where no font on this machine has its characters
    """
    return _families(spoken())


@cache
def _families(language: Language) -> tuple[str, ...]:
    if language is not Language.CHINESE:
        return (LATIN,)
    from matplotlib import font_manager

    # Without a bold face the regular one stands in, which matplotlib would tell the user for each word.
    logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
    manager = font_manager.fontManager
    known = {font.fname for font in manager.ttflist}
    for file in font_manager.findSystemFonts():  # matplotlib's own list may be older than this font
        if file not in known:
            manager.addfont(file)
    installed = {font.name: font for font in reversed(manager.ttflist) if font.name in CHINESE}
    return (chinese_among([name for name, font in installed.items() if draws_our_words(font)]), LATIN)


def chinese_among(families: Collection[str]) -> str:
    """The first of the Chinese fonts among those of a machine. raises: MissingPackage if there is none"""
    if name := next((name for name in CHINESE if name in families), None):
        return name
    raise MissingPackage.in_words(
        "language",
        "--language zh needs a font with Chinese characters, which this machine does not have: install "
        "fonts-wqy-microhei or fonts-noto-cjk (apt install fonts-wqy-microhei)",
    )


def families_for(texts: Iterable[str]) -> tuple[str, ...]:
    """Font families for these texts beside words in a language. raises: MissingPackage, as families() does"""
    with speaking(language_of(texts)):
        return families()


def language_of(texts: Iterable[str]) -> Language:
    """The language that decides on the font of these texts: Chinese names may stand among English words."""
    return Language.CHINESE if any(map(CHINESE_CHARACTER.search, texts)) else spoken()


@contextmanager
def kept_list() -> Iterator[None]:
    """Context in which matplotlib and the processes that this one starts keep their list of fonts in one folder.

    Where it may not write its own, matplotlib makes a temporary one for each process, which stays behind when the
    process is killed, as those of jobs are.
    """
    if _may_write(_list_folder()):
        yield
        return
    before = {name: os.environ[name] for name in (LIST_FOLDER,) if name in os.environ}
    with ExitStack() as stack:
        with suppress(OSError):  # Without room for temporary files only figures and films fail.
            os.environ[LIST_FOLDER] = stack.enter_context(temporary("fonts-"))
        yield
    os.environ.pop(LIST_FOLDER, None)
    os.environ.update(before)


def _list_folder() -> Path:
    if folder := os.environ.get(LIST_FOLDER):
        return Path(folder)
    return Path(os.environ.get("XDG_CONFIG_HOME") or os.path.expanduser("~/.config")) / "matplotlib"


def _may_write(folder: Path) -> bool:
    """True if this folder is there and may be written, or can be made."""
    there = next(place for place in (folder.absolute(), *folder.absolute().parents) if place.exists())
    return there.is_dir() and os.access(there, os.W_OK)


def draws_our_words(entry: object) -> bool:
    """True if the font of an entry in matplotlib's list is there and has our characters: the list may be older."""
    from matplotlib.ft2font import FT2Font

    file = entry.fname  # type: ignore[attr-defined]
    try:
        try:
            font = FT2Font(file, face_index=getattr(entry, "index", 0))
        except TypeError:  # before matplotlib 3.11 a file had one face
            font = FT2Font(file)
    except (OSError, RuntimeError):
        return False
    with speaking(Language.CHINESE):
        tried = {character for sentence in TRIED for character in CHINESE_CHARACTER.findall(say(sentence))}
    return font.get_charmap().keys() >= set(map(ord, tried))
