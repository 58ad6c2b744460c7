/** The clock of the dance: plays, steps, scrubs, and stops at first contact. */

import { $, make, numberIn, onClick, onSlide } from "./elements.js";
import { announce } from "./overlays.js";
import { clockIn, secondsBetween } from "./passages.js";
import { pending } from "./pending.js";
import { RATES } from "./state.js";
import { say, sentencesOf } from "./text.js";

/** Time between requests for the service's own numbers in motion [ms]. */
const EXACT_EVERY = 250;
/** Time between steps of the dance with reduced motion [ms]. */
const STEP_EVERY = 500;
/** Longest frame time that counts [ms], so that the dance does not jump after a slow frame. */
const FRAME_MAX = 100;
const MOTION = Symbol("motion");
/** Doors behind which the dance slows down before a contact; time in which it would be there at the speed of each instant [s], and least speed [1]. */
const [SLOW, BRAKE, SLOWEST] = [["arrival", "look"], 1.5, 1];

export class Player {
  #playing = false;
  #frame = 0;
  #requested = 0;
  /** Time since the dance last moved [ms]. */
  #passed = 0;
  #exact = null;

  /**
   * show(pose): draws it; list(pose): only puts it into the table
   * @param {State} state
   * @param {Questions} questions
   */
  constructor(state, questions, show, list) {
    this.state = state;
    this.questions = questions;
    this.show = show;
    this.list = list;
    this.still = matchMedia("(prefers-reduced-motion: reduce)");
    onClick("#play", () => this.toggle());
    onClick("#back", () => this.#step(-1));
    onClick("#on", () => this.#step(1));
    onClick("#to-end", () => this.seek(Infinity));
    onSlide($("#time"), () => this.seek(Number($("#time").value)));
    onClick("#clock", () => this.#typeTime());
    $("#rate").append(...RATES.map((rate) => new Option(`${rate}×`, String(rate))));
    $("#rate").addEventListener("change", (event) => state.set({ rate: Number(event.target.value) }));
  }

  get playing() {
    return this.#playing;
  }

  /**
   * Play from the beginning at the first movement of a pointer or the first touch, unless motion is reduced or a key comes first: who reads the
   * page by keys or by the landmarks of a screen reader starts the dance with its button.
   */
  open() {
    if (this.still.matches) return;
    const waiting = new AbortController();
    const listen = (type, act) => addEventListener(type, act, { capture: true, signal: waiting.signal });
    const end = () => waiting.abort();
    for (const type of ["keydown", "focusin", "popstate"]) listen(type, end);
    for (const type of ["pointerdown", "pointermove", "wheel"]) {
      listen(type, () => {
        end();
        if (!this.#playing && this.state.get("time") === 0) this.toggle();
      });
    }
  }

  get #span() {
    return this.questions.dance ?? { begin: 0, end: 0 };
  }

  /** The shown instant; without a time in the state it is the end. */
  get time() {
    const { begin, end } = this.#span;
    return Math.min(Math.max(this.state.get("time") ?? end, begin), end);
  }

  seek(time) {
    const { begin, end } = this.#span;
    this.state.set({ time: time >= end ? null : Math.max(begin, time) });
  }

  /** Let a person type the time in place of the clock: in seconds, or a time of day if the start has one. */
  #typeTime() {
    if (this.#playing) this.stop();
    const clock = $("#clock");
    const field = make("input", { id: "typed-time", inputMode: "decimal", autocomplete: "off", value: clock.textContent.split(" ")[0], "aria-label": say("Type a time") });
    const end = () => {
      field.onblur = null;
      clock.hidden = false;
      field.remove();
    };
    const take = () => {
      const start = this.questions.dance?.clock;
      const [time, day] = [numberIn(field.value), start && clockIn(field.value)];
      end();
      if (typeof time === "number") this.seek(time);
      else if (day) this.seek(secondsBetween(start, day));
      else announce(() => say("Write the time in seconds, such as 300{clock}.", { clock: start ? say(", or as 19:31:00") : "" }));
    };
    field.onkeydown = (event) => {
      if (event.key === "Enter") take();
      else if (event.key === "Escape") end();
      else return;
      event.preventDefault(); // Enter would press the clock.
      clock.focus();
    };
    field.onblur = take;
    clock.hidden = true;
    clock.after(field);
    field.select();
  }

  /** Seconds of the dance in a second: for those who look, fewer before benches touch, so that they see it come. */
  get #rate() {
    const rate = this.state.get("rate");
    const { answer, end } = this.questions.dance;
    if (!SLOW.includes(this.state.get("door")) || !answer.time) return rate;
    return Math.min(rate, Math.max((end - this.time) / BRAKE, SLOWEST));
  }

  #step(seconds) {
    this.stop();
    this.seek(this.time + seconds);
  }

  toggle() {
    if (this.#playing) return this.stop();
    const { begin, end } = this.#span;
    if (begin >= end) return;
    this.questions.dance.track?.retry();
    if (this.state.get("time") === null) this.seek(begin);
    this.#playing = true;
    pending(MOTION, true);
    this.translate();
    this.#tick(performance.now(), performance.now());
  }

  translate() {
    $("#play").textContent = `${this.#playing ? "❚❚" : "▶"} ${say(this.#playing ? "Pause" : "Play")}`;
  }

  /** After a change of the time or of the answers: show samples, and ask for the service's own numbers. */
  update(ask = true) {
    const { dance } = this.questions;
    // A carrier's view has its own clock.
    if (!dance || this.state.get("bench") !== null) return;
    const { time } = this;
    const now = performance.now();
    const pose = dance.track?.at(time);
    const isExact = this.#exact?.time === time && this.#exact.dance === dance;
    if (pose && (time < dance.end || dance.parts) && !isExact) this.show(pose);
    if (!ask || (this.#playing && now - this.#requested < EXACT_EVERY)) return;
    this.#requested = now;
    if (!dance.parts) this.questions.pose(time);
  }

  /** Called when the service's own numbers arrive. */
  exact(pose) {
    this.#exact = pose;
    if (!this.#playing || pose.time === this.time) this.show(pose);
    else this.list(pose);
  }

  /** Stop at the instant shown. */
  stop() {
    this.#playing = false;
    pending(MOTION, false);
    cancelAnimationFrame(this.#frame);
    this.translate();
    this.update();
  }

  #tick(now, before) {
    this.#frame = requestAnimationFrame((next) => this.#tick(next, now));
    const { dance } = this.questions;
    if (!dance) return this.stop();
    const refusal = dance.track?.refusal;
    if (refusal) {
      announce(() => sentencesOf([say("The dance cannot be played: step through it, or move the time."), refusal.sentence]));
      return this.stop();
    }
    if (!dance.track?.at(this.time)) return;
    this.#passed += Math.min(now - before, FRAME_MAX);
    if (this.still.matches && this.#passed < STEP_EVERY) return;
    this.seek(this.time + (this.#passed / 1000) * this.#rate);
    this.#passed = 0;
    if (this.state.get("time") === null) this.stop();
  }
}
