"""What a refusal must say: the field and the values in its message, whatever its words."""

from contextlib import contextmanager

import pytest

from core import InvalidValue


@contextmanager
def refused(field, error=InvalidValue, **values):
    """A block that must be refused because of this field, with at least these values in the message."""
    with pytest.raises(error) as caught:
        yield
    result = caught.value.values | {"got": caught.value.got}
    assert (caught.value.field, {**result, **values}) == (field, result)
