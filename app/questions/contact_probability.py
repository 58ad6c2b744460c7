"""The question contact_probability: the probability of a contact when people wobble."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field

import core
from app.questions.tolerance import CircleQuery, SpanOrCircle, span_of
from app.wire.dances import DanceFields
from app.wire.fields import Answer, Whole, Wire, check_limit, measure
from app.wire.question import UNKNOWN_COST, Command, Question, Terms
from core.language import phrase, say
from core.tolerance.chance import CONFIDENCE, SEED_MAX
from core.values import Interval, Pair

# Quantiles of the times of first contact in the answer [1].
QUANTILES = (0.05, 0.5, 0.95)

Spread = Annotated[float, Field(ge=0, le=5)]
Diameter = Annotated[float, Field(ge=0, le=1)]
Correlation = Annotated[float, Field(gt=0, le=1e9)]


class Wobbling(Wire):
    """Model of wobbling people, and number of dances to draw."""

    lateral: Spread = measure("m", "Standard deviation of where a person wants to stand, across the path", 0.01)
    forward: Spread = measure("m", "Standard deviation along the path", 0.01)
    correlation_time: Correlation = measure(
        "s", "Time after which 1 / e of a person's displacement is left; at two steps a second 5 s are ten steps", 5.0
    )
    step: Correlation | None = measure(
        "s", "Time between two instants, at most a fifth of the correlation time; default: that fifth", None
    )
    correlation_benches: Correlation = Field(
        2.0, description="Number of benches between two people whose displacements have a correlation of 1 / e"
    )
    hole: Diameter = measure("m", "Diameter of the holes in the benches; with the pin it gives the play", 0.0)
    pin: Diameter = measure("m", "Diameter of the pins in these holes, each of which lies anywhere in its holes", 0.0)
    pitch_error: Spread = measure("m", "Standard deviation of the pitch of the painted spiral", 0.0)
    samples: Whole = Field(500, ge=1, description="Number of dances drawn at random")
    seed: Whole = Field(
        1, ge=0, le=SEED_MAX, description="Seed of the random numbers: the same seed gives the same dances"
    )

    def to_model(self) -> core.Wobble:
        """raises: InvalidValue"""
        return core.Wobble(**{name: getattr(self, name) for name in core.Wobble.__slots__})


class ContactProbabilityQuery(Wobbling, CircleQuery):
    """Probability of a contact on the way to a turning circle."""


class ContactProbabilityRequest(Wobbling, SpanOrCircle, DanceFields, strict=True):
    """Probability of a contact when people wobble, in any dance."""


class ContactProbability(Answer, of=core.ContactProbability):
    """Probability that two benches that share no handle touch at one of some instants.

    limits: limits of the probability of the model, after Clopper and Pearson
    confidence: probability that it lies between these limits
    time_quantiles: times up to which 5, 50 and 95 % of these contacts have come about; null without a contact [s]
    benches: the pair that is most often the first to touch; null without a contact
    tolerance: Proven: while no hole is further from its place, nothing touches at any time; 0: none is known to be
        safe; null with a pitch error [m]
    strayed: number of samples in which a hole is further from its place than that before anything touches, or when it
        does; null with a pitch error
    union_bound: proven without samples: the probability of the model is no larger at these instants; null with play or
        a pitch error
    method: the model and its evidence, in sentences
    claim: the claim as a kind and values
    """

    probability: float
    limits: Interval
    confidence: float
    contacts: int
    samples: int
    time_quantiles: tuple[float, float, float] | None
    benches: Pair | None
    tolerance: float | None
    strayed: int | None
    union_bound: float | None
    step: float
    instants: int
    start: float
    stop: float
    seed: int
    method: str
    claim: core.ProbabilityClaim


def contact_probability(
    request: ContactProbabilityQuery | ContactProbabilityRequest, terms: Terms
) -> ContactProbability:
    """Probability that two benches touch when people wobble, from dances drawn at random, with its limits."""
    settings = terms.settings
    check_limit(
        "samples", "samples must be at most {most} here", request.samples, settings.samples_max, "ask for fewer samples"
    )
    dance, model = request.to_dance(settings.checked_benches_max), request.to_model()
    start, stop = span_of(request, dance)
    result = core.contact_probability(
        dance,
        model,
        request.samples,
        request.seed,
        start=start,
        stop=stop,
        budget=terms.budget,
        progress=terms.progress,
    )
    quantiles = benches = None
    if result.contacts:
        quantiles = tuple(np.quantile(result.time, QUANTILES).tolist())
        pairs, counts = np.unique(result.benches, axis=0, return_counts=True)
        benches = tuple(pairs[counts.argmax()].tolist())
    return ContactProbability.from_result(result, confidence=CONFIDENCE, time_quantiles=quantiles, benches=benches)


# Time of one dance that is drawn, of the default dragon, measured 2026-11-26 [s].
SECONDS_PER_SAMPLE = 0.015


def _cost(request: ContactProbabilityRequest) -> float:
    return max(UNKNOWN_COST, SECONDS_PER_SAMPLE * request.samples)


QUESTION = Question(
    contact_probability,
    ContactProbability,
    body=ContactProbabilityRequest,
    cost=_cost,
    command=Command(
        "Probability of a contact when people wobble, from dances drawn at random.\n\n"
        "Without a FILE: on the way to the turning circle. With a FILE: in the whole dance.",
        lambda request: say("Probability of a contact when people wobble"),
        options=ContactProbabilityQuery,
        instead=phrase("--lateral and --forward describe how people wobble"),
    ),
)
