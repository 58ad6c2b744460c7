"""The command paper: the paper's numbers beside those of this program."""

from __future__ import annotations

from collections.abc import Sequence

from rich.text import Text

from app.command import show
from app.command.options import Json
from app.questions import paper as papers
from app.questions.paper import PaperNumber, PublishedNumber
from app.questions.question import Terms


def paper(json: Json = False) -> None:
    """The paper's numbers beside those of this program, with the reason for each difference."""
    with show.waiting("recomputing the paper"):
        answer = papers.paper(papers.Nothing(), Terms())
    if json:
        show.print_json(answer.to_json())
    else:
        show.print_parts(*paper_tables(answer.rows, answer.literature))


def paper_tables(rows: Sequence[PaperNumber], literature: Sequence[PublishedNumber]) -> list[show.Part]:
    """The numbers side by side, then each reason with its evidence; then the numbers of other publications."""
    table = show.new_table("The paper beside this program", "quantity", "paper", "here", "difference")
    for one in rows:
        name = f"{one.quantity} [{one.unit}], {one.source}"
        table.add_row(name, str(one.paper), show.shown(one.ours), f"{one.difference:+.6f}")
    parts: list[show.Part] = [table]
    for one in rows:
        facts = [f"  {fact.what}: {show.shown(fact.value)} {fact.unit}" for fact in one.evidence]
        parts += [Text(one.quantity, style="bold"), one.reason, *facts, ""]
    others = show.new_table("Other publications", "quantity", "published", "here", "difference")
    for other in literature:
        difference = f"{other.difference:+.6f}"
        others.add_row(f"{other.quantity} [{other.unit}]", str(other.published), show.shown(other.ours), difference)
    parts.append(others)
    for other in literature:
        known = [f"{found.words} {found.evidence}" for found in other.diagnosis] or ["No known shortcut gives it."]
        parts += [Text(f"{other.published} {other.unit}: {other.source}", style="bold"), *known, ""]
    return parts
