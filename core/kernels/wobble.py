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
# Pairs that can be skipped. Each bench has a room: while the holes of each of two benches stray less than its room, the
# two do not touch. A bench that leaves its room is loud, and a pair can touch only if one of the two is loud. A bench
# that touches another in its nominal place has no room, and is always loud.

# Columns of the play of a bench: of its front hole and of its rear hole from their pins [m].
FRONT_X, FRONT_Y, REAR_X, REAR_Y = range(4)


# Input:  new numbers for every person and instant, the nominal places and tangents, the play, and the rooms.
# State:  z and z' of every person (`state`); the chain as it hangs at this instant; which benches are `loud`.
# Output: the first instant at which two benches touch, that pair, and the furthest stray of a hole on the way.
class Wobbler:
    """A dragon in which people wobble.

    sizes: (benches + 1, SIZE_COLUMNS); boxes: (benches + 1, BOX_COLUMNS) scratch
    lateral, forward: standard deviations of where people want to stand [m]; along: see above [1]; all 0 until set
    loud: (2 benches + 2,) scratch: of every bench, then of every block of benches
    chain: (benches + 1, UY + 1), the benches as last laid out: rows of a chain up to UY only, to save cache
    first, second: the pair found last; furthest: largest distance of any hole from its place since this was set to 0
    [m]
    """

    def __init__(self, sizes, budget, chain, boxes, loud):
        self.sizes = sizes
        self.lateral = self.forward = self.along = 0.0
        self.budget = budget
        self.chain = chain
        self.boxes = boxes
        self.loud = loud
        self.benches = sizes.shape[0] - 1
        self.first = self.second = 0
        self.furthest = 0.0

    def dance(self, memory, numbers, play, places, tangents, rooms, state):
        """Number of instants before the first at which two benches touch; all T if none touch.

        memory: (T,) of each instant for the one before [1]; numbers: (T, benches + 1, 2) new normal numbers [1]; play:
        (benches, 4) [m]; places, tangents: (T, benches + 1, 2) nominal; rooms: (T, benches) [m]; state: (benches + 1,
        2) z and z'
        """
        with cython.nogil:
            for t in range(memory.shape[0]):
                if self.budget.stopped:
                    return t
                self.stand(t, memory[t], numbers, places, tangents, state)
                if self.hang(t, play, places, rooms) and self.touching():
                    return t
        return memory.shape[0]

    def stand(self, t, memory, numbers, places, tangents, state):
        """Advance `state` to the next instant, and write into the chain where each person wants to stand."""
        fresh = sqrt(1.0 - memory * memory)
        new = sqrt(1.0 - self.along * self.along)
        x = numbers[t, 0, 0]
        y = numbers[t, 0, 1]
        for k in range(self.benches + 1):
            if k > 0:
                x = self.along * x + new * numbers[t, k, 0]
                y = self.along * y + new * numbers[t, k, 1]
            state[k, 0] = memory * state[k, 0] + fresh * x
            state[k, 1] = memory * state[k, 1] + fresh * y
            side = self.lateral * state[k, 0]
            ahead = self.forward * state[k, 1]
            self.chain[k, PX] = places[t, k, 0] + (ahead * tangents[t, k, 0] - side * tangents[t, k, 1])
            self.chain[k, PY] = places[t, k, 1] + (ahead * tangents[t, k, 1] + side * tangents[t, k, 0])

    def hang(self, t, play, places, rooms):
        """Lay out the chain at instant t: each bench behind the one before, its people as near as its chord allows to
        where they want to stand. Returns whether any bench is loud, see above."""
        chain: cython.double[:, ::1] = self.chain
        some = False
        px = chain[0, PX]
        py = chain[0, PY]
        furthest = self.furthest * self.furthest
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
            fx -= places[t, k, 0]
            fy -= places[t, k, 1]
            rx -= places[t, k + 1, 0]
            ry -= places[t, k + 1, 1]
            stray = max(fx * fx + fy * fy, rx * rx + ry * ry)
            furthest = max(furthest, stray)
            room = rooms[t, k]
            self.loud[k] = room <= 0.0 or stray >= room * room
            some = some or self.loud[k]
        self.furthest = sqrt(furthest)
        return some

    def touching(self):
        """Whether a loud bench touches another one in the laid-out chain; the two are then `first` and `second`."""
        blocks = block_boxes(self.benches, self.sizes, self.chain, self.boxes)
        for a in range(blocks):
            self.loud[self.benches + 1 + a] = False
            for i in range(a * BLOCK, min(a * BLOCK + BLOCK, self.benches)):
                self.loud[self.benches + 1 + a] = self.loud[self.benches + 1 + a] or self.loud[i]
        for a in range(blocks):
            for b in range(a, blocks):
                if self.loud[self.benches + 1 + a] or self.loud[self.benches + 1 + b]:
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

    def measure(self, most, gains, places, rooms):
        """Fill in the room of every bench (T, benches) at every instant, `most` at most [m]; negative: it has no room.

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
                    dx = places[t, k, 0] - places[t, k + 1, 0]
                    dy = places[t, k, 1] - places[t, k + 1, 1]
                    length = sqrt(dx * dx + dy * dy)
                    chain[k, MX] = 0.5 * (places[t, k, 0] + places[t, k + 1, 0])
                    chain[k, MY] = 0.5 * (places[t, k, 1] + places[t, k + 1, 1])
                    chain[k, UX] = dx / length
                    chain[k, UY] = dy / length
                    rooms[t, k] = most
                    widest = max(widest, gains[k])
                blocks = block_boxes(self.benches, self.sizes, chain, self.boxes)
                for a in range(blocks):
                    for b in range(a, blocks):
                        if boxes_apart(a, b, 2.0 * widest * most, self.boxes):
                            continue
                        for i in range(a * BLOCK, min(a * BLOCK + BLOCK, self.benches)):
                            for j in range(max(i + 2, b * BLOCK), min(b * BLOCK + BLOCK, self.benches)):
                                self.part(t, i, j, most, gains, rooms)

    def part(self, t, i, j, most, gains, rooms):
        """Reduce the rooms of benches i and j to the room between them."""
        chain: cython.double[:, ::1] = self.chain
        both = gains[i] + gains[j]
        dx = chain[j, MX] - chain[i, MX]
        dy = chain[j, MY] - chain[i, MY]
        far = self.sizes[i, RADIUS] + self.sizes[j, RADIUS] + both * most
        if dx * dx + dy * dy <= far * far:
            room = bench_gap_within(i, j, NO_LIMIT, self.sizes, chain) / both - ROOM_ROUNDING
            rooms[t, i] = min(rooms[t, i], room)
            rooms[t, j] = min(rooms[t, j], room)


# Gap along a face above which benches are apart, whatever the rounding [m].
APART = 1e-9
# Error allowed for rooms and strays, far above the rounding of places up to 1e4 m [m].
ROOM_ROUNDING = 1e-9
