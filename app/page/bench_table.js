/** The editor of a table of benches: it is typed, pasted, dropped or opened. */

import { tableOf, tableText } from "./read_table.js";
import { $, bearer, make, textButton } from "./elements.js";
import { LABELS } from "./fields.js";
import { announce, announceRefusal } from "./overlays.js";
import { Pause } from "./pending.js";
import { language, nameBenches, say, sentencesOf } from "./text.js";

/** A typed table counts after this pause [ms]. */
const TYPING = 500;
const ROWS = 6;

/** The text of a table in a file, null if it holds none, and notes on it; the service reads workbooks. throws: Problem */
export async function tableOfFile(file, service) {
  const typed = await tableText(file);
  if (typed !== null) return { text: typed, notes: [] };
  const { dance, notes } = await service.ask("places", "places", { query: { language: language() }, file, headers: bearer() });
  const text = dance?.dragon?.csv ?? null;
  return { text, notes: text === null ? [say("{name} holds no table of benches.", { name: file.name })] : notes };
}

export class BenchTable {
  /**
   * group: the numbers of equal benches, which the table replaces
   * @param {State} state
   * @param {Service} service
   * @param {any} parts have the steps that can be undone
   */
  constructor(group, state, service, parts) {
    this.parts = parts;
    this.group = group;
    this.state = state;
    this.service = service;
    this.title = make("summary");
    const described = { "aria-describedby": "csv-help csv-error" };
    this.text = make("textarea", { id: "csv", rows: ROWS, spellcheck: false, wrap: "off", "data-label": LABELS.csv, ...described });
    this.file = make("input", { type: "file", id: "csv-file", accept: ".csv,.tsv,.txt,.xlsx", "data-label": "Open a table …", hidden: true });
    this.error = make("p", { id: "csv-error", className: "error", hidden: true });
    this.note = make("p", { className: "hint" });
    const buttons = [
      textButton("Open a table …", () => this.file.click(), { id: "csvOpen" }),
      textButton("Begin with equal benches", () => this.#begin(), { id: "csvBegin" }),
      textButton("Equal benches again", () => this.#take(""), { id: "csvClear" }),
    ];
    const help = make("p", { id: "csv-help", className: "hint", "data-text": "Paste a table or drop a file (CSV, .xlsx), head first, in metres: name (optional), length, width, overhang. Sweeps take equal benches." });
    this.box = make("details", { id: "one-by-one" }, this.title, help, this.text, this.error, this.note, make("p", { className: "buttons" }, ...buttons, this.file));
    group.append(this.box);
    this.#listen();
    this.show();
  }

  #listen() {
    const typing = new Pause("csv");
    this.text.addEventListener("input", () => typing.begin(TYPING, () => this.#take(this.text.value, "csv")));
    this.text.addEventListener("change", () => {
      typing.end();
      this.#take(this.text.value, "csv");
    });
    this.file.addEventListener("change", async () => {
      if (this.file.files[0]) await this.#open(this.file.files[0]);
      this.file.value = "";
    });
    this.box.addEventListener("dragover", (event) => event.preventDefault());
    this.box.addEventListener("drop", async (event) => {
      const file = event.dataTransfer.files[0];
      if (!file) return;
      event.preventDefault();
      await this.#open(file);
    });
    this.state.listen((names) => (names.has("csv") || names.has("path")) && this.show());
  }

  async #open(file) {
    try {
      const { text, notes } = await tableOfFile(file, this.service);
      if (text !== null) this.#take(text);
      if (notes.length) announce(() => sentencesOf(notes), true);
    } catch (error) {
      announceRefusal(error);
    }
  }

  /** Take another table, or none, as one step that can be undone. kind: of steps that are one if they follow each other soon */
  async #take(text, kind = null) {
    const csv = text.trim() && text;
    if (csv === this.state.get("csv")) return this.show();
    const { stepsOf } = await this.parts.load("history");
    stepsOf(this.state).change({ csv }, kind);
    this.show();
  }

  /** Begin with the present equal benches. */
  #begin() {
    const numbers = ["benches", "head_length", "body_length", "width", "overhang"].map((name) => [name, Number(this.state.get(name))]);
    this.#take(tableOf({ ...Object.fromEntries(numbers), names: [say("the head")] }));
  }

  show() {
    const { csv, listed } = this.state.extras();
    nameBenches(listed?.names ?? []);
    if (this.text.value !== csv) this.text.value = csv;
    if (csv) this.box.open = true;
    this.group.classList.toggle("listed", Boolean(csv));
    $("#csvBegin").hidden = Boolean(csv);
    $("#csvClear").hidden = !csv;
    this.title.textContent = csv ? say("Benches measured one by one: {count}", { count: listed.lengths.length }) : say(LABELS.csv);
    this.note.textContent = csv && !this.state.fits ? say("This table is too long for an address: save it as a file to share it.") : "";
  }

  /** error: of the service about the table, which names the line; or none */
  refuse(error) {
    this.error.hidden = !error;
    this.error.textContent = error?.sentence ?? "";
    this.text.setAttribute("aria-invalid", Boolean(error));
  }
}
