"""Words for a corner or an edge of a bench."""

from __future__ import annotations

from typing import Protocol

from core.language import Phrases, say

FEATURES: Phrases = {
    "front": "front edge of bench {bench}",
    "rear": "rear edge of bench {bench}",
    "inner": "inner edge of bench {bench}",
    "outer": "outer edge of bench {bench}",
    "front-outer": "front-outer corner of bench {bench}",
    "front-inner": "front-inner corner of bench {bench}",
    "rear-outer": "rear-outer corner of bench {bench}",
    "rear-inner": "rear-inner corner of bench {bench}",
}


class BenchFeature(Protocol):
    """A corner or an edge of a bench, by its name."""

    @property
    def bench(self) -> int: ...
    @property
    def name(self) -> str: ...


def feature_words(feature: BenchFeature) -> str:
    return say(FEATURES[feature.name], bench=feature.bench)
