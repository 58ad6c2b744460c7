"""The text of a QR code, read independently of the page that draws it: level L, mask 0, bytes (ISO/IEC 18004)."""

# Codewords of error correction in a block and number of blocks, by version (table 9, level L).
LAYOUT = {1: (7, 1), 2: (10, 1), 3: (15, 1), 4: (20, 1), 5: (26, 1), 6: (18, 2), 7: (20, 2), 8: (24, 2), 9: (30, 2)}
LAYOUT |= {10: (18, 4), 11: (20, 4), 12: (24, 4), 13: (26, 4), 14: (30, 4), 15: (22, 6), 16: (24, 6), 17: (28, 6)}
# Middles of the alignment patterns, by version (table E.1).
MIDDLES = {2: [6, 18], 3: [6, 22], 4: [6, 26], 5: [6, 30], 6: [6, 34], 7: [6, 22, 38], 8: [6, 24, 42], 9: [6, 26, 46]}
MIDDLES |= {10: [6, 28, 50], 11: [6, 30, 54], 12: [6, 32, 58], 13: [6, 34, 62], 14: [6, 26, 46, 66]}
MIDDLES |= {15: [6, 26, 48, 70], 16: [6, 26, 50, 74], 17: [6, 30, 54, 78]}
LEVEL_L_MASK_0 = "111011111000100"
FIELD = 0x11D


def _times(a, b):
    """Product in GF(256), bit by bit."""
    product = 0
    for bit in range(8):
        product ^= (a << bit) * (b >> bit & 1)
    for bit in range(14, 7, -1):
        product ^= (FIELD << bit - 8) * (product >> bit & 1)
    return product


def _is_whole(block, checks):
    """True if the block is zero at the first powers of 2, as an undamaged block is."""
    point = 1
    for _ in range(checks):
        value = 0
        for word in block:
            value = _times(value, point) ^ word
        if value:
            return False
        point = _times(point, 2)
    return True


def read_qr(rows):
    """Its text. rows: the modules, True where dark, without a light edge; raises: AssertionError for a damaged code"""
    size = len(rows)
    version = (size - 17) // 4
    middles, corners = MIDDLES.get(version, []), ((6, 6), (6, size - 7), (size - 7, 6))
    patterns = [(a, b) for a in middles for b in middles if (a, b) not in corners]

    def is_fixed(x, y):
        """Whether a module holds a pattern, the version or the format instead of the text."""
        at_corner = (x < 9 and y < 9) or (x > size - 9 and y < 9) or (x < 9 and y > size - 9)
        is_version = version > 6 and min(x, y) < 6 and max(x, y) > size - 12
        in_pattern = any(abs(x - a) < 3 and abs(y - b) < 3 for a, b in patterns)
        return at_corner or is_version or in_pattern or 6 in (x, y)

    along = [0, 1, 2, 3, 4, 5, 7, 8]
    written = [rows[8][x] for x in along] + [rows[y][8] for y in reversed(along[:-1])]
    assert "".join("01"[one] for one in written) == LEVEL_L_MASK_0
    bits = []
    columns = [x for x in range(size - 1, 0, -2) if x > 6] + [5, 3, 1]
    for k, right in enumerate(columns):
        for y in range(size) if k % 2 else reversed(range(size)):
            bits += [rows[y][x] ^ ((x + y) % 2 == 0) for x in (right, right - 1) if not is_fixed(x, y)]
    words = [int("".join("01"[one] for one in bits[k : k + 8]), 2) for k in range(0, len(bits) - 7, 8)]
    checks, count = LAYOUT[version]
    room = len(words) - checks * count
    blocks = [[] for _ in range(count)]
    shorter = count - room % count
    turns = [k for _ in range(room // count) for k in range(count)] + list(range(shorter, count))[: room % count]
    for k, word in zip([*turns, *(k % count for k in range(checks * count))], words, strict=True):
        blocks[k].append(word)
    assert all(_is_whole(block, checks) for block in blocks)
    stream = "".join(f"{word:08b}" for block in blocks for word in block[:-checks])
    width = 8 if version < 10 else 16
    assert stream[:4] == "0100"
    length = int(stream[4 : 4 + width], 2)
    start = 4 + width
    return bytes(int(stream[start + 8 * k : start + 8 * k + 8], 2) for k in range(length)).decode()
