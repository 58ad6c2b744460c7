"""The store of jobs."""

from contextlib import closing

import pytest

from app.jobs.store import Store


@pytest.fixture
def store(tmp_path):
    with closing(Store(tmp_path / "data")) as store:
        yield store
