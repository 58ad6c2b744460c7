"""The five answers in numbers, each with its bracket and its evidence."""

from __future__ import annotations

from dataclasses import dataclass

from app.contest.solved import Solved, Turned
from app.files.words import Say
from core import EndReason, MinimumPitch, Outcome, ShortestTurn


@dataclass(frozen=True)
class Result:
    """One number of an answer.

    question: 1 to 5; bracket: interval that is proven to hold the exact value, if there is one; how: the evidence
    """

    question: int
    name: str
    value: float
    unit: str
    bracket: tuple[float | None, float | None] | None
    how: str


def answers(solved: Solved, say: Say) -> list[Result]:
    """The numbers of the five answers, in the order of the questions."""
    results = [*_inwards(solved, say), *_contact(solved, say), _pitch(solved.pitch, say)]
    if solved.turned:
        limit = solved.request.speed_limit
        results += [*_turn(solved.turned, say), *_times(solved.turned, limit, say), _speed(solved.turned, limit, say)]
    return results


def _inwards(solved: Solved, say: Say) -> list[Result]:
    motion, stop = solved.inwards, solved.inwards.time[-1]
    how = say(
        "every handle from the chord equation, every speed from the rigid links: good to 1e-11 m and 1e-11 m/s",
        "逐节由弦长方程求位置，由刚性约束求速度：误差小于 1e-11 m 与 1e-11 m/s",
    )
    rear, at = say("rear handle of the tail", "龙尾后把手"), say(f" at {stop:g} s", f"（{stop:g} s）")
    places = [
        Result(1, f"{name}{say(', ', ' ')}{axis}{at}", float(motion.position[-1, k, i]), "m", None, how)
        for name, k in ((say("head", "龙头前把手"), 0), (rear, -1))
        for i, axis in enumerate("xy")
    ]
    return [*places, Result(1, f"{rear}{say(', speed', '速度')}{at}", float(motion.speed[-1, -1]), "m/s", None, how)]


def _contact(solved: Solved, say: Say) -> list[Result]:
    contact = solved.contact
    if contact.time is None or contact.benches is None or contact.head is None:
        name = say("no contact until", "直到此刻没有碰撞")
        return [Result(2, name, solved.met_at, "s", contact.time_bracket, _why_ended(solved, say))]
    a, b = contact.benches
    pair = say(f"benches {a} and {b}", f"{a} 号与 {b} 号板凳（龙头为 0 号）")
    steps = contact.certificate.steps
    how = say(
        f"{pair} touch; {steps} proven steps show that nothing touched earlier",
        f"{pair}相碰；{steps} 个经过证明的步表明此前没有碰撞",
    )
    place = say("the head at that time", "该时刻的龙头")
    return [
        Result(2, say("first contact", "首次碰撞时刻"), contact.time, "s", contact.time_bracket, how),
        Result(
            2, say("distance of the head from the centre", "龙头到中心的距离"), contact.head.radius, "m", None, place
        ),
    ]


def _why_ended(solved: Solved, say: Say) -> str:
    end = solved.contact.end
    if end is None or solved.contact.outcome is Outcome.UNDECIDED:
        return say("the search ended there", "搜索到此为止")
    if end.reason is EndReason.FOLD:
        return say(
            f"the run ends there: bench {end.bench} folds and cannot follow any further",
            f"盘入到此结束：{end.bench} 号板凳折转，无法继续跟随",
        )
    return say("the head is at the centre", "龙头已到中心")


def _pitch(minimum: MinimumPitch, say: Say) -> Result:
    pair = minimum.benches or ()
    whose = say(" of benches {} and {}", "（{} 号与 {} 号板凳）").format(*pair) if pair else ""
    words = {
        "graze": say(f"a graze{whose} on the way", f"途中的擦碰{whose}"),
        "circle": say(f"contact{whose} on the circle", f"到达调头圆时的碰撞{whose}"),
        "start": say(f"contact{whose} at the start", f"起点处的碰撞{whose}"),
        "fold": say("a bench that can no longer follow", "板凳无法继续跟随"),
    }
    every = minimum.proven_up_to is None and minimum.scan_step is None
    proven = say("every larger pitch is proven feasible", "已证明更大的螺距全部可行")
    sampled = say("larger pitches are partly sampled, not proven", "更大的螺距有一部分是抽样而非证明")
    limit = say("limited by ", "限制因素：") + words[minimum.limited_by.value]
    how = f"{limit}{say('; ', '；')}{proven if every else sampled}"
    return Result(3, say("minimum pitch", "最小螺距"), minimum.pitch, "m", minimum.pitch_bracket, how)


def _turn(turned: Turned, say: Say) -> list[Result]:
    shortest, even, length = turned.shortest, turned.even, turned.path.length
    why = say(
        "closed form. The sum of the radii is S = sqrt(R^2 + (p / 2 pi)^2) at every ratio, and both arcs have the "
        "same angle a, so the length S a does not depend on the ratio",
        "闭式解：两段圆弧半径之和 S = sqrt(R^2 + (p / 2π)^2) 与比例无关，且两段圆弧转过同一角 a，"
        "因此长度 S a 与半径之比无关",
    )
    inner, shorter = say("shortest turn", "最短调头曲线长度"), say("shorter by", "缩短")
    equal = say("shortest turn with equal arcs (ratio 1)", "两段圆弧半径相等（比例 1）时的最短长度")
    rows = [
        (say("length of the turn", "调头曲线长度"), length, None, why),
        (inner, shortest.turn.length, shortest.length_bracket, _why_shortest(shortest, say)),
        (shorter, length - shortest.turn.length, None, say("the difference", "两者之差")),
    ]
    if even and even.turn.length < shortest.turn.length:
        rows.append((equal, even.turn.length, even.length_bracket, _why_shortest(even, say)))
    return [Result(4, name, value, "m", bracket, how) for name, value, bracket, how in rows]


def _why_shortest(shortest: ShortestTurn, say: Say) -> str:
    limits = {
        "least_radius": say(
            "the least radius of a bend, half of the longest chord and 0.1 % more for the proof",
            "最小弯曲半径（最长把手间距的一半再加 0.1 %，证明所需）",
        ),
        "contact": say("benches would touch", "板凳会相碰"),
        "circle": say("its circle", "调头空间的边界"),
        "centre": say("nothing, down to the centre", "直到中心都没有限制"),
        "undecided": say("rounding hides whether benches would touch", "舍入误差使是否相碰无法判定"),
    }
    entry, leaving = (f"{radius:.6f} m" for radius in (shortest.turn.entry_radius, shortest.turn.exit_radius))
    limit = limits[shortest.limited_by.value]
    return say(
        f"entry at a radius of {entry}, exit at {leaving}; limit: {limit}",
        f"在半径 {entry} 处进入、{leaving} 处离开；限制：{limit}",
    )


def _times(turned: Turned, limit: float, say: Say) -> list[Result]:
    """How long the head takes through the turns if no handle exceeds the limit."""
    turns = (
        say("the turn of question 4", "问题 4 的调头曲线"),
        say("the shortest turn", "最短调头曲线"),
        say("the quickest turn (of a scan)", "最快调头曲线（扫描所得）"),
    )
    results = []
    for name, time in zip(turns, turned.times, strict=False):
        entry, leaving = time.turn.entry_radius, time.turn.exit_radius
        how = say(
            f"{time.length:.6f} m at {time.head_speed:.6f} m/s, the highest head speed at which no handle exceeds "
            f"{limit:g} m/s; entry at a radius of {entry:.6f} m, exit at {leaving:.6f} m",
            f"长 {time.length:.6f} m，龙头以 {time.head_speed:.6f} m/s 行进，"
            f"即各把手不超过 {limit:g} m/s 时的最大速度；"
            f"在半径 {entry:.6f} m 处进入、{leaving:.6f} m 处离开",
        )
        results.append(Result(4, say(f"time through {name}", f"通过{name}的时间"), time.time, "s", None, how))
    return results


def _speed(turned: Turned, limit: float, say: Say) -> Result:
    fastest = turned.fastest
    handles = say(", ", "、").join(map(str, fastest.handles))
    how = say(
        f"handles {handles} reach {limit:g} m/s at {fastest.time:.6f} s, "
        f"{fastest.speed_ratio:.6f} times the head's speed",
        f"{handles} 号把手在 {fastest.time:.6f} s 达到 {limit:g} m/s，为龙头速度的 {fastest.speed_ratio:.6f} 倍",
    )
    return Result(
        5, say("maximum head speed", "龙头最大速度"), fastest.head_speed, "m/s", fastest.head_speed_bracket, how
    )
