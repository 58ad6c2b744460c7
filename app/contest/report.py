"""The report of a kit, all of one run: report.md, which leads to its files, and report.pdf, for paper."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from app.contest.answers import Result
from app.contest.solved import Solved
from app.contest.tables import KitTable, in_markdown
from core import Budget
from core.language import Listed, say
from core.quantities import format_number

if TYPE_CHECKING:
    from app.contest.figures import Drawn

DIGITS = 9


def answer_lines(results: Sequence[Result]) -> list[list[str]]:
    """The heads of the table of the five answers, then its rows."""
    rows = [
        [f"{one.question}", one.name, f"{one.value:.{DIGITS}f} {one.unit}", _bracket(one), one.how] for one in results
    ]
    return [say("question|what|value|bracket|how it is known").split("|"), *rows]


def answer_table(results: Sequence[Result]) -> str:
    """The five answers as a table in Markdown."""
    heads, *rows = answer_lines(results)
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
) -> str:
    """The page. films: names of their files"""
    names = ("result1.xlsx", "result2.xlsx", "result4.xlsx")[: 3 if solved.turned else 2]
    books = [f"[{name}]({name})" for name in names]
    parts = [
        say("# The bench dragon: every answer"),
        _dragon(solved),
        say("## Answers"),
        answer_table(results),
        _ratio(solved),
        say("## Workbooks"),
        say("{books}: all handles, six decimals, halves rounded away from zero.", books=Listed(books)),
        say("## Tables"),
    ]
    for table in tables:
        links = " ".join(f"[{kind}](tables/{table.name}.{kind})" for kind in ("csv", "md", "tex"))
        parts += [f"**{table.caption}** ({links})", table.to_markdown()]
    if drawn:
        parts.append(say("## Figures"))
    for one in drawn:
        links = " ".join(f"[{kind}](figures/{one.name}.{kind})" for kind in one.files)
        parts.append(f"![{one.name}](figures/{one.name}.png)\n\n*{one.caption}* ({links})")
    if films:
        parts += [say("## Films"), str(Listed(f"[{name}]({name})" for name in films))]
    return "\n\n".join(part.rstrip("\n") for part in parts) + "\n"


def report_pdf(
    solved: Solved, results: Sequence[Result], tables: Sequence[KitTable], drawn: Sequence[Drawn], budget: Budget
) -> bytes:
    """The answers, tables and figures on paper, tagged. raises: MissingPackage without a font for the language"""
    from app.files.typeset import face_for, typeset

    def table(heading: str, lines: list[list[str]], widths: list[float], left: list[int]) -> dict[str, Any]:
        columns, *rows = lines
        return {"heading": heading, "columns": columns, "rows": rows, "widths": widths, "left": left}

    numbers = [table(one.caption, one.lines(), [2.0, *[1.0] * len(one.columns)], [0]) for one in tables]
    data = {
        "title": _bare(say("# The bench dragon: every answer")),
        "dragon": _dragon(solved),
        "answers": table(_bare(say("## Answers")), answer_lines(results), [1.0, 2.2, 1.7, 2.2, 3.4], [0, 1, 3, 4]),
        "turn": _ratio(solved),
        "tables-heading": _bare(say("## Tables")),
        "tables": numbers,
        "figures-heading": _bare(say("## Figures")),
        "figures": [(one.caption, one.files["svg"].decode()) for one in drawn],
    }
    template = files("app.contest").joinpath("report.typ").read_bytes()
    return typeset(template, face_for([solved.why_no_turn]), data, budget)


def _bare(heading: str) -> str:
    """A heading of Markdown without its marks."""
    return heading.lstrip("# ")


def _dragon(solved: Solved) -> str:
    request = solved.request
    return say(
        "{request.benches} benches (head {request.head_length:g} m, body {request.body_length:g} m, "
        "width {request.width:g} m, overhang {request.overhang:g} m) on a spiral of {request.pitch:g} "
        "m pitch from {request.start_turns:g} turns, the head at {request.head_speed:g} m/s; turning "
        "circle {request.turning_diameter:g} m, pitch of the turn {request.turn_pitch:g} m, ratio of "
        "its arcs {request.ratio:g}, speed limit {request.speed_limit:g} m/s.",
        request=request,
    )


def _ratio(solved: Solved) -> str:
    if solved.turned is None:
        return say(
            "Questions 4 and 5 have no answer: {solved.why_no_turn}. Change the turning diameter, the "
            "pitch of the turn or the ratio of its arcs.",
            solved=solved,
        )
    turn, shortest, even = solved.turned.path, solved.turned.shortest.turn, solved.turned.even
    low = solved.turned.shortest.length_bracket[0]
    words = say(
        "Question 4 asks for a shorter turn. Another ratio alone does not help: the length is {turn.length:.7f} m at "
        "every ratio while the dance leaves opposite to its entry. An entry and an exit inside the circle do: from "
        "{shortest.entry_radius:.6f} m to {shortest.exit_radius:.6f} m from the centre the turn is "
        "{shortest.length:.7f} m long, {saved:.7f} m shorter; with this ratio none is shorter than {low:.7f} m "
        "(proven).",
        turn=turn,
        shortest=shortest,
        saved=turn.length - shortest.length,
        low=low,
    )
    if even and even.turn.length < shortest.length:
        words += say(
            " Another ratio makes it even shorter: with equal arcs (ratio 1), from "
            "{even.turn.entry_radius:.6f} m to {even.turn.exit_radius:.6f} m from the centre, it is "
            "{even.turn.length:.7f} m long.",
            even=even,
        )
    return words
