"""Films of several dragons: as those of one (film.py), with each dragon in its own colour and its name beside."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.files.film import BATCH, FilmPicture, encoded, tones_of
from app.files.film_planes import COLOURS, Tone
from app.files.film_spec import FilmSpec
from app.files.looks import colour_of
from app.files.performances import LEGEND_MOST
from core import Budget, Dragon, Performance, bench_outlines, trajectory
from core.language import say
from core.plots import draw_dance
from core.questions import question_about
from core.values import Floats

# Place of the first name and distance from one name to the next, as shares of the height of the picture.
NAME_AT, NAME_STEP = 0.97, 0.045


@question_about("performance", Performance, "the film was not drawn")
def performance_film(
    performance: Performance,
    spec: FilmSpec,
    form: str,
    *,
    title: str = "",
    budget: Budget | None = None,
    progress: Callable[[float], None] = lambda share: None,
) -> bytes:
    """The bytes of a film of several dragons in one of FORMS, in their venue.

    progress: called with the share of finished frames
    raises: TooMuchWork where the budget is stopped; MissingPackage without a font for the language
    """
    stage = PerformancePicture(performance, spec, title, tones_of(form), budget := budget or Budget())
    return encoded(_frames(stage, spec, budget), spec, form, progress)


def _frames(stage: PerformancePicture, spec: FilmSpec, budget: Budget) -> Iterator[NDArray[np.uint8]]:
    """Pictures as PerformancePicture.picture() gives them, each valid until the next one."""
    times, performance = spec.times, stage.performance
    dragons = [part.dance.dragon for part in performance.parts]
    for first in range(0, times.size, BATCH):
        some = times[first : first + BATCH]
        results = trajectory(performance, some, budget=budget)
        outlines = [bench_outlines(dragon, one.position) for dragon, one in zip(dragons, results, strict=True)]
        for k, time in enumerate(some.tolist()):
            budget.look()
            touching = spec.touching if first + k == times.size - 1 else None
            yield stage.picture(time, [own[k] for own in outlines], spec.dragons, touching)


class PerformancePicture(FilmPicture):
    """A picture of several dragons that is drawn again for each frame."""

    def __init__(
        self,
        performance: Performance,
        spec: FilmSpec,
        title: str,
        tones: tuple[Tone, ...] = COLOURS,
        budget: Budget | None = None,
    ) -> None:
        self.performance = performance
        self.prepare(spec, performance.venue, title, tones, budget)

    def name_of(self, dragon: int) -> str:
        """Name of a dragon, or its number in words."""
        return self.performance.parts[dragon].name or say("dragon {k}", k=dragon)

    def draw_paths(self, times: Floats) -> Floats:
        places = []
        for part, result in zip(self.performance.parts, trajectory(self.performance, times), strict=True):
            places.append(result.position.reshape(-1, 2))
            draw_dance(self.axes, part.dance.path, places[-1], np.empty((0, 4, 2)))
        look: dict[str, Any] = {"transform": self.axes.transAxes, "zorder": 9, "parse_math": False, "va": "top"}
        for k in range(min(len(places), LEGEND_MOST)):
            self.axes.text(
                0.015, NAME_AT - NAME_STEP * k, self.name_of(k), color=colour_of(self.performance, k), **look
            )
        return np.concatenate(places)

    @property
    def dragons(self) -> list[Dragon]:
        return [part.dance.dragon for part in self.performance.parts]

    def colours(self, dragon: int) -> tuple[str, str, str, str]:
        own = colour_of(self.performance, dragon)
        return own, own, own, "black"

    def picture(
        self,
        time: float,
        outlines: list[Floats],
        dragons: tuple[int, int] | None = None,
        touching: tuple[int, int] | None = None,
    ) -> NDArray[np.uint8]:
        """The picture, as Paper.picture, at one instant.

        outlines: (n, 4, 2) of each dragon [m]; dragons, touching: the dragons and the benches that are marked and named
        """
        if touching is None or dragons is None:
            return self.compose(time, outlines)
        pairs = list(zip(dragons, touching, strict=True))
        dragon, second = map(self.name_of, dragons)
        first = say(
            "bench {bench} of {dragon} and bench {other} of {second} touch\n",
            bench=touching[0],
            dragon=dragon,
            other=touching[1],
            second=second,
        )
        return self.compose(time, outlines, pairs, first)
