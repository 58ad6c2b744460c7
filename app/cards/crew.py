"""A crew in words and as CSV: who carries which bench from when to when."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from app.cards.words import CardWords
from app.wire.texts import text_to_cell
from core.language import joined, say
from core.people.crew import Crew, Spell
from core.values import Point

COLUMNS = (
    "person", "label", "bench", "name", "begin", "begin_clock", "end", "end_clock", "time", "way", "relieves", "x", "y",
    "mark", "past_mark", "steps",
)  # fmt: skip


@dataclass(frozen=True)
class CrewWords:
    """A crew and what its words follow from. places: of the front handle at the begin of each spell, x, y [m]"""

    crew: Crew
    words: CardWords
    places: tuple[Point, ...]

    @cached_property
    def labels(self) -> list[str]:
        """Short names of all people: 17.2 is the second of bench 17 at the start, S3 the third spare."""
        own = [f"{bench}.{k}" for bench, count in enumerate(self.crew.needed) for k in range(1, count + 1)]
        return own + [say("S{k}", k=k) for k in range(1, self.crew.spares + 1)]

    @property
    def longest(self) -> float:
        """The longest time that somebody carries without a break [s]."""
        return max(one.end - one.begin for one in self.crew.spells)

    @property
    def changes(self) -> list[Spell]:
        """The spells that begin with a change, in order of time."""
        return [one for one in self.crew.spells if one.relieved is not None]

    @property
    def sentences(self) -> list[str]:
        """How many people there are, how long anybody carries, and whether the spares are too few for all changes."""
        crew, (minutes, seconds) = self.crew, divmod(int(self.longest), 60)
        summary = say(
            "{people} people, {spares} of them spare; {changes} changes; nobody carries longer than {longest} without "
            "a break.",
            people=crew.people, spares=crew.spares, changes=len(self.changes), longest=f"{minutes}:{seconds:02d}",
        )  # fmt: skip
        if crew.is_kept:
            return [summary]
        few = say(
            "Too few spares: not everybody can go out at every change. {enough} spares are enough.", enough=crew.enough
        )
        never, benches = len(crew.unrelieved), len(crew.needed)
        unchanged = say("{count} of {benches} benches never change.", count=never, benches=benches) if never else ""
        return [summary, joined([few, unchanged])]


def crew_csv(crew: CrewWords) -> bytes:
    """CSV with the columns of COLUMNS, a line for each spell; an entry is empty where it does not apply."""
    sink = io.StringIO(newline="")
    writer = csv.DictWriter(sink, COLUMNS, lineterminator="\n")
    writer.writeheader()
    writer.writerows(_lines(crew))
    return sink.getvalue().encode()


def _lines(crew: CrewWords) -> Iterator[dict[str, object]]:
    names, chalk, clock = crew.words.names, crew.words.chalk, crew.words.clock.of_day
    for one, (x, y) in zip(crew.crew.spells, crew.places, strict=True):
        mark, past = chalk.nearest(one.s)
        yield {
            "person": one.person, "label": crew.labels[one.person], "bench": one.bench,
            "name": text_to_cell(names[one.bench]) if names else "",
            "begin": one.begin, "begin_clock": clock(one.begin), "end": one.end, "end_clock": clock(one.end),
            "time": one.end - one.begin, "way": one.way,
            "relieves": "" if one.relieved is None else crew.labels[one.relieved],
            "x": x, "y": y, "mark": mark, "past_mark": past, "steps": chalk.steps(past),
        }  # fmt: skip
