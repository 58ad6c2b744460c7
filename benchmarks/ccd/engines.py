"""The engines: each answers the same query about the same motion, used as its own documentation advises.

A query: does a corner of one bench meet an edge of another, moved outwards by a margin, and when first?
docs/dragon-ccd.md gives the promise, the settings with their reasons, and the results of each engine.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from importlib.metadata import version
from typing import Any, NamedTuple

import numpy as np

from benchmarks.ccd.march import march
from benchmarks.ccd.motion import Motion, Point, local_corner, moved_edge

# Box2D: size of the longest bench, at the upper end of the recommended range of 0.1 to 10, where tolerances (parts of
# b2_linearSlop) are relatively smallest [units]; the same a hundred times larger, which is beyond that range [1].
BOX2D_SIZE, BOX2D_BEYOND = 10.0, 100.0
BOX2D_SLOP = 0.005  # b2_linearSlop of Box2D 2.3 [units]
# A step of Box2D or FCL is so short that its even motion is this near the true one: for Box2D a tenth of its tolerance
# of b2_linearSlop / 4, for FCL [m].
BOX2D_BOW_SHARE = 0.1
FCL_BOW = 1e-6
# Radius of the sphere around the corner and of the capsule around the edge, which is moved back by both [m].
FCL_RADIUS = 0.01


class Answer(NamedTuple):
    """touches: True if the corner comes within the margin; time: the first time in [0, 1], else not a number."""

    touches: bool
    time: float


CLEAR = Answer(False, math.nan)
Solver = Callable[[Motion], Answer]


class Engine(NamedTuple):
    """An engine as it is used.

    name: in tables; package: that provides it, empty for our own; settings: in words; made: gives its solver
    afresh: a process of its own for every file of queries, because its answers differ from process to process
    """

    name: str
    package: str
    settings: str
    made: Callable[[], Solver]
    afresh: bool = False

    @property
    def version(self) -> str:
        """Version of the package. raises: PackageNotFoundError if it is not installed"""
        return version(self.package or "bench-dragon")


def ours() -> Solver:
    """The certified march of this library, for one corner and one edge."""

    def solve(motion: Motion) -> Answer:
        time = march(motion)
        return CLEAR if time is None else Answer(True, time)

    return solve


def with_ipctk(rescaling: float | None) -> Solver:
    """NonlinearCCD.point_edge_ccd with our bound for its max_distance_from_linear."""
    import ipctk

    ccd = ipctk.NonlinearCCD() if rescaling is None else ipctk.NonlinearCCD(conservative_rescaling=rescaling)

    class Way(ipctk.NonlinearTrajectory):  # type: ignore[misc]
        def __init__(self, motion: Motion, bench: int, local: Point) -> None:
            super().__init__()
            self.motion, self.bench, self.local, self.reach = motion, bench, local, math.hypot(*local)

        def __call__(self, t: float) -> Any:
            return np.array(self.motion.point(t, self.bench, self.local))

        def max_distance_from_linear(self, t0: float, t1: float) -> float:
            return self.motion.bow(t0, t1, self.bench, self.reach)

    def solve(motion: Motion) -> Answer:
        query, stage = motion.query, motion.stage
        ends = [Way(motion, query.edge_bench, end) for end in moved_edge(stage, query, query.margin)]
        point = Way(motion, query.corner_bench, local_corner(stage, query.corner_bench, query.corner))
        touches, time = ccd.point_edge_ccd(point, *ends)
        return Answer(True, float(time)) if touches else CLEAR

    return solve


def with_box2d(scale: float) -> Solver:
    """b2TimeOfImpact over short steps. scale: units in a metre, times the longest bench's length."""
    import Box2D as box  # noqa: N813

    def solve(motion: Motion) -> Answer:
        query, stage = motion.query, motion.stage
        unit = scale / float(stage.dance.dragon.lengths.max())
        # Box2D keeps shapes at a distance: the sum of their radii less 3 slops, but at least 1 slop. Here the radii are
        # 0 and 2 slops (an edge), so the distance is 1 slop.
        ends = moved_edge(stage, query, query.margin - BOX2D_SLOP / unit)
        edge = box.b2EdgeShape(vertices=[(x * unit, y * unit) for x, y in ends])
        x, y = local_corner(stage, query.corner_bench, query.corner)
        point = box.b2CircleShape(pos=(x * unit, y * unit), radius=0.0)
        steps = motion.even_steps(BOX2D_BOW_SHARE * 0.25 * BOX2D_SLOP / unit)
        before = None
        for k in range(steps + 1):
            after = [motion.pose(k / steps, bench) for bench in (query.edge_bench, query.corner_bench)]
            if before is not None:
                sweeps = [sweep(box, start, end, before[0], unit) for start, end in zip(before, after, strict=True)]
                state, time = box.b2TimeOfImpact(
                    shapeA=edge, shapeB=point, idxA=0, idxB=0, sweepA=sweeps[0], sweepB=sweeps[1], tMax=1.0
                )
                if state in (box.b2TOIOutput.e_touching, box.b2TOIOutput.e_overlapped):
                    part = time if state == box.b2TOIOutput.e_touching else 0.0
                    return Answer(True, (k - 1 + part) / steps)
            before = after
        return CLEAR

    return solve


Pose = tuple[float, float, float, float]


def sweep(box: Any, start: Pose, end: Pose, origin: Pose, unit: float) -> Any:
    """The even motion between two poses, in units, from an origin near both, as its numbers are single floats."""
    turn = math.atan2(start[2] * end[3] - start[3] * end[2], start[2] * end[2] + start[3] * end[3])
    angle = math.atan2(start[3], start[2])
    made = box.b2Sweep()
    made.localCenter, made.alpha0 = (0.0, 0.0), 0.0
    made.c0, made.c = (((pose[0] - origin[0]) * unit, (pose[1] - origin[1]) * unit) for pose in (start, end))
    made.a0, made.a = angle, angle + turn
    return made


def with_fcl(solver: str, motion_type: str) -> Solver:
    """continuousCollide over short steps: a sphere around the corner, a capsule around the edge."""
    import fcl

    request = fcl.ContinuousCollisionRequest(
        ccd_motion_type=getattr(fcl.CCDMotionType, motion_type), ccd_solver_type=getattr(fcl.CCDSolverType, solver)
    )

    def placed(pose: Pose, at: tuple[float, float], upright: bool) -> Any:
        """The place of a shape at a point of a bench, its z axis along or across that."""
        x, y, ux, uy = pose
        way = np.array([[uy, 0.0, ux], [-ux, 0.0, uy], [0.0, -1.0, 0.0]])
        if upright:
            way = np.array([[ux, 0.0, -uy], [uy, 0.0, ux], [0.0, -1.0, 0.0]])
        return fcl.Transform(way, np.array([x + at[0] * ux - at[1] * uy, y + at[0] * uy + at[1] * ux, 0.0]))

    def solve(motion: Motion) -> Answer:
        query, stage = motion.query, motion.stage
        ends = moved_edge(stage, query, query.margin - 2.0 * FCL_RADIUS)
        middle = ((ends[0][0] + ends[1][0]) / 2, (ends[0][1] + ends[1][1]) / 2)
        capsule, sphere = fcl.Capsule(FCL_RADIUS, math.dist(*ends)), fcl.Sphere(FCL_RADIUS)
        corner = local_corner(stage, query.corner_bench, query.corner)
        steps = motion.even_steps(FCL_BOW)
        before: list[Any] = []
        for k in range(steps + 1):
            edge_pose, corner_pose = (motion.pose(k / steps, bench) for bench in (query.edge_bench, query.corner_bench))
            after = [placed(edge_pose, middle, query.edge % 2 == 0), placed(corner_pose, corner, False)]
            if before:
                objects = [fcl.CollisionObject(shape, at) for shape, at in zip((capsule, sphere), before, strict=True)]
                result = fcl.ContinuousCollisionResult()
                fcl.continuousCollide(objects[0], after[0], objects[1], after[1], request, result)
                if result.is_collide:
                    return Answer(True, (k - 1 + result.time_of_contact) / steps)
            before = after
        return CLEAR

    return solve


ADVANCING, NAIVE = "CCDC_CONSERVATIVE_ADVANCEMENT", "CCDC_NAIVE"
ENGINES = (
    Engine("ours", "", "certified march, bracket of 1e-10 m where rounding allows it", ours),
    Engine("ipctk", "ipctk", "NonlinearCCD.point_edge_ccd, all defaults (rescaling 0.8)", lambda: with_ipctk(None)),
    Engine("ipctk 0.9999", "ipctk", "the same, conservative_rescaling 0.9999", lambda: with_ipctk(0.9999)),
    Engine("Box2D", "box2d", "b2TimeOfImpact, longest bench 10 units", lambda: with_box2d(BOX2D_SIZE)),
    Engine("Box2D x100", "box2d", "the same, longest bench 1,000 units", lambda: with_box2d(BOX2D_SIZE * BOX2D_BEYOND)),
    Engine("FCL advancing", "python-fcl", f"{ADVANCING}, CCDM_SCREW", lambda: with_fcl(ADVANCING, "CCDM_SCREW")),
    Engine("FCL naive", "python-fcl", f"{NAIVE}, CCDM_SCREW", lambda: with_fcl(NAIVE, "CCDM_SCREW")),
    Engine(
        "FCL linear", "python-fcl", f"{ADVANCING}, CCDM_LINEAR", lambda: with_fcl(ADVANCING, "CCDM_LINEAR"), afresh=True
    ),
)
