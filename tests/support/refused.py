"""What a refusal must say: the field and the values in its message, whatever its words."""

import re
from contextlib import contextmanager

import pytest

from core import InvalidValue

# More digits than anybody reads; what a caller gave is repeated as it was.
LONG = re.compile(r"(?:\d\.?){13}")


@contextmanager
def refused(field, error=InvalidValue, **values):
    """A block that must be refused because of this field, with at least these values in the message."""
    with pytest.raises(error) as caught:
        yield caught
    result = caught.value.values | {"got": caught.value.got}
    assert caught.value.field == field
    assert {**result, **values} == result
    assert [word for word, value in caught.value.values.items() if word != "got" and LONG.search(str(value))] == []
