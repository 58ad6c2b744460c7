/** Three more figures: looks and bounds, the turn of two arcs, and how a rigid bench passes a speed on. */

import { Problem } from "../api.js";
import { phrase, say } from "../text.js";
import { Chart, Picture, halves, onSpiral } from "./draw.js";

/** The contest's benches: overhang, width and the chord of the head [m]; its turn: pitch and radius of the circle [m]. */
const DRAGON = { overhang: 0.275, width: 0.3 };
const [CHORD, PITCH, CIRCLE] = [2.86, 1.7, 4.5];
/** Benches that are judged or drawn: those behind repeat what these do. */
const BENCHES = 40;
const [MM, CM] = [1000, 100];
/** Points of an arc, and turns of the coils that are drawn. */
const [ARC_POINTS, COIL_TURNS] = [60, 2];

/** The stretch that is looked at [s], its number of points, and the gaps that are drawn [mm]. */
const [FROM, TO, POINTS] = [405.5, 411.5, 181];
const GAPS = [-4, 24];

export const proof = {
  dials: {
    step: { label: phrase("Time between two looks"), value: 0.25, min: 0.05, max: 1.5, step: 0.05, decimals: 2, unit: "s" },
    width: { label: phrase("Width of every bench"), value: 30, min: 29.9, max: 30.2, step: 0.01, decimals: 2, unit: "cm" },
  },
  async ask(ask, { step, width }) {
    const dragon = { benches: BENCHES, width: width / CM };
    const looks = Array.from({ length: Math.floor((TO - FROM) / step + 1e-9) + 1 }, (_, k) => Number((FROM + k * step).toFixed(9)));
    const grid = Array.from({ length: POINTS }, (_, k) => FROM + ((TO - FROM) * k) / (POINTS - 1));
    const gap = await ask("clearance", { body: { dragon, times: [...new Set([...grid, ...looks])].sort((a, b) => a - b) } });
    const walk = await ask("collision-time", { body: { dragon, start: FROM, stop: TO, cross_check: "none" } });
    return { gap, looks, walk };
  },
  draw(svg, box, data) {
    const { gap } = data;
    const chart = new Chart(svg, box, { x: [FROM, TO], y: GAPS, labels: [say("time [s]"), say("least gap [mm]")] });
    const points = gap.time.map((time, k) => [time, MM * gap.clearance[k]]);
    for (const { time, clearance } of gap.grazes) points.push([time, MM * clearance]);
    chart.across(0, "zero");
    chart.line(points.sort((a, b) => a[0] - b[0]), "curve");
    for (const { arc, proves } of arcsOf(data)) chart.line(arc, `arch ${proves ? "good" : "bad"}`);
    for (const [time, value] of seenIn(data)) chart.dot(time, value, value < 0 ? "seen" : "sample", 4);
    return chart;
  },
  outputs(data) {
    const { gap, walk } = data;
    const nearest = gap.grazes.reduce((least, one) => (one.clearance < least.clearance ? one : least));
    const arcs = arcsOf(data);
    const count = arcs.length;
    const seen = seenIn(data).some(([, value]) => value < 0);
    const proven = arcs.filter(({ proves }) => proves).length;
    const clear = say("Of {count} stretches between two looks, {proven} are proven to be clear.", { count, proven });
    const missed = say(seen ? "Two benches touch at {time} s, and some look sees them overlap." : "Two benches touch at {time} s, and no look sees it.", { time: walk.time?.toFixed(6) });
    return {
      bound: `${walk.certificate.bound.toFixed(2)} m/s²`,
      near: `${(MM * nearest.clearance).toFixed(3)} mm`,
      time: `${nearest.time.toFixed(2)} s`,
      steps: String(walk.certificate.steps),
      verdict: walk.time === null ? clear : missed,
    };
  },
};

/** What looks see: time [s] and gap [mm]. */
const seenIn = ({ gap, looks }) => looks.map((time) => [time, MM * gap.clearance[gap.time.indexOf(time)]]);

/** The lowest curve between each two looks, and whether it proves that nothing touches there. */
function arcsOf(data) {
  const seen = seenIn(data);
  return seen.slice(1).map(([end, last], k) => {
    const [begin, first] = seen[k];
    const sag = 0.5 * MM * data.walk.certificate.bound * (end - begin) ** 2;
    const arc = Array.from({ length: 21 }, (_, j) => [begin + ((end - begin) * j) / 20, first + ((last - first) * j) / 20 - (sag * j * (20 - j)) / 400]);
    return { arc, proves: arc.every(([, value]) => value > 0) };
  });
}

const pathOf = ({ ratio, entry, exit }) => ({ kind: "turn", pitch: PITCH, turning_diameter: 2 * CIRCLE, ratio, entry_radius: entry, exit_radius: exit });

/** The points of an arc about a centre, from one of its points on by an angle [rad]. */
function arcFrom([cx, cy], radius, [x, y], angle) {
  const begin = Math.atan2(y - cy, x - cx);
  return Array.from({ length: ARC_POINTS + 1 }, (_, k) => begin + (angle * k) / ARC_POINTS).map((at) => [cx + radius * Math.cos(at), cy + radius * Math.sin(at)]);
}

/** Draw the circle, the coils and the two arcs of an answer of /turn. */
function drawTurn(picture, { centres, radii, angles, entry, tangent_point: joint, entry_radius, exit_radius }) {
  picture.circle(0, 0, CIRCLE, "turning");
  const coil = (inner) => Array.from({ length: 200 }, (_, k) => onSpiral(PITCH, inner / PITCH + (COIL_TURNS * k) / 199));
  picture.line(coil(entry_radius), "spiral");
  picture.line(coil(exit_radius).map(([x, y]) => [-x, -y]), "spiral");
  picture.line(arcFrom(centres[0], radii[0], entry, -angles[0]), "arc one");
  picture.line(arcFrom(centres[1], radii[1], joint, angles[1]), "arc two");
}

export const turn = {
  dials: {
    ratio: { label: phrase("Radius of the first arc over that of the second"), value: 2, min: 0.5, max: 3, step: 0.01, decimals: 2, unit: "" },
    entry: { label: phrase("Distance of the entry from the centre"), value: 4.5, min: 2.8, max: 4.5, step: 0.01, decimals: 2, unit: "m", exact: true },
    exit: { label: phrase("Distance of the exit from the centre"), value: 4.5, min: 2.8, max: 4.5, step: 0.01, decimals: 2, unit: "m", exact: true },
  },
  knob: true,
  held: "entry",
  async ask(ask, values) {
    const { kind, ...query } = pathOf(values);
    const shape = await ask("turn", { query });
    try {
      const body = { dragon: { benches: BENCHES }, path: { kind, ...query }, times: [shape.length + CHORD] };
      const { x, y } = await ask("trajectory", { body });
      return { shape, pose: { x: x[0], y: y[0] }, jam: "" };
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
      return { shape, pose: null, jam: error.problem.sentence };
    }
  },
  draw(svg, box, { shape, pose }) {
    const picture = new Picture(svg, box, { x: 0, y: 0, span: 11 });
    if (pose) picture.dragon(pose, DRAGON);
    drawTurn(picture, shape);
    for (const centre of shape.centres) picture.dot(...centre, "hole", 3);
    picture.dot(...shape.tangent_point, "hole", 4);
    picture.dot(...shape.exit, "knob", 8);
    picture.dot(...shape.entry, "knob", 8);
    for (const [words, [x, y], down] of /** @type {[string, number[], number][]} */ ([[say("entry"), shape.entry, 14], [say("exit"), shape.exit, -10]])) picture.text(words, x, y, "label", [12, down]);
    picture.bar(1);
    return picture;
  },
  /** The knob that was taken moves its end, also where the hand leaves the coil. */
  pull([x, y], { shape: { entry, exit } }, begins) {
    const [before, behind] = [entry, exit].map(([left, up]) => Math.hypot(x - left, y - up));
    if (begins) this.held = before < behind ? "entry" : "exit";
    return { [this.held]: Math.hypot(x, y) };
  },
  outputs({ shape: { length, angles, radii }, jam }) {
    const radius = `${Math.min(...radii).toFixed(3)} m`;
    return {
      length: `${length.toFixed(6)} m`,
      angle: `${[...new Set(angles.map((angle) => angle.toFixed(6)))].join(" / ")} rad`,
      sum: `${(radii[0] + radii[1]).toFixed(6)} m`,
      least: `${(CHORD / 2).toFixed(2)} m`,
      verdict: jam ? say("The benches jam: the tighter bend has a radius of {radius}, and the head cannot follow it.", { radius }) : say("The benches go through: the tighter bend has a radius of {radius}.", { radius }),
    };
  },
};

/** The way of the head whose speeds are drawn [m], and its number of samples. */
const [WAY, SAMPLES] = [[-2, 32], 681];
const LIMIT = 2;
const PLAIN = { ratio: 2, entry: CIRCLE, exit: CIRCLE };

export const speed = {
  dials: {
    way: { label: phrase("Way of the head past the beginning of the turn"), value: 14.48, min: 0, max: 30, step: 0.02, decimals: 2, unit: "m" },
    handle: { label: phrase("Number of the handle"), value: 1, min: 1, max: 12, step: 1, decimals: 0, unit: "" },
  },
  async ask(ask, { way }) {
    const { kind, ...query } = pathOf(PLAIN);
    const dance = { dragon: { benches: BENCHES }, path: { kind, ...query } };
    this.known ??= {
      shape: await ask("turn", { query }),
      curve: await ask("trajectory", { body: { ...dance, times: { start: WAY[0], stop: WAY[1], step: (WAY[1] - WAY[0]) / (SAMPLES - 1) }, decimals: 6 } }),
      fastest: await ask("maximum-head-speed", { query: { speed_limit: LIMIT } }),
    };
    const { x, y, speed: rates } = await ask("trajectory", { body: { ...dance, times: [way] } });
    return { ...this.known, pose: { x: x[0], y: y[0], speed: rates[0] } };
  },
  draw(svg, box, { shape, curve, pose, values: { way, handle } }) {
    const [left, right] = halves(svg, box, 0.5);
    const labels = [say("way of the head [m]"), say("speed of the handle over that of the head")];
    const chart = new Chart(svg, left, { x: WAY, y: [0.4, 1.7], labels });
    chart.across(1, "zero");
    chart.line(curve.time.map((time, k) => [time, curve.speed[k][handle]]), "curve");
    chart.up(way, "here");
    chart.dot(way, pose.speed[handle], "now", 6);
    const picture = new Picture(svg, right, { x: 0, y: 0, span: 10.5 });
    picture.dragon(pose, DRAGON, handle - 1);
    drawTurn(picture, shape);
    picture.dot(...shape.tangent_point, "center", 4);
    picture.dot(pose.x[handle], pose.y[handle], "now", 6);
    picture.bar(1);
    return chart;
  },
  pull: (way) => ({ way }),
  outputs({ pose, fastest, values: { handle } }) {
    const [own, ahead] = [pose.speed[handle], pose.speed[handle - 1]];
    const share = Math.abs(CM * (own / ahead - 1)).toFixed(1);
    const verdict = share === "0.0" ? phrase("Here both ends of the bench are equally fast.") : own > ahead ? phrase("Here the bench makes the handle behind {share} % faster than the one before it.") : phrase("Here the bench makes the handle behind {share} % slower than the one before it.");
    return { speed: `${own.toFixed(4)} m/s`, ahead: `${ahead.toFixed(4)} m/s`, peak: `${fastest.speed_ratio.toFixed(4)} m/s`, limit: `${fastest.head_speed.toFixed(6)} m/s`, verdict: say(verdict, { share }) };
  },
};
