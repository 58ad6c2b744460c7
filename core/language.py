"""The language of sentences: English stands in the code, every other language in a catalogue of core/words.

A further language needs one file. An edge, such as a command or a request, says once which language is spoken.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from enum import StrEnum
from functools import cache, reduce
from importlib.resources import files
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gettext import NullTranslations

# The room of the catalogues, and their endings: as people write them, and compiled beside that.
ROOM = "core.words"
WRITTEN, COMPILED = ".po", ".mo"


def catalogues() -> dict[str, str]:
    """Codes of the languages that have a catalogue -> its name: zh -> zh_CN."""
    names = [file.name.removesuffix(WRITTEN) for file in files(ROOM).iterdir() if file.name.endswith(WRITTEN)]
    return {name.partition("_")[0]: name for name in sorted(names)}


class Language(StrEnum):
    """Language of sentences: English, or that of a catalogue."""

    _ignore_ = "code"
    ENGLISH = "en"
    CHINESE = "zh"
    for code in catalogues().keys() - {CHINESE}:
        vars()[code.upper()] = code


def named_language(name: str) -> Language | None:
    """The language of a locale or a tag, such as zh_CN.UTF-8 or en-GB; None if nothing is said in it."""
    code = name.lower().replace("-", "_").partition("_")[0]
    return Language(code) if code in list(Language) else None


# Templates that are said elsewhere, by their codes: so annotated they come into the catalogues.
Phrases = dict[str, str]

_SPOKEN = ContextVar("spoken", default=Language.ENGLISH)


def spoken() -> Language:
    """The language of the sentences that are composed now."""
    return _SPOKEN.get()


@contextmanager
def speaking(language: Language | str) -> Iterator[None]:
    """Context in which sentences are in a language; it holds for this thread, and for what is awaited.

    >>> with speaking("zh"):
    ...     say("bench {k}", k=3)
    '3 号板凳'
    """
    before = _SPOKEN.set(Language(language))
    try:
        yield
    finally:
        _SPOKEN.reset(before)


@cache
def _translations(language: Language) -> NullTranslations:
    """raises: FileNotFoundError for a catalogue that the build has not compiled"""
    from gettext import GNUTranslations, NullTranslations

    if language is Language.ENGLISH:
        return NullTranslations()
    with files(ROOM).joinpath(catalogues()[language] + COMPILED).open("rb") as file:
        return GNUTranslations(file)


def say(template: str, /, **values: Any) -> str:
    """A sentence, or a part of one, from its English template.

    values: of the words in {braces}; without any, the template itself comes back
    """
    language = _SPOKEN.get()
    text = template if language is Language.ENGLISH else _translations(language).gettext(template)
    return text.format(**values) if values else text


def phrase(template: str) -> str:
    """A template that is said elsewhere: so marked it comes into the catalogues."""
    return template


# What stands between the clauses of a refusal: what joins them, and the name that one begins with.
JOINTS = (
    phrase(": "),
    phrase(". "),
    phrase("; "),
    phrase(", when "),
    phrase(", got "),
    phrase(" {then}, with {count} benches"),
    phrase(" {then}, with {count} dragons"),
)
SUBJECT = r"(?:(?<=: )|^)(?:\{\w+\} |\+ )+(?=must |is )|^\{(?:field|text)\} "
JOINT = re.compile(rf"((?<!\")(?:{'|'.join(map(re.escape, JOINTS))})|{SUBJECT})")


def clauses(template: str) -> list[str]:
    """The clauses of a refusal, each of which stands in the catalogues.

    >>> clauses("{field} must be smaller: {why}; take fewer benches")
    ['must be smaller', '{why}', 'take fewer benches']
    """
    return list(filter(None, JOINT.split(template)[::2]))


def say_clauses(template: str) -> str:
    """A refusal from its English template, said clause by clause; its values stay to be filled in."""
    if _SPOKEN.get() is Language.ENGLISH:
        return template
    return "".join(map(say, filter(None, JOINT.split(template))))


def sense(meaning: str, template: str, /, **values: Any) -> str:
    """What say() gives, for a template that other languages put in several ways. meaning: the one that is meant"""
    text = _translations(_SPOKEN.get()).pgettext(meaning, template)
    return text.format(**values) if values else text


def counted(count: int, one: str, many: str, /, **values: Any) -> str:
    """What say() gives, with a {count}. one, many: templates for 1 and for other counts

    >>> counted(1, "{count} pause", "{count} pauses"), counted(2, "{count} pause", "{count} pauses")
    ('1 pause', '2 pauses')
    """
    return _translations(_SPOKEN.get()).ngettext(one, many, count).format(count=count, **values)


class Listed(tuple[object, ...]):
    """Parts of a list, which as text stand in a row as the language that is spoken writes it.

    >>> str(Listed([3, 4])), f"handles {Listed([3])}"
    ('3, 4', 'handles 3')
    """

    __slots__ = ()

    def __str__(self) -> str:
        return sense("list", ", ").join(map(str, self))


def joined(sentences: Iterable[str]) -> str:
    """Sentences in a row; empty ones are left out."""
    said = list(filter(None, sentences))
    return reduce(lambda first, second: say("{first} {second}", first=first, second=second), said) if said else ""
