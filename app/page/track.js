/**
 * The dance as samples of the service, loaded in chunks around the shown time.
 *
 * Between two samples, SAMPLE_TRAVEL metres of the head apart, the cubic through four of them gives smooth motion. It is
 * off by less than 1 mm down to a radius of 2 m, and used only for the moving picture. Numbers on the page and the
 * picture at rest are the service's own for that instant.
 */

import { Problem } from "./api.js";

const SAMPLE_TRAVEL = 0.5;
const [CHUNK_CELLS, CHUNK_SAMPLES_MIN] = [30_000, 16];
const DECIMALS = 5;
const KEPT = 6;

/** Instants times handles for the colours of the whole dance. */
const SPEED_CELLS = 12_000;

/** Instants for the colours of the whole dance: fewer with more handles. */
export function speedTimes({ begin, end, numbers: { benches } }) {
  const count = Math.min(Math.max(Math.floor(SPEED_CELLS / (benches + 1)), 8), 100);
  return begin < end ? { start: begin, stop: end, step: (end - begin) / count } : [begin];
}

export class Track {
  #chunks = new Map();
  #loading = new Set();
  #kept = KEPT;

  /**
   * ask(chunk, times, decimals) -> Promise of the table at {start, stop, step}; span: [first, last] instant [s];
   * ready() is called when a chunk has arrived
   */
  constructor(ask, span, handles, headSpeed, ready) {
    this.ask = ask;
    this.span = span;
    this.handles = handles;
    this.ready = ready;
    this.samples = Math.max(3, Math.ceil(((span[1] - span[0]) * headSpeed) / SAMPLE_TRAVEL));
    this.step = (span[1] - span[0]) / this.samples;
    this.size = Math.max(CHUNK_SAMPLES_MIN, Math.floor(CHUNK_CELLS / handles));
    this.stopped = false;
    this.refusal = null;
  }

  /** Ask again for what the service refused. */
  retry() {
    this.refusal = null;
  }

  /** True if every chunk has arrived and is kept. */
  get isWhole() {
    return this.#kept === Infinity && this.#chunks.size * this.size >= this.samples;
  }

  /** Number of the places of all handles. */
  get cells() {
    return this.samples * this.handles;
  }

  /** Load and keep every chunk. */
  async hold() {
    this.#kept = Infinity;
    for (let k = 0; k * this.size < this.samples && !this.stopped && !this.refusal; k++) {
      while (this.#loading.has(k)) await new Promise(requestAnimationFrame);
      if (!this.#chunks.has(k)) await this.#load(k, this.#first(k));
    }
  }

  /** Number of the first sample of a chunk. */
  #first(k) {
    return Math.max(0, k * this.size - 2);
  }

  /** {time, x, y, speed} at an instant, each a row over the handles; null while its chunk is on its way. */
  at(time) {
    if (!this.step) return null;
    const place = Math.min(Math.max((time - this.span[0]) / this.step, 0), this.samples);
    const index = Math.min(Math.floor(place), this.samples - 1);
    const chunk = this.#chunk(Math.floor(index / this.size));
    this.#chunk(Math.floor((index + 0.6 * this.size) / this.size));
    if (!chunk) return null;
    const from = Math.min(Math.max(index - chunk.first - 1, 0), chunk.time.length - 4);
    const weights = cubic(place - chunk.first - from);
    const mix = (table) => mixed(table.slice(from, from + 4), weights);
    return { time, x: mix(chunk.x), y: mix(chunk.y), speed: mix(chunk.speed) };
  }

  #chunk(k) {
    if (k * this.size >= this.samples || this.stopped || this.refusal) return null;
    if (!this.#chunks.has(k) && !this.#loading.has(k)) this.#load(k, this.#first(k));
    return this.#chunks.get(k);
  }

  async #load(k, first) {
    const last = Math.min(this.samples, (k + 1) * this.size + 1);
    const [start, stop] = [first, last].map((sample) => Math.min(this.span[0] + sample * this.step, this.span[1]));
    this.#loading.add(k);
    try {
      const table = await this.ask(k, { start, stop, step: this.step }, DECIMALS);
      this.#chunks.set(k, { ...table, first });
      if (this.#chunks.size > this.#kept) this.#chunks.delete(this.#chunks.keys().next().value);
      if (!this.stopped) this.ready();
    } catch (error) {
      // The service refuses, or the dance has changed; at rest the dance is drawn without samples.
      if (error instanceof Problem) this.refusal = error.problem;
      else this.stopped = true;
    } finally {
      this.#loading.delete(k);
    }
  }
}

/** Lagrange's weights of samples at 0, 1, 2 and 3 for the place u between them. */
function cubic(u) {
  const [a, b, c, d] = [u, u - 1, u - 2, u - 3];
  return [(-b * c * d) / 6, (a * c * d) / 2, (-a * b * d) / 2, (a * b * c) / 6];
}

function mixed(/** @type {number[][]} */ [a, b, c, d], /** @type {number[]} */ [p, q, r, s]) {
  return Float64Array.from(b, (_, k) => p * a[k] + q * b[k] + r * c[k] + s * d[k]);
}
