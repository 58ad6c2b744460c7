"""Rectangles with smooth edges, filled into the bytes of a picture."""

import cython
from cython.cimports.libc.math import ceil, fabs

# A pixel is mixed by the part of it that a rectangle covers. Across, a stretch of half width w whose middle is v away
# from the middle of the pixel covers [v - w, v + w] of [-1/2, 1/2]: held(v + w + 1/2) - held(v - w + 1/2), which for
# w >= 1/2 and v >= 0 is held(w - v + 1/2). Along, the same; the product is exact for rectangles along the axes, and
# else wrong only in the pixels of edges, by less than what the eye sees.
#
# In a row at dy from the middle, |dx cos + dy sin| < reach holds between two columns; so each row is filled between
# the columns where the outer rectangle begins and ends. Where the inner one covers pixels whole, they are not mixed.

# Columns of the table of rectangles: middle, direction of the length, half length and half width [pixels].
MIDDLE_X, MIDDLE_Y, ALONG_X, ALONG_Y, HALF_ALONG, HALF_ACROSS = 0, 1, 2, 3, 4, 5
FACE, EDGE = 0, 1
# Slope below which a row is parallel to an edge [1].
PARALLEL = 1e-9
# Further than any column [pixels].
OUTSIDE = 1e9


def held(x):
    return 0.0 if x < 0.0 else 1.0 if x > 1.0 else x


def covered(v, w):
    """Part of a pixel that a stretch covers. v: from its middle, at least 0; w: its half width [pixels]"""
    return held(w - v + 0.5) - held(0.5 - w - v)


def stretch_of(slope, offset, reach):
    """The values x between which |slope * x + offset| < reach."""
    if fabs(slope) < PARALLEL:
        return (-OUTSIDE, OUTSIDE) if fabs(offset) < reach else (0.0, 0.0)
    middle = -offset / slope
    half = fabs(reach / slope) if reach > 0.0 else 0.0
    return middle - half, middle + half


def index_of(x, most):
    """A number of rows or columns as an index from 0 to most."""
    return 0 if x <= 0.0 else most if x >= most else cython.cast(cython.Py_ssize_t, x)


def fill_rectangles(plane, rectangles, line, inks):
    """Fill rectangles one after the other, with lines around them.

    plane: (rows, columns, channels), which is changed; rectangles: (N, 6); line: half width of the lines [pixels]
    inks: (2, channels) values inside the lines, and of the lines, whole numbers up to 255
    """
    with cython.nogil:
        for k in range(rectangles.shape[0]):
            cos, sin = rectangles[k, ALONG_X], rectangles[k, ALONG_Y]
            length, width = rectangles[k, HALF_ALONG], rectangles[k, HALF_ACROSS]
            far, wide = length + line + 0.5, width + line + 0.5
            from_middle, reach = rectangles[k, MIDDLE_Y] - 0.5, far * fabs(sin) + wide * fabs(cos)
            first = index_of(ceil(from_middle - reach), plane.shape[0])
            last = index_of(ceil(from_middle + reach), plane.shape[0])
            for row in range(first, last):
                fill_row(plane, row, rectangles, k, line, inks)


def fill_row(plane, row, rectangles, k, line, inks):
    """Fill one row of rectangle k."""
    cos, sin = rectangles[k, ALONG_X], rectangles[k, ALONG_Y]
    length, width = rectangles[k, HALF_ALONG], rectangles[k, HALF_ACROSS]
    dy, from_middle, columns = row + 0.5 - rectangles[k, MIDDLE_Y], rectangles[k, MIDDLE_X] - 0.5, plane.shape[1]
    begin, end = stretch_of(cos, dy * sin, length + line + 0.5)
    low, high = stretch_of(sin, -dy * cos, width + line + 0.5)
    first = index_of(ceil(from_middle + max(begin, low)), columns)
    last = index_of(ceil(from_middle + min(end, high)), columns)
    begin, end = stretch_of(cos, dy * sin, length - line - 0.5)
    low, high = stretch_of(sin, -dy * cos, width - line - 0.5)
    begin, end = from_middle + max(begin, low), from_middle + min(end, high)
    inner = min(max(index_of(ceil(begin), columns), first), last)
    after = min(max(index_of(ceil(end), columns), inner), last) if begin < end else inner
    mix_row(plane, row, first, inner, rectangles, k, line, inks)
    for channel in range(plane.shape[2]):
        plane[row, inner:after, channel] = cython.cast(cython.uchar, inks[FACE, channel])
    mix_row(plane, row, after, last, rectangles, k, line, inks)


def mix_row(plane, row, first, last, rectangles, k, line, inks):
    """Mix the pixels of a row from column first to before last with the colours of rectangle k."""
    cos, sin = rectangles[k, ALONG_X], rectangles[k, ALONG_Y]
    length, width = rectangles[k, HALF_ALONG], rectangles[k, HALF_ACROSS]
    dy = row + 0.5 - rectangles[k, MIDDLE_Y]
    for column in range(first, last):
        dx = column + 0.5 - rectangles[k, MIDDLE_X]
        along, across = fabs(dx * cos + dy * sin), fabs(dx * sin - dy * cos)
        outer = covered(along, length + line) * covered(across, width + line)
        within = covered(along, length - line) * covered(across, width - line) if min(length, width) > line else 0.0
        for channel in range(plane.shape[2]):
            before = 1.0 * plane[row, column, channel]
            value = before + outer * (inks[EDGE, channel] - before)
            plane[row, column, channel] = cython.cast(
                cython.uchar, value + within * (inks[FACE, channel] - value) + 0.5
            )
