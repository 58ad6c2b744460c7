/** Charts by uPlot: clearance over time, and against the pitch stray and radius at first contact; and ticks of all axes. */

import { SMALL_TYPE, colours, inType, make } from "./elements.js";
import { phrase, say } from "./text.js";

const HEIGHT = 240;
/** Upper end of a scale, as a multiple of its highest value [1]. */
const ABOVE = 1.06;
/** Tolerance of a tick, as a part of the step between ticks: far more than rounding [1]. */
const ROUNDING = 1e-6;

/** A chart in a box. A click or a drag calls seek(x). The marker is an element above the chart, so that it moves without a redraw. */
export class Chart {
  #plot = null;
  #data = null;
  #now = null;
  #marker = make("div", { className: "now" });

  /**
   * plan(data) gives {labels: of both axes; table: the columns x and y; range: of y; width: of the line of this table [px],
   * 0 for none; draw(pen): draws everything else}.
   */
  constructor(box, plan, seek) {
    this.box = box;
    this.plan = plan;
    this.seek = seek;
    new ResizeObserver(() => this.#plot?.setSize({ width: box.clientWidth, height: HEIGHT })).observe(box);
  }

  /** Draw the data, or draw the last data again after a change of language or colour scheme. */
  show(data = this.#data) {
    this.#data = data;
    this.#plot?.destroy();
    this.#plot = null;
    if (!data) return;
    const plan = this.plan(data);
    this.#plot = new uPlot(this.#options(plan), plan.table, this.box);
    this.#plot.over.append(this.#marker);
    this.#listen(this.#plot.over);
    this.now(this.#now);
  }

  /** Move the marker to x; null hides it. */
  now(x) {
    this.#now = x;
    if (!this.#plot) return;
    const left = x === null ? NaN : this.#plot.valToPos(x, "x");
    this.#marker.hidden = !(left >= -1 && left <= this.#plot.bbox.width / devicePixelRatio + 1);
    this.#marker.style.transform = `translateX(${left}px)`;
  }

  #options({ labels, range, width, draw }) {
    const colour = colours();
    const [grid, font] = [{ stroke: colour("line"), width: 1 }, `${inType(SMALL_TYPE)}px system-ui, sans-serif`];
    const look = { stroke: colour("muted"), grid, ticks: grid, font, labelFont: font, labelSize: 22 };
    const moveMarker = () => this.now(this.#now);
    return {
      width: this.box.clientWidth,
      height: HEIGHT,
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, y: false, points: { show: false } },
      scales: { x: { time: false }, y: { range } },
      axes: labels.map((label, k) => ({ ...look, label: say(label), size: inType([36, 56][k]) })),
      series: [{}, { stroke: colour("accent"), width, points: { show: false }, ...(width ? {} : { paths: () => null }) }],
      hooks: { draw: [(plot) => draw(pen(plot, colour))], setSize: [moveMarker], ready: [moveMarker] },
    };
  }

  #listen(over) {
    const seek = (event) => {
      const box = over.getBoundingClientRect();
      this.seek(this.#plot.posToVal(Math.min(Math.max(event.clientX - box.left, 0), box.width), "x"));
    };
    over.addEventListener("pointerdown", (event) => {
      over.setPointerCapture(event.pointerId);
      seek(event);
    });
    over.addEventListener("pointermove", (event) => event.buttons && seek(event));
  }
}

/** A pen that draws on the canvas of a uPlot, at places in the units of its axes, in colours of the page by their names. */
function pen(plot, colour) {
  const { ctx: context } = plot;
  const { left, top, width, height } = plot.bbox;
  const at = (x, y) => [plot.valToPos(x, "x", true), plot.valToPos(y, "y", true)];
  const line = (from, to, name, dash) => {
    Object.assign(context, { strokeStyle: colour(name), lineWidth: 1.5 * devicePixelRatio });
    context.setLineDash(dash.map((one) => one * devicePixelRatio));
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
    context.setLineDash([]);
  };
  return {
    /** A line through all points [[x, y], ...]; dash: lengths of dashes and gaps [px], empty for a full line. */
    along(points, name, dash = []) {
      for (let k = 1; k < points.length; k++) line(at(...points[k - 1]), at(...points[k]), name, dash);
    },
    /** A dashed line across the whole chart at a height y. */
    across: (y, name) => line([left, at(0, y)[1]], [left + width, at(0, y)[1]], name, [6, 4]),
    /** A dashed line from the bottom to the top of the chart at x. */
    up: (x, name) => line([at(x, 0)[0], top], [at(x, 0)[0], top + height], name, [2, 3]),
    /** A filled circle; radius in pixels of the page. */
    dot(x, y, name, radius) {
      context.beginPath();
      context.arc(...at(x, y), radius * devicePixelRatio, 0, 2 * Math.PI);
      context.fillStyle = colour(name);
      context.fill();
    },
    /** A diagonal cross. */
    cross(x, y, name) {
      const [px, py] = at(x, y);
      const size = 6 * devicePixelRatio;
      for (const way of [size, -size]) line([px - size, py - way], [px + size, py + way], name, []);
    },
  };
}

/** Clearance over time, from an answer of /clearance. margin: [m]; contact: {time [s], gap [m]} of the first contact, or null */
export function clearancePlan({ time, clearance, grazes, margin, contact }) {
  const low = 1000 * Math.min(0, ...clearance);
  const high = 1000 * Math.max(margin, ...clearance) || 1;
  return {
    labels: [phrase("time [s]"), phrase("clearance [mm]")],
    table: [time, clearance.map((one) => 1000 * one)],
    range: [ABOVE * low - 0.04 * high, ABOVE * high],
    width: 1.5,
    draw(pen) {
      pen.across(1000 * margin, "contact");
      for (const graze of grazes) pen.dot(graze.time, 1000 * graze.clearance, "text", 2.5);
      if (contact) pen.cross(contact.time, 1000 * contact.gap, "contact");
    },
  };
}

/**
 * Proven stray against the pitch, from an answer of /tolerance-curve. own: the stray of the dance on the page [m];
 * least: the minimum pitch with that stray [m], or null
 */
export function curvePlan({ pitch, stray, own, least }) {
  return {
    labels: [phrase("pitch [m]"), phrase("stray [cm]")],
    table: [pitch, stray.map((one) => 100 * one)],
    range: [0, 100 * ABOVE * Math.max(own, ...stray)],
    width: 2,
    draw(pen) {
      if (own > 0) pen.across(100 * own, "text");
      if (least !== null) pen.up(least, "clear");
    },
  };
}

/**
 * Distance of the head from the centre at first contact, against the pitch, from an answer of /pitch-scan.
 * circle: radius of the turning circle [m]; coarse: true for a first view of samples, whose jumps are not known yet
 */
export function scanPlan({ pitch, radius, pieces, jumps, minimum_pitch, circle, coarse }) {
  const samples = pitch.map((one, k) => [one, radius[k]]);
  const stretches = coarse ? [samples].filter((points) => points.length) : staircase(samples, pieces, jumps);
  return {
    labels: [phrase("pitch [m]"), phrase("radius [m]")],
    table: [pitch, radius],
    range: [0, ABOVE * Math.max(circle, ...radius)],
    width: 0,
    draw(pen) {
      pen.across(circle, "text");
      pen.up(minimum_pitch, "clear");
      for (const points of stretches) pen.along(points, "accent", coarse ? [3, 3] : []);
      for (const points of stretches) for (const [x, y] of [points[0], points.at(-1)]) pen.dot(x, y, "accent", 2);
    },
  };
}

/** Stretches without a jump, each a list of points: the samples of a piece, and before and after them the ends of jumps. */
export function staircase(samples, pieces, jumps) {
  const ends = jumps.map(({ pitch, radius }) => pitch.map((one, k) => [one, radius[k]]));
  const stretches = [[]];
  const jump = ([before, after]) => {
    stretches.at(-1).push(before);
    stretches.push([after]);
  };
  for (const [from, to] of pieces) {
    const left = ends.length;
    while (ends.length && ends[0][0][0] < samples[from][0]) jump(ends.shift());
    // Two pieces without a jump between them are apart: at the pitches between them nothing touches.
    if (left === ends.length) stretches.push([]);
    stretches.at(-1).push(...samples.slice(from, to));
  }
  ends.forEach(jump);
  return stretches.filter((points) => points.length);
}

/** Round numbers in a range, with steps of 1, 2 or 5 times a power of ten, and their decimals: {values, decimals}. most: steps at most */
export function ticks([low, high], most) {
  const rough = (high - low) / most || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((one) => one * power).find((one) => one >= rough);
  const first = Math.ceil(low / step - ROUNDING);
  const values = Array.from({ length: Math.max(Math.floor(high / step + ROUNDING) - first + 1, 0) }, (_, k) => (first + k) * step);
  return { values, decimals: Math.max(0, -Math.floor(Math.log10(step) + ROUNDING)) };
}
