"""Numbers as people type them: with a comma, with their unit, with full-width digits."""

from __future__ import annotations

import re
import unicodedata
from decimal import Decimal

from app.grade.words import Note, note
from core import InvalidValue
from core.quantities import Given

# A number as it was typed, because its digits show its rounding.
TYPED = re.compile(r"[+-]?([0-9]{1,6}(\.[0-9]{0,20})?|\.[0-9]{1,20})([eE][+-]?[0-9]{1,2})?")
# A number with what stands behind it.
WITH_UNIT = re.compile(r"(?P<number>[-+0-9.,eE]*[0-9.,])\s*(?P<unit>[^\W\d_eE][^\d_,]*)")
# How people write each unit.
WRITTEN = {
    "s": ("s", "sec", "seconds", "秒"),
    "m": ("m", "metres", "meters", "米"),
    "m/s": ("m/s", "mps", "米/秒", "米每秒"),
}
# Sizes of other units that people write, in the unit that is asked for; and their names in Chinese.
OTHER_UNITS = {
    "s": {"min": Decimal(60), "ms": Decimal("1e-3")},
    "m": {"cm": Decimal("1e-2"), "mm": Decimal("1e-3"), "km": Decimal("1e3")},
    "m/s": {"km/h": 1 / Decimal("3.6"), "cm/s": Decimal("1e-2"), "mm/s": Decimal("1e-3")},
}
CHINESE = {
    "毫秒": "ms", "厘米": "cm", "毫米": "mm", "千米": "km", "公里": "km", "厘米/秒": "cm/s", "毫米/秒": "mm/s",
}  # fmt: skip
# Numbers of usual form.
EXAMPLES = {"s": "300.25", "m": "12.345", "m/s": "1.25"}


def plain_number(name: str, text: str, unit: str) -> tuple[str, list[Note]]:
    """The number in a text as a program writes it, with a note on all that it was read through.

    name: of the number; unit: that it must have, whether it is written or not
    raises: InvalidValue for what is no number, or has another unit
    """
    typed = text.strip()
    bare, notes = unicodedata.normalize("NFKC", typed).replace("。", "."), []
    size = None
    if bare != typed:
        notes.append(note("full_width"))
    if not TYPED.fullmatch(bare) and (parts := WITH_UNIT.fullmatch(bare)):
        written = parts["unit"].lower()
        size = OTHER_UNITS[unit].get(CHINESE.get(written, written))
        # By a power of ten alone: other sizes would change the digits, which show the rounding.
        if written not in WRITTEN[unit] and not (size and size == Decimal(10) ** size.adjusted()):
            raise InvalidValue(name, "must be in {unit}, without another unit", got=Given(text), unit=unit)
        bare = parts["number"]
        notes.append(note("converted", written=written, unit=unit) if size else note("with_unit", unit=unit))
    if bare.count(",") == 1 and "." not in bare:
        bare = bare.replace(",", ".")
        notes.append(note("with_comma"))
    if not TYPED.fullmatch(bare):
        words = "must be a number [{unit}] in digits, such as {example}"
        raise InvalidValue(name, words, got=Given(text), unit=unit, example=EXAMPLES[unit])
    if size:
        bare = format(Decimal(bare).scaleb(size.adjusted()), "f")
    return bare, [note("read_as", number=bare), *notes] if notes else []
