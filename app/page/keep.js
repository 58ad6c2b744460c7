/** What a person takes away: the link, files, and the command that gives the same. */

import { Problem, Superseded } from "./api.js";
import { say } from "./text.js";

const $ = (selector) => document.querySelector(selector);
const CSV_STEP = 1;

export class Keep {
  /** announce(words) tells what happened */
  constructor(state, service, questions, canvas, announce) {
    Object.assign(this, { state, service, questions, canvas, announce });
    $("#share").addEventListener("click", () => this.#share());
    $("#copy-curl").addEventListener("click", () => this.#copy($("#curl").textContent));
    for (const kind of ["csv", "png", "figure", "json"]) $(`#${kind}`).addEventListener("click", () => this.#save(kind));
  }

  /** The commands for the dance that is shown. */
  show() {
    const { dance } = this.questions;
    const base = new URL("./", location).href;
    const post = (path, body) => `curl '${base}${path}' -H 'Content-Type: application/json' -d '${JSON.stringify(body)}'`;
    const contact =
      dance.kind === "turn"
        ? post("check", this.questions.checkBody(dance))
        : `curl '${base}collision-time?${new URLSearchParams(dance.query)}'`;
    $("#curl").textContent = `${contact}\n${post("trajectory", this.#table())}`;
  }

  async #share() {
    this.state.write();
    await this.#copy(location.href);
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
      const [name, blob] = await this[kind]();
      const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
      this.announce(say("saved", { name }));
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
    const copy = Object.assign(document.createElement("canvas"), { width: this.canvas.width, height: this.canvas.height });
    const context = copy.getContext("2d");
    context.fillStyle = getComputedStyle(this.canvas).backgroundColor;
    context.fillRect(0, 0, copy.width, copy.height);
    context.drawImage(this.canvas, 0, 0);
    return ["dance.png", await new Promise((resolve) => copy.toBlob(resolve, "image/png"))];
  }

  async figure() {
    const { kind, query, numbers } = this.questions.dance;
    const asked = kind === "spiral" ? { query } : { body: this.questions.body({ margin: numbers.margin }) };
    const blob = await this.service.ask("figure", "figures/contact.svg", { ...asked, accept: "image/svg+xml" });
    return ["first-contact.svg", blob];
  }

  async json() {
    const text = JSON.stringify(this.questions.dance.answer, null, 2);
    return ["collision-time.json", new Blob([text], { type: "application/json" })];
  }
}
