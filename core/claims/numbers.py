"""Numbers in claims."""

from __future__ import annotations

from core.errors import said as format_number
from core.errors import said_bound as format_bound


def format_safe(stray: float) -> str:
    """A stray that is proven safe [m], rounded down to 1e-12 m, so that it stays proven.

    >>> format_safe(0.8250000000000001), format_safe(0.02)
    ('0.825', '0.02')
    """
    return format_number(float(format_bound(stray, 12)))
