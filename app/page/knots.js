/** Points through which a curve follows a given path, so that a path of lines and arcs can be edited like a drawn one. */

/** Turn of the path between two samples at which it still is straight [rad], and the shortest straight leg [m]. */
const [STRAIGHT, LEG] = [1e-6, 2];
/** Turn [rad] and length [m] of the curve between two points. */
const [TURN, LENGTH] = [Math.PI / 5, 15];
const DECIMALS = 2;

const wrapped = (angle) => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));

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
  return { points: samples.map((k) => [Number(x[k].toFixed(DECIMALS)), Number(y[k].toFixed(DECIMALS))]), straight };
}
