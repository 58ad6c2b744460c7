/** A figure with its sentences: a person drags their numbers, the service answers, and the figure is drawn. */

import { Problem, Superseded } from "../api.js";
import { button, make, textButton } from "../elements.js";
import { say } from "../text.js";
import { CODE } from "./code.js";
import { Dial } from "./dial.js";

/** A name in a text: a number to drag, a number of the answer, or with a value a button that sets a number. */
const NAMES = /\{(\w+)(?:=([\d.]+))?\}/;
const EVERY_THIRD = 3;
const TALL = 0.62;
const [LOWEST, HIGHEST] = [300, 440];
/** Least width of a page after its layout [px]. */
const NARROWEST = 160;

export class Figure {
  data = null;
  /** The problem of a refusal; null if there is none. */
  #refused = null;
  #texts = [];
  #outputs = new Map();

  /**
   * section: with its texts; plan: {dials, ask(ask, values) -> data, draw(svg, {width, height}, data) -> sheet, outputs(data)}, perhaps
   * refine(ask), refused(error, values) -> data that shows what a refusal means or null, and, where the drawing is dragged,
   * pull(place, data, begins) -> {name of a dial: value}; changed(): called when a number changes
   * @param {Service} service
   */
  constructor(section, plan, service, changed = () => {}) {
    this.section = section;
    this.plan = plan;
    this.service = service;
    const dial = ([name, one]) => [name, new Dial({ ...one, unit: () => (one.unit === "turns" ? say("turns") : one.unit) }, () => {
      changed();
      this.change();
    })];
    this.dials = Object.fromEntries(Object.entries(plan.dials).map(dial));
    const part = (selector) => section.querySelector(selector);
    this.figure = part("figure");
    this.svg = part("svg");
    this.note = part(".note");
    this.#texts = [...section.querySelectorAll(".lead, .verdict, .more")];
    this.code = make("code");
    const copy = textButton("Copy", () => navigator.clipboard?.writeText(this.code.textContent));
    const python = make("details", { className: "python" }, make("summary", { "data-text": "The same in Python" }), make("pre", { tabIndex: 0 }, this.code), copy);
    section.append(python);
    this.#pulled();
    new ResizeObserver(() => this.draw()).observe(this.svg);
  }

  /** Write all sentences in the language of the page. */
  translate() {
    for (const element of this.#texts) {
      element.replaceChildren(...this.#sentence(say(element.dataset.text ?? "{verdict}")));
      element.hidden = false;
    }
    for (const dial of Object.values(this.dials)) dial.show(say(dial.plan.label));
    this.draw();
    this.#tell();
  }

  #sentence(text) {
    const pieces = text.split(NAMES);
    return pieces.flatMap((piece, k) => {
      if (k % EVERY_THIRD === 0) return piece;
      return k % EVERY_THIRD === 1 ? this.#number(piece, pieces[k + 1]) : [];
    });
  }

  #number(name, value) {
    const dial = this.dials[name];
    if (!dial) {
      this.#outputs.set(name, make("span", { className: "output", textContent: "…", "data-name": name }));
      return this.#outputs.get(name);
    }
    if (value === undefined) return dial.element;
    return button({ className: "try", textContent: dial.words(Number(value)) }, () => dial.choose(Number(value)));
  }

  /** Ask the service about the present numbers. */
  async change() {
    const values = Object.fromEntries(Object.entries(this.dials).map(([name, { value }]) => [name, value]));
    const { id } = this.section;
    this.code.textContent = CODE[id](values);
    this.figure.setAttribute("aria-busy", "true");
    try {
      const answer = await this.plan.ask((call, how) => this.service.ask(`${id} ${call}`, call, how), values);
      [this.data, this.#refused] = [{ ...answer, values }, null];
    } catch (error) {
      if (error instanceof Superseded) return;
      if (!(error instanceof Problem)) throw error;
      const meaning = error.errors[0] && this.plan.refused?.(error.errors[0], values);
      if (meaning) this.data = { ...meaning, values };
      this.#refused = meaning ? null : error.problem;
    }
    this.figure.setAttribute("aria-busy", "false");
    this.draw();
    this.#tell();
  }

  /** Ask for the slower part that refines the drawing, if there is one; where the service refuses it, the drawing stays. */
  async refine() {
    try {
      await this.plan.refine?.((call, how) => this.service.ask(`${this.section.id} ${call} in full`, call, how));
    } catch (error) {
      if (!(error instanceof Problem)) throw error;
    }
    this.draw();
  }

  /** Say that the service is lost. words: text for that, or nothing when it is back */
  lost(words) {
    this.missed = words;
    this.#tell();
  }

  /** Show the error below the drawing, which is then older than the numbers. */
  #tell() {
    const waits = this.missed && this.figure.getAttribute("aria-busy") === "true";
    this.note.textContent = waits ? this.missed : this.#refused?.sentence ?? "";
    this.figure.classList.toggle("stale", Boolean(this.#refused || waits));
  }

  draw() {
    const { svg, data, plan } = this;
    if (!data || svg.clientWidth < NARROWEST) return;
    const width = svg.clientWidth;
    const height = Math.round(Math.min(Math.max(TALL * width, LOWEST), HIGHEST));
    svg.setAttribute("height", String(height));
    svg.replaceChildren();
    this.sheet = plan.draw(svg, { width, height }, data);
    // On paper the drawing is scaled.
    svg.setAttribute("viewBox", `0 0 ${width} ${svg.getAttribute("height")}`);
    for (const [name, words] of Object.entries(plan.outputs(data))) {
      const output = this.#outputs.get(name);
      if (output && output.textContent !== words) output.textContent = words;
    }
  }

  /** Let drags in the drawing change the numbers too. */
  #pulled() {
    const { svg, plan } = this;
    if (!plan.pull) return;
    svg.classList.add(plan.knob ? "knobs" : "pulls");
    let held = false;
    const go = (event, begins = false) => {
      const { left, top } = svg.getBoundingClientRect();
      const place = this.sheet.from(event.clientX - left, event.clientY - top);
      for (const [name, value] of Object.entries(plan.pull(place, this.data, begins))) this.dials[name].set(value);
    };
    svg.addEventListener("pointerdown", (event) => {
      if (!this.sheet || event.button || (plan.knob && !(event.target instanceof Element && event.target.classList.contains("knob")))) return;
      svg.setPointerCapture(event.pointerId);
      held = true;
      go(event, true);
      event.preventDefault();
    });
    svg.addEventListener("pointermove", (event) => held && go(event));
    svg.addEventListener("lostpointercapture", () => (held = false));
  }
}
