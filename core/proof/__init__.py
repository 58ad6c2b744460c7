"""A first contact or a minimum pitch, proven in ball arithmetic, and checked again without a search.

Two claims about a dragon on a spiral r = b theta, b = pitch / (2 pi), each number exactly the double given:

    collision time t   nothing touches in [0, t - 1e-10 s], and a pair strictly overlaps at t + 1e-10 s
    minimum pitch p    nothing touches from the start until the head reaches the circle, and with p - 1e-6 m
                       a pair strictly overlaps on that way, or the start lies within the circle

Handles. With chord c, the bend d from a handle at theta to the next one, at f(theta) = theta + d, is the first
root of F(theta, d) = d^2 + 2 theta (theta + d) (1 - cos d) = (c / b)^2.
  1. F_d = 2 d + 2 theta (1 - cos d) + 2 theta (theta + d) sin d > 0 for 0 < d <= pi: a root there is the first.
     A root d > pi is the first if F_dd = 2 + 4 theta sin d + 2 theta (theta + d) cos d < 0 on [pi, d] and
     F_d > 0 at d, for then F_d falls from pi to d and stays positive.
  2. F_theta = 2 (2 theta + d) (1 - cos d) > 0, so for theta in [m, M] nothing below d(M) is a root, and F has
     reached (c / b)^2 at d(m): the first root lies in [d(M), d(m)]. Where F_d > 0 on that box it is the only
     one there, with the derivative d' = -F_theta / F_d < 0.
  3. So where 1 + d' > 0 on the box, the next handle rises with theta from f(m) to f(M): the chains at the two
     ends enclose those between, link after link, without wrapping. Where it does not (handle 1 turns back near
     the fold), the mean value theorem encloses the rest of the chain. The chain at one theta comes from one
     interval Newton step for each link.

Pairs. A stretch is one bench a whose front handle goes through [m, M], and the benches behind it, in the frame
that turns with that handle, for there neighbouring rings move slowly. Bench j >= a + 2 is apart from a if one
face of either has all four corners of the other beyond it. Let g(theta) be the distance of one corner beyond a
face, w = M - m, and D1 <= g' <= D2 on the stretch, from the exact velocities of rigid links. Then
    g >= g(m) + D1 (theta - m)   and   g >= g(M) - D2 (M - theta).
  4. If g(m) > 0 and g(M) > 0, then g > 0 throughout when D1 >= 0, or D2 <= 0, or D2 g(m) - D1 g(M) + D1 D2 w > 0:
     for both bounds to be 0 or less at one theta, w >= g(m) / -D1 + g(M) / D2 is needed. Near the contact g
     is monotone, so that the last stretch, down to 1e-10 s before it, is as wide as any.
  5. Every point of a bench is within h = hypot(overhang, width / 2) of the segment between its handles. A point
     that divides this segment as q : 1 - q has r^2 = q r1^2 + (1 - q) r2^2 - q (1 - q) c^2 >= min(r1, r2)^2 - c^2 / 4.
     Handles lie outwards along the chain. So, with the longest chord c and the largest h of the dragon, all the
     benches from handle k on are apart from bench a when sqrt(r[k]^2 - c^2 / 4) - h > r[a + 1] + h[a]; and
     they do follow, since F(theta, pi) > 4 theta^2 > (c / b)^2. All other pairs are shown one by one.

The whole chain. A sweep tiles with stretches every place that the front handle of one bench takes: sweep 0 the
head's way, sweep a + 1 all places where the stretches of sweep a have handle a + 1.
  6. If the benches from u on are alike, sweep u does for all of them when it reaches far enough out: all handles
     follow one path, so with handle k > u at theta the benches from k on lie as those from u on do with handle u
     at theta, only that k - u of them are missing at the end. Let P[u] be above all places of handle u, and
     P[k + 1] = f(P[k]). Then no handle k >= u comes above P[k]: f rises, or where 3. does not say so, the next
     handle is below P[u + 1]. A stretch that begins above P[u], ..., P[u + s - 1] is passed only by handles
     from u + s on: in it, bench u needs its pairs with benches up to n - 1 - s.

A certificate holds the parameters, the stretches as [highest theta, lowest theta, faces] and the overlap. The doubles
and the faces are guesses, made in double precision; every inequality above is decided on balls, when a proof is made
and when it is checked. The precision of flint is one for the process: prove and check in one thread at a time.
"""

from __future__ import annotations

try:
    import flint  # noqa: F401
except ImportError as error:
    raise ImportError("a proof needs python-flint: pip install 'bench-dragon[proof]'") from error

from core.proof.certificate import (
    Certificate,
    Proof,
    check,
    digest,
    prove_clear,
    prove_collision_time,
    prove_contact,
    prove_minimum_pitch,
)

__all__ = [
    "Certificate",
    "Proof",
    "check",
    "digest",
    "prove_clear",
    "prove_collision_time",
    "prove_contact",
    "prove_minimum_pitch",
]
