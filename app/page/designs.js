/** Many designs at once: the form, its jobs, and the map from which a design opens as a dance. */

import { $ } from "./elements.js";
import { Jobs } from "./jobs.js";
import { SweepMap } from "./map.js";
import { QUESTIONS, SweepForm } from "./sweeps.js";
import { language, learn } from "./text.js";

export class Designs {
  /** The spec behind the map; null if another browser asked for it. */
  #spec = null;

  /**
   * names: of the state's numbers, which a design may set
   * @param {State} state
   * @param {Service} service
   */
  constructor(state, service, names) {
    this.state = state;
    this.names = names;
    this.service = service;
    this.map = new SweepMap($("#map"), (over, row) => this.#open(over, row));
    this.jobs = new Jobs($("#jobs"), service, (columns, spec) => this.#show(columns, spec));
    new SweepForm($("#sweep"), state, (spec) => this.jobs.start(spec));
  }

  async #show(columns, spec) {
    await learn(this.service, language(), "columns");
    this.#spec = spec ?? null;
    this.map.show(columns, QUESTIONS[spec?.question]?.value, QUESTIONS[spec?.question]?.named);
  }

  /** Show the dance of one design. over: its parameters; row: all columns of it */
  #open(over, row) {
    const { path, value } = QUESTIONS[this.#spec?.question] ?? { path: "spiral" };
    const answered = value === "pitch" && row.pitch !== null ? { pitch: row.pitch } : {};
    const known = Object.entries({ ...this.#spec?.request, ...over, ...answered }).filter(([name]) => this.names.includes(name));
    // Back leads to the numbers before.
    this.state.push({ path, time: null, view: null, ...Object.fromEntries(known.map(([name, number]) => [name, String(number)])) });
    $("#canvas").scrollIntoView({ block: "nearest" });
  }
}
