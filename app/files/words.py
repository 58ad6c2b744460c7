"""Texts in two languages: each caller gives both, and Say chooses one."""

from __future__ import annotations

from dataclasses import dataclass

from app.files.tables import Language


@dataclass(frozen=True)
class Say:
    """The English or the Chinese one of two phrases.

    >>> Say(Language.ENGLISH)("head", "龙头")
    'head'
    """

    language: Language

    def __call__(self, english: str, chinese: str) -> str:
        return chinese if self.language is Language.CHINESE else english
