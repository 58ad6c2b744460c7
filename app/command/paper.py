"""The command paper: the paper's numbers beside those of this program."""

from __future__ import annotations

from collections.abc import Iterator

from app.command import show
from app.command.options import Json
from app.grade.words import word
from app.questions import paper as papers
from app.questions.paper import PaperTable
from app.wire.labels import Heading, Part, Table, value_text
from app.wire.question import Terms
from core.language import say


def paper(
    json: Json = False,
) -> None:
    """The paper's numbers beside those of this program, with the reason for each difference."""
    with show.waiting(say("recomputing the paper")):
        answer = papers.paper(papers.PaperQuery(), Terms())
    show.print_result(answer, json, _parts(answer))


def _parts(answer: PaperTable) -> Iterator[Part]:
    """The numbers side by side, then each reason with its evidence; then the numbers of other publications."""

    def words(code: str) -> str:
        return word(f"paper_{code}")

    table = Table(words("title"), *map(words, ("quantity", "paper", "ours", "difference")))
    for one in answer.rows:
        name = f"{one.quantity} [{one.unit}], {one.source}"
        table.add(name, str(one.paper), value_text(one.ours), f"{one.difference:+.6f}")
    yield table
    for one in answer.rows:
        yield Heading(one.quantity)
        yield one.reason
        yield from (f"  {fact.what}: {value_text(fact.value)} {fact.unit}" for fact in one.evidence)
        yield ""
    others = Table(words("others"), *map(words, ("quantity", "published", "ours", "difference")))
    for other in answer.literature:
        difference = f"{other.difference:+.6f}"
        others.add(f"{other.quantity} [{other.unit}]", str(other.published), value_text(other.ours), difference)
    yield others
    for other in answer.literature:
        yield Heading(f"{other.published} {other.unit}: {other.source}")
        yield from [f"{error.words} {error.evidence}" for error in other.diagnosis] or [words("unknown")]
        yield ""
