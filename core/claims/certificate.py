"""Base of certificates, which carry a claim as data and put it in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from core.claims import chinese, english
from core.claims.claim import Claim
from core.display import Readable
from core.errors import Given, InvalidValue

SENTENCES = {"en": english.SENTENCES, "zh": chinese.SENTENCES}


class WithClaim(Readable):
    """Base of certificates that carry a claim."""

    __slots__ = ()

    if TYPE_CHECKING:

        @property
        def claim(self) -> Claim: ...

    @property
    def method(self) -> str:
        """The claim and its proof, in sentences."""
        return self.in_words()

    def in_words(self, language: str = "en") -> str:
        """The claim and its proof in sentences, in English (en) or Chinese (zh). raises: InvalidValue"""
        return claim_words(self.claim, language)

    def _values(self) -> list[tuple[str, object, str]]:
        """The fields to show, the sentences in place of the claim."""
        return [("method", self.method, "") if one[0] == "claim" else one for one in Readable._values(self)]


def claim_words(claim: Claim, language: str = "en") -> str:
    """A claim and its proof in sentences, in English (en) or Chinese (zh). raises: InvalidValue

    >>> from core.claims.claim import ClaimKind, GroundClaim
    >>> claim_words(GroundClaim(ClaimKind.SWEPT_GROUND, 0.0, 9.5, 1e-3, 2, 30.0, 88), "zh")[:25]
    '0 s 至 9.5 s，没有板凳越出这些多边形，其'
    """
    if language not in SENTENCES:
        raise InvalidValue("language", "must be en or zh", got=Given(language))
    return SENTENCES[language][type(claim)](claim)
