"""Dances in which people wobble: where the benches are, and the first instant at which two of them touch."""

import cython
from cython.cimports.libc.math import fabs, sqrt

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.clearance import BLOCK, block_boxes, boxes_apart
    from core.kernels.constants import *
    from core.kernels.rectangles import bench_of, pair_gap, pair_gap_within

# Who wants to stand where. n_k is the nominal place of handle k at an instant, T its tangent, N that turned left.
# Person k wants to stand at w_k = n_k + d_k, d_k = lateral z_k N + forward z'_k T, z and z' normal with variance 1,
#   z_k(t) = memory z_k(t - 1) + sqrt(1 - memory^2) x_k,
#   x_k = along x_{k-1} + sqrt(1 - along^2) times a new number,
# so that two people k apart have the correlation along^|k|, and one person at two instants the product of the memories
# between them. A memory of 0 starts afresh.
#
# How the chain is laid out. Handle 0 stays where person 0 wants to stand: p_0 = w_0. Bench k hangs on p_k with the play
# of its pin there: its front hole is f = p_k + a_k. Its rear hole would be at g = w_{k+1} + b_k, with the play at its
# other pin, but its chord c is rigid: on the circle of radius c about f the point nearest to g is
#   r = f + c (g - f) / |g - f|.
# That is the rear hole, and the pin behind is p_{k+1} = r - b_k. So what a person wants across the bench in front comes
# about; along it the bench leads, and what the handle in front strays along the bench is handed on.
#
# What need not be looked at. Each bench has a room: while the holes of each of two benches stray less than its room,
# the two do not touch. A bench that leaves its room is loud, and a pair can touch only if one of the two is loud. A
# bench that touches another in its nominal place has no room, and is always loud.

# Columns of the play of a bench: of its front hole and of its rear hole from their pins [m].
FRONT_X = 0
FRONT_Y = 1
REAR_X = 2
REAR_Y = 3


class Wobbler:
    """A dragon in which people wobble.

    sizes: (benches + 1, SIZE_COLUMNS); boxes: (benches + 1, BOX_COLUMNS) scratch
    lateral, forward: sizes of what people want [m]; along: see above [1]; all 0 until they are set
    loud: (2 benches + 2,) scratch: of every bench, then of every block of them
    chain: (benches + 1, UY + 1), the benches as last laid out: rows of a chain without what follows UY, which would
        crowd the cache
    first, second: the pair found last; furthest: how far any hole has been from its place since that was set to 0 [m]
    """

    def __init__(self, sizes, halt, chain, boxes, loud):
        self.sizes = sizes
        self.lateral = self.forward = self.along = 0.0
        self.halt = halt
        self.chain = chain
        self.boxes = boxes
        self.loud = loud
        self.benches = sizes.shape[0] - 1
        self.first = self.second = 0
        self.furthest = 0.0

    def dance(self, memory, numbers, play, places, tangents, rooms, state):
        """How many instants come before the first at which two benches touch; all of them if none do.

        memory: (T,) of each instant for the one before [1]; numbers: (T, benches + 1, 2) new ones; play: (benches, 4)
        [m]; places, tangents: (T, benches + 1, 2) nominal; rooms: (T, benches) [m]; state: (benches + 1, 2) z and z'
        """
        with cython.nogil:
            for t in range(memory.shape[0]):
                if self.halt.stopped:
                    return t
                self.stand(t, memory[t], numbers, places, tangents, state)
                if self.hang(t, play, places, rooms) and self.touching():
                    return t
        return memory.shape[0]

    def stand(self, t, memory, numbers, places, tangents, state):
        """Lets every person go on to the next instant: `state`, and in the chain where they want to stand."""
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
        """Hangs every bench on the one before, where people want to stand if they can; is any bench loud?"""
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
        """Do two benches touch, one of them loud, as the chain is laid out? They are `first` and `second`."""
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
        """Does a bench of block a touch one of block b, one of the two loud?

        Most pairs are apart along the face of the first: that is tried here, as calls of other modules cost more.
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
                if pair_gap_within(bench_of(i, sizes, chain), bench_of(j, sizes, chain), 0.0) <= 0.0:
                    self.first = i
                    self.second = j
                    return True
        return False

    def measure(self, most, gains, places, rooms):
        """Fill in the room of every bench (T, benches) at every instant, at most so much [m]; negative without any.

        gains: (benches,) how far a point of a bench goes at most where both of its holes go 1 m [1]
        places: (T, benches + 1, 2) nominal [m]
        Benches i and j with a gap g cannot touch while holes of i and of j stray less than g / (gains_i + gains_j).
        """
        chain: cython.double[:, ::1] = self.chain
        with cython.nogil:
            for t in range(places.shape[0]):
                if self.halt.stopped:
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
        """Give benches i and j no more room than they have between them."""
        chain: cython.double[:, ::1] = self.chain
        both = gains[i] + gains[j]
        dx = chain[j, MX] - chain[i, MX]
        dy = chain[j, MY] - chain[i, MY]
        far = self.sizes[i, RADIUS] + self.sizes[j, RADIUS] + both * most
        if dx * dx + dy * dy <= far * far:
            room = pair_gap(bench_of(i, self.sizes, chain), bench_of(j, self.sizes, chain)) / both - ROOM_ROUNDING
            rooms[t, i] = min(rooms[t, i], room)
            rooms[t, j] = min(rooms[t, j], room)


# Benches that are so much apart along a face are apart, whatever rounding does [m].
APART = 1e-9
# What rooms and strays may be off by, far above the rounding of places up to 1e4 m [m].
ROOM_ROUNDING = 1e-9
