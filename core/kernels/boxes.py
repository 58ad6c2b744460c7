"""Broad phase: which rectangles may touch, by a tree of upright boxes."""

import cython

if not cython.compiled:  # the .pxd imports the same names for the compiler
    from core.kernels.constants import *
    from core.kernels.rectangles import rows_gap_within

# Broad phase. The rectangles' upright boxes are ordered so that neighbours in the list lie near each other, and hang in
# fours from a complete binary tree: node 1 is the root, node k has the children 2 k and 2 k + 1, node leaves + k holds
# rows 4 k to 4 k + 3. The walk needs no stack: where the node's box is met it goes down to 2 k, elsewhere on to k + 1,
# and up while that is a left child (even), because its parent has the same first leaf. The walk of row i starts at the
# row's own leaf: it meets every later row once, and so finds every pair whose boxes meet.
BOXES_PER_LEAF = 4
LEAF = BOXES_PER_LEAF


def boxes_meet(a, i, b, j):
    """Whether row i of a and row j of b, both of columns X_LOW to Y_HIGH, meet or touch."""
    return (
        a[i, X_LOW] <= b[j, X_HIGH]
        and b[j, X_LOW] <= a[i, X_HIGH]
        and a[i, Y_LOW] <= b[j, Y_HIGH]
        and b[j, Y_LOW] <= a[i, Y_HIGH]
    )


def grow_tree(boxes, tree):
    """Fill the tree over the boxes.

    boxes: (n, BOX_COLUMNS); tree: (2 leaves, BOX_COLUMNS), leaves a power of two >= n / 4
    """
    leaves = tree.shape[0] // 2
    with cython.nogil:
        for k in range(tree.shape[0]):
            tree[k, X_LOW] = tree[k, Y_LOW] = NO_LIMIT
            tree[k, X_HIGH] = tree[k, Y_HIGH] = -NO_LIMIT
        for i in range(boxes.shape[0]):
            widen(tree, leaves + i // LEAF, boxes, i)
        for k in range(tree.shape[0] - 1, 1, -1):
            widen(tree, k // 2, tree, k)


def widen(tree, k, boxes, i):
    """Widen node k so that it holds box i."""
    tree[k, X_LOW] = min(tree[k, X_LOW], boxes[i, X_LOW])
    tree[k, Y_LOW] = min(tree[k, Y_LOW], boxes[i, Y_LOW])
    tree[k, X_HIGH] = max(tree[k, X_HIGH], boxes[i, X_HIGH])
    tree[k, Y_HIGH] = max(tree[k, Y_HIGH], boxes[i, Y_HIGH])


# Input:  the tree and its boxes; which pairs count (margin, exact, chained); when to stop (most_...).
# State:  i, the row whose walk it is; k, the node that the walk has come to.
# Output: pairs as far as there is room, the number of pairs found, and the number of boxes met.
class Meetings:
    """Which of many rectangles come near each other.

    frames: (n, FRAME_COLUMNS), boxes: (n, BOX_COLUMNS), order: (n,), all in the tree's order; `order` holds the number
        of the rectangle in each row; tree: as grow_tree() fills it
    budget: ends find() before it is done
    count, met: number of pairs that find() found, and of boxes that it met
    """

    def __init__(self, frames, boxes, tree, order, budget):
        self.frames = frames
        self.boxes = boxes
        self.tree = tree
        self.order = order
        self.budget = budget
        self.pairs = None
        self.count = self.met = 0

    def find(self, margin, exact, chained, most_pairs, most_met, pairs):
        """Fill in pairs (capacity, 2), a < b, whose boxes meet; with exact, only those within the margin.

        chained: leave out pairs of consecutive numbers; most_pairs, most_met: find() stops when it exceeds one of them
        """
        # Local, because a view that belongs to an object, or is passed on, costs a third more time.
        boxes: cython.double[:, ::1] = self.boxes
        tree: cython.double[:, ::1] = self.tree
        leaves = tree.shape[0] // 2
        self.pairs = pairs
        self.count = self.met = 0
        with cython.nogil:
            for i in range(boxes.shape[0]):
                if self.count > most_pairs or self.met > most_met or self.budget.stopped:
                    break
                k = leaves + i // LEAF
                while True:
                    if boxes_meet(tree, k, boxes, i):
                        if k < leaves:
                            k = 2 * k
                            continue
                        first = (k - leaves) * LEAF
                        last = min(first + LEAF, boxes.shape[0])
                        for j in range(max(first, i + 1), last):
                            if boxes_meet(boxes, i, boxes, j):
                                self.met += 1
                                self.note(i, j, margin, exact, chained)
                    k += 1
                    while k % 2 == 0:
                        k = k // 2
                    if k == 1:
                        break

    def note(self, i, j, margin, exact, chained):
        """Add the pair of rows i and j if it counts."""
        a = self.order[i] if self.order[i] < self.order[j] else self.order[j]
        b = self.order[j] if self.order[i] < self.order[j] else self.order[i]
        if chained and b - a == 1:
            return
        if exact and rows_gap_within(i, j, margin, self.frames) > margin:
            return
        if self.count < self.pairs.shape[0]:
            self.pairs[self.count, PAIR_A] = a
            self.pairs[self.count, PAIR_B] = b
        self.count += 1
