/** Two charts drawn by uPlot: clearance over time, and where the head stops against the pitch. */

import { say } from "./text.js";

const HEIGHT = 240;
const ABOVE = 1.06;

function colours() {
  const style = getComputedStyle(document.documentElement);
  const read = (name) => style.getPropertyValue(`--${name}`).trim();
  const [text, grid, line, bad, mark, good] = ["muted", "line", "accent", "contact", "text", "clear"].map(read);
  return { text, grid, line, bad, mark, good };
}

/** A chart in a box; click or drag calls seek(x). The marker `now` is an element, so moving it redraws nothing. */
class Chart {
  #plot = null;
  #data = null;
  #now = null;

  constructor(box, seek) {
    Object.assign(this, { box, seek });
    this.marker = document.createElement("div");
    this.marker.className = "now";
    new ResizeObserver(() => this.#plot?.setSize({ width: box.clientWidth, height: HEIGHT })).observe(box);
  }

  /** Draw anew, also after another language or colour scheme. */
  show(data = this.#data) {
    this.#data = data;
    this.#plot?.destroy();
    this.#plot = null;
    if (!data) return;
    this.#plot = new uPlot(this.options(data, colours()), this.table(data), this.box);
    this.#plot.over.append(this.marker);
    this.#listen(this.#plot.over);
    this.now(this.#now);
  }

  now(x) {
    this.#now = x;
    if (!this.#plot || x === null) return;
    const left = this.#plot.valToPos(x, "x");
    this.marker.hidden = !(left >= -1 && left <= this.#plot.over.clientWidth + 1);
    this.marker.style.transform = `translateX(${left}px)`;
  }

  frame(paint, xAxis, yAxis, series, hook, y) {
    const [grid, font] = [{ stroke: paint.grid, width: 1 }, "12px system-ui, sans-serif"];
    const looks = { stroke: paint.text, grid, ticks: grid, font, labelFont: font, labelSize: 22 };
    return {
      width: this.box.clientWidth,
      height: HEIGHT,
      legend: { show: false },
      cursor: { drag: { x: false, y: false }, y: false, points: { show: false } },
      scales: { x: { time: false }, y },
      axes: [
        { ...looks, label: say(xAxis), size: 34 },
        { ...looks, label: say(yAxis), size: 52 },
      ],
      series: [{}, series],
      hooks: { draw: [hook], setSize: [() => this.now(this.#now)], ready: [() => this.now(this.#now)] },
    };
  }

  #listen(over) {
    const go = (event) => {
      const box = over.getBoundingClientRect();
      this.seek(this.#plot.posToVal(Math.min(Math.max(event.clientX - box.left, 0), box.width), "x"));
    };
    over.addEventListener("pointerdown", (event) => {
      over.setPointerCapture(event.pointerId);
      go(event);
    });
    over.addEventListener("pointermove", (event) => event.buttons && go(event));
  }
}

/** Draws on a uPlot canvas at data coordinates. */
function pen(plot) {
  const { ctx: context } = plot;
  const at = (x, y) => [plot.valToPos(x, "x", true), plot.valToPos(y, "y", true)];
  const line = (from, to, colour, dash = [6, 4]) => {
    Object.assign(context, { strokeStyle: colour, lineWidth: 1.5 * devicePixelRatio });
    context.setLineDash(dash.map((one) => one * devicePixelRatio));
    context.beginPath();
    context.moveTo(...from);
    context.lineTo(...to);
    context.stroke();
    context.setLineDash([]);
  };
  const { left, top, width, height } = plot.bbox;
  return {
    across: (y, colour, dash) => line([left, at(0, y)[1]], [left + width, at(0, y)[1]], colour, dash),
    up: (x, colour, dash) => line([at(x, 0)[0], top], [at(x, 0)[0], top + height], colour, dash),
    dot(x, y, colour, radius) {
      context.beginPath();
      context.arc(...at(x, y), radius * devicePixelRatio, 0, 2 * Math.PI);
      Object.assign(context, { fillStyle: colour });
      context.fill();
    },
    cross(x, y, colour) {
      const [px, py] = at(x, y);
      const size = 6 * devicePixelRatio;
      for (const way of [1, -1]) line([px - size, py - way * size], [px + size, py + way * size], colour, []);
    },
  };
}

/** data: {time, clearance [m], grazes, margin [m], contact: time or null} */
export class ClearanceChart extends Chart {
  table({ time, clearance }) {
    return [time, clearance.map((one) => 1000 * one)];
  }

  options({ clearance, grazes, margin, contact }, paint) {
    const low = Math.min(0, ...clearance) * 1000;
    const high = 1000 * Math.max(margin, ...clearance) || 1;
    const hook = (plot) => {
      const draw = pen(plot);
      draw.across(1000 * margin, paint.bad);
      for (const graze of grazes) draw.dot(graze.time, 1000 * graze.clearance, paint.mark, 2.5);
      if (contact !== null) draw.cross(contact, 1000 * margin, paint.bad);
    };
    const range = [ABOVE * low - 0.04 * high, ABOVE * high];
    const series = { stroke: paint.line, width: 1.5, points: { show: false } };
    return this.frame(paint, "timeAxis", "clearanceAxis", series, hook, { range });
  }
}

/** data: {pitch, radius, pieces, circle: radius, least: minimum pitch} */
export class ScanChart extends Chart {
  table({ pitch, radius, pieces }) {
    const [x, y] = [[], []];
    for (const [from, to] of pieces) {
      // A hole between two pieces: a jump is not a line.
      if (x.length) {
        x.push((x.at(-1) + pitch[from]) / 2);
        y.push(null);
      }
      x.push(...pitch.slice(from, to));
      y.push(...radius.slice(from, to));
    }
    return [x, y];
  }

  options({ pitch, radius, pieces, circle, least }, paint) {
    const hook = (plot) => {
      const draw = pen(plot);
      draw.across(circle, paint.mark);
      draw.up(least, paint.good, [2, 3]);
      for (const [from, to] of pieces) for (const k of [from, to - 1]) draw.dot(pitch[k], radius[k], paint.line, 2);
    };
    const range = [0, ABOVE * Math.max(circle, ...radius)];
    const series = { stroke: paint.line, width: 2, points: { show: false } };
    return this.frame(paint, "pitchAxis", "radiusAxis", series, hook, { range });
  }
}
