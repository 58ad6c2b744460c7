/** Benches measured one by one: a table that is typed, pasted, dropped or opened, in the service's format. */

import { $, make, worded } from "./elements.js";
import { Pause } from "./pending.js";
import { nameBenches, refusalWords, say } from "./text.js";

/** A typed table counts after this pause [ms]. */
const TYPING = 500;
const ROWS = 6;
/** First letters of the column names: the name, and the sizes in the order of a table. */
const COLUMNS = { names: /^(name|名称|姓名)/i, lengths: /^(length|长)/i, widths: /^(width|宽)/i, overhangs: /^(overhang|孔距|端距)/i };
const QUOTED = /^"(.*)"$/s;

/** Entries of a line; a quoted one may hold the separator. */
function cellsOf(line, separator) {
  const cells = line.match(new RegExp(`(?:^|${separator})\\s*("(?:[^"]|"")*"|[^${separator}]*)`, "g")) ?? [];
  return cells.map((cell, k) => cell.slice(k && 1).trim().replace(QUOTED, (_, inner) => inner.replaceAll('""', '"')).trim());
}

/** The benches of a table that the service accepts: {names, lengths, widths, overhangs}, head first [m]. */
export function benchesOf(text) {
  const [first = "", ...lines] = text.split(/\r?\n|\r/).filter((line) => line.trim());
  const separator = ["\t", ";"].find((mark) => first.includes(mark)) ?? ",";
  const heads = cellsOf(first, separator);
  const rows = lines.map((line) => cellsOf(line, separator)).filter((row) => row.some(Boolean));
  const column = (pattern) => {
    const at = heads.findIndex((head) => pattern.test(head));
    return rows.map((row) => row[at] ?? "");
  };
  const numbers = (pattern) => column(pattern).map((cell) => Number(cell.replace(",", ".")));
  const { names, ...sizes } = COLUMNS;
  return { names: column(names), ...Object.fromEntries(Object.entries(sizes).map(([name, pattern]) => [name, numbers(pattern)])) };
}

const quoted = (name) => (/[",]/.test(name) ? `"${name.replaceAll('"', '""')}"` : name);

/** The table of a dragon in a request; an empty text for equal benches without names. */
export function tableOf({ csv, lengths, widths, overhangs, names, ...equal }) {
  if (csv !== undefined) return csv;
  if (!lengths && !names?.some(Boolean)) return "";
  const { benches = 223, head_length: head = 3.41, body_length: body = 2.2, width = 0.3, overhang = 0.275 } = equal;
  const own = lengths ?? Array.from({ length: benches }, (_, k) => (k ? body : head));
  const rows = own.map((length, k) => [quoted(names?.[k] ?? ""), length, widths?.[k] ?? width, overhangs?.[k] ?? overhang].join());
  return ["name,length,width,overhang", ...rows].join("\n");
}

export class BenchTable {
  /** group: the numbers of equal benches, which the table replaces */
  constructor(group, state) {
    Object.assign(this, { group, state });
    this.title = make("summary");
    const described = { "aria-describedby": "csv-help csv-error" };
    this.text = make("textarea", { id: "csv", rows: ROWS, spellcheck: false, wrap: "off", "data-label": "csv", ...described });
    this.file = make("input", { type: "file", id: "csv-file", accept: ".csv,.tsv,.txt", "data-label": "csvOpen", hidden: true });
    this.error = make("p", { id: "csv-error", className: "error", hidden: true });
    this.note = make("p", { className: "hint" });
    const acts = { csvOpen: () => this.file.click(), csvBegin: () => this.#begin(), csvClear: () => state.set({ csv: "" }) };
    const buttons = Object.entries(acts).map(([id, act]) => worded(id, act, { id }));
    const help = make("p", { id: "csv-help", className: "hint", "data-text": "csvHelp" });
    this.box = make("details", { id: "one-by-one" }, this.title, help, this.text, this.error, this.note, make("p", { className: "buttons" }, ...buttons, this.file));
    group.append(this.box);
    this.#listen();
    this.show();
  }

  #listen() {
    const typing = new Pause("csv");
    this.text.addEventListener("input", () => typing.begin(TYPING, () => this.#take(this.text.value)));
    this.text.addEventListener("change", () => {
      typing.end();
      this.#take(this.text.value);
    });
    this.file.addEventListener("change", async () => {
      if (this.file.files[0]) this.#take(await this.file.files[0].text());
      this.file.value = "";
    });
    this.box.addEventListener("dragover", (event) => event.preventDefault());
    this.box.addEventListener("drop", async (event) => {
      const file = event.dataTransfer.files[0];
      if (!file) return;
      event.preventDefault();
      this.#take(await file.text());
    });
    this.state.listen((names) => (names.has("csv") || names.has("path")) && this.show());
  }

  #take(text) {
    this.state.set({ csv: text.trim() && text });
    this.state.write();
    this.show();
  }

  /** Begin with the present equal benches. */
  #begin() {
    const numbers = ["benches", "head_length", "body_length", "width", "overhang"].map((name) => [name, Number(this.state.get(name))]);
    this.#take(tableOf({ ...Object.fromEntries(numbers), names: [say("theHead")] }));
  }

  show() {
    const { csv, listed } = this.state.said();
    nameBenches(listed?.names ?? []);
    if (this.text.value !== csv) this.text.value = csv;
    if (csv) this.box.open = true;
    this.group.classList.toggle("listed", Boolean(csv));
    $("#csvBegin").hidden = Boolean(csv);
    $("#csvClear").hidden = !csv;
    this.title.textContent = csv ? say("csvCount", { count: listed.lengths.length }) : say("csv");
    this.note.textContent = csv && !this.state.fits ? say("csvLong") : "";
  }

  /** error: of the service about the table, which names the line; or none */
  refuse(error) {
    this.error.hidden = !error;
    Object.assign(this.error, error ? refusalWords(error) : { textContent: "" });
    this.text.setAttribute("aria-invalid", Boolean(error));
  }
}
