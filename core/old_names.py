"""Names of questions about several dances until 0.2: each is now that of the question about one dance."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any
from warnings import warn

NEW = {
    "performance_check": "check",
    "performance_clearance": "clearance_profile",
    "performance_cues": "bench_cues",
    "performance_envelope": "envelope",
    "performance_least_clearance": "least_clearance",
    "performance_tolerance": "tolerance",
    "performance_trajectory": "trajectory",
}


def question_of(name: str, question: Callable[[str], Any]) -> Callable[..., Any]:
    """The question of an old name, which takes the arguments of old; warns of the new name.

    question: the question of a name
    """
    new = NEW[name]
    warn(f"{name}() is {new}(), which takes a Performance too", DeprecationWarning, stacklevel=3)

    def asked(performance: Any, *args: Any, details: bool = True, **query: Any) -> Any:
        if new == "bench_cues" and args:
            query["dragon"], *args = args  # type: ignore[assignment]
        return question(new if details else "quick_check")(performance, *args, **query)

    return asked
