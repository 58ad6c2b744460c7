/** The figures: the question of each to the service, the drawing of the answer, and the numbers in its sentences. */

import { staircase } from "../charts.js";
import { benchName, phrase, say } from "../text.js";
import { Chart, Picture, halves, onSpiral } from "./draw.js";
import { proof, speed, turn } from "./turns.js";

/** Number of the contest's benches, of drawn ones, and of judged ones if only the first ones meet [1]. */
const DRAGON = { overhang: 0.275, width: 0.3 };
const [DRAWN, JUDGED] = [60, 40];
const START_TURNS = 16;
/** Pitch of the contest's spiral [m]. */
const PITCH = 0.55;
const MM = 1000;
const CM = 100;

const spiralOf = (pitch, start_turns = START_TURNS) => ({ kind: "spiral", pitch, start_turns });

/** The pose {x, y, speed} of the first benches of a dance at one instant. */
async function poseAt(ask, path, time, dragon) {
  const { x, y, speed } = await ask("trajectory", { body: { dragon, path, times: [time] } });
  return { x: x[0], y: y[0], speed: speed[0] };
}

/** All benches of a pose, the last one first, and then the important ones in their colours. */
function drawDragon(picture, pose, dragon, pair) {
  picture.dragon(pose, dragon);
  pair.forEach((bench, k) => picture.bench(pose, bench, dragon, `bench ${["first", "second"][k]}`));
}

const chord = {
  dials: {
    chord: { label: phrase("Chord of the head bench"), value: 2.86, min: 0.6, max: 4, step: 0.01, decimals: 2, unit: "m" },
    turns: { label: phrase("Place of the head in turns from the centre"), value: 5, min: 1.5, max: 6, step: 0.05, decimals: 2, unit: phrase("turns") },
  },
  knob: true,
  async ask(ask, { chord, turns }) {
    const dragon = { benches: 11, head_length: chord + 2 * DRAGON.overhang };
    const pose = await poseAt(ask, spiralOf(PITCH, turns), 0, dragon);
    this.way = Math.atan2(pose.y[1] - pose.y[0], pose.x[1] - pose.x[0]);
    return { pose };
  },
  /** Where a bench folds there is no pose: the figure shows the head and its circle, whose knob stays where it was last. */
  refused({ values: { least, bench } }, { chord, turns }) {
    if (!least || bench?.value !== 0) return null;
    const [x, y] = onSpiral(PITCH, turns);
    const way = this.way ?? Math.atan2(-y, -x);
    const knob = { x: [x, x + chord * Math.cos(way)], y: [y, y + chord * Math.sin(way)] };
    return { pose: knob, folds: least.value };
  },
  draw(svg, box, { pose, folds, values }) {
    const { x, y } = pose;
    const picture = new Picture(svg, box, { x: 0, y: 0, span: 9.4 });
    picture.spiral(PITCH, 0, START_TURNS);
    if (!folds) drawDragon(picture, pose, DRAGON, []);
    picture.circle(x[0], y[0], values.chord, "compass");
    picture.line([[x[0], y[0]], [x[1], y[1]]], "radius");
    for (let k = x.length - 1; k > 1; k--) picture.dot(x[k], y[k], "hole", 3);
    picture.dot(x[0], y[0], "center", 5);
    picture.dot(x[1], y[1], "knob", 8);
    picture.text(say("head"), x[0], y[0], "label", [10, -10]);
    if (!folds) picture.text(say("second handle"), x[1], y[1], "label", [12, 18]);
    picture.bar(1);
    return picture;
  },
  pull: ([x, y], { pose }) => ({ chord: Math.hypot(x - pose.x[0], y - pose.y[0]) }),
  outputs({ pose: { x, y, speed }, folds }) {
    if (folds) return { verdict: say("The bench folds: the circle no longer finds its first meeting, so there is no second handle. With this chord the head must be more than {least} from the centre.", { least: `${folds} ${say("turns")}` }) };
    return { verdict: say("The second handle is at ({x}, {y}). While the head moves at 1 m/s, this handle moves at {speed}.", { x: `${x[1].toFixed(3)} m`, y: `${y[1].toFixed(3)} m`, speed: `${speed[1].toFixed(6)} m/s` }) };
  },
};

/** The staircase: a first view, and later with its jumps. */
let scan = null;
const SAMPLES = 200;

const stairs = {
  dials: { pitch: { label: phrase("Pitch of the spiral"), value: 0.4503, min: 0.37, max: 0.6, step: 0.0001, decimals: 4, unit: "m" } },
  async ask(ask, { pitch }) {
    scan ??= await ask("pitch-scan", { query: { samples: SAMPLES, locate: false } });
    const contact = await ask("collision-time", { query: { pitch, cross_check: "none" } });
    return { contact, pose: await poseAt(ask, spiralOf(pitch), contact.time, { benches: DRAWN }) };
  },
  async refine(ask) {
    scan = { ...(await ask("pitch-scan", { query: { samples: SAMPLES } })), whole: true };
  },
  draw(svg, box, { contact, pose, values }) {
    const [left, right] = halves(svg, box, 0.56);
    const labels = [say("pitch [m]"), say("head stops at [m]")];
    const chart = new Chart(svg, left, { x: [0.365, 0.605], y: [1.5, 7], labels });
    chart.across(4.5, "turning");
    chart.text(say("turning circle"), 0.605, 4.5, "tick right", [-4, -6]);
    drawStairs(chart);
    chart.up(values.pitch, "here");
    chart.dot(values.pitch, contact.head.radius, "now", 6);
    const picture = new Picture(svg, right, { x: 0, y: 0, span: 12.6 });
    picture.circle(0, 0, 4.5, "turning");
    drawDragon(picture, pose, DRAGON, contact.benches);
    picture.circle(...contact.point, 0.45, "ring");
    picture.bar(2);
    return chart;
  },
  pull: (pitch) => ({ pitch }),
  outputs({ contact }) {
    const [a, b] = contact.benches.map((bench) => benchName(bench, 223));
    return { radius: `${contact.head.radius.toFixed(4)} m`, a, b, least: `${scan.minimum_pitch.toFixed(9)} m` };
  },
};

function drawStairs(chart) {
  const samples = scan.pitch.map((pitch, k) => [pitch, scan.radius[k]]);
  if (!scan.whole) return samples.forEach((sample) => chart.dot(...sample, "sample", 1.5));
  for (const stretch of staircase(samples, scan.pieces, scan.jumps)) chart.line(stretch, "curve");
  for (const { pitch, radius } of scan.jumps) chart.line([[pitch[0], radius[0]], [pitch[1], radius[1]]], "jump");
}

/** Interval around the step in which the true gap is drawn [s], and number of instants. */
const [BEFORE, AFTER, POINTS] = [0.1, 0.55, 53];

const step = {
  dials: {
    time: { label: phrase("Start of the interval"), value: 409.7, min: 398, max: 412.4, step: 0.01, decimals: 2, unit: "s" },
    length: { label: phrase("Length of the interval"), value: 0.06, min: 0.01, max: 0.5, step: 0.01, decimals: 2, unit: "s" },
  },
  async ask(ask, { time, length }) {
    const [start, stop] = [time, time + length];
    const grid = Array.from({ length: POINTS }, (_, k) => time - BEFORE + ((BEFORE + AFTER) * k) / (POINTS - 1));
    const times = [...new Set([...grid, start, stop])].sort((a, b) => a - b);
    const dragon = { benches: JUDGED };
    const gap = await ask("clearance", { body: { dragon, times } });
    const proof = await ask("collision-time", { body: { dragon, start, stop, cross_check: "none" } });
    this.whole ??= await ask("collision-time", { query: { cross_check: "none" } });
    return { gap, proof, start, stop, whole: this.whole };
  },
  draw(svg, box, { gap, proof, start, stop }) {
    const points = gap.time.map((time, k) => [time, MM * gap.clearance[k]]);
    const [low, high] = [start, stop].map((time) => points.find((point) => point[0] === time)[1]);
    const top = 1.15 * Math.max(...points.map((point) => point[1]));
    const labels = [say("time [s]"), say("least gap [mm]")];
    const range = { x: [start - BEFORE, start + AFTER], y: [-0.35 * top, top] };
    const chart = new Chart(svg, box, { ...range, labels });
    const way = proof.outcome !== "clear" ? "bad" : proof.certificate.steps > 1 ? "short" : "good";
    chart.area([[start, range.y[0]], [start, top], [stop, top], [stop, range.y[0]]], `span ${way}`);
    chart.across(0, "zero");
    chart.line(points, "curve");
    // The lowest curve through both gaps with a second derivative up to the service's bound.
    const sag = 0.5 * MM * proof.certificate.bound * (stop - start) ** 2;
    const lowest = (u) => [start + u * (stop - start), low + (high - low) * u - sag * u * (1 - u)];
    if (way !== "bad") chart.line(Array.from({ length: 41 }, (_, k) => lowest(k / 40)), `arch ${way}`);
    for (const [time, value] of [[start, low], [stop, high]]) chart.dot(time, value, "now", 5);
    return chart;
  },
  pull: (at, { start, stop }) => (at < (start + stop) / 2 ? {} : { length: at - start }),
  outputs({ proof: { outcome, certificate: { steps, bound }, time }, whole }) {
    const proven = [phrase("Here the benches are so far apart that a formula settles the whole interval without a step: no touch is possible in it."), phrase("The sagging curve stays above zero: no touch is possible in this interval. The service proves it in one step."), phrase("The sagging curve dips below zero, so one step over this interval would prove nothing. The service takes {steps} shorter steps, each of them a proof: no touch is possible in this interval either.")];
    const verdict = outcome === "clear" ? proven[Math.min(steps, 2)] : phrase("Two benches touch in this interval, at {time} s. Until then the steps prove that nothing touches.");
    return {
      bound: `${bound.toFixed(2)} m/s²`,
      verdict: say(verdict, { steps, time: time?.toFixed(6) }),
      all: String(whole.certificate.steps),
      contact: `${whole.time.toFixed(6)} s`,
    };
  },
};

const WINDOW = [211, 221];

const graze = {
  dials: {
    step: { label: phrase("Time between two looks"), value: 1, min: 0.1, max: 2, step: 0.1, decimals: 1, unit: "s" },
    pitch: { label: phrase("Pitch of the spiral"), value: 0.4503, min: 0.4496, max: 0.4506, step: 0.00001, decimals: 5, unit: "m" },
  },
  async ask(ask, { step, pitch }) {
    const over = { pitch, benches: JUDGED, start: WINDOW[0], stop: WINDOW[1] };
    const looks = await ask("clearance", { query: { ...over, step } });
    const key = String(pitch);
    if (this.key !== key) {
      const contact = await ask("collision-time", { query: { pitch, cross_check: "none" } });
      Object.assign(this, { curve: await ask("clearance", { query: { ...over, step: 0.05 } }), contact, key });
    }
    return { looks, curve: this.curve, contact: this.contact };
  },
  draw(svg, box, { looks, curve, contact }) {
    const labels = [say("time [s]"), say("least gap [mm]")];
    const chart = new Chart(svg, box, { x: WINDOW, y: [-0.35, 1.6], labels });
    const points = curve.time.map((time, k) => [time, curve.clearance[k]]);
    for (const { time, clearance } of curve.grazes) points.push([time, clearance]);
    points.sort((a, b) => a[0] - b[0]);
    const [from, to] = WINDOW;
    chart.area([[from, 0], ...points.map(([time, gap]) => [time, MM * Math.min(gap, 0)]), [to, 0]], "deep");
    chart.across(0, "zero");
    chart.line(points.map(([time, gap]) => [time, MM * gap]), "curve");
    if (contact.time < to) chart.up(contact.time, "here");
    looks.time.forEach((time, k) => {
      const gap = looks.clearance[k];
      chart.line([[time, chart.y[0]], [time, MM * gap]], "look");
      chart.dot(time, MM * gap, gap < 0 ? "seen" : "sample", 4);
    });
    return chart;
  },
  outputs({ looks, curve, contact }) {
    const seen = looks.clearance.filter((gap) => gap < 0).length;
    const depth = -Math.min(...curve.grazes.map(({ clearance }) => clearance));
    const [time, touches] = [contact.time.toFixed(6), contact.time < WINDOW[1]];
    const truth = touches && depth > 0 ? say("two benches touch at {time} s, and then overlap by up to {depth} mm.", { time, depth: (MM * depth).toFixed(4) }) : say("nothing touches in the figure; first contact comes at {time} s.", { time });
    return { count: String(looks.time.length), looked: say(seen ? "In {seen} of them benches overlap." : "Every look finds all benches apart.", { seen }), truth };
  },
};

const stray = {
  dials: {
    stray: { label: phrase("How far every handle may stray"), value: 3, min: 0, max: 30, step: 0.1, decimals: 1, unit: "cm" },
    pitch: { label: phrase("Pitch of the spiral"), value: 0.55, min: 0.46, max: 1, step: 0.01, decimals: 2, unit: "m" },
  },
  async ask(ask, { stray, pitch }) {
    if (this.key !== pitch) {
      const free = await ask("tolerance", { query: { pitch } });
      const near = { pitch, stray: free.stray_bracket[1], cross_check: "none" };
      const { point } = await ask("collision-time", { query: near });
      const pose = await poseAt(ask, spiralOf(pitch), free.time, { benches: DRAWN });
      Object.assign(this, { known: { free, point, pose }, key: pitch });
    }
    const { known } = this;
    if (stray / CM < known.free.stray_bracket[1]) return known;
    const query = { pitch, stray: stray / CM, cross_check: "none" };
    return { ...known, first: await ask("collision-time", { query }) };
  },
  draw(svg, box, { free, point, pose, values }) {
    const picture = new Picture(svg, box, { x: point[0], y: point[1], span: 1.7 });
    const pair = free.benches;
    for (let k = pose.x.length - 2; k >= 0; k--) {
      const place = pair.indexOf(k);
      const colour = ["first", "second"][place] ?? "";
      if (values.stray) picture.ground(pose, k, DRAGON, values.stray / CM, `ground ${colour}`);
    }
    drawDragon(picture, pose, DRAGON, pair);
    if (values.stray / CM >= free.stray_bracket[1]) {
      const { handles } = free.exhibit;
      const exhibit = { x: handles.map((hole) => hole[0]), y: handles.map((hole) => hole[1]) };
      for (const bench of pair) picture.bench(exhibit, bench, DRAGON, "exhibit");
    }
    picture.bar(0.2);
    return picture;
  },
  outputs({ free: { stray_bracket: [low, high] }, first, values: { stray } }) {
    const inside = stray / CM <= low;
    const verdict = inside ? phrase("With this stray nothing can touch on the whole way to the turning circle: that is proven.") : first ? phrase("From {time} s on benches may touch. The dashed outlines show how: in one pose of the whole dragon these two do.") : phrase("This stray lies between the two numbers below: neither proven safe nor shown to touch.");
    const [least, most] = [(Math.floor(CM * CM * low) / CM).toFixed(2), (Math.ceil(CM * CM * high) / CM).toFixed(2)];
    return { low: `${least} cm`, high: `${most} cm`, verdict: say(verdict, { time: first?.time.toFixed(6) }) };
  },
};

/** The plan of each figure, by the id of its section. */
export const PLANS = { chord, staircase: stairs, step, graze, proof, stray, turn, speed };
