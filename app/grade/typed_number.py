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
# Other units that people write, and the power of ten that makes of them the one that is asked for.
CONVERTED = {
    "s": {"ms": -3, "毫秒": -3},
    "m": {"mm": -3, "毫米": -3, "cm": -2, "厘米": -2, "km": 3, "千米": 3, "公里": 3},
    "m/s": {"mm/s": -3, "毫米/秒": -3, "cm/s": -2, "厘米/秒": -2},
}
# Numbers of usual form.
EXAMPLES = {"s": "300.25", "m": "12.345", "m/s": "1.25"}


def plain_number(name: str, text: str, unit: str) -> tuple[str, list[Note]]:
    """The number in a text as a program writes it, with a note on all that it was read through.

    name: of the number; unit: that it must have, whether it is written or not
    raises: InvalidValue for what is no number, or has another unit
    """
    typed = text.strip()
    bare, notes = unicodedata.normalize("NFKC", typed).replace("。", "."), []
    power: int | None = 0
    if bare != typed:
        notes.append(note("full_width"))
    if not TYPED.fullmatch(bare) and (parts := WITH_UNIT.fullmatch(bare)):
        written = parts["unit"].lower()
        power = 0 if written in WRITTEN[unit] else CONVERTED[unit].get(written)
        if power is None:
            raise InvalidValue(name, "must be in {unit}, without another unit", got=Given(text), unit=unit)
        bare = parts["number"]
        notes.append(note("with_unit", unit=unit) if not power else note("converted", written=written, unit=unit))
    if bare.count(",") == 1 and "." not in bare:
        bare = bare.replace(",", ".")
        notes.append(note("with_comma"))
    if not TYPED.fullmatch(bare):
        words = "must be a number [{unit}] in digits, such as {example}"
        raise InvalidValue(name, words, got=Given(text), unit=unit, example=EXAMPLES[unit])
    if power:
        bare = format(Decimal(bare).scaleb(power), "f")
    return bare, [note("read_as", number=bare), *notes] if notes else []
