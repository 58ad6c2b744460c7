"""Cue cards as CSV: a line for the stand of each bench, and one for each of its cues."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence

from app.cards.words import CardWords
from app.wire.texts import text_to_cell
from core.people.cards import Card, Cue

COLUMNS = (
    "bench", "name", "number", "kind", "time", "clock", "since", "until", "x", "y", "other", "other_name", "side",
    "gap", "oncoming", "speed", "mark", "past_mark", "steps", "words",
)  # fmt: skip
COUNT = "count"
# Columns before and after them for several dragons.
DRAGON_COLUMNS, OTHER_DRAGON = ("dragon", "dragon_name"), "other_dragon"


def cards_csv(decks: Sequence[tuple[Sequence[Card], CardWords]]) -> bytes:
    """CSV with the columns of COLUMNS, of several dragons with DRAGON_COLUMNS before and OTHER_DRAGON after them; with
    music also COUNT. An entry is empty where it does not apply.

    decks: the cards of each dragon, and what their words follow from
    """
    are_several, with_music = decks[0][1].dragon is not None, any(words.clock.music for _, words in decks)
    columns = [*DRAGON_COLUMNS, *COLUMNS, OTHER_DRAGON] if are_several else [*COLUMNS]
    columns += [COUNT] * with_music
    sink = io.StringIO(newline="")
    writer = csv.DictWriter(sink, columns, extrasaction="ignore", lineterminator="\n")
    writer.writeheader()
    for cards, words in decks:
        for line in (line for card in cards for line in _lines(card, words)):
            writer.writerow({name: _cell(value) for name, value in line.items()})
    return sink.getvalue().encode()


def _cell(value: object) -> str:
    """An entry; numbers have all digits, and text runs in no spreadsheet."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return text_to_cell(value) if isinstance(value, str) else repr(value)


def _lines(card: Card, words: CardWords) -> Iterator[dict[str, object]]:
    bench, stand = card.bench, card.bench.start
    own: dict[str, object] = {"bench": bench.bench, "name": words.names[bench.bench] if words.names else ""}
    if words.dragon is not None:
        own |= dict(zip(DRAGON_COLUMNS, (words.dragon, words.dragons[words.dragon][0]), strict=True))
    mark, past = words.chalk.nearest(stand.s)
    place = {"mark": mark, "past_mark": past, "steps": words.chalk.steps(past)}
    at = {"time": stand.time, "x": stand.x, "y": stand.y, "clock": words.clock.of_day(stand.time) or ""}
    yield own | {"number": 0, "kind": "stand", "words": words.at_mark(stand)} | at | place
    for number, cue in enumerate(card.cues, start=1):
        at = {"time": cue.time, "x": cue.x, "y": cue.y, "since": cue.since, "until": cue.until}
        at["clock"] = words.clock.of_day(cue.time) or ""
        about = {"number": number, "kind": cue.kind.value, "words": words.sentence(card, cue)}
        about[COUNT] = words.clock.count(cue.time)
        yield own | about | at | _more(card, cue, words)


def _more(card: Card, cue: Cue, words: CardWords) -> dict[str, object]:
    """What only some kinds of cues have."""
    if met := cue.nearest:
        return {
            "other": met.bench, "other_name": words.met_name(met), "side": met.side.value, "gap": met.gap,
            "oncoming": met.oncoming, OTHER_DRAGON: met.dragon,
        }  # fmt: skip
    return {"speed": card.bench.fastest.speed} if cue.kind == "fastest" else {}
