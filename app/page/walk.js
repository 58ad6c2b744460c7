/**
 * A path of lines, arcs and coils as a short text, for an address: where it begins, x, y [m] and heading [rad], then a step
 * for each piece: the length of a line [m], radius [m] and sweep [rad] of an arc, pitch [m] and turns at both ends of a coil.
 * Every piece begins where the one before ends, so rounded numbers leave no gap.
 */

/** Decimals of metres, and of angles and turns. */
const [METRES, ANGLES] = [6, 9];
const rounded = (number, decimals) => Number(number.toFixed(decimals));
const TURN = 2 * Math.PI;

/** Place and heading of a coil without rotation about its centre at some turns: {x, y, heading}. */
function onCoil({ pitch, start_turns: first, end_turns: last }, turns) {
  const [cos, sin, growth] = [Math.cos(TURN * turns), Math.sin(TURN * turns), 1 / TURN];
  const [dx, dy] = [growth * cos - turns * sin, growth * sin + turns * cos];
  return { x: pitch * turns * cos, y: pitch * turns * sin, heading: Math.atan2(dy, dx) + (last < first ? Math.PI : 0) };
}

const rotated = ({ x, y }, turn) => [Math.cos(turn) * x - Math.sin(turn) * y, Math.sin(turn) * x + Math.cos(turn) * y];

/** Of each kind of piece: its pose at the beginning, its numbers, and the piece of some numbers from a pose on with the pose at its end. */
const KINDS = {
  line: {
    begin: ({ start: [x, y], end }) => [x, y, Math.atan2(end[1] - y, end[0] - x)],
    numbers: ({ start, end }) => [rounded(Math.hypot(end[0] - start[0], end[1] - start[1]), METRES)],
    from([x, y, heading], [length]) {
      const end = [x + length * Math.cos(heading), y + length * Math.sin(heading)];
      return [{ kind: "line", start: [x, y], end }, [...end, heading]];
    },
  },
  arc: {
    begin: ({ centre: [x, y], radius, start_angle: angle, sweep }) => [x + radius * Math.cos(angle), y + radius * Math.sin(angle), angle + (Math.sign(sweep) * Math.PI) / 2],
    numbers: ({ radius, sweep }) => [rounded(radius, METRES), rounded(sweep, ANGLES)],
    from([x, y, heading], [radius, sweep]) {
      const angle = heading - (Math.sign(sweep) * Math.PI) / 2;
      const [cx, cy] = [x - radius * Math.cos(angle), y - radius * Math.sin(angle)];
      const piece = { kind: "arc", centre: [cx, cy], radius, start_angle: angle, sweep };
      return [piece, [cx + radius * Math.cos(angle + sweep), cy + radius * Math.sin(angle + sweep), heading + sweep]];
    },
  },
  coil: {
    begin(coil) {
      const { x, y, heading } = onCoil(coil, coil.start_turns);
      const [cx, cy] = coil.centre;
      const [dx, dy] = rotated({ x, y }, coil.rotation);
      return [cx + dx, cy + dy, heading + coil.rotation];
    },
    numbers: ({ pitch, start_turns: first, end_turns: last }) => [rounded(pitch, METRES), rounded(first, ANGLES), rounded(last, ANGLES)],
    from([x, y, heading], [pitch, first, last]) {
      const coil = { kind: "coil", pitch, start_turns: first, end_turns: last };
      const rotation = heading - onCoil(coil, first).heading;
      const [begin, end] = [onCoil(coil, first), onCoil(coil, last)];
      const [[bx, by], [ex, ey]] = [rotated(begin, rotation), rotated(end, rotation)];
      const centre = [x - bx, y - by];
      return [{ ...coil, centre, rotation }, [centre[0] + ex, centre[1] + ey, end.heading + rotation]];
    },
  },
};
const BY_COUNT = [null, KINDS.line, KINDS.arc, KINDS.coil];

/** The text of a route; null if it has other pieces. */
export function walkText({ kind, pieces }) {
  if (kind !== "route" || !pieces.length || pieces.some((piece) => !(piece.kind in KINDS))) return null;
  const [x, y, heading] = KINDS[pieces[0].kind].begin(pieces[0]);
  const pose = [rounded(x, METRES), rounded(y, METRES), rounded(heading, ANGLES)];
  return [pose, ...pieces.map((piece) => KINDS[piece.kind].numbers(piece))].join("_");
}

/** The pieces of a text. raises: Error if it is no such text */
export function piecesOf(text) {
  const [first, ...steps] = text.split("_").map((step) => step.split(",").map(Number));
  if (first.length !== 3 || !steps.length || ![first, ...steps].flat().every(Number.isFinite)) throw new Error(text);
  let pose = first;
  return steps.map((step) => {
    const [piece, end] = BY_COUNT[step.length].from(pose, step);
    pose = end;
    return piece;
  });
}

/** The route with the numbers of its text, or itself if it has none. */
export function roundedRoute(path) {
  const text = walkText(path);
  return text ? { ...path, pieces: piecesOf(text) } : path;
}
