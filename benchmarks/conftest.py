"""The service under test is the one that the tests use."""

from tests.conftest import server

__all__ = ["server"]
