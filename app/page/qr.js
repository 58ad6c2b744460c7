/**
 * A text as a QR code (ISO/IEC 18004:2015): bytes, error correction L, the smallest of versions 1 to 25 that holds it.
 *
 * Bits of the text fill codewords; those are split into blocks, each followed by the remainder of its polynomial over
 * GF(256), and written interleaved in columns of two from the lower right, around the fixed patterns.
 */

/** Codewords of error correction in a block, and number of blocks, at level L for each version (table 9). */
const CHECKS = [7, 10, 15, 20, 26, 18, 20, 24, 30, 18, 20, 24, 26, 30, 22, 24, 28, 30, 28, 28, 28, 28, 30, 30, 26];
const BLOCKS = [1, 1, 1, 1, 1, 2, 2, 2, 2, 4, 4, 4, 4, 4, 6, 6, 6, 6, 7, 8, 8, 9, 9, 10, 12];
/** The field polynomial of GF(256), and the generators of the codes of format and version, with the mask of the format. */
const [FIELD, FORMAT, FORMAT_MASK, VERSION] = [0x11d, 0x537, 0x5412, 0x1f25];
const BYTES = 0b0100;
const LEVEL_L = 0b01;
const PADDING = [0xec, 0x11];

const [POWERS, LOGS] = [new Array(510), new Array(256)];
for (let k = 0, one = 1; k < 255; k++, one = (one << 1) ^ (one > 127 ? FIELD : 0)) {
  POWERS[k] = POWERS[k + 255] = one;
  LOGS[one] = k;
}
const product = (a, b) => (a && b ? POWERS[LOGS[a] + LOGS[b]] : 0);

/** The codewords that correct errors in a block. count: how many */
function checksOf(block, count) {
  let generator = [1];
  for (let k = 0; k < count; k++) {
    const next = [...generator, 0];
    generator.forEach((one, at) => (next[at + 1] ^= product(one, POWERS[k])));
    generator = next;
  }
  const rest = [...block, ...new Array(count).fill(0)];
  for (let k = 0; k < block.length; k++) {
    const lead = rest[k];
    generator.forEach((one, at) => (rest[k + at] ^= product(one, lead)));
  }
  return rest.slice(block.length);
}

/** The remainder of a value after which as many bits follow as the generator has, as in the codes of format and version. */
function coded(value, generator) {
  const bits = generator.toString(2).length - 1;
  let rest = value << bits;
  for (let at = rest.toString(2).length; at > bits; at = rest.toString(2).length) rest ^= generator << (at - bits - 1);
  return (value << bits) | rest;
}

/** Places of the middles of the alignment patterns in one direction. */
function alignments(version) {
  if (version === 1) return [];
  const [count, last] = [Math.floor(version / 7) + 2, 4 * version + 10];
  const step = 2 * Math.ceil((last - 6) / (count - 1) / 2);
  return [6, ...Array.from({ length: count - 1 }, (_, k) => last - step * (count - 2 - k))];
}

/** The fixed patterns: rows of true (dark), false, or null where data belong. */
function frame(version) {
  const size = 4 * version + 17;
  const rows = Array.from({ length: size }, () => new Array(size).fill(null));
  const square = (x, y, reach, isDark) => {
    for (let dy = -reach; dy <= reach; dy++) {
      for (let dx = -reach; dx <= reach; dx++) if (rows[y + dy]?.[x + dx] !== undefined) rows[y + dy][x + dx] = isDark(Math.max(Math.abs(dx), Math.abs(dy)));
    }
  };
  for (let k = 8; k < size - 8; k++) rows[6][k] = rows[k][6] = k % 2 === 0;
  for (const [x, y] of [[3, 3], [size - 4, 3], [3, size - 4]]) square(x, y, 4, (ring) => ring !== 2 && ring !== 4);
  const middles = alignments(version);
  for (const x of middles) {
    // Three corners have the large patterns.
    const isCorner = (y) => (x === 6 && (y === 6 || y === size - 7)) || (x === size - 7 && y === 6);
    for (const y of middles) if (!isCorner(y)) square(x, y, 2, (ring) => ring !== 1);
  }
  // Room of the format, and the module that is always dark.
  for (let k = 0; k < 9; k++) {
    for (const [x, y] of [[8, k], [k, 8], ...(k < 8 ? [[8, size - 1 - k], [size - 1 - k, 8]] : [])]) rows[y][x] ??= false;
  }
  rows[size - 8][8] = true;
  if (version >= 7) {
    const bits = coded(version, VERSION);
    for (let k = 0; k < 18; k++) rows[Math.floor(k / 3)][size - 11 + (k % 3)] = rows[size - 11 + (k % 3)][Math.floor(k / 3)] = ((bits >> k) & 1) === 1;
  }
  return rows;
}

/** Mask 0 turns every second module. */
const isTurned = (x, y) => (x + y) % 2 === 0;

function writeFormat(rows) {
  const size = rows.length;
  const bits = coded(LEVEL_L << 3, FORMAT) ^ FORMAT_MASK;
  const bit = (k) => ((bits >> k) & 1) === 1;
  const along = [0, 1, 2, 3, 4, 5, 7, 8];
  for (let k = 0; k < 8; k++) {
    rows[along[k]][8] = rows[8][size - 1 - k] = bit(k);
    if (k < 7) rows[8][along[6 - k] ?? 0] = rows[size - 7 + k][8] = bit(k + 8);
  }
}

/** The codewords of a text: its blocks interleaved, then their checks; null if it is too long. */
function codewords(bytes) {
  for (let version = 1; version <= CHECKS.length; version++) {
    const rows = frame(version);
    const [count, checks] = [BLOCKS[version - 1], CHECKS[version - 1]];
    const total = Math.floor(rows.flat().filter((one) => one === null).length / 8);
    const room = total - count * checks;
    const length = version < 10 ? 8 : 16;
    if (4 + length + 8 * bytes.length > 8 * room) continue;
    const text = [[BYTES, 4], [bytes.length, length], ...[...bytes].map((one) => [one, 8])].map(([value, bits]) => value.toString(2).padStart(bits, "0")).join("");
    const bits = text.padEnd(Math.min(text.length + 4, 8 * room), "0");
    const data = bits.padEnd(8 * Math.ceil(bits.length / 8), "0").match(/.{8}/g).map((one) => parseInt(one, 2));
    for (let k = 0; data.length < room; k++) data.push(PADDING[k % 2]);
    const short = Math.floor(room / count);
    const blocks = Array.from({ length: count }, (_, k) => {
      const from = k * short + Math.max(0, k - (count - (room % count)));
      return data.slice(from, from + short + (k >= count - (room % count) ? 1 : 0));
    });
    const interleaved = (all) => Array.from({ length: Math.max(...all.map((one) => one.length)) }, (_, k) => all.flatMap((one) => (k < one.length ? [one[k]] : []))).flat();
    return { rows, words: [...interleaved(blocks), ...interleaved(blocks.map((one) => checksOf(one, checks)))] };
  }
  return null;
}

/** Rows of the modules of the code, true where dark; null for a text that is too long for one. */
export function qrCode(text) {
  const code = codewords(new TextEncoder().encode(text));
  if (!code) return null;
  const { rows, words } = code;
  const size = rows.length;
  const isFree = rows.map((row) => row.map((one) => one === null));
  let k = 0;
  for (let right = size - 1, up = true; right > 0; right -= 2, up = !up) {
    if (right === 6) right = 5;
    for (let step = 0; step < size; step++) {
      const y = up ? size - 1 - step : step;
      for (const x of [right, right - 1]) {
        if (!isFree[y][x]) continue;
        const bit = ((words[k >> 3] ?? 0) >> (7 - (k & 7))) & 1;
        rows[y][x] = (bit === 1) !== isTurned(x, y);
        k++;
      }
    }
  }
  writeFormat(rows);
  return rows;
}
