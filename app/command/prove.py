"""The command bench-dragon prove: make a certificate for a claim, or check one.

The exit code is 0 for a proof, 1 when a claim or a certificate is refused, 2 for wrong usage, and 130 when
interrupted. A certificate is checked before it is written, and its file is written completely or not at all.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import orjson
import typer
from pydantic import Field
from rich.console import Console
from rich.progress import Progress as Bar

import core
from app.command.options import asks
from app.command.usage import Commands, path_argument
from app.files.disk import checked_output, write_whole
from app.maps.dances import read_dance
from app.questions.check import DanceCheck
from app.questions.tolerance import CircleQuery
from app.settings import Settings
from app.wire.fields import DanceQuery, HeadSpeed, Instant, Margin, UniformDragon, Wire, measure
from app.wire.messages import checked
from app.wire.paths import Circle, TurnFields
from app.wire.texts import Unreadable, json_of
from core import Outcome
from core.errors import ProofRefused
from core.language import Phrases, say
from core.quantities import Quantity, format_number
from core.tolerance.curve import time_on_circle
from core.values import Progress

if TYPE_CHECKING:
    from core.proof import Proof

# Exit codes.
REFUSED, WRONG_USAGE, INTERRUPTED = 1, 2, 130
# Parts of a dance that no proof is about.
UNPROVEN: Phrases = {"venue": "venue", "speed_limit": "speed limit"}
Output = Annotated[Path, typer.Option(help="File for the certificate.")]


class _Thorough(Wire):
    every_pair: bool = Field(
        False, description="Prove every pair separately, also those that repeat because benches are equal"
    )


class CollisionProofRequest(_Thorough, DanceQuery):
    """First time two benches touch or come within the margin."""

    time: float | None = measure("s", "Time to prove; default: the answer of collision-time", None, ge=0)
    margin: Margin = 0.0


class PitchProofRequest(_Thorough, Circle, UniformDragon):
    """Smallest pitch of the spiral."""

    pitch: float | None = measure("m", "Pitch to prove; default: the answer of minimum-pitch", None, ge=1e-3, le=10)


class ClearRequest(_Thorough, DanceQuery):
    """A run on the spiral without a contact."""

    start: Instant = measure("s", "Start time", 0.0)
    stop: Instant | None = measure("s", "End time; default: the end of the run, which is proven too", None)
    margin: Margin = 0.0


class TurnProofRequest(_Thorough, HeadSpeed, TurnFields, UniformDragon):
    """A dance through the turn."""

    start: Instant = measure("s", "Start time; 0 is the entry into the turn", -100.0)
    stop: Instant = measure("s", "End time", 100.0)
    margin: Margin = 0.0


class StrayProofRequest(_Thorough, CircleQuery):
    """Largest stray with which nothing touches until the head is on the circle."""

    stray: float | None = measure(
        "m", "Stray to prove safe; default: the answer of tolerance, and its pose in which two benches touch", None,
        gt=0,
    )  # fmt: skip


@contextmanager
def _working(what: str) -> Iterator[Progress]:
    """A progress bar on standard error; yields a function of the share done. A refusal or Ctrl-C ends the command."""
    bar = Bar(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty())
    try:
        with bar:
            task = bar.add_task(what, total=1.0)
            yield lambda share: bar.update(task, completed=share)
    except KeyboardInterrupt:
        code, message = INTERRUPTED, say("Interrupted: nothing was written.")
    except ProofRefused as refused:
        code, message = REFUSED, say("Refused: {why}", why=refused.message)
    except ImportError as missing:
        code, message = WRONG_USAGE, say("Error: {message}", message=missing)
    else:
        return
    print(message, file=sys.stderr)
    raise typer.Exit(code)


def _terms(request: CollisionProofRequest | PitchProofRequest | ClearRequest, progress: Progress) -> dict[str, Any]:
    """Keyword arguments that these proofs share."""
    return {"margin": request.margin, "every_pair": request.every_pair, "progress": progress}


prove = typer.Typer(cls=Commands, add_completion=False)


@prove.callback(invoke_without_command=True)
def check_or_prove(
    context: typer.Context,
    check: Annotated[
        Path | None, typer.Option(help="Verify this certificate without a search; - reads standard input.")
    ] = None,
    dance: Annotated[
        Path | None, typer.Option(help="The certificate to check must be about the dance of this file.")
    ] = None,
) -> None:
    """Prove a contact, a clear run, a pitch or a stray in ball arithmetic, or check a proof (extra proof)."""
    if (check is None) == (context.invoked_subcommand is None):
        raise typer.BadParameter(say("give either a claim to prove or --check FILE"))
    if check is None:
        if dance is not None:
            raise typer.BadParameter(say("give --dance FILE with --check FILE"))
        return
    data = sys.stdin.buffer.read() if str(check) == "-" else check.read_bytes()
    try:
        certificate = json_of(data)
    except Unreadable as error:
        raise error.of("check", str(check)) from error
    _print(_checked(certificate, None if dance is None else _read(dance)[1]))


@prove.command()
@asks(CollisionProofRequest)
def collision_time(request: CollisionProofRequest, output: Output = Path("collision-time.proof.json")) -> None:
    """Prove that nothing touches until 1e-10 s before a time, and that two benches overlap 1e-10 s after it.

    With a margin: no two benches come within it before, and two are within it after.
    """
    checked_output("output", output, (".json",))
    dance, time = request.to_dance(Settings().benches_max), request.time
    with _working("proof") as progress:
        from core.proof import prove_collision_time

        if time is None:
            time = core.first_contact(dance, margin=request.margin).time
        if time is None:
            words, margin = "nothing touches, so there is no collision time to prove", Quantity(request.margin, "m")
            if request.margin:
                words = "no two benches come nearer than {margin}, so there is no collision time to prove"
            raise ProofRefused.in_words("time", words, reason="prove clear", margin=margin)
        certificate = prove_collision_time(dance, time, **_terms(request, progress))
    _finish(certificate, output)


@prove.command()
@asks(PitchProofRequest)
def minimum_pitch(request: PitchProofRequest, output: Output = Path("minimum-pitch.proof.json")) -> None:
    """Prove that nothing touches on the way to the circle, and that at a pitch 1e-6 m smaller two benches overlap or
    one folds.

    With a margin: no two benches come within it, and at the smaller pitch two do. Larger pitches are not part of the
    proof.
    """
    checked_output("output", output, (".json",))
    dragon, radius, pitch = request.to_dragon(Settings().benches_max), request.turning_diameter / 2, request.pitch
    with _working("proof") as progress:
        from core.proof import prove_minimum_pitch

        if pitch is None:
            pitch = core.minimum_pitch(dragon, **request.to_circle()).pitch_bracket[1]
            if Fraction(pitch) * Fraction(request.start_turns) < Fraction(radius):  # start within the circle
                pitch = math.nextafter(pitch, math.inf)
        certificate = prove_minimum_pitch(
            dragon, pitch, turning_radius=radius, start_turns=request.start_turns, **_terms(request, progress)
        )
    _finish(certificate, output)


@prove.command()
@asks(ClearRequest)
def clear(request: ClearRequest, output: Output = Path("clear.proof.json")) -> None:
    """Prove that nothing touches, or comes within the margin, on the spiral until a time or the end of the run."""
    checked_output("output", output, (".json",))
    dance = request.to_dance(Settings().benches_max)
    with _working("proof") as progress:
        from core.proof import prove_clear

        certificate = prove_clear(dance, request.stop, start=request.start, **_terms(request, progress))
    _finish(certificate, output)


@prove.command()
@asks(StrayProofRequest)
def tolerance(request: StrayProofRequest, output: Output = Path("tolerance.proof.json")) -> None:
    """Prove a tolerance: with strays up to it nothing touches until the head is on the circle.

    Without --stray a second proof is added: a pose of the whole dragon in which two benches overlap, with strays that
    are a little larger. The proof lets benches next but one to each other stray independently. The command tolerance
    also uses the bench between them, which holds them apart, so its answer is larger on straight paths and wide
    spirals.
    """
    checked_output("output", output, (".json",))
    dance = request.to_dance(Settings().benches_max)
    stop = time_on_circle(dance, request.turning_diameter / 2)
    with _working("proof") as progress:
        from core.proof import prove_tolerance

        stray, exhibit = request.stray, None
        if stray is None:
            result = core.tolerance(dance, stop=stop)
            stray, exhibit = result.independent, result.exhibit  # the proof does not use the bench between
            if stray == 0.0:
                raise ProofRefused.in_words("stray", "no stray is known to be safe until the head is on the circle")
        certificate = prove_tolerance(
            dance, stray, exhibit=exhibit, stop=stop, every_pair=request.every_pair, progress=progress
        )
    _finish(certificate, output)


@prove.command()
@asks(TurnProofRequest)
def turn(request: TurnProofRequest, output: Output = Path("turn.proof.json")) -> None:
    """Prove that a dance on the contest's turn is clear from start to stop, or prove its first contact."""
    checked_output("output", output, (".json",))
    dance = core.Dance(request.to_dragon(Settings().benches_max), request.to_turn(), request.head_speed)
    times = {"start": request.start, "stop": request.stop, "margin": request.margin}
    _finish(_dance_proven(dance, times, request.every_pair), output)


@prove.command()
def dance(
    file: Annotated[
        Path,
        path_argument("FILE", "Dragon, path, margin and times as for check, as a .toml or .json file."),
    ],
    every_pair: Annotated[bool, typer.Option(help="Prove every pair separately, also those that repeat.")] = False,
    output: Output = Path("dance.proof.json"),
) -> None:
    """Prove that a dance, on any path but waypoints, is clear from start to stop or end, or prove its first contact."""
    checked_output("output", output, (".json",))
    request, whole = _read(file)
    for name in UNPROVEN:
        if getattr(request, name) is not None:
            print(say("The {part} is not part of the proof.", part=say(UNPROVEN[name])), file=sys.stderr)
    if whole.passages:
        words = say(
            "Passages are not part of the proof, which is about places: its times are for a head at a constant {speed} "
            "m/s.",
            speed=format_number(whole.head_speed),
        )
        print(words, file=sys.stderr)
    begin, until = whole.whole_span(request.start, request.stop)
    dance, clock = whole.steady, whole.clock
    start, stop = clock.steady(np.array([begin, until])).tolist()
    times = {"start": start, "stop": None if request.stop is None else stop, "margin": request.margin}
    _finish(_dance_proven(dance, times, every_pair), output)


def _read(file: Path) -> tuple[DanceCheck, core.Dance]:
    """The question of a file of check, and its dance."""
    request = checked(DanceCheck, read_dance(file))
    return request, request.to_dance(Settings().checked_benches_max)


def _dance_proven(dance: core.Dance, times: dict[str, Any], every_pair: bool) -> dict[str, Any]:
    """A certificate that a dance is clear, or for its first contact."""
    with _working("proof") as progress:
        from core.proof import prove_clear, prove_contact

        contact = core.first_contact(dance, **times)
        stop, margin = times.pop("stop"), Quantity(times["margin"], "m")
        terms: dict[str, Any] = {"every_pair": every_pair, "progress": progress}
        if contact.outcome is Outcome.CLEAR:
            return prove_clear(dance, stop, **times, **terms)
        if contact.outcome is Outcome.CONTACT and contact.time is not None:
            return prove_contact(dance, contact.time, **times, **terms)
        if contact.benches is None:
            words = "the search did not decide whether two benches touch"
            if margin.value:
                words = "the search did not decide whether two benches come nearer than {margin}"
            raise ProofRefused.in_words("time", words, margin=margin)
        words, (a, b) = "benches {a} and {b} overlap already at the start, {start}", contact.benches
        if margin.value:
            words = "benches {a} and {b} are nearer than {margin} already at the start, {start}"
        at_start = Quantity(times["start"], "s")
        raise ProofRefused.in_words("start", words, a=a, b=b, margin=margin, start=at_start)


def _checked(certificate: Any, dance: core.Dance | None = None) -> Proof:
    with _working("check") as progress:
        from core.proof import verify

        return verify(certificate, dance=None if dance is None else dance.steady, progress=progress)


def _finish(certificate: dict[str, Any], output: Path) -> None:
    """Check a new certificate as any reader would, write it, and print what it proves."""
    data = orjson.dumps(certificate, option=orjson.OPT_APPEND_NEWLINE)
    checked = _checked(orjson.loads(data))
    with _working("writing"):
        write_whole(output, data)
    _print(checked)
    print(say("{file}: {count} bytes", file=output, count=len(data)), file=sys.stderr)


def _print(checked: Proof) -> None:
    print(say("Proven: {statement}", statement=checked.statement))
    print(say("{checked.pair_proofs} pair proofs over {checked.stretches} stretches.", checked=checked))
