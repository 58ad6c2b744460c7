"""Dances in which people wobble: the places of the benches, and the first instant at which two of them touch."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.clearance import BLOCK, block_boxes, boxes_apart
    from core.kernels.constants import *
    from core.kernels.rectangles import bench_gap_within

# Where each person wants to stand. n_k is the nominal place of handle k at an instant, T its tangent, N = T turned
# left. Person k wants to stand at w_k = n_k + d_k, d_k = lateral z_k N + forward z'_k T, z and z' normal with variance
# 1,
#   z_k(t) = memory z_k(t - 1) + sqrt(1 - memory^2) x_k,
#   x_k = along x_{k-1} + sqrt(1 - along^2) times a new number,
# so that two people k apart have the correlation along^|k|, and one person at two instants the product of the memories
# between them. A memory of 0 starts afresh.
#
# How the chain is laid out. Handle 0 stays where person 0 wants to stand: p_0 = w_0. Bench k hangs on p_k with the play
# of its pin there: its front hole is f = p_k + a_k. Its rear hole would be at g = w_{k+1} + b_k, with the play at its
# other pin, but its chord c is rigid: on the circle of radius c about f the point nearest to g is
#   r = f + c (g - f) / |g - f|.
# That is the rear hole, and the pin behind is p_{k+1} = r - b_k. So a person's wish across the bench in front is
# fulfilled, but along the bench the chord decides: a stray of the handle in front along the bench is passed on.
#
# Pairs that can be skipped. Each bench has a safe stray: while the holes of each of two benches stray less than that of
# their bench, the two do not touch. A bench that strays further is called loud; a pair can touch only if one of the two
# is loud. A bench that touches another in its nominal place has the safe stray 0, and is always loud.

# Columns of the play of a bench: of its front hole and of its rear hole from their pins [m].
FRONT_X, FRONT_Y, REAR_X, REAR_Y = range(4)
# Columns of the new numbers and of the state: for z, across the path, and for z', along it.
LATERAL, FORWARD = range(2)


# Input:  new numbers for every person and instant, the nominal places and tangents, the play, and the safe strays.
# State:  z and z' of every person (`state`); the chain as it hangs at this instant; which benches and blocks are loud.
# Output: the first instant at which two benches touch, that pair, and the furthest stray of a hole on the way.
class Wobbler:
    """A dragon in which people wobble.

    sizes: (benches + 1, SIZE_COLUMNS); boxes: (benches + 1, BOX_COLUMNS) scratch
    lateral, forward: standard deviations of where people want to stand [m]; along: see above [1]; all 0 until set
    loud, loud_blocks: (benches + 1,) scratch: whether a bench is loud, and whether one of a block of benches is
    chain: (benches + 1, UY + 1), the benches as last laid out: rows of a chain up to UY only, to save cache
    first, second: the pair found last; furthest: largest distance of any hole from its place since this was set to 0
    [m]
    """

    def __init__(self, sizes, budget, chain, boxes, loud, loud_blocks):
        self.sizes = sizes
        self.lateral = self.forward = self.along = 0.0
        self.budget = budget
        self.chain = chain
        self.boxes = boxes
        self.loud = loud
        self.loud_blocks = loud_blocks
        self.benches = sizes.shape[0] - 1
        self.first = self.second = 0
        self.furthest = 0.0

    def dance(self, memory, numbers, play, places, tangents, safe, state):
        """Number of instants before the first at which two benches touch; all T if none touch.

        memory: (T,) of each instant for the one before [1]; numbers: (T, benches + 1, 2) new normal numbers [1]; play:
        (benches, 4) [m]; places, tangents: (T, benches + 1, 2) nominal; safe: (T, benches) strays, see measure() [m];
        state: (benches + 1, 2)
        """
        with cython.nogil:
            for t in range(memory.shape[0]):
                if self.budget.stopped:
                    return t
                self.stand(t, memory[t], numbers, places, tangents, state)
                if self.hang(t, play, places, safe) and self.touching():
                    return t
        return memory.shape[0]

    def stand(self, t, memory, numbers, places, tangents, state):
        """Advance `state` to the next instant, and write into the chain where each person wants to stand."""
        fresh = sqrt(1.0 - memory * memory)
        new = sqrt(1.0 - self.along * self.along)
        lateral = numbers[t, 0, LATERAL]
        forward = numbers[t, 0, FORWARD]
        for k in range(self.benches + 1):
            if k > 0:
                lateral = self.along * lateral + new * numbers[t, k, LATERAL]
                forward = self.along * forward + new * numbers[t, k, FORWARD]
            state[k, LATERAL] = memory * state[k, LATERAL] + fresh * lateral
            state[k, FORWARD] = memory * state[k, FORWARD] + fresh * forward
            side = self.lateral * state[k, LATERAL]
            ahead = self.forward * state[k, FORWARD]
            self.chain[k, PX] = places[t, k, X] + (ahead * tangents[t, k, X] - side * tangents[t, k, Y])
            self.chain[k, PY] = places[t, k, Y] + (ahead * tangents[t, k, Y] + side * tangents[t, k, X])

    def hang(self, t, play, places, safe):
        """Lay out the chain at instant t: each bench behind the one before, its people as near as its chord allows to
        where they want to stand. Returns whether any bench is loud, see above."""
        chain: cython.double[:, ::1] = self.chain
        some = False
        px = chain[0, PX]
        py = chain[0, PY]
        furthest2 = self.furthest * self.furthest
        for k in range(self.benches):
            fx = px + play[k, FRONT_X]
            fy = py + play[k, FRONT_Y]
            dx = chain[k + 1, PX] + play[k, REAR_X] - fx
            dy = chain[k + 1, PY] + play[k, REAR_Y] - fy
            length = sqrt(dx * dx + dy * dy)
            dx /= length
            dy /= length
            chord = self.sizes[k, CHORD]
            rx = fx + chord * dx
            ry = fy + chord * dy
            chain[k, MX] = fx + 0.5 * chord * dx
            chain[k, MY] = fy + 0.5 * chord * dy
            chain[k, UX] = -dx
            chain[k, UY] = -dy
            px = rx - play[k, REAR_X]
            py = ry - play[k, REAR_Y]
            front_dx = fx - places[t, k, X]
            front_dy = fy - places[t, k, Y]
            rear_dx = rx - places[t, k + 1, X]
            rear_dy = ry - places[t, k + 1, Y]
            stray2 = max(front_dx * front_dx + front_dy * front_dy, rear_dx * rear_dx + rear_dy * rear_dy)
            furthest2 = max(furthest2, stray2)
            self.loud[k] = stray2 >= safe[t, k] * safe[t, k]
            some = some or self.loud[k]
        self.furthest = sqrt(furthest2)
        return some

    def touching(self):
        """Whether a loud bench touches another one in the laid-out chain; the two are then `first` and `second`."""
        blocks = block_boxes(self.benches, self.sizes, self.chain, self.boxes)
        for a in range(blocks):
            self.loud_blocks[a] = False
            for i in range(a * BLOCK, min(a * BLOCK + BLOCK, self.benches)):
                self.loud_blocks[a] = self.loud_blocks[a] or self.loud[i]
        for a in range(blocks):
            for b in range(a, blocks):
                if self.loud_blocks[a] or self.loud_blocks[b]:
                    if not boxes_apart(a, b, 0.0, self.boxes) and self.blocks_touch(a, b):
                        return True
        return False

    def blocks_touch(self, a, b):
        """Whether a bench of block a touches one of block b, if at least one of these two benches is loud.

        Most pairs are apart along the face of the first: this is tried here, because calls of other modules cost more.
        """
        chain: cython.double[:, ::1] = self.chain
        sizes: cython.double[:, ::1] = self.sizes
        for i in range(a * BLOCK, min(a * BLOCK + BLOCK, self.benches)):
            x = chain[i, MX]
            y = chain[i, MY]
            radius = sizes[i, RADIUS]
            dx = max(self.boxes[b, X_LOW] - x, x - self.boxes[b, X_HIGH])
            dy = max(self.boxes[b, Y_LOW] - y, y - self.boxes[b, Y_HIGH])
            if max(dx, dy) > radius:
                continue
            ux = chain[i, UX]
            uy = chain[i, UY]
            for j in range(max(i + 2, b * BLOCK), min(b * BLOCK + BLOCK, self.benches)):
                dx = chain[j, MX] - x
                dy = chain[j, MY] - y
                far = radius + sizes[j, RADIUS]
                if dx * dx + dy * dy > far * far or not (self.loud[i] or self.loud[j]):
                    continue
                cosine = fabs(ux * chain[j, UX] + uy * chain[j, UY])
                sine = fabs(ux * chain[j, UY] - uy * chain[j, UX])
                reach = sizes[i, HALF_WIDTH] + (sine * sizes[j, HALF_LENGTH] + cosine * sizes[j, HALF_WIDTH])
                if fabs(dy * ux - dx * uy) - reach > APART:
                    continue
                if bench_gap_within(i, j, 0.0, sizes, chain) <= 0.0:
                    self.first = i
                    self.second = j
                    return True
        return False

    def measure(self, most, gains, places, safe):
        """Fill in the safe stray (T, benches) of every bench at every instant, `most` at most [m]; 0: none is known.

        gains: (benches,) largest way of any point of a bench per metre that both of its holes stray [1]
        places: (T, benches + 1, 2) nominal [m]
        Benches i and j with a gap g cannot touch while holes of i and of j stray less than g / (gains_i + gains_j).
        """
        chain: cython.double[:, ::1] = self.chain
        with cython.nogil:
            for t in range(places.shape[0]):
                if self.budget.stopped:
                    return
                widest = 0.0
                for k in range(self.benches):
                    dx = places[t, k, X] - places[t, k + 1, X]
                    dy = places[t, k, Y] - places[t, k + 1, Y]
                    length = sqrt(dx * dx + dy * dy)
                    chain[k, MX] = 0.5 * (places[t, k, X] + places[t, k + 1, X])
                    chain[k, MY] = 0.5 * (places[t, k, Y] + places[t, k + 1, Y])
                    chain[k, UX] = dx / length
                    chain[k, UY] = dy / length
                    safe[t, k] = most
                    widest = max(widest, gains[k])
                blocks = block_boxes(self.benches, self.sizes, chain, self.boxes)
                for a in range(blocks):
                    for b in range(a, blocks):
                        if boxes_apart(a, b, 2.0 * widest * most, self.boxes):
                            continue
                        for i in range(a * BLOCK, min(a * BLOCK + BLOCK, self.benches)):
                            for j in range(max(i + 2, b * BLOCK), min(b * BLOCK + BLOCK, self.benches)):
                                self.part(t, i, j, most, gains, safe)

    def part(self, t, i, j, most, gains, safe):
        """Reduce the safe strays of benches i and j to the one that the gap between them leaves both."""
        chain: cython.double[:, ::1] = self.chain
        both = gains[i] + gains[j]
        dx = chain[j, MX] - chain[i, MX]
        dy = chain[j, MY] - chain[i, MY]
        far = self.sizes[i, RADIUS] + self.sizes[j, RADIUS] + both * most
        if dx * dx + dy * dy <= far * far:
            stray = max(bench_gap_within(i, j, NO_LIMIT, self.sizes, chain) / both - STRAY_ROUNDING, 0.0)
            safe[t, i] = min(safe[t, i], stray)
            safe[t, j] = min(safe[t, j], stray)


# Gap along a face above which benches are apart, whatever the rounding [m].
APART = 1e-9
# Error allowed for strays, far above the rounding of places up to 1e4 m [m].
STRAY_ROUNDING = 1e-9
