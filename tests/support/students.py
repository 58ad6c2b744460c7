"""Results as students hand them in: right ones, and some with one error each, computed without the grader's models.

Results are positions (T, 224, 2) [m] and speeds (T, 224) [m/s].
"""

import io
import math
from functools import cache

import numpy as np
import xlsxwriter

from core import Coil, Dance, Dragon, Line, Route, Spiral, Turn, trajectory
from tests.support.slow_search import arc_length

SPIRAL_TIMES = np.arange(301.0)
TURN_TIMES = np.arange(-100.0, 101.0)
B = 0.55 / (2.0 * math.pi)
START = 32.0 * math.pi
CONTACT = 412.47383768211466  # [s]
AT_CONTACT = np.array([CONTACT])
# Cells of the contest's three workbooks.
ALL_CELLS = 338_016


def of(dance, times):
    motion = trajectory(dance, times)
    return motion.position, motion.speed


def spiral(times=SPIRAL_TIMES, dragon=None, **path):
    return of(Dance(dragon or Dragon(), Spiral(**path)), times)


def turn(times=TURN_TIMES, dragon=None, **path):
    return of(Dance(dragon or Dragon(), Turn(1.7, **path)), times)


def arc(theta):
    """Arc length of the contest's spiral from its centre [m]."""
    return B * arc_length(theta)


def head_at(theta_of):
    """The right dance at the moments at which its head is at these angles."""
    return spiral(np.array([arc(START) - arc(theta_of(t)) for t in SPIRAL_TIMES]))


def circle_angle():
    return head_at(lambda t: math.sqrt(START**2 - 2.0 * t / B))


def rounded_head():
    angles = Spiral().theta(SPIRAL_TIMES).round(3)
    return head_at(lambda t: float(angles[int(t)]))


def steady_angle():
    return head_at(lambda t: START - t / 8.8)


def equal_arcs():
    """Every handle is a chord's length behind the one before along the path, instead of in a straight line."""
    back = np.concatenate([[0.0], np.cumsum(Dragon().chords)])
    return np.asarray(Spiral().position(SPIRAL_TIMES[:, None] - back)), np.ones((301, 224))


def in_degrees():
    """The polar angles in degrees, given to a cosine that takes radians."""
    position, speed = spiral()
    radius = np.hypot(position[..., 0], position[..., 1])
    angle = np.degrees(radius / B)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1), speed


def mirrored(results):
    return results[0] * [1.0, -1.0], results[1]


def quotient(before, after, motion=spiral):
    """Speeds as distance over time between two moments. before, after: of them, from the time of the row [s]"""
    times = SPIRAL_TIMES if motion is spiral else TURN_TIMES
    way = motion(times + after)[0] - motion(times + before)[0]
    return motion(times)[0], np.hypot(way[..., 0], way[..., 1]) / (after - before)


def gradient():
    """Speeds by numpy.gradient from the places as they stand in the table, with six decimals."""
    position = np.round(spiral()[0], 6)
    velocity = np.gradient(position, axis=0)
    return position, np.hypot(velocity[..., 0], velocity[..., 1])


def is_outside(position):
    """Handles that are not yet on the spiral."""
    return np.hypot(position[..., 0], position[..., 1]) > 8.8 + 1e-9


def outside(value):
    """Right results, but with this value as place and speed of handles that are not yet on the spiral."""
    position, speed = spiral()
    beyond = is_outside(position)
    return np.where(beyond[..., None], value, position), np.where(beyond, value, speed)


def on_line():
    """Handles that are not yet on the spiral stand on its tangent at the start, a chord apart, at the head's speed."""
    begin = 400.0 * np.array([math.cos(math.atan(START)), math.sin(math.atan(START))]) + [8.8, 0.0]
    path = Route([Line(tuple(begin), (8.8, 0.0)), Coil(0.55, 16.0, 3.0)], 400.0)
    position, speed = of(Dance(Dragon(), path), SPIRAL_TIMES)
    return position, np.where(is_outside(position), 1.0, speed)


def bisected(excess, low, high):
    """Place between low and high at which excess changes its sign, for each instant, to 1e-11 of the range."""
    sign = np.sign(excess(low))
    for _ in range(37):
        middle = 0.5 * (low + high)
        same = np.sign(excess(middle)) == sign
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return high


def strayed(path, results, times, handle, elsewhere):
    """Right results but for one handle, which is elsewhere on the path; those behind it follow it.

    elsewhere: ends of the stretch where it is, by the distance of the one before from the centre and the usual ends [m]
    """
    position = results[0].copy()
    s = times
    for k, chord in enumerate(Dragon().chords, start=1):
        point = position[:, k - 1]

        def excess(u, point=point, chord=chord):
            return np.linalg.norm(path.position(u) - point, axis=-1) - chord

        ends = s - 1.6 * chord, s - 0.9 * chord
        s = bisected(excess, *(elsewhere(np.linalg.norm(point, axis=-1), *ends) if k == handle else ends))
        position[:, k] = path.position(s)
    return position, results[1]


def wrong_ring(handle):
    """One handle takes the next root of the chord equation, half a turn to a turn behind the one before."""

    def elsewhere(radius, low, high):
        return arc(START) - arc(radius / B + 2.0 * math.pi), arc(START) - arc(radius / B + math.pi)

    return strayed(Spiral(), spiral(), SPIRAL_TIMES, handle, elsewhere)


def wrong_coil(handle, times):
    """One handle is on the other coil while the one before it is outside the turn."""
    path = Turn(1.7)
    growth = 1.7 / (2.0 * math.pi)

    def elsewhere(radius, low, high):
        # In the same direction from the centre the other coil is half a ring further out.
        near = path.length + growth / B * (arc(radius / growth + math.pi) - arc(4.5 / growth))
        is_outside = high < -4.5
        return np.where(is_outside, near + 2.5, low), np.where(is_outside, near, high)

    return strayed(path, turn(times), times, handle, elsewhere)


def followed(place, times):
    """Handles (T, 224, 2) on a path of one's own: each is at the first place behind the one before a chord away."""
    s = times
    points = [place(times)]
    for chord in Dragon().chords:

        def excess(u, point=points[-1], chord=chord):
            return np.linalg.norm(place(u) - point, axis=-1) - chord

        # At a kink it may be several chords back along the path.
        far = s - 0.9 * chord
        while (short := excess(far) < 0.0).any():
            far = np.where(short, far - 0.05, far)
        s = bisected(excess, far, far + 0.05)
        points.append(place(s))
    return np.stack(points, axis=1)


def semicircles(times):
    """A turn of two semicircles, 3 m and 1.5 m in radius, with their centres on the line from the entry to the exit."""
    path = Turn(1.7)
    entry = np.array(path.entry)
    along = -entry / np.linalg.norm(entry)
    left = np.array([-along[1], along[0]])
    middle = 3.0 * math.pi
    end = 4.5 * math.pi

    def place(s):
        first = s < middle  # to the left of the line, as seen along it
        angle = np.where(first, s / 3.0, (s - middle) / 1.5)[:, None]
        along_way, radius, side = (np.where(first, *pair)[:, None] for pair in ((3.0, 7.5), (3.0, 1.5), (-1.0, 1.0)))
        bend = entry + along_way * along - radius * (np.cos(angle) * along + side * np.sin(angle) * left)
        away = np.asarray(path.position(np.where(s < end, s, path.length + s - end)))
        return np.where(((s >= 0.0) & (s < end))[:, None], bend, away)

    return followed(place, times), turn(times)[1]


def mirrored_arcs(times):
    """The two arcs are mirrored in the line from the entry to the exit, where they still begin and end."""
    path = Turn(1.7)
    along = np.array(path.exit) - np.array(path.entry)
    along /= np.linalg.norm(along)

    def place(s):
        point = np.asarray(path.position(s))
        away = point - path.entry
        across = away - (away @ along)[:, None] * along
        return np.where(((s > 0.0) & (s < path.length))[:, None], point - 2.0 * across, point)

    return followed(place, times), turn(times)[1]


def labels(kind):
    names = ["龙头", *(f"第{k}节龙身" for k in range(1, 222)), "龙尾", "龙尾（后）"]
    if kind == "position":
        return [f"{name}{axis} (m)" for name in names for axis in "xy"]
    return [f"{name} (m/s)" for name in names]


def sheets(results):
    """Rows of the two sheets, rounded to six decimals as the contest asks."""
    position, speed = results
    return np.round(position.transpose(1, 2, 0).reshape(-1, len(position)), 6), np.round(speed.T, 6)


def lines(results, times):
    """CSV with a line for each handle and instant; reading it takes much less time than a workbook."""
    rows = (
        f"{t:g},{handle},{x:.6f},{y:.6f},{v:.6f}"
        for t, points, speeds in zip(times, results[0].tolist(), results[1].tolist(), strict=True)
        for handle, ((x, y), v) in enumerate(zip(points, speeds, strict=True))
    )
    return "\n".join(["time,handle,x,y,speed", *rows]).encode()


def contact_rows(results):
    """Rows of result2: the first instant of these results."""
    [position], [speed] = (part[:1].tolist() for part in results)
    rows = zip(labels("speed"), position, speed, strict=True)
    contact = [[label.removesuffix(" (m/s)"), *(round(value, 6) for value in (*p, v))] for label, p, v in rows]
    return [[None, "横坐标x (m)", "纵坐标y (m)", "速度 (m/s)"], *contact]


def contact_workbook(results=None):
    """result2; the right one unless results are given."""
    return by_xlsxwriter({"Sheet1": contact_rows(results or spiral(AT_CONTACT))})


def rows_of(results, times):
    entries = {}
    for title, kind, rows in zip(("位置", "速度"), ("position", "speed"), sheets(results), strict=True):
        labelled = [[label, *row] for label, row in zip(labels(kind), rows.tolist(), strict=True)]
        entries[title] = [[None, *(f"{t:g} s" for t in times)], *labelled]
    return entries


def by_xlsxwriter(sheets):
    sink = io.BytesIO()
    with xlsxwriter.Workbook(sink, {"in_memory": True}) as book:
        for title, rows in sheets.items():
            sheet = book.add_worksheet(title)
            for k, row in enumerate(rows):
                sheet.write_row(k, 0, row)
    return sink.getvalue()


def few():
    """A result1 of a few instants."""
    return rows_of(spiral(SPIRAL_TIMES[:4]), SPIRAL_TIMES[:4])


@cache
def three():
    """Rows of the contest's workbooks, by the titles of their sheets."""
    second = {"Sheet1": contact_rows(spiral(AT_CONTACT))}
    return [rows_of(spiral(), SPIRAL_TIMES), second, rows_of(turn(), TURN_TIMES)]
