"""What questions about turns share: a circle in which nothing can be danced is refused by its name."""

from core import Dragon, dubins_turn
from tests.support.refused import refused


def test_a_circle_that_no_bench_can_follow_is_refused():
    """Other questions refuse it in tests/app/wire/test_refusals.py."""
    with refused("turning_radius"):
        dubins_turn(Dragon(), 1.7, 1.4)
