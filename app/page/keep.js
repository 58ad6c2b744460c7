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
    const { query, end } = this.questions.dance;
    const body = JSON.stringify(this.questions.body({ times: { start: 0, stop: Math.floor(end), step: CSV_STEP } }));
    const base = new URL("./", location).href;
    $("#curl").textContent = [
      `curl '${base}collision-time?${new URLSearchParams(query)}'`,
      `curl '${base}trajectory' -H 'Content-Type: application/json' -d '${body}'`,
    ].join("\n");
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

  async csv() {
    const body = this.questions.body({ times: { start: 0, stop: this.questions.dance.end, step: CSV_STEP } });
    return ["trajectory.csv", await this.service.ask("csv", "trajectory", { body, accept: "text/csv" })];
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
    const { query } = this.questions.dance;
    return ["first-contact.svg", await this.service.ask("figure", "figures/contact.svg", { query, accept: "image/svg+xml" })];
  }

  async json() {
    const text = JSON.stringify(this.questions.dance.answer, null, 2);
    return ["collision-time.json", new Blob([text], { type: "application/json" })];
  }
}
