"""The clearance at an instant, and the travel at which a gap closes or stops closing."""

import cython

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.chain import place_chain
    from core.kernels.constants import *
    from core.kernels.hulls import hulls_met, nearest_hulls
    from core.kernels.records import Closest, Pair
    from core.kernels.rectangles import bench_gap_within, row_separation


def at_rest(scene, j):
    """Whether a row holds an edge at rest."""
    return scene.edges > 0 and j > scene.room


def row_gap(scene, i, j, chain):
    """Separation of benches i and j of a chain, or of a bench and an edge at rest [m]."""
    return row_gap_within(scene, i, j, NO_LIMIT, chain)


# Part of the lengths by which a limit is raised, so that rounding decides nothing about pairs at the limit itself [1]:
# far above the few roundings of a separation.
LIMIT_ROUNDING = 1e-12


def row_gap_within(scene, i, j, limit, chain):
    """row_gap() where that is at most limit; elsewhere a value between limit and row_gap() [m]."""
    raised = limit + LIMIT_ROUNDING * (limit + scene.sizes[i, RADIUS] + scene.sizes[j, RADIUS])
    gap = bench_gap_within(i, j, raised, scene.sizes, chain)
    if scene.kinds.some and gap < limit:
        return nearest_hulls(scene.kinds, i, j, at_rest(scene, j), limit, scene.sizes, chain).gap
    return gap


def meet(scene, i, j, chain):
    """Fill the witnesses of a scene for benches i and j of a chain."""
    if scene.kinds.some:
        hulls_met(scene.kinds, i, j, at_rest(scene, j), scene.sizes, chain, scene.met)
    else:
        row_separation(i, j, scene.sizes, chain, scene.met)


# Number of consecutive benches that share one upright box, so that most distant pairs are skipped together [1].
BLOCK = 8


def block_boxes(benches, sizes, chain, boxes):
    """Fill in the box around every block of benches, columns X_LOW to Y_HIGH [m]; returns the number of blocks."""
    blocks = (benches + BLOCK - 1) // BLOCK
    for block in range(blocks):
        boxes[block, X_LOW] = boxes[block, Y_LOW] = FREE
        boxes[block, X_HIGH] = boxes[block, Y_HIGH] = -FREE
        for k in range(block * BLOCK, block * BLOCK + BLOCK if block + 1 < blocks else benches):
            boxes[block, X_LOW] = min(boxes[block, X_LOW], chain[k, MX] - sizes[k, RADIUS])
            boxes[block, X_HIGH] = max(boxes[block, X_HIGH], chain[k, MX] + sizes[k, RADIUS])
            boxes[block, Y_LOW] = min(boxes[block, Y_LOW], chain[k, MY] - sizes[k, RADIUS])
            boxes[block, Y_HIGH] = max(boxes[block, Y_HIGH], chain[k, MY] + sizes[k, RADIUS])
    return blocks


def boxes_apart(a, b, within, boxes):
    """Whether the boxes of two blocks are further apart than `within` [m]."""
    dx = max(boxes[b, X_LOW] - boxes[a, X_HIGH], boxes[a, X_LOW] - boxes[b, X_HIGH], 0.0)
    dy = max(boxes[b, Y_LOW] - boxes[a, Y_HIGH], boxes[a, Y_LOW] - boxes[b, Y_HIGH], 0.0)
    return dx * dx + dy * dy > within * within


def beyond_box(i, b, within, boxes, chain):
    """Whether the centre of row i is further than `within` [m] from the box of a block."""
    dx = max(boxes[b, X_LOW] - chain[i, MX], chain[i, MX] - boxes[b, X_HIGH], 0.0)
    dy = max(boxes[b, Y_LOW] - chain[i, MY], chain[i, MY] - boxes[b, Y_HIGH], 0.0)
    return dx * dx + dy * dy > within * within


def least_with(scene, i, first, end, best, chain):
    """The nearer pair: `best`, or row i with the nearest of the rows from first to end - 1."""
    for j in range(first, end):
        dx = chain[j, MX] - chain[i, MX]
        dy = chain[j, MY] - chain[i, MY]
        far = scene.sizes[i, RADIUS] + scene.sizes[j, RADIUS] + max(best.gap, 0.0)
        if dx * dx + dy * dy <= far * far:
            gap = row_gap_within(scene, i, j, best.gap, chain)
            if gap < best.gap:
                best = Closest(gap, i, j)
    return best


# Input:  a chain up to handle `handles`, and the number of benches that lead pairs (`active`).
# State:  the nearest pair so far; upright boxes around blocks of BLOCK benches, of which far ones are skipped.
# Output: the record Closest.
def row_clearance(scene, active, handles, best, chain, boxes):
    """Least separation among the pairs led by the first `active` benches, and that pair.

    handles: the last handle of the chain; best: the separation of one of these pairs, if known; boxes: scratch of at
        least (handles / BLOCK, BOX_COLUMNS)
    On a spiral radii r grow from handle to handle. No point of a bench is further in than its front handle's r less two
    of the largest half diagonals, nor further out than its rear handle's r plus one: benches far enough out are
    skipped.
    """
    growth = scene.curve.growth
    if scene.edges > 0:  # they follow the last handle's row, which holds no bench
        for i in range(active):
            if scene.budget.stopped:
                break
            best = least_with(scene, i, scene.room + 1, scene.room + 1 + scene.edges, best, chain)
        return best
    if scene.copies > 1:
        return clearance_between(scene, active, handles, best, chain)
    if active > 0:  # a first value to compare with
        best = least_with(scene, 0, scene.between + 1, handles, best, chain)
    blocks = block_boxes(handles, scene.sizes, chain, boxes)
    widest = 0.0
    for i in range(handles):
        widest = max(widest, scene.sizes[i, RADIUS])
    for a in range((active + BLOCK - 1) // BLOCK):
        if scene.budget.stopped:
            break
        reach = growth * chain[min(a * BLOCK + BLOCK, handles), THETA] + 3.0 * widest
        for b in range(a, blocks):
            if scene.curve.is_spiral and growth * chain[b * BLOCK, THETA] > reach + max(best.gap, 0.0):
                break
            if boxes_apart(a, b, max(best.gap, 0.0), boxes):
                continue
            for i in range(a * BLOCK, min(a * BLOCK + BLOCK, active)):
                if not beyond_box(i, b, scene.sizes[i, RADIUS] + max(best.gap, 0.0), boxes, chain):
                    first = max(i + scene.between + 1, b * BLOCK)
                    best = least_with(scene, i, first, min(b * BLOCK + BLOCK, handles), best, chain)
    return best


def clearance_between(scene, active, handles, best, chain):
    """row_clearance() among the dragon and its copies."""
    scene.copy_chain(handles, chain)
    for i in range(active):
        if scene.budget.stopped:
            break
        for row in range(scene.stride, scene.copies * scene.stride):
            if i <= row % scene.stride < handles:
                best = least_with(scene, i, row, row + 1, best, chain)
    return best


def clearance_left(scene, leaders, benches, chain, moved):
    """Least separation, less the ways of both benches, of all pairs led by the first `leaders` benches [m].

    moved: (benches,) the way that each bench still moves [m], an edge at rest none; returns FREE without pairs
    """
    sizes: cython.double[:, ::1] = scene.sizes
    best = FREE
    for i in range(leaders):
        if scene.budget.stopped:
            break
        first = scene.room + 1 if scene.edges > 0 else i + scene.between + 1
        end = first + scene.edges if scene.edges > 0 else benches
        for j in range(first, end):
            way = moved[i] if scene.edges > 0 else moved[i] + moved[j]
            dx = chain[j, MX] - chain[i, MX]
            dy = chain[j, MY] - chain[i, MY]
            far = sizes[i, RADIUS] + sizes[j, RADIUS] + way + best
            if far > 0.0 and dx * dx + dy * dy <= far * far:
                best = min(best, row_gap(scene, i, j, chain) - way)
    return best


def clearance_at(scene, place, benches, leaders, chain, boxes):
    """Clearance over all pairs led by the first `leaders` benches with the head at a place [m], and the nearest pair.

    benches: number of benches to lay out; chain, boxes: scratch; returns FREE without pairs, or where the chain folds
    """
    if place_chain(scene.curve, place, benches, scene.sizes, chain) == FOLDED:
        return FREE, 0, 0
    scene.turn_edges(chain)
    best = row_clearance(scene, leaders, benches, Closest(FREE, 0, 0), chain, boxes)
    return best.gap, best.first, best.second


def last_handle(scene, a, b):
    """Number of the last handle that benches a and b need, or bench a and the edge at rest in row b."""
    if scene.copies > 1:
        return max(a, b % scene.stride) + 1
    return b + 1 if b < scene.room else a + 1


def gap_at(scene, place, a, b, chain):
    """Separation of bench a from bench b, or from edge at rest b, with the head at a place [m]; FREE at a fold."""
    if place_chain(scene.curve, place, last_handle(scene, a, b), scene.sizes, chain) == FOLDED:
        return FREE
    scene.turn_edges(chain)
    scene.copy_chain(last_handle(scene, a, b), chain)
    return row_gap(scene, a, b, chain)


def gap_rate_at(scene, place, a, b, chain):
    """Rate at which benches a and b part per metre of head travel: normal . (velocity of witness b - of witness a) [1].

    The velocity of a bench's centre is the mean of its handles'; it turns at omega = u x (a' T_a - b' T_b) / chord.
    """
    if place_chain(scene.curve, place, last_handle(scene, a, b), scene.sizes, chain) == FOLDED:
        return 0.0
    scene.turn_edges(chain)
    scene.copy_chain(last_handle(scene, a, b), chain)
    meet(scene, a, b, chain)
    rate = -speed_along(scene, a, scene.met.ax, scene.met.ay, chain)
    if not at_rest(scene, b):
        rate += speed_along(scene, b, scene.met.bx, scene.met.by, chain)
    return rate


def speed_along(scene, k, x, y, chain):
    """Speed of a point of bench k along the normal of the last pair met, per metre of head travel [1]."""
    vx = chain[k, RATE] * chain[k, TX] - chain[k + 1, RATE] * chain[k + 1, TX]
    vy = chain[k, RATE] * chain[k, TY] - chain[k + 1, RATE] * chain[k + 1, TY]
    omega = (chain[k, UX] * vy - chain[k, UY] * vx) / scene.sizes[k, CHORD]
    vx = 0.5 * (chain[k, RATE] * chain[k, TX] + chain[k + 1, RATE] * chain[k + 1, TX])
    vy = 0.5 * (chain[k, RATE] * chain[k, TY] + chain[k + 1, RATE] * chain[k + 1, TY])
    vx -= omega * (y - chain[k, MY])
    vy += omega * (x - chain[k, MX])
    return scene.met.nx * vx + scene.met.ny * vy


def contact_between(scene, low, high, a, b, width, chain):
    """Head travel in [low, high] at which a and b come within the margin [m]: apart at low, within it at high."""
    return crossing(scene, low, high, Pair(a, b), width, False, chain)


def bottom_between(scene, low, high, a, b, width, chain):
    """Head travel in [low, high] at which a and b stop approaching [m]; they approach at low and part at high."""
    return crossing(scene, low, high, Pair(a, b), width, True, chain)


# Input:  a bracket [low, high] of travels, and a function that is positive at low and negative at high.
# State:  the bracket; `above` and `below`, the function at its ends, halved where an end stays; `last`, the end that
#         moved last.
# Output: the upper end of a bracket no wider than `width`.
def crossing(scene, low, high, pair, width, of_rate, chain):
    """Travel at which the gap of a pair less the margin, or (of_rate) the rate at which it closes, falls to 0 [m].

    Within `width`, unless 100 rounds do not suffice or the budget is stopped.
    Method: the Illinois form of the false position, with a bisection now and then.
    """
    above = 1.0
    below = -1.0
    last = 0
    if not of_rate:
        above = gap_at(scene, scene.place - low, pair.first, pair.second, chain) - scene.margin
        below = gap_at(scene, scene.place - high, pair.first, pair.second, chain) - scene.margin
    for i in range(100):
        if high - low <= width or scene.budget.stopped:
            break
        middle = low + (high - low) * above / (above - below)
        if not (low < middle < high) or i % 4 == 3:
            middle = 0.5 * (low + high)
        if of_rate:
            value = -gap_rate_at(scene, scene.place - middle, pair.first, pair.second, chain)
        else:
            value = gap_at(scene, scene.place - middle, pair.first, pair.second, chain) - scene.margin
        if value > 0.0:
            low = middle
            above = value
            if last == 1:
                below *= 0.5
            last = 1
        else:
            high = middle
            below = value
            if last == -1:
                above *= 0.5
            last = -1
    return high
