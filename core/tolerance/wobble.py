"""The model of people who wobble, for contact_probability() (core/tolerance/chance.py)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from core.checks import SIZE_MAX, checked_number
from core.dance import Dance
from core.display import Readable
from core.dragon import wider_pin
from core.errors import InvalidValue
from core.quantities import Parameter, Quantity, quantities

# Least number of instants in a correlation time [1].
INSTANTS_PER_TIME = 5
# Longest correlation, in seconds and in benches [1].
CORRELATION_MAX = 1e9
# Largest displacement and play relative to the shortest chord, and largest pitch error relative to the pitch [1]: so
# nobody ever wants to stand on the far side of the next person, and no pitch is ever negative.
SIZE_PART, PITCH_PART = 0.1, 0.1


@dataclass(frozen=True, slots=True)
class Wobble(Readable):
    """Model of wobbling people. At two steps a second, a correlation time of 5 s is ten steps.

    lateral: displacement that a person wants across the path: a normal number with this standard deviation, so that one
        step in twenty is further than twice of it; where the chain bends, it moves people along the path too [m]
    forward: the same along the path; chords are rigid, so only that of the first person counts [m]
    correlation_time: time after which 1 / e of a person's displacement is left, and the rest is new [s]
    correlation_benches: number of benches over which two people share 1 / e of their displacement; people who carry the
        same bench share exp(-1 / correlation_benches) of it
    hole: diameter of the holes in the benches; the place of a pin in each of its two holes is drawn once for a dance,
        uniformly over the hole [m]
    pin: diameter of the pins in these holes [m]
    pitch_error: standard deviation of the pitch of the painted spiral, drawn once for a dance; the head keeps the
        distance from the centre, at every instant, that it has without an error [m]
    step: time between two instants, at most 1 / INSTANTS_PER_TIME of the correlation time; None stands for this
        maximum. The path of a person is as rough as a random walk, so closer instants show more contacts [s]

    >>> Wobble(lateral=0.02, correlation_time=5.0).lateral
    0.02
    """

    lateral: float = 0.01
    forward: float = 0.01
    correlation_time: float = 5.0
    correlation_benches: float = 2.0
    hole: float = 0.0
    pin: float = 0.0
    pitch_error: float = 0.0
    step: float | None = None

    def __post_init__(self) -> None:
        for name in ("lateral", "forward", "hole", "pin", "pitch_error"):
            object.__setattr__(self, name, checked_number(f"model.{name}", getattr(self, name), "m", 0.0, SIZE_MAX))
        for name, unit in (("correlation_time", "s"), ("correlation_benches", "")):
            value = checked_number(f"model.{name}", getattr(self, name), unit, 0.0, CORRELATION_MAX, open_low=True)
            object.__setattr__(self, name, value)
        if self.step is not None:
            step = checked_number("model.step", self.step, "s", 0.0, CORRELATION_MAX, open_low=True)
            object.__setattr__(self, "step", step)
            most = self.correlation_time / INSTANTS_PER_TIME
            if step > most and not math.isclose(step, most):
                rule, got = "must be at most {most}, 1 / {instants} of {time}", Quantity(step, "s")
                values = quantities("s", 9, most=most) | {"time": Parameter("model.correlation_time")}
                raise InvalidValue("model.step", rule, got=got, instants=INSTANTS_PER_TIME, **values)
        if self.pin > self.hole:
            raise wider_pin("model.pin", "model.hole", self)

    @property
    def play(self) -> float:
        """Largest distance of a hole from its pin [m]."""
        return 0.5 * (self.hole - self.pin)

    @property
    def along(self) -> float:
        """Correlation of two people who carry the same bench [1]."""
        return math.exp(-1.0 / self.correlation_benches)


def check_sizes(dance: Dance, model: Wobble) -> None:
    """raises: InvalidValue for a model whose sizes do not fit a dance"""
    bench = int(dance.dragon.chords.argmin())
    most = SIZE_PART * float(dance.dragon.chords[bench])
    values = quantities("m", 9, most=most) | {"part": SIZE_PART, "bench": bench}
    for name, size in (("lateral", model.lateral), ("forward", model.forward)):
        if size > most:
            rule = "must be at most {part} of the chord of bench {bench} ({most})"
            raise InvalidValue(f"model.{name}", rule, got=Quantity(size, "m"), **values)
    if model.play > most:
        rule = "must leave a play of at most {part} of the chord of bench {bench} ({most}) around its {pin}"
        got = f"{Quantity(model.play, 'm', 9)} of play"
        raise InvalidValue("model.hole", rule, got=got, pin=Parameter("model.pin"), **values)
    if model.pitch_error > 0.0:
        spiral, rule = dance.path.spiral, "must be 0 on a path that is not a spiral"
        most = PITCH_PART * spiral.pitch if spiral else 0.0
        if model.pitch_error > most:
            rule = "must be at most {part} of the pitch ({most})" if spiral else rule
            values = quantities("m", got=model.pitch_error) | quantities("m", 9, most=most) | {"part": PITCH_PART}
            raise InvalidValue("model.pitch_error", rule, **values)
