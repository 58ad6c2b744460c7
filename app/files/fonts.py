"""The font of a picture, which has every character of its words, so that no character becomes an empty box."""

from __future__ import annotations

import logging
from functools import cache

from app.extras import MissingPackage
from app.files.tables import Language

# Font families with the characters of simplified Chinese; those made for it come first.
CHINESE = (
    "Noto Sans CJK SC", "Source Han Sans SC", "Source Han Sans CN", "WenQuanYi Micro Hei", "WenQuanYi Zen Hei",
    "Microsoft YaHei", "PingFang SC", "Hiragino Sans GB", "SimHei", "Heiti SC", "Droid Sans Fallback",
    "Noto Sans CJK JP",
)  # fmt: skip
# The font that comes with matplotlib: Latin letters, digits and mathematical signs.
LATIN = "DejaVu Sans"
# Characters that a Chinese font must have: some of those that our pictures use.
TRIED = "板凳龙螺距速度首次碰撞调头把手"


@cache
def families(language: Language) -> tuple[str, ...]:
    """Font families in order: a character is drawn in the first one that has it.

    raises: MissingPackage for Chinese where no font on this machine has its characters
    """
    if language is Language.ENGLISH:
        return (LATIN,)
    from matplotlib import font_manager

    # Without a bold face the regular one stands in, which matplotlib would tell the user for each word.
    logging.getLogger("matplotlib.font_manager").setLevel(logging.ERROR)
    manager = font_manager.fontManager
    known = {font.fname for font in manager.ttflist}
    for file in font_manager.findSystemFonts():  # matplotlib's own list may be older than this font
        if file not in known:
            manager.addfont(file)
    installed = {font.name: font for font in reversed(manager.ttflist)}
    if name := next((name for name in CHINESE if name in installed and draws_our_words(installed[name])), None):
        return (name, LATIN)
    raise MissingPackage.in_words(
        "language",
        "--language zh needs a font with Chinese characters, which this machine does not have: install "
        "fonts-wqy-microhei or fonts-noto-cjk (apt install fonts-wqy-microhei)",
    )


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
    return font.get_charmap().keys() >= set(map(ord, TRIED))
