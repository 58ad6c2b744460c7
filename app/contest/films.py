"""The two films of the kit: the dance inwards up to first contact, and the turn."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor, wait
from contextlib import contextmanager
from contextvars import copy_context
from dataclasses import dataclass
from functools import partial

from app.contest.solved import Solved
from app.files.film_spec import ENDINGS, LOOKS, FilmSpec
from core import Budget
from core.language import say

# Names of the films, without their endings.
FILMS = ("dance", "turn")
# Time between two looks at films that another thread makes [s].
LOOK_SECONDS = 0.05
# A file of the kit, by its name; and what is called with the name of a step and its finished share.
NamedFile = tuple[str, bytes]
StepProgress = Callable[[str, float], None]


@dataclass(frozen=True)
class Wanted:
    """films: False for no films; gif: each also as a GIF; seconds: length of each [s]"""

    films: bool = True
    gif: bool = False
    seconds: float = 20.0


@contextmanager
def films_beside(solved: Solved, wanted: Wanted, progress: StepProgress) -> Iterator[Callable[[], list[NamedFile]]]:
    """Context in which another thread makes the films; they end with it. Yields the function that waits for films().

    That function reports their progress, and raises Halted once the budget of the answers is stopped.
    """
    # A budget of its own: one that two threads use would stop but one of them.
    budget, shares = Budget(math.inf), dict[str, float]()

    def wait_for_films() -> list[NamedFile]:
        while True:
            is_done = bool(wait([filming], LOOK_SECONDS).done)
            for name, share in list(shares.items()):
                progress(name, share)
            if is_done:
                return filming.result()
            solved.budget.look()

    with ThreadPoolExecutor(1, "films") as threads:
        drawn = partial(films, solved, wanted, budget, shares.__setitem__)
        filming = threads.submit(copy_context().run, lambda: list(drawn()))
        try:
            yield wait_for_films
        finally:
            budget.stop()


def films(solved: Solved, wanted: Wanted, budget: Budget, progress: StepProgress) -> Iterator[NamedFile]:
    """Name and bytes of every wanted film; without PyAV each is a GIF.

    raises: MissingPackage without matplotlib, or without a font for the language
    """
    if not wanted.films:
        return
    from app.files import film

    span = solved.request.span
    inwards, pair = say("Bench dragon, to first contact"), solved.contact.benches
    if solved.contact.time is None:
        inwards, pair = say("Bench dragon, to the end of the run"), None
    kinds = [(FILMS[0], solved.spiral, 0.0, solved.met_at, inwards, pair)]
    if solved.turned:
        kinds.append((FILMS[1], solved.turned.dance, -span, span, say("Bench dragon, the turn"), None))
    forms = list(ENDINGS) if wanted.gif else list(ENDINGS)[:1]
    for name, dance, start, stop, title, touching in kinds:
        for form in forms:
            spec = FilmSpec(start, stop, wanted.seconds, *LOOKS[form], touching=touching)
            file = name + ENDINGS[form]
            yield file, film.film(dance, spec, form, title=title, budget=budget, progress=partial(progress, file))
