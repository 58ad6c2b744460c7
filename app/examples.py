"""A request and its true answer for each call, shown in the documentation; a test asks the service for each."""

from __future__ import annotations

from typing import Any

THREE_BENCHES: dict[str, Any] = {
    "dragon": {"benches": 2},
    "path": {"kind": "spiral", "pitch": 0.55, "start_turns": 16},
    "head_speed": 1.0,
    "times": {"start": 0, "stop": 2, "step": 1},
    "decimals": 6,
}
CROSSED_BENCHES: dict[str, Any] = {
    "benches": [
        {"x": 0.0, "y": 0.0, "heading": 0.0, "length": 2.2, "width": 0.3},
        {"x": 1.0, "y": 0.5, "heading": 1.5707963267948966, "length": 2.2, "width": 0.3},
    ],
    "margin": 0.0,
    "chained": False,
}
# Call -> examples of its body, as OpenAPI names them.
BODIES: dict[str, Any] = {
    "/trajectory": {"default": {"summary": "The paper's dance, 300 s", "value": {}}, "short": {"value": THREE_BENCHES}},
    "/overlaps": {"crossed": {"summary": "Two crossed benches", "value": CROSSED_BENCHES}},
}
# Call -> an answer.
CALLS = ("/trajectory", "/collision-time", "/minimum-pitch", "/clearance", "/overlaps", "/paper")
ANSWERS: dict[str, Any] = {call: {} for call in CALLS}
