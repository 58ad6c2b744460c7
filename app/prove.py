"""The command bench-dragon prove: a certificate for a claim, and the check of one.

Exit code 0 for a proof, 1 when a claim or a certificate is refused, 2 for wrong usage, 130 when interrupted. A
certificate is checked before it is written, and its file is there whole or not at all.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import orjson
import typer
from pydantic import Field
from rich.console import Console
from rich.progress import Progress

import core
from app import schemas
from app.files import checked_output, write_whole
from app.settings import Settings
from app.wire import StartTurns, TurningDiameter, Wire
from core import InvalidValue
from core.errors import ProofRefused

if TYPE_CHECKING:
    from core.proof import Proof

# Exit codes.
REFUSED = 1
WRONG_USAGE = 2
INTERRUPTED = 130


class _Thorough(Wire):
    every_pair: bool = Field(
        False, description="Prove each pair in its own right, also those that equal benches repeat"
    )


class CollisionClaim(_Thorough, schemas.DanceQuery):
    """When two benches first touch."""

    time: float | None = Field(None, ge=0, description="The claim; else what collision-time answers [s]")


class PitchClaim(_Thorough, schemas.UniformDragon):
    """How tight the spiral may be."""

    pitch: float | None = Field(None, ge=1e-3, le=10, description="The claim; else what minimum-pitch answers [m]")
    turning_diameter: TurningDiameter = Field(9.0, description="Diameter of the circle that the head must reach [m]")
    start_turns: StartTurns = 16.0


@contextmanager
def _working(what: str) -> Iterator[Callable[[float], None]]:
    """A bar on standard error; yields the function that takes the share done. Ends the command when it must."""
    bar = Progress(console=Console(stderr=True), transient=True, disable=not sys.stderr.isatty())
    try:
        with bar:
            task = bar.add_task(what, total=1.0)
            yield lambda share: bar.update(task, completed=share)
    except KeyboardInterrupt:
        code, message = INTERRUPTED, "Interrupted: nothing was written."
    except ProofRefused as refused:
        code, message = REFUSED, f"Refused: {refused.message}"
    except ImportError as missing:
        code, message = WRONG_USAGE, f"Error: {missing}"
    else:
        return
    print(message, file=sys.stderr)
    raise typer.Exit(code)


def prove(
    context: typer.Context,
    check: Annotated[Path | None, typer.Option(help="Verify this certificate, without a search; - reads it.")] = None,
) -> None:
    """Prove a first contact or a minimum pitch in ball arithmetic, or check a certificate; needs python-flint."""
    if (check is None) == (context.invoked_subcommand is None):
        raise typer.BadParameter("give either a claim to prove or --check FILE")
    if check is None:
        return
    data = sys.stdin.buffer.read() if str(check) == "-" else check.read_bytes()
    try:
        certificate = orjson.loads(data)
    except orjson.JSONDecodeError as error:
        raise InvalidValue("check", f"{check} is not JSON: {error}") from error
    _print(_checked(certificate))


def collision_time(
    asked: CollisionClaim,
    output: Annotated[Path, typer.Option(help="The certificate.")] = Path("collision-time.proof.json"),
) -> None:
    """Nothing touches up to 1e-10 s before this time, and two benches overlap 1e-10 s after it."""
    checked_output("output", output)
    dragon, path, time = asked.to_dragon(Settings().benches_max), asked.to_path(), asked.time
    with _working("proof") as progress:
        from core.proof import prove_collision_time

        if time is None:
            time = core.first_contact(dragon, path, head_speed=asked.head_speed).time
        if time is None:
            raise ProofRefused("time", "nothing touches, so there is no collision time to prove")
        certificate = prove_collision_time(
            dragon, path, time, head_speed=asked.head_speed, every_pair=asked.every_pair, progress=progress
        )
    _finish(certificate, output)


def minimum_pitch(
    asked: PitchClaim,
    output: Annotated[Path, typer.Option(help="The certificate.")] = Path("minimum-pitch.proof.json"),
) -> None:
    """Nothing touches on the way to the circle with this pitch; two benches overlap on it with 1e-6 m less."""
    checked_output("output", output)
    dragon, radius, pitch = asked.to_dragon(Settings().benches_max), asked.turning_diameter / 2, asked.pitch
    with _working("proof") as progress:
        from core.proof import prove_minimum_pitch

        if pitch is None:
            found = core.minimum_pitch(dragon, turning_radius=radius, start_turns=asked.start_turns)
            pitch = found.pitch_bracket[1]
        certificate = prove_minimum_pitch(
            dragon,
            pitch,
            turning_radius=radius,
            start_turns=asked.start_turns,
            every_pair=asked.every_pair,
            progress=progress,
        )
    _finish(certificate, output)


def _checked(certificate: Any) -> Proof:
    with _working("check") as progress:
        from core.proof import check

        return check(certificate, progress=progress)


def _finish(certificate: dict[str, Any], output: Path) -> None:
    """Check a fresh certificate as anyone would, write it whole, and say what it proves."""
    data = orjson.dumps(certificate, option=orjson.OPT_APPEND_NEWLINE)
    checked = _checked(orjson.loads(data))
    with _working("writing"):
        write_whole(output, data)
    _print(checked)
    print(f"{output}: {len(data)} bytes", file=sys.stderr)


def _print(checked: Proof) -> None:
    print(f"Proven: {checked.statement}")
    print(f"{checked.pair_proofs} pair proofs over {checked.stretches} stretches.")
