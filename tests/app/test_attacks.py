"""Each attack, and what another client sees meanwhile."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.app.attacks import ATTACKS, watching
from tests.app.serving import serving

# How long an attack goes on, and the longest that another client may wait, 0.1 s on an idle machine [s].
SECONDS, SLOWEST = 2.0, 1.0


@pytest.fixture(scope="module")
def attacked(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """A service of its own: what an attack leaves running ends with it."""
    with serving(tmp_path_factory.mktemp("attacked") / "server.log", grace_seconds=1) as service:
        yield service.url


@pytest.mark.parametrize("name", sorted(ATTACKS))
def test_another_client_is_answered_meanwhile(attacked: str, name: str) -> None:
    with watching(attacked) as watch:
        ATTACKS[name](attacked, SECONDS)
    assert watch.failures == []
    assert max(watch.slowest.values()) < SLOWEST, watch.slowest
