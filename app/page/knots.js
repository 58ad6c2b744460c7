/** Points that make a given path, so that a path of lines and arcs can be edited like a drawn one. */

/** Turn of the path between two samples at which it still is straight [rad], and the shortest straight leg [m]. */
const [STRAIGHT, LEG] = [1e-6, 2];
/** Turn [rad] and length [m] of the curve between two points. */
const [TURN, LENGTH] = [Math.PI / 5, 15];
const DECIMALS = 2;
/** Turn of one corner at most [rad], with room for rounding; distance at which two of them are the same [m]. */
const [CORNER, SAME] = [Math.PI / 2 + 1e-3, 0.05];

const rounded = (number) => Number(number.toFixed(DECIMALS));
const wrapped = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

/** Corners of the tangents around an arc, whose rounding is the arc. */
function around({ centre, radius, start_angle: first, sweep }) {
  const count = Math.ceil(Math.abs(sweep) / CORNER);
  const half = sweep / count / 2;
  return Array.from({ length: count }, (_, k) => polar(centre, first + (2 * k + 1) * half, radius / Math.cos(half)));
}

const polar = ([x, y], angle, radius) => [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];

/**
 * {points, straight, radius} of straight legs whose rounded corners are the arcs of a path: four of them make a ring, and
 * its laps share them. null for a path that has other pieces than lines and arcs
 */
export function cornersOf({ pieces }) {
  if (pieces.some(({ kind }) => kind !== "line" && kind !== "arc")) return null;
  const endOf = (piece, isLast) => (piece.kind === "line" ? piece[isLast ? "end" : "start"] : polar(piece.centre, piece.start_angle + (isLast ? piece.sweep : 0), piece.radius));
  const all = [endOf(pieces[0], false), ...pieces.flatMap((piece) => (piece.kind === "arc" ? around(piece) : [])), endOf(pieces.at(-1), true)];
  const points = [];
  for (const point of all) points.push(points.find(([x, y]) => Math.hypot(x - point[0], y - point[1]) < SAME) ?? point.map(rounded));
  return { points, straight: points.slice(1).map((_, k) => k), radius: rounded(Math.max(...pieces.map(({ radius = 0 }) => radius))) };
}

/** {points, straight} of a path sampled at equal distances, as by /course: {x, y} [m]. turn, length: of the curve between two points at most [rad], [m] */
export function knotsOf({ x, y }, turn = TURN, length = LENGTH) {
  const last = x.length - 1;
  const ways = Array.from({ length: last }, (_, k) => [x[k + 1] - x[k], y[k + 1] - y[k]]);
  const headings = ways.map(([dx, dy]) => Math.atan2(dy, dx));
  const turns = headings.map((heading, k) => (k ? Math.abs(wrapped(heading - headings[k - 1])) : 0));
  const step = Math.hypot(...ways[0]);
  const samples = [0];
  const straight = [];
  for (let k = 0; k < last; ) {
    const isLine = (at) => at + 1 < last && turns[at + 1] < STRAIGHT;
    let end = k + 1;
    while (isLine(end - 1)) end += 1;
    if ((end - k) * step >= LEG) {
      if (samples.at(-1) !== k) samples.push(k);
      straight.push(samples.length - 1);
      samples.push(end);
      k = end;
      continue;
    }
    // A curve up to the next line, in parts of equal turn and length.
    const begin = k;
    const lengthOfLine = (at) => {
      let far = at + 1;
      while (isLine(far - 1)) far += 1;
      return (far - at) * step;
    };
    while (k < last && lengthOfLine(k) < LEG) k += 1;
    const weights = Array.from({ length: k - begin }, (_, at) => (begin + at > 0 ? turns[begin + at] : 0) / turn + step / length);
    const total = weights.reduce((a, b) => a + b, 0);
    const parts = Math.max(Math.ceil(total), 1);
    if (samples.at(-1) !== begin) samples.push(begin);
    let sum = 0;
    let next = 1;
    weights.forEach((weight, at) => {
      sum += weight;
      if (next < parts && sum >= (next * total) / parts) {
        samples.push(begin + at + 1);
        next += 1;
      }
    });
    if (samples.at(-1) !== k) samples.push(k);
  }
  return { points: samples.map((k) => [x[k], y[k]].map(rounded)), straight };
}
