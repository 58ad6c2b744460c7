/** The clock of the dance: plays, steps, scrubs, and stops at first contact. */

import { RATES } from "./state.js";
import { say } from "./text.js";

/** While the dance moves, the service's own numbers are asked so often [ms]. */
const EXACT_EVERY = 250;
/** With reduced motion the dance moves in steps this far apart [ms]. */
const STEP_EVERY = 500;
/** A frame that took longer than this [ms] does not jump ahead. */
const FRAME_MAX = 100;

const $ = (selector) => document.querySelector(selector);

export class Player {
  #playing = false;
  #frame = 0;
  #asked = 0;
  #drawn = 0;

  /** show(pose) draws it; list(pose) puts it into the table alone */
  constructor(state, questions, show, list) {
    Object.assign(this, { state, questions, show, list });
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    $("#play").addEventListener("click", () => this.toggle());
    $("#back").addEventListener("click", () => this.step(-1));
    $("#on").addEventListener("click", () => this.step(1));
    $("#to-end").addEventListener("click", () => this.seek(Infinity));
    $("#time").addEventListener("input", (event) => this.seek(Number(event.target.value)));
    $("#rate").append(...RATES.map((rate) => new Option(`${rate}×`, rate)));
    $("#rate").addEventListener("change", (event) => this.state.set({ rate: Number(event.target.value) }));
  }

  /** The instant that is shown: no time in the state is the end. */
  time() {
    const { begin, end } = this.#span();
    const time = this.state.get("time");
    return time === null ? end : Math.min(Math.max(time, begin), end);
  }

  seek(time) {
    const { begin, end } = this.#span();
    this.state.set({ time: time >= end ? null : Math.max(begin, time) });
  }

  #span() {
    return this.questions.dance ?? { begin: 0, end: 0 };
  }

  step(seconds) {
    this.#stop();
    this.seek(this.time() + seconds);
  }

  toggle() {
    if (this.#playing) return this.#stop();
    const { begin, end } = this.#span();
    if (begin >= end) return;
    if (this.state.get("time") === null) this.seek(begin);
    this.#playing = true;
    this.translate();
    this.#tick(performance.now(), performance.now());
  }

  translate() {
    $("#play").textContent = `${this.#playing ? "❚❚" : "▶"} ${say(this.#playing ? "pause" : "play")}`;
  }

  /** The time, or what is known of the dance, is another: show it from samples, and ask for the service's own. */
  update(ask = true) {
    const { dance } = this.questions;
    if (!dance) return;
    const time = this.time();
    const now = performance.now();
    const pose = dance.track?.at(time);
    if (pose && time < dance.end && (!this.#exactAt(time))) this.show(pose);
    if (!ask || (this.#playing && now - this.#asked < EXACT_EVERY)) return;
    this.#asked = now;
    this.questions.pose(time);
  }

  /** The service's own numbers have come. */
  exact(pose) {
    this.last = pose;
    if (!this.#playing || pose.time === this.time()) this.show(pose);
    else this.list(pose);
  }

  #exactAt(time) {
    return this.last?.time === time && this.last.dance === this.questions.dance;
  }

  #stop() {
    this.#playing = false;
    cancelAnimationFrame(this.#frame);
    this.translate();
    this.update();
  }

  #tick(now, before) {
    if (!this.#playing) return;
    this.#frame = requestAnimationFrame((next) => this.#tick(next, now));
    const { dance } = this.questions;
    const time = this.time();
    if (!dance.track?.at(time)) return;
    this.#drawn += Math.min(now - before, FRAME_MAX);
    if (this.still.matches && this.#drawn < STEP_EVERY) return;
    const next = time + (this.#drawn / 1000) * this.state.get("rate");
    this.#drawn = 0;
    if (next >= dance.end) {
      this.state.set({ time: null });
      this.#stop();
    } else this.state.set({ time: next });
  }
}
