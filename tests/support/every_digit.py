"""A result with all its digits, for comparisons to the last bit: reprs of results are short."""

from dataclasses import fields, is_dataclass

import numpy as np


def every_digit(value):
    """Names and values of all fields of a result, arrays as lists, down to plain numbers and texts.

    The dance that a result carries is left out: it is what was asked, not what was found.
    """
    if isinstance(value, np.ndarray):
        return value.tolist()
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: every_digit(getattr(value, field.name)) for field in fields(value) if field.name != "dance"}
    if isinstance(value, (tuple, list)):
        return [every_digit(entry) for entry in value]
    return value
