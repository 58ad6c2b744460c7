"""The contest's five questions, solved, with every file that a student hands in."""

from __future__ import annotations

from collections.abc import Callable

from pydantic import Field

from app.contest.films import FILMS, Wanted
from app.contest.kit import workbook_alone, zip_of
from app.contest.solved import ContestRequest
from app.files.film_spec import ENDINGS, LOOKS
from app.files.tables import XLSX_TYPE
from app.questions.films import SECONDS_PER_MEGAPIXEL, megapixels_of
from app.wire.fields import Whole, check_limit, measure
from app.wire.question import Question, Terms
from core.kernels import Halted
from core.language import Language
from core.questions import unanswered

ZIP_TYPE = "application/zip"
# Time of everything but the films of the contest's dance, measured 2026-11-27 [s].
SECONDS = 12.0
# Time of the workbook of a question, measured 2026-11-30 [s].
WORKBOOK_SECONDS = 1.0
# Work of the answers and of the figures, beside 1 for a film.
ANSWERS, FIGURES = 0.1, 0.5


class ContestKitRequest(ContestRequest, strict=True):
    """The numbers of the problem, as for the command, and the look of the kit."""

    language: Language = Field(Language.CHINESE, description="Language of names and captions: zh or en", strict=False)
    films: bool = Field(True, description="Whether the kit holds a film of the dance and one of the turn")
    gif: bool = Field(False, description="Whether each film is there as a GIF too")
    seconds: float = measure("s", "Length of each film", 20.0, ge=0.1, le=120)
    question: Whole | None = Field(
        None,
        ge=1,
        le=5,
        description="The only question that the archive is about: its workbook, tables and figures, without films and "
        "report; default: all five",
    )

    @property
    def has_films(self) -> bool:
        return self.films and self.question is None

    @property
    def shot(self) -> Wanted:
        return Wanted(self.has_films, self.gif, self.seconds)


def contest_kit(request: ContestKitRequest, terms: Terms, form: str = ZIP_TYPE) -> bytes:
    """The contest kit (CUMCM 2024 A) as a ZIP archive: workbooks, answers, tables, figures, films and a report.

    The workbook of a question alone is there as .xlsx.
    """
    limits, handles = terms.settings, request.benches + 1
    check_limit(
        "benches",
        "benches must be at most {most} here",
        request.benches,
        limits.checked_benches_max,
        "shorten the dragon",
    )
    for field, instants in (("stop", request.stop + 1), ("span", 2 * request.span + 1)):
        # Two numbers for the place of a handle, as in the contest's workbooks.
        cells, most = int(2 * handles * instants), limits.workbook_cells_max
        check_limit(
            field, "cells of a sheet must be at most {most} here", cells, most, "shorten the time or the dragon"
        )
    if request.has_films:
        pixels = round(sum(_megapixels(request).values()))
        check_limit(
            "seconds",
            "millions of pixels must be at most {most} here",
            pixels,
            limits.film_megapixels_max,
            "take shorter films",
        )
    try:
        if form == XLSX_TYPE:
            return workbook_alone(request, terms, request.question)
        return zip_of(request, request.shot, terms, _overall(request, terms), request.question)
    except Halted as halted:
        raise unanswered(halted.budget, "benches", "the kit was not made", request.benches) from halted


def _overall(request: ContestKitRequest, terms: Terms) -> Callable[[str, float], None]:
    """Function that reports the share of the whole kit from a step and its own share, and ends a stopped question."""
    steps: dict[str, float] = {}
    films = len(_megapixels(request)) if request.has_films else 0
    weights = [ANSWERS, FIGURES, *[1.0] * films]

    def report(step: str, share: float) -> None:
        steps[step] = share
        done = sum(weight * one for weight, one in zip(weights, steps.values(), strict=False))
        terms.progress(done / sum(weights))
        if terms.budget.stopped:
            raise Halted(terms.budget)

    return report


def _megapixels(request: ContestKitRequest) -> dict[tuple[str, str], float]:
    """Millions of pixels of every film, by its name and its form."""
    forms = list(ENDINGS) if request.gif else list(ENDINGS)[:1]
    sizes = {form: megapixels_of(request.seconds, *look) for form, look in LOOKS.items()}
    return {(name, form): sizes[form] for name in FILMS for form in forms}


def _cost(request: ContestKitRequest, form: str = ZIP_TYPE) -> float:
    if form == XLSX_TYPE:
        return WORKBOOK_SECONDS
    films = _megapixels(request).items() if request.has_films else ()
    return SECONDS + sum(pixels * SECONDS_PER_MEGAPIXEL[form] for (_, form), pixels in films)


QUESTION = Question(
    contest_kit, None, body=ContestKitRequest, forms=(ZIP_TYPE, XLSX_TYPE), cost=_cost, at="/contest-kit"
)
