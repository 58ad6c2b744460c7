"""report.md: one page that presents the files of the kit, with all numbers from the same run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from app.contest.answers import Result
from app.contest.solved import Solved
from app.contest.tables import KitTable, in_markdown
from app.files.words import Say
from core.errors import format_number

if TYPE_CHECKING:
    from app.contest.figures import Drawn

DIGITS = 9


def answer_table(results: Sequence[Result], say: Say) -> str:
    """The five answers as a table in Markdown."""
    heads = say("question|what|value|bracket|how it is known", "问题|量|数值|区间|依据").split("|")
    rows = [
        [f"{one.question}", one.name, f"{one.value:.{DIGITS}f} {one.unit}", _bracket(one), one.how] for one in results
    ]
    return in_markdown([heads, ["---", "---", "---:", "---", "---"], *rows])


def _bracket(one: Result) -> str:
    if one.bracket is None:
        return ""
    return ", ".join("?" if end is None else format_number(end) for end in one.bracket) + f" {one.unit}"


def report(
    solved: Solved,
    results: Sequence[Result],
    tables: Sequence[KitTable],
    drawn: Sequence[Drawn],
    films: Sequence[str],
    say: Say,
) -> str:
    """The page. films: names of their files"""
    names = ("result1.xlsx", "result2.xlsx", "result4.xlsx")[: 3 if solved.turned else 2]
    books = [f"[{name}]({name})" for name in names]
    parts = [
        say("# The bench dragon: every answer", "# 板凳龙：全部答案"),
        _dragon(solved, say),
        say("## Answers", "## 答案"),
        answer_table(results, say),
        _ratio(solved, say),
        say("## Workbooks", "## 结果文件"),
        say(
            f"{', '.join(books)}: all handles, six decimals, halves rounded away from zero.",
            f"{'、'.join(books)}：全部把手，六位小数，四舍五入。",
        ),
        say("## Tables", "## 表格"),
    ]
    for table in tables:
        links = " ".join(f"[{kind}](tables/{table.name}.{kind})" for kind in ("csv", "md", "tex"))
        parts += [f"**{table.caption}** ({links})", table.to_markdown()]
    if drawn:
        parts.append(say("## Figures", "## 图"))
    for one in drawn:
        links = " ".join(f"[{kind}](figures/{one.name}.{kind})" for kind in one.files)
        parts.append(f"![{one.name}](figures/{one.name}.png)\n\n*{one.caption}* ({links})")
    if films:
        parts += [say("## Films", "## 动画"), say(", ", "、").join(f"[{name}]({name})" for name in films)]
    return "\n\n".join(part.rstrip("\n") for part in parts) + "\n"


def _dragon(solved: Solved, say: Say) -> str:
    request = solved.request
    return say(
        f"{request.benches} benches (head {request.head_length:g} m, body {request.body_length:g} m, "
        f"width {request.width:g} m, overhang {request.overhang:g} m) "
        f"on a spiral of {request.pitch:g} m pitch from {request.start_turns:g} turns, "
        f"the head at {request.head_speed:g} m/s; turning circle {request.turning_diameter:g} m, "
        f"pitch of the turn {request.turn_pitch:g} m, ratio of its arcs {request.ratio:g}, "
        f"speed limit {request.speed_limit:g} m/s.",
        f"共 {request.benches} 节板凳（龙头长 {request.head_length:g} m，龙身与龙尾长 {request.body_length:g} m，"
        f"板宽 {request.width:g} m，孔到板端 {request.overhang:g} m），螺距 {request.pitch:g} m，"
        f"自第 {request.start_turns:g} 圈盘入，"
        f"龙头速度 {request.head_speed:g} m/s；调头圆直径 {request.turning_diameter:g} m，"
        f"调头螺距 {request.turn_pitch:g} m，"
        f"圆弧半径之比 {request.ratio:g}，限速 {request.speed_limit:g} m/s。",
    )


def _ratio(solved: Solved, say: Say) -> str:
    if solved.turned is None:
        return say(
            f"Questions 4 and 5 have no answer: {solved.why_no_turn}. Change the turning diameter, the pitch of the "
            "turn or the ratio of its arcs.",
            f"问题 4 和 5 没有答案：{solved.why_no_turn}。请改变调头圆直径、调头螺距或圆弧半径之比。",
        )
    turn, shortest, even = solved.turned.path, solved.turned.shortest.turn, solved.turned.even
    low = solved.turned.shortest.length_bracket[0]
    words = say(
        f"Question 4 asks for a shorter turn. Another ratio alone does not help: the length is {turn.length:.7f} m at "
        f"every ratio while the dance leaves opposite to its entry. An entry and an exit inside the circle do: from "
        f"{shortest.entry_radius:.6f} m to {shortest.exit_radius:.6f} m from the centre the turn is "
        f"{shortest.length:.7f} m long, {turn.length - shortest.length:.7f} m shorter; with this ratio none is shorter "
        f"than {low:.7f} m (proven).",
        f"问题 4 问调头曲线能否变短。只改变半径之比不能：终点与起点相对时，任何比例下长度都是 "
        f"{turn.length:.7f} m。起点和终点都可在圆内自由选取：距中心 {shortest.entry_radius:.6f} m 处进入、"
        f"{shortest.exit_radius:.6f} m 处离开时长度为 {shortest.length:.7f} m，"
        f"缩短 {turn.length - shortest.length:.7f} m；此比例下没有短于 {low:.7f} m 的（已证明）。",
    )
    if even and even.turn.length < shortest.length:
        words += say(
            f" Another ratio makes it even shorter: with equal arcs (ratio 1), from {even.turn.entry_radius:.6f} m to "
            f"{even.turn.exit_radius:.6f} m from the centre, it is {even.turn.length:.7f} m long.",
            f"改变比例还能更短：两段圆弧半径相等（比例 1）、距中心 {even.turn.entry_radius:.6f} m 处进入、"
            f"{even.turn.exit_radius:.6f} m 处离开时，长度为 {even.turn.length:.7f} m。",
        )
    return words
