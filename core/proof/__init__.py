"""Contact and clear runs, proven in ball arithmetic, and checked again without a search.

Five claims about a dragon, each number exactly the double given:

    collision time t   on a spiral r = b theta, b = pitch / (2 pi): nothing touches in [0, t - 1e-10 s], and a pair
                       strictly overlaps at t + 1e-10 s
    minimum pitch p    every bench follows and nothing touches from the start until the head reaches the circle, and
                       with p - 1e-6 m a pair strictly overlaps on that way, or a bench cannot follow as far as the
                       circle (it folds), or the start lies within the circle; larger pitches are not claimed
    clear run          on a spiral, a turn or a route of lines, arcs and coils: nothing touches in [start, stop]; if
                       the claim includes the end, the run is over by stop + 1e-9 s: a bench folds, the head is at
                       the centre, or the route is at its end
    contact t          a collision time on any of these paths, from a start on
    tolerance d        on a spiral: while every hole is within d of its place and every chord keeps its length, nothing
                       touches in [start, stop]; if the claim includes a pose, a pair strictly overlaps in it, and its
                       strays are below a second number

With a margin, "touches" is "comes within the margin", and "strictly overlaps" is "is strictly nearer than the margin".

Handles. With chord c, the angle d from a handle at theta to the next one, at f(theta) = theta + d, is the first
root of F(theta, d) = d^2 + 2 theta (theta + d) (1 - cos d) = (c / b)^2.
  1. F_d = 2 d + 2 theta (1 - cos d) + 2 theta (theta + d) sin d > 0 for 0 < d <= pi: a root there is the first.
     A root d > pi is the first if F_d > 0 at d and F_dd = 2 + 4 theta sin d + 2 theta (theta + d) cos d < 0 on
     [x, d], for then F_d falls from x to d and stays positive, and, where x > pi, if F_d > 0 on pieces that cover
     [pi, x].
  2. F_theta = 2 (2 theta + d) (1 - cos d) > 0, so for theta in [m, M] nothing below d(M) is a root, and F has
     reached (c / b)^2 at d(m): the first root lies in [d(M), d(m)]. Where F_d > 0 on that box it is the only
     one there, with the derivative d' = -F_theta / F_d < 0.
  3. So where 1 + d' > 0 on the box, the next handle rises with theta from f(m) to f(M): the chains at the two
     ends enclose those between, link after link, without wrapping effect. Elsewhere (handle 1 reverses
     near the fold) the mean value theorem encloses the rest of the chain. The chain at one theta comes from one
     interval Newton step for each link.

Pairs. A stretch is one bench a whose front handle goes through [m, M], and the benches behind it, in the frame
that rotates with that handle, because neighbouring rings move slowly there. Bench j >= a + 2 is apart from a if all
four corners of one lie beyond one face of the other. Let g(theta) be the distance of one corner beyond a
face, w = M - m, and D1 <= g' <= D2 on the stretch, from the exact velocities of rigid links. Then
    g >= g(m) + D1 (theta - m)   and   g >= g(M) - D2 (M - theta).
  4. If g(m) > 0 and g(M) > 0, then g > 0 throughout if D1 >= 0, or D2 <= 0, or D2 g(m) - D1 g(M) + D1 D2 w > 0:
     both bounds can be 0 or less at one theta only if w >= g(m) / -D1 + g(M) / D2. Near the contact g is
     monotone, so that the last stretch, down to 1e-10 s before it, can be as wide as any other.
  5. Every point of a bench is within h = hypot(overhang, width / 2) of the segment between its handles. A point
     that divides this segment as q : 1 - q has r^2 = q r1^2 + (1 - q) r2^2 - q (1 - q) c^2 >= min(r1, r2)^2 - c^2 / 4.
     Handles lie outwards along the chain. So, with the longest chord c and the largest h of the dragon, all the
     benches from handle k on are apart from bench a when sqrt(r[k]^2 - c^2 / 4) - h > r[a + 1] + h[a]; and
     they do follow, since F(theta, pi) > 4 theta^2 > (c / b)^2. All other pairs are proven one by one.

The whole chain. A sweep covers with stretches every place that the front handle of one bench takes: sweep 0 covers
the head's way, sweep a + 1 all places of handle a + 1 in the stretches of sweep a.
  6. If the benches from u on are equal and sweep u reaches far enough out, it covers all of them: all handles
     follow one path, so with handle k > u at theta the benches from k on lie as those from u on do with handle u
     at theta, except that k - u of them are missing at the end. Let P[u] be above all places of handle u, and
     P[k + 1] = f(P[k]). Then no handle k >= u comes above P[k]: f rises, or where 3. does not prove it, the next
     handle is below P[u + 1]. Only handles from u + s on pass a stretch that begins above P[u], ..., P[u + s - 1]:
     in it, bench u needs only its pairs with benches up to n - 1 - s.

Margin. Let the separation of two benches be the distance between two closest points, one of each.
  7. If bench a lies behind a line of unit normal n, and all corners of b lie more than the margin beyond it, the
     separation exceeds the margin, because it is no less than the distance between the projections onto n. Besides the
     eight faces, n may be any direction fixed in the first bench; two corners that are nearest to one another need
     this. 4. holds for it as for a face. Two benches are nearer than the margin m when they strictly
     overlap, or when some corner of one, with x and y its distances beyond the nearer of two opposite faces of the
     other (0 between them), has x^2 + y^2 < m^2: the corner and the point of the other next to it are two such
     points.

Routes. Along a route the place of a handle is z = -s, so that it falls as theta does; f(z) is the place of the next
handle, the first point behind at the chord c. Let the curvature be between k1 and k2 from there to here, K the larger
of |k1| and |k2|, k0 the least |curvature| (0 where the sign may change), and l the length between. With the direction
of travel phi and the direction psi of the chord, alpha = phi - psi at the front and beta = phi - psi at the rear.
  8. If K l <= pi, then alpha and -beta lie in [k1 l / 2, k2 l / 2]. Put the rear at 0 with phi(0) = 0: the chord
     is V = integral of exp(i phi) over [0, l]. With h = k2 l / 2, Im(V exp(-i h)) is the integral over [0, l / 2] of
     sin(phi(t) - h) + sin(phi(l - t) - h) = 2 sin(M) cos(N), |N| = |phi(t) - phi(l - t)| / 2 <= K l / 2 <= pi / 2,
     M = (phi(t) + phi(l - t)) / 2 - h between -K l / 2 - h >= -pi and k2 l / 2 - h = 0: it is 0 or less. Likewise
     Im(V exp(-i k1 l / 2)) >= 0. So the argument of V, -beta, lies between the two; alpha by travelling backwards.
     The distance D of the two points grows with l by cos(beta) >= cos(K l / 2), and by cos(beta) <= cos(k0 l / 2):
         (2 / K) sin(K l / 2) <= D <= (2 / k0) sin(k0 l / 2)   while K l <= pi.
     So a point behind at distance c with K l <= pi is the first one, and it exists if K c < 2, with
     (2 / k0) asin(k0 c / 2) <= l <= (2 / K) asin(K c / 2) < pi / K. Over a stretch z in [m, M], with K the bound on
     [m, f(M)] and K c < 2: seen from the fixed point R = f(M) the distance of the point at z falls with z while
     K (R - z) <= pi, so at R it is c or more, and so it is at pi c / 2 behind z where R - z is more than pi / K: f(z)
     does not exceed f(M). So f does not fall, the chains at the two ends enclose those between as in 3., and
     f' = cos(alpha) / cos(beta) > 0, since the chord keeps its length.
     alpha and beta change by k - psi' and f' k - psi' per length of the front handle's way, psi' = (sin(alpha) -
     f' sin(beta)) / c. No place of the stretch is farther than half that way from the nearer end, so they also
     differ from their values at an end by at most this half way times these rates. On one line or arc l, alpha and beta
     do not change.
  9. Seen from the first bench a, in its own frame, bench b has its centre at q and the direction e. With v the
     velocity of a centre in its bench's own frame, (cos(alpha), (sin(alpha) + f' sin(beta)) / 2) times the speed
     r of the front handle, and w = r psi' the rate of rotation,
         e' = i (w_b - w_a) e,   q' = e v_b - v_a - i w_a q,   |q|' <= |e v_b - v_a|,
     and r of the next handle is f' r. Each encloses e and q from either end of the stretch through half of it. So
     4. applies with g' from e, e', q and q', and with a and b exchanged.
 10. Benches are apart if the distance between their centres exceeds the sum of their half diagonals. By the last of
     9. this distance is never less than half the sum of its values at both ends, less half of |e v_b - v_a| times the
     stretch.
 11. Let the first piece coil inwards; it continues outwards without end. If a handle stands on it and bench a is
     inside the circle, 5. holds for all benches from that handle on: a point of the way of its handle, of length w,
     is no farther from the centre than half the sum of w and its distances at both ends.
     core/proof/paths.py describes how the pieces are joined.

Tight bends and corners. 8. serves while K c < 1.9980001, which every bend does that is always followed, and without a
corner. Elsewhere let D(z, y) be the distance of the points at the places z and y > z, u the direction from y to z, T
that of travel, at a corner those on both sides. D grows with y at the rate u . T(y), and falls with z at u . T(z).
 18. A place y1 between z and y2 is short of y2 if D(z, y) < c over some part of the path that holds y1, or D grows with
     y all over it. From y2, where D <= c, back to z, part by part, D stays below c: if all places between are short of
     y2 and D(z, y2) = c, then y2 = f(z). Over a stretch z in [m, M], let p = f(m) <= q = f(M), u . T(z) > 0 and u .
     T(y) > 0 for all these z and all y in [p, q], and all places between m and p short of p for all these z. Then D(z,
     p) <= D(m, p) = c = D(M, q) <= D(z, q), D grows from p to q, and it is less than c between z and p: f(z) is the
     only place in [p, q] at distance c. So f is continuous and rises, the chains at the two ends enclose those between,
     and between corners f' = cos(alpha) / cos(beta) > 0, u . T(z) and u . T(y) being these cosines at y = f(z): points
     and tangents of the whole stretch enclose alpha and beta. The rates of 8. do so too, with the curvature at the
     handle, except where it passes a corner. There velocities jump, but no place does: 4. and 10. hold, because g and q
     change by the integral of their rates. Besides, cos(beta) > 0.0447 is proven, which follows from K c < 1.9980001 as
     well. Of one or two benches, which have no pair, sweep 0 proves that they follow. At a contact a stretch over its
     bracket proves that all benches up to the two that meet follow there, too.

Fold. The claim: bench k folds while the head goes from theta = M in to m, where its handle k is at t(m). (A minimum
pitch need not prove how the dance gets to M: if a bench folds earlier, the head does not reach the circle either.)
 12. Until bench k folds, all handles up to k follow continuously, and so does the angle d of bench k, from d1 on. Let
     T be above all places of handle k on the way. If F(T, D) < (c / b)^2 for some D > d1, then F(theta, D) < (c / b)^2
     for all theta <= T by 2.: d never equals D, so it stays below. If moreover F(t(m), d) < (c / b)^2 for all d in
     [0, D], then no root is left at m.
 13. Sweeps that cover the way of the head prove that all benches follow on it. Over a stretch F_d > 0 on the box of
     every placed angle, so it is the first root and changes without a jump; where two stretches join it is the same
     root. The angles further out are below pi by 5., so 1. applies to them. 6. holds for them as for pairs. One or
     two benches have no pair, but a minimum pitch has sweep 0 for them too, which proves only that they follow.

Strays. Let the two holes of every bench be within d of their places, and its chord c be kept, d < c.
 14. The ground of a bench is the union of all its possible places, in the frame of its nominal place. Whatever the
     benches between two others allow, these two do not touch if their grounds do not meet. Cut the bench across
     at its holes into three parts. Wherever a part is, it is the convex hull of its corners. So a polygon of SIDES half
     planes, evenly spaced, that holds all places of its corners (15.) holds all places of the part; a fourth polygon,
     with the largest of the three supports in each direction, holds the ground. A point of the segment between the
     displaced handles is within d of the point that divides the segment between their nominal places in the same
     ratio: so 5. holds with h + d in place of h.
 15. Let the bench rotate by phi, q = c sin(phi / 2): one hole moves by m + i q exp(i phi / 2), the other by m - i q
     exp(i phi / 2); the point p of the bench, counted from the middle of the chord, moves to m + exp(i phi) p. So
     |q| <= d, and m is in the lens of two discs of radius d. In the direction e, with t the argument of
     exp(i phi / 2) / e, m comes as far as
         d - |q sin t|   where |q| <= d |sin t|,   else   |cos t| sqrt(d^2 - q^2).
     The second is never more than the first (Cauchy and Schwarz), which is used where the balls do not decide.
     Let q = d sin(psi), kappa = d / c, kappa' = kappa / sqrt(1 - kappa^2). By psi, |phi'| <= 2 kappa and |phi''| <= 2
     kappa', as sin(phi / 2) = kappa sin(psi). So the second derivatives are at most d (1 + 2 kappa + kappa^2 + kappa')
     for m, on either range, and |p| (4 kappa^2 + 2 kappa') for exp(i phi) p. On either side of psi = 0 values and
     slopes of the two ranges agree where they meet. So between two samples of psi that are w apart, and not on both
     sides of 0, nothing is more than K w^2 / 8 above the higher one, K the sum of these two bounds.
 16. Let n be the outward normal of a side of a polygon, and let u = -n, seen from the other bench, lie between the
     directions of sides k and k + 1 of its polygon: u is the sum of these two with factors that are not negative. So no
     point of that polygon is farther along u than the corner where its sides k and k + 1 meet. Two polygons are apart
     over a stretch if 4. holds for the corners of all k that u passes. Two grounds are apart if their fourth polygons
     are, or if each of the three of one is apart from each of the three of the other.
 17. A pose is given by its first handle and the heading of every bench: each chord is exact. The place of a handle on
     the spiral is known from the time.

A certificate holds the parameters, the stretches as [highest place, lowest place, faces], and the overlap, or the bench
that folds with M and m of 12. `faces` has one digit for each bench from the next but one on: 0 to 3 for the faces +x,
+y, -x, -y of the first bench, 4 to 7 for those of the other one, 8 for a direction of 7. (then the directions [rad] are
the fourth entry), 9 for 10. A claim about strays has a list of one side or of nine (16.) in place of each digit: 0 to
SIDES - 1 for those of the first bench, from SIDES on for those of the other one. The doubles, the faces and the sides
are guesses, made in double precision; every inequality above is decided on balls, when a proof is made and when it is
checked. The precision of flint is global to the process: prove and check in one thread at a time.
"""

from __future__ import annotations

from core.extras import not_installed

try:
    import flint  # noqa: F401
except ImportError as error:
    raise ImportError(not_installed("A proof", "python-flint", "proof"), name="flint") from error

from core.proof.certificate import (
    Certificate,
    Proof,
    digest,
    prove_clear,
    prove_collision_time,
    prove_contact,
    prove_minimum_pitch,
    prove_tolerance,
    verify,
)

__all__ = [
    "Certificate",
    "Proof",
    "digest",
    "prove_clear",
    "prove_collision_time",
    "prove_contact",
    "prove_minimum_pitch",
    "prove_tolerance",
    "verify",
]
