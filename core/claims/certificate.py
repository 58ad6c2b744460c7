"""Base of certificates, which carry a claim as data and put it in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

from core.claims.claim import Claim
from core.display import Readable
from core.errors import InvalidValue
from core.language import Language, speaking
from core.quantities import Given
from core.words.claims import claim_words


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

    def in_words(self, language: str | None = None) -> str:
        """The claim and its proof in sentences. language: en, zh; else that of speaking(). raises: InvalidValue"""
        if language is None:
            return claim_words(self.claim)
        if language not in list(Language):
            raise InvalidValue("language", "must be {allowed}", got=Given(language), allowed=" or ".join(Language))
        with speaking(language):
            return claim_words(self.claim)

    def _values(self) -> list[tuple[str, object, str]]:
        """The fields to show, the sentences in place of the claim."""
        return [("method", self.method, "") if one[0] == "claim" else one for one in Readable._values(self)]
