"""The locked versions can be installed on every machine that README names, without a compiler."""

from __future__ import annotations

import pytest

from tests.conftest import OUTER
from tests.support.lock import PROCESSORS, PYTHONS, ROOT, resolved

pytestmark = [pytest.mark.uncompiled, pytest.mark.index]

# What make serve and make test install; of the engines some machines lack some.
LOCKS = ("requirements.lock", "requirements-test.lock")


@pytest.mark.parametrize("processor", PROCESSORS)
@pytest.mark.parametrize("python", PYTHONS)
def test_there_is_a_wheel_of_every_locked_version(python: str, processor: str) -> None:
    done = resolved([word for name in LOCKS for word in ("-r", str(ROOT / name))], python, processor, OUTER)
    assert done.returncode == 0, done.stderr


def test_a_version_without_a_wheel_is_noticed() -> None:
    done = resolved(["-r", str(ROOT / "requirements-ccd.lock")], "3.14", "aarch64", OUTER)
    assert done.returncode != 0
    assert "no wheels" in done.stderr
