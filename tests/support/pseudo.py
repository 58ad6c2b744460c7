"""A third language of one file, made from the catalogue: English in foreign letters, such as “béńčħ” for “bench”.

What stands in no catalogue is left in English: left() finds it.
"""

import re
import shutil

from babel.messages.mofile import write_mo
from babel.messages.pofile import read_po, write_po

from tests.support.command import ROOT

CODE = "qps"  # of pseudo-languages, as in Windows
LETTERS = str.maketrans("aceghijklnorstuyACEGHIJKLNORSTUY", "áčéğħíĵķłńóŕśŧúýÁČÉĞĦÍĴĶŁŃÓŔŚŦÚÝ")
# Values of a template, options and words; and what is left in English of a text, or without its value.
PARTS = re.compile(r"(\{[^}]*\}|--[\w-]+|[A-Za-z](?:[\w./-]*\w)?)")
ENGLISH = re.compile(r"(?<![\w./-])[A-Za-z]*[a-z]{3,}(?![\w/\[-]|\.\w| múśŧ )|\{\w+\}")
# What no catalogue has: units, functions, names of formats, programs, people, and of what stands in a square.
NAMES = """
    rad deg xlsx min max cos sin theta json Python Arrow GeoJSON Parquet shapely English Clopper Pearson
    square well stage fence east north Bench Dragon
"""


def house(folder):
    """The folder, in which the program has the language too. Words stay that are Chinese as well, such as units."""
    with (ROOT / "core/words/zh_CN.po").open("rb") as file:
        catalogue = read_po(file)
    for message in catalogue:
        if message.id:
            kept = PARTS.findall(str(message.string))
            several = isinstance(message.id, tuple)
            parts = PARTS.split(message.id[0] if several else message.id)
            said = "".join(one if one[:1] in ("{", "-") or one in kept else one.translate(LETTERS) for one in parts)
            message.string = (said,) if several else said
    shutil.copytree(ROOT / "core", folder / "core")
    for ending, write in ((".po", write_po), (".mo", write_mo)):
        with (folder / f"core/words/{CODE}{ending}").open("wb") as file:
            write(file, catalogue)
    for room in ("app", "tests"):
        (folder / room).symlink_to(ROOT / room)
    return folder


def left(text):
    """The lines of a text with a word that is neither in the language nor a name."""
    return [line for line in text.splitlines() if {*ENGLISH.findall(line)} - {*NAMES.split()}]
