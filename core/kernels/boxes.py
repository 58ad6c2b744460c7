"""Broad phase: which rectangles may touch, by a tree of upright boxes."""

import cython

if not cython.compiled:  # for the compiler the same stands in the .pxd
    from core.kernels.constants import *
    from core.kernels.rectangles import pair_gap_within

# Broad phase: the rectangles' upright boxes, ordered so that neighbours in the list lie near each other, hang in
# fours from a complete binary tree: node 1 is the root, node k has the children 2 k and 2 k + 1, node leaves + k
# holds rows 4 k to 4 k + 3. A walk that needs no stack: down to 2 k where the node's box is met, else on to k + 1
# and up while that is a left child (even), for its parent has the same first leaf. Starting row i's walk at its
# own leaf meets every later row once, and every pair whose boxes meet.
BOXES_PER_LEAF = 4
LEAF = BOXES_PER_LEAF


def boxes_meet(a, i, b, j):
    """Whether row i of a and row j of b, both x low, y low, x high, y high, meet or touch."""
    return a[i, 0] <= b[j, 2] and b[j, 0] <= a[i, 2] and a[i, 1] <= b[j, 3] and b[j, 1] <= a[i, 3]


def grow_tree(boxes, tree):
    """Fill the tree over the boxes. boxes: (n, 4); tree: (2 leaves, 4), leaves a power of two >= n / 4."""
    leaves = tree.shape[0] // 2
    with cython.nogil:
        for k in range(tree.shape[0]):
            tree[k, 0] = tree[k, 1] = NO_LIMIT
            tree[k, 2] = tree[k, 3] = -NO_LIMIT
        for i in range(boxes.shape[0]):
            widen(tree, leaves + i // LEAF, boxes, i)
        for k in range(tree.shape[0] - 1, 1, -1):
            widen(tree, k // 2, tree, k)


def widen(tree, k, boxes, i):
    """Widen node k so that it holds box i."""
    for axis in range(2):
        if boxes[i, axis] < tree[k, axis]:
            tree[k, axis] = boxes[i, axis]
        if boxes[i, axis + 2] > tree[k, axis + 2]:
            tree[k, axis + 2] = boxes[i, axis + 2]


def meeting_pairs(frames, boxes, tree, order, margin, exact, chained, limits, pairs, counts):
    """Pairs whose boxes meet; with exact, only those whose separation is at most the margin.

    frames (n, 6), boxes (n, 4), order (n,): rows in the tree's order, and each row's own number
    chained: leave out pairs of consecutive numbers
    limits: (2,) the search stops once it has found more pairs, or met more boxes, than these
    pairs: (capacity, 2), a < b, filled as far as it goes; counts: (2,) pairs found and boxes met
    """
    leaves = tree.shape[0] // 2
    capacity = pairs.shape[0]
    found = 0
    met = 0
    with cython.nogil:
        for i in range(boxes.shape[0]):
            if found > limits[0] or met > limits[1]:
                break
            k = leaves + i // LEAF
            while True:
                if boxes_meet(tree, k, boxes, i):
                    if k < leaves:
                        k = 2 * k
                        continue
                    j = (k - leaves) * LEAF
                    last = j + LEAF if j + LEAF < boxes.shape[0] else boxes.shape[0]
                    if j <= i:
                        j = i + 1
                    while j < last:
                        if boxes_meet(boxes, i, boxes, j):
                            met += 1
                            a = order[i] if order[i] < order[j] else order[j]
                            b = order[j] if order[i] < order[j] else order[i]
                            if not (chained and b - a == 1) and (not exact or rows_gap(frames, i, j, margin) <= margin):
                                if found < capacity:
                                    pairs[found, 0] = a
                                    pairs[found, 1] = b
                                found += 1
                        j += 1
                k += 1
                while k % 2 == 0:
                    k = k // 2
                if k == 1:
                    break
    counts[0] = found
    counts[1] = met


def rows_gap(frames, i, j, limit):
    """pair_gap_within() of two rows of frames."""
    return pair_gap_within(
        frames[i, 0], frames[i, 1], frames[i, 2], frames[i, 3], frames[i, 4], frames[i, 5],
        frames[j, 0], frames[j, 1], frames[j, 2], frames[j, 3], frames[j, 4], frames[j, 5],
        limit,
    )  # fmt: skip
