"""The clearance at an instant, and where a gap closes or stops closing."""

import cython

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.chain import place_chain
    from core.kernels.constants import *
    from core.kernels.pairs import row_separation
    from core.kernels.rectangles import pair_gap


def row_gap(i, j, sizes, chain):
    """Separation of benches i and j of a chain [m]."""
    return pair_gap(
        chain[i, MX], chain[i, MY], chain[i, UX], chain[i, UY], sizes[i, HALF_LENGTH], sizes[i, HALF_WIDTH],
        chain[j, MX], chain[j, MY], chain[j, UX], chain[j, UY], sizes[j, HALF_LENGTH], sizes[j, HALF_WIDTH],
    )  # fmt: skip


# Benches this many in a row share one upright box, so that most of what is far apart is passed over together.
BLOCK = 8


def block_boxes(benches, sizes, chain, boxes):
    """Box around every block of benches: x from, x to, y from, y to [m]; returns how many there are."""
    blocks = (benches + BLOCK - 1) // BLOCK
    for block in range(blocks):
        boxes[block, 0] = boxes[block, 2] = FREE
        boxes[block, 1] = boxes[block, 3] = -FREE
        for k in range(block * BLOCK, block * BLOCK + BLOCK if block + 1 < blocks else benches):
            boxes[block, 0] = min(boxes[block, 0], chain[k, MX] - sizes[k, RADIUS])
            boxes[block, 1] = max(boxes[block, 1], chain[k, MX] + sizes[k, RADIUS])
            boxes[block, 2] = min(boxes[block, 2], chain[k, MY] - sizes[k, RADIUS])
            boxes[block, 3] = max(boxes[block, 3], chain[k, MY] + sizes[k, RADIUS])
    return blocks


def least_with(i, first, end, best, sizes, chain, pair):
    """The lesser of best and the separations of row i from rows first to end - 1 [m]; the pair, where that is less."""
    for j in range(first, end):
        dx = chain[j, MX] - chain[i, MX]
        dy = chain[j, MY] - chain[i, MY]
        far = sizes[i, RADIUS] + sizes[j, RADIUS] + max(best, 0.0)
        if dx * dx + dy * dy <= far * far:
            far = row_gap(i, j, sizes, chain)
            if far < best:
                best = far
                pair[1] = i
                pair[2] = j
    return best


def row_clearance(growth, active, handles, statics, sizes, chain, boxes, pair):
    """Least separation among the pairs led by the first `active` benches, and that pair [m]; FREE without pairs.

    growth: of the spiral, 0 on a route; boxes: (handles / BLOCK, 4) at least, scratch
    On a spiral radii r grow from handle to handle, and no point of a bench is further in than its r less two of the
    largest half diagonals, nor further out than its rear handle's r and one of them: far enough out all is passed over.
    """
    best = FREE
    b = handles + 1 + (statics if statics >= 0 else -statics)
    for i in range(active):  # the last handle's row holds no bench; after it stand the edges at rest
        best = least_with(i, handles + 1, b, best, sizes, chain, pair)
    if statics < 0:
        return best
    if active > 0:  # a first value to compare with
        best = least_with(0, 2, handles, best, sizes, chain, pair)
    blocks = block_boxes(handles, sizes, chain, boxes)
    widest = 0.0
    for i in range(handles):
        widest = max(widest, sizes[i, RADIUS])
    for a in range((active + BLOCK - 1) // BLOCK):
        reach = growth * chain[min(a * BLOCK + BLOCK, handles), THETA] + 3.0 * widest
        for b in range(a, blocks):
            if growth > 0.0 and growth * chain[b * BLOCK, THETA] > reach + max(best, 0.0):
                break
            dx = max(boxes[b, 0] - boxes[a, 1], boxes[a, 0] - boxes[b, 1], 0.0)
            dy = max(boxes[b, 2] - boxes[a, 3], boxes[a, 2] - boxes[b, 3], 0.0)
            if dx * dx + dy * dy > max(best, 0.0) * max(best, 0.0):
                continue
            for i in range(a * BLOCK, min(a * BLOCK + BLOCK, active)):
                far = sizes[i, RADIUS] + max(best, 0.0)
                dx = max(boxes[b, 0] - chain[i, MX], chain[i, MX] - boxes[b, 1], 0.0)
                dy = max(boxes[b, 2] - chain[i, MY], chain[i, MY] - boxes[b, 3], 0.0)
                if dx * dx + dy * dy <= far * far:
                    first = max(i + 2, b * BLOCK)
                    best = least_with(i, first, min(b * BLOCK + BLOCK, handles), best, sizes, chain, pair)
    return best


def clearance_left(leaders, benches, sizes, chain, moved):
    """The least, over pairs led by the first `leaders` benches, of a separation less what both benches still move [m].

    moved: (benches,) [m]; FREE without pairs
    """
    best = FREE
    for i in range(leaders):
        for j in range(i + 2, benches):
            dx = chain[j, MX] - chain[i, MX]
            dy = chain[j, MY] - chain[i, MY]
            far = sizes[i, RADIUS] + sizes[j, RADIUS] + moved[i] + moved[j] + best
            if far > 0.0 and dx * dx + dy * dy <= far * far:
                best = min(best, row_gap(i, j, sizes, chain) - moved[i] - moved[j])
    return best


def clearance_at(growth, pieces, place, benches, leaders, statics, sizes, chain, boxes, pair):
    """Clearance with the head at a place over all pairs led by the first `leaders` benches [m]; the pair in pair[1],
    pair[2]; FREE without pairs.

    chain: (n + 1, CHAIN_COLUMNS), boxes: (n / BLOCK, 4) scratch; pair[0]: the last handle placed, -1 if the chain folds
    """
    pair[0] = place_chain(growth, pieces, place, benches, sizes, chain)
    if pair[0] < 0:
        return FREE
    return row_clearance(growth if pieces.shape[0] == 0 else 0.0, leaders, benches, statics, sizes, chain, boxes, pair)


def gap_at(growth, pieces, place, benches, a, b, sizes, chain):
    """Separation of bench a and bench (or, beyond the last handle's row, edge at rest) b with the head at a place [m].

    FREE if the chain folds.
    """
    if place_chain(growth, pieces, place, b + 1 if b < benches else a + 1, sizes, chain) < 0:
        return FREE
    return row_gap(a, b, sizes, chain)


def gap_rate_at(growth, pieces, place, benches, a, b, sizes, chain, out):
    """How fast benches a and b part per metre of head travel: normal . (velocity of witness b - of witness a) [1].

    A bench moves with its handles: its centre by their mean, and it turns at omega = u x (a' T_a - b' T_b) / chord.
    """
    rate = 0.0
    if gap_at(growth, pieces, place, benches, a, b, sizes, chain) >= FREE:
        return 0.0
    row_separation(a, b, sizes, chain, out)
    for side in range(2):
        k = b if side else a
        if k > benches:
            continue
        vx = chain[k, RATE] * chain[k, TX] - chain[k + 1, RATE] * chain[k + 1, TX]
        vy = chain[k, RATE] * chain[k, TY] - chain[k + 1, RATE] * chain[k + 1, TY]
        omega = (chain[k, UX] * vy - chain[k, UY] * vx) / sizes[k, CHORD]
        vx = 0.5 * (chain[k, RATE] * chain[k, TX] + chain[k + 1, RATE] * chain[k + 1, TX])
        vy = 0.5 * (chain[k, RATE] * chain[k, TY] + chain[k + 1, RATE] * chain[k + 1, TY])
        vx -= omega * (out[2 + 2 * side] - chain[k, MY])
        vy += omega * (out[1 + 2 * side] - chain[k, MX])
        rate += (2 * side - 1) * (out[5] * vx + out[6] * vy)
    return rate


def crossing(growth, pieces, place, benches, low, high, a, b, margin, tolerance, of_rate, sizes, chain, out):
    """Head travel from a place, in [low, high], at which benches a, b come within the margin, or (of_rate) stop
    approaching [m].

    The Illinois form of the false position with a bisection now and then, until the bracket is below the tolerance;
    its later end. Apart (approaching) at low and within the margin (parting) at high.
    """
    above = 1.0
    below = -1.0
    last = 0
    if not of_rate:
        above = gap_at(growth, pieces, place - low, benches, a, b, sizes, chain) - margin
        below = gap_at(growth, pieces, place - high, benches, a, b, sizes, chain) - margin
    for i in range(100):
        if high - low <= tolerance:
            break
        middle = low + (high - low) * above / (above - below)
        if not (low < middle < high) or i % 4 == 3:
            middle = 0.5 * (low + high)
        if of_rate:
            value = -gap_rate_at(growth, pieces, place - middle, benches, a, b, sizes, chain, out)
        else:
            value = gap_at(growth, pieces, place - middle, benches, a, b, sizes, chain) - margin
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
