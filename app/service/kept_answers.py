"""The latest answers in memory, because many people look at the same dance."""

from __future__ import annotations

import collections
from threading import Lock

from prometheus_client import CollectorRegistry, Counter

# Largest answer that is kept, relative to the room for all [1].
SHARE_MAX = 1 / 16


class KeptAnswers:
    """Answers by their tags. A tag depends on everything that determines the answer: request, form and build.

    bytes_max: room for all of them [bytes]; the answer that was asked for least recently goes first
    """

    def __init__(self, bytes_max: int, registry: CollectorRegistry) -> None:
        self.bytes_max = bytes_max
        self._repeated = Counter("bench_dragon_repeated", "Answers given from memory", registry=registry)
        self._kept: collections.OrderedDict[str, bytes] = collections.OrderedDict()
        self._used = 0
        self._lock = Lock()

    def get(self, tag: str) -> bytes | None:
        with self._lock:
            answer = self._kept.get(tag)
            if answer is not None:
                self._kept.move_to_end(tag)
                self._repeated.inc()
            return answer

    def keep(self, tag: str, answer: bytes) -> None:
        """Keep an answer, unless it is too large."""
        if len(answer) > SHARE_MAX * self.bytes_max:
            return
        with self._lock:
            if tag in self._kept:  # Two clients asked at the same time.
                return
            self._kept[tag] = answer
            self._used += len(answer)
            while self._used > self.bytes_max:
                self._used -= len(self._kept.popitem(last=False)[1])
