"""Words in the language asked for: each place gives both, and Say chooses."""

from __future__ import annotations

from dataclasses import dataclass

from app.files.tables import Language


@dataclass(frozen=True)
class Say:
    """The first or the second of two phrases, as the language is.

    >>> Say(Language.ENGLISH)("head", "龙头")
    'head'
    """

    language: Language

    def __call__(self, english: str, chinese: str) -> str:
        return chinese if self.language is Language.CHINESE else english
