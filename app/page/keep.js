/** What a person can keep: the link, files, and the command that gives the same answer. */

import { Problem, Superseded } from "./api.js";
import { $, make, onClick } from "./elements.js";
import { strayOf } from "./state.js";
import { say } from "./text.js";

const CSV_STEP = 1;

export class Keep {
  /** announce(words): reports what happened */
  constructor(state, service, questions, canvas, announce) {
    Object.assign(this, { service, questions, canvas, announce });
    onClick("#share", () => {
      state.write();
      this.#copy(location.href);
    });
    onClick("#copy-curl", () => this.#copy($("#curl").textContent));
    for (const kind of ["csv", "png", "figure", "json"]) onClick(`#${kind}`, () => this.#save(kind));
  }

  /** The commands for the dance that is shown. */
  show() {
    const { dance } = this.questions;
    const base = new URL("./", location).href;
    const post = (path, body) => `curl '${base}${path}' -H 'Content-Type: application/json' -d '${JSON.stringify(body)}'`;
    const get = () => `curl '${base}collision-time?${new URLSearchParams(dance.query)}'`;
    const contact = dance.kind === "spiral" ? get() : post("check", this.questions.checkBody(dance));
    $("#curl").textContent = `${contact}\n${post("trajectory", this.#table())}`;
  }

  async #copy(text) {
    try {
      await navigator.clipboard.writeText(text);
      this.announce(say("copied"));
    } catch {
      this.announce(say("copyFailed"));
    }
  }

  async #save(kind) {
    if (!this.questions.dance) return;
    try {
      const [download, blob] = await this[kind]();
      const link = make("a", { href: URL.createObjectURL(blob), download });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
      this.announce(say("saved", { name: download }));
    } catch (error) {
      if (error instanceof Problem) this.announce(error.message);
      else if (!(error instanceof Superseded)) throw error;
    }
  }

  #table() {
    const { begin, end } = this.questions.dance;
    return this.questions.body({ times: { start: begin, stop: end, step: CSV_STEP } });
  }

  async csv() {
    return ["trajectory.csv", await this.service.ask("csv", "trajectory", { body: this.#table(), accept: "text/csv" })];
  }

  async png() {
    const { width, height } = this.canvas;
    const copy = make("canvas", { width, height });
    const context = copy.getContext("2d");
    context.fillStyle = getComputedStyle(this.canvas).backgroundColor;
    context.fillRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, 0);
    return ["dance.png", await new Promise((resolve) => copy.toBlob(resolve, "image/png"))];
  }

  async figure() {
    const { kind, query, numbers, end } = this.questions.dance;
    const { stray, hole, pin, ...flat } = query;
    // The figure of a contact has everybody in their place: with a stray, the figure is that of the last instant shown.
    const strays = strayOf(query) > 0;
    const body = this.questions.body(strays ? { time: end } : { margin: numbers.margin });
    const asked = kind === "spiral" && !strays ? { query: flat } : { body };
    const path = `figures/${strays ? "trajectory" : "contact"}.svg`;
    const blob = await this.service.ask("figure", path, { ...asked, accept: "image/svg+xml" });
    return [strays ? "dance.svg" : "first-contact.svg", blob];
  }

  /** The answer that the command gives; in the one shown, the engines may have judged only the pair. */
  async json() {
    const { dance } = this.questions;
    const path = dance.kind === "spiral" ? "collision-time" : "check";
    const asked = dance.kind === "spiral" ? { query: dance.query } : { body: this.questions.checkBody(dance) };
    const text = JSON.stringify(await this.service.ask("json", path, asked), null, 2);
    return [`${path}.json`, new Blob([text], { type: "application/json" })];
  }
}
