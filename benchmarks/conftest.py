"""The benchmarks use the same service as the tests."""

from tests.conftest import server

__all__ = ["server"]
