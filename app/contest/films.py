"""The two films of the kit: the dance inwards up to first contact, and the turn."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

from app.contest.solved import Solved
from app.files.film_spec import ENDINGS, LOOKS, FilmSpec
from app.files.words import Say

# Names of the films, without their endings.
FILMS = ("dance", "turn")


@dataclass(frozen=True)
class Wanted:
    """films: False for no films; gif: each also as a GIF; seconds: length of each [s]"""

    films: bool = True
    gif: bool = False
    seconds: float = 20.0


def films(
    solved: Solved, say: Say, wanted: Wanted, progress: Callable[[str, float], None]
) -> Iterator[tuple[str, bytes]]:
    """Name and bytes of every wanted film; without PyAV each is a GIF.

    raises: MissingPackage without matplotlib, or without a font for the language
    """
    if not wanted.films:
        return
    from app.files import film

    span = solved.request.span
    inwards = say("Bench dragon, to first contact", "板凳龙：盘入至首次碰撞")
    if solved.contact.time is None:
        inwards = say("Bench dragon, to the end of the run", "板凳龙：盘入至终点")
    pair = solved.contact.benches if solved.contact.time is not None else None
    kinds = [(FILMS[0], solved.spiral, 0.0, solved.met_at, inwards, pair)]
    if solved.turned:
        kinds.append((FILMS[1], solved.turned.dance, -span, span, say("Bench dragon, the turn", "板凳龙：调头"), None))
    forms = list(ENDINGS) if wanted.gif else list(ENDINGS)[:1]
    for name, dance, start, stop, title, touching in kinds:
        for form in forms:
            spec = FilmSpec(start, stop, wanted.seconds, *LOOKS[form], say.language, touching=touching)
            file = name + ENDINGS[form]
            yield (
                file,
                film.film(dance, spec, form, title=title, budget=solved.budget, progress=partial(progress, file)),
            )
