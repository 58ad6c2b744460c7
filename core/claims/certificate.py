"""Certificate: the base of all evidence that carries a claim, and the sentences of a claim."""

from __future__ import annotations

from typing import Literal

from core.claims import chinese, english
from core.claims.claim import Claim
from core.shown import Readable


class Certificate(Readable):
    """Base of certificates that carry a claim; its sentences are made when they are asked for."""

    __slots__ = ()
    claim: Claim

    @property
    def method(self) -> str:
        """The claim and its proof, in sentences."""
        return claim_words(self.claim)

    def _told(self) -> list[tuple[str, object, str]]:
        """The fields to show, the sentences in place of the claim."""
        return [("method", self.method, "") if one[0] == "claim" else one for one in Readable._told(self)]


def claim_words(claim: Claim, language: Literal["en", "zh"] = "en") -> str:
    """A claim and its proof in sentences, in English or Chinese.

    >>> from core.claims.claim import ClaimKind, GroundClaim
    >>> claim_words(GroundClaim(ClaimKind.SWEPT_GROUND, 0.0, 9.5, 1e-3, 2, 30.0, 88), "zh")[:25]
    '0 s 至 9.5 s，没有板凳越出这些多边形'
    """
    words = chinese.WORDS if language == "zh" else english.WORDS
    return words[type(claim)](claim)
