/** A proposed dance on a card: what is good and what is tight about it, and its picture. */

import { strayOf } from "./fields.js";
import { say } from "./text.js";
import { extent } from "./square.js";

/** Kinds of dances. @type {Phrases} */
const FIGURES = {
  spiral: "Spiral in and out",
  eight: "Figure eight",
  serpentine: "Serpentine",
  ring: "Ring",
  parade: "From gate to gate",
};

/** Angle between two benches that is worth a word [degrees]; stray that is little room for people, and a near distance [m]. */
const [BEND, LITTLE, NEAR] = [40, 0.1, 0.3];
/** From this time on minutes are counted [s]. */
const LONG = 120;
/** Room around the picture and width of its lines, as parts of its larger side [1]; most points of a path. */
const [AROUND, LINE, POINTS] = [0.04, 0.006, 400];
/** A safe stray as people say it, rounded down [cm]. */
const centimetresDown = (stray) => (stray < LITTLE ? Math.floor(1000 * stray) / 10 : Math.floor(100 * stray));
const degrees = (angle) => (angle * 180) / Math.PI;

/** Twice the area that a line goes around [m2]: positive to the left. */
const twiceArea = ({ x, y }) => x.reduce((sum, one, k) => sum + one * y[(k + 1) % x.length] - x[(k + 1) % x.length] * y[k], 0);

/** In which words proposals of one figure on one way may differ, the first ones preferred. course: the part of that of /course that is danced in the square */
const MARKS = [
  (_, course) => say("{wide} m wide", { wide: extent(course.x.map((x, k) => [x, course.y[k]])).width.toFixed(0) }),
  (_, course) => say(twiceArea(course) > 0 ? "to the left" : "to the right"),
  ({ turns }) => say("{turns} turns", { turns: turns.toFixed(1) }),
  ({ length }) => say("{length} m", { length: length.toFixed(0) }),
];

/** The figure of a proposal, and between which gates it leads. names: of all gates */
function nameOf({ figure, gates: [a, b] }, names) {
  const words = say(FIGURES[figure]);
  if (a === b) return words;
  const way = { a: names[a], b: names[b] };
  return figure === "parade" ? say("From {a} to {b}", way) : say("{figure}, {parts}", { figure: words, parts: say("from {a} to {b}", way) });
}

/** The titles of all proposals; those of one figure on one way are told apart by the first thing in which each differs from all others, else by a number. gates: their names */
export function cardTitles({ proposals, courses, yard }, gates) {
  const { width, height, middle: [left, low] } = extent(yard);
  const isInside = (x, y) => Math.abs(x - left) <= width / 2 && Math.abs(y - low) <= height / 2;
  const danced = courses.map(({ s, x, y }) => {
    // Streets and the place where the dragon stands are no part of a figure.
    const own = [...s.keys()].filter((k) => s[k] >= 0 && isInside(x[k], y[k]));
    return { x: own.map((k) => x[k]), y: own.map((k) => y[k]) };
  });
  const figures = proposals.map((one) => nameOf(one, gates));
  return figures.map((figure, at) => {
    const alike = [...figures.keys()].filter((k) => figures[k] === figure);
    if (alike.length < 2) return figure;
    const words = MARKS.map((mark) => alike.map((k) => mark(proposals[k], danced[k]))).find((all) => new Set(all).size === all.length);
    const place = alike.indexOf(at);
    return say("{figure}, {parts}", { figure, parts: words?.[place] ?? say("no. {number}", { number: place + 1 }) });
  });
}

/** Whole seconds as people say them. */
const timeWords = (seconds) => (seconds < LONG ? say("{seconds} s", { seconds }) : say("{minutes} min {seconds} s", { minutes: Math.floor(seconds / 60), seconds: seconds % 60 }));

/** {size, good, tight, isTight}: the words of a proposal among all of them; isTight: whether to look out there. square: name of the area */
export function cardWords(proposal, all, square) {
  const { dance, duration, length, tolerance, turns, near, clearance, clearance_in_place: apart, sharpest_bend: bend } = proposal;
  const most = (value) => all.length > 1 && all.every((one) => one === proposal || value(one) < value(proposal) - 1e-3);
  const stray = String(centimetresDown(tolerance));
  const good = [say(most((one) => one.tolerance) ? "Most room: people may be {stray} cm from their places" : "People may be {stray} cm from their places", { stray })];
  if (most((one) => one.duration)) good.push(say("the longest dance"));
  if (most((one) => one.turns)) good.push(say("the most turns: {turns}", { turns: turns.toFixed(1) }));
  if (most((one) => -(one.sharpest_bend ?? 0))) good.push(say("the gentlest bends"));
  const isPair = clearance !== null && clearance < near.distance;
  const [inPlace, strayed] = isPair ? [apart, clearance] : [near.in_place, near.distance];
  const nearest = say(isPair ? "benches that are not neighbours come as near as {distance} m to each other" : near.name === square ? "nobody comes nearer than {distance} m to the border of the square" : "nobody comes nearer than {distance} m to “{name}”", { distance: inPlace.toFixed(2), name: near.name });
  // The distance counts from people in place, as does the stray that is safe.
  const asked = strayOf({ stray: 0, hole: 0, pin: 0, ...dance });
  const tight = [asked ? nearest + say(" (at least {distance} m while people stray by {stray} cm)", { stray: Number((100 * asked).toFixed(2)), distance: strayed.toFixed(2) }) : nearest];
  const isTight = Math.min(clearance ?? Infinity, near.distance) < NEAR || degrees(bend ?? 0) > BEND || tolerance < LITTLE;
  if (degrees(bend ?? 0) > BEND) tight.push(say("bends of up to {angle}°", { angle: degrees(bend).toFixed(0) }));
  if (tolerance < LITTLE) tight.push(say("people may be only {stray} cm from their places", { stray }));
  const benches = dance.dragon.benches ?? dance.dragon.lengths.length;
  const size = say("{benches} benches, {time}; the head walks {length} m", { benches, time: timeWords(Math.round(duration)), length: length.toFixed(0) });
  return { size, good: good.join(say(", ")), tight: tight.join(say(", ")), isTight };
}

const pointsText = (points) => points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");

/** The picture of a proposed dance, as the text of an SVG. yard: corners of the square; course: of /course */
export function cardPicture({ yard, things }, course) {
  const every = Math.ceil(course.x.length / POINTS);
  const path = course.x.map((x, k) => [x, course.y[k]]).filter((_, k) => k % every === 0 || k === course.x.length - 1);
  const { width, height, middle: [x, y] } = extent(yard);
  const size = Math.max(width, height) * (1 + 2 * AROUND);
  const line = size * LINE;
  const blocks = things.map(({ kind, points, radius }) => {
    if (kind === "circle") return `<circle class="thing" cx="${points[0][0]}" cy="${points[0][1]}" r="${radius}"/>`;
    if (kind === "wall") return `<polyline class="wall" points="${pointsText(points)}" stroke-width="${Math.max(2 * radius, line)}"/>`;
    return kind === "block" ? `<polygon class="thing" points="${pointsText(points)}"/>` : "";
  });
  const [box, flip] = [`${x - size / 2} ${-y - size / 2} ${size} ${size}`, 'transform="scale(1 -1)"'];
  const first = course.s.findIndex((s) => s >= 0);
  const head = `<circle class="head" cx="${course.x[first]}" cy="${course.y[first]}" r="${2.5 * line}"/>`;
  return `<svg viewBox="${box}"><g ${flip} stroke-width="${line}"><polygon class="ground" points="${pointsText(yard)}"/>${blocks.join("")}<polyline class="way" points="${pointsText(path)}"/>${head}</g></svg>`;
}
