/** A class: the files in folders and archives, each with its team, and the table of all, which a teacher sorts and saves. */

import { button, download, make } from "./elements.js";
import { announceRefusal } from "./overlays.js";
import { announceSaved } from "./saved.js";
import { say } from "./text.js";

/** Endings of what is handed in, the wrong kinds included, for which the service has a sentence. */
const HANDED_IN = /\.(xlsx|xlsm|xls|csv|png|jpe?g|pdf|docx?)$/i;
/** Longest file that is unpacked [bytes]: the service reads none that is longer. */
const LONGEST = 20_000_001;
/** Signatures of a ZIP archive: the end of its list, and an entry of it. */
const [END, ENTRY] = [0x06054b50, 0x02014b50];
export const TYPES = { xlsx: "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet", csv: "text/csv" };

const foldersOf = (path) => path.split("/").slice(0, -1);

/** The files, each with its team: the first folder that not all of them share, else that in which all lie, or the name without an ending; empty for a file that lies alone. found: {file, path} */
function withTeams(found) {
  const sharedOf = (/** @type {string[][]} */ [first = [], ...others]) => {
    const differs = first.findIndex((name, k) => others.some((one) => one[k] !== name));
    return differs < 0 ? first.length : differs;
  };
  const every = found.map(({ path }) => foldersOf(path)).filter(({ length }) => length);
  // A file beside the folders of the teams is no team's.
  const deep = every.filter(({ length }) => length > 1);
  const root = deep.length && sharedOf(every) ? sharedOf(deep) : sharedOf(every);
  return found.map(({ file, path }) => {
    const folders = foldersOf(path);
    const own = folders[root] ?? (root > 1 ? folders[root - 1] : undefined);
    return { file, team: own ?? (folders.length ? file.name.replace(/\.\w+$/, "") : "") };
  });
}

const isHandedIn = (path) => HANDED_IN.test(path) && !path.split("/").some((part) => /^(\.|~\$|__MACOSX)/.test(part));

/** The bytes of a stream, at most so many. */
async function bytesOf(stream, most) {
  const parts = [];
  let count = 0;
  for (const reader = stream.getReader(); count < most; ) {
    const { done, value } = await reader.read();
    if (done) break;
    parts.push(value);
    count += value.length;
  }
  return new Blob(parts);
}

/** The files in a ZIP archive: {file, path}. */
async function unzipped(archive) {
  const view = new DataView(await archive.arrayBuffer());
  let end = view.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== END) end--;
  const found = [];
  if (end < 0) return found;
  let at = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left && at + 46 <= view.byteLength && view.getUint32(at, true) === ENTRY; left--) {
    const [flags, method, packed, name, extra, comment, local] = [view.getUint16(at + 8, true), view.getUint16(at + 10, true), view.getUint32(at + 20, true), view.getUint16(at + 28, true), view.getUint16(at + 30, true), view.getUint16(at + 32, true), view.getUint32(at + 42, true)];
    // Archives from Chinese versions of Windows have names in GB 18030.
    const path = new TextDecoder(flags & 0x800 ? "utf-8" : "gb18030").decode(new Uint8Array(view.buffer, at + 46, name));
    at += 46 + name + extra + comment;
    if (!isHandedIn(path)) continue;
    const begin = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    const data = archive.slice(begin, begin + packed);
    const content = method === 8 ? await bytesOf(data.stream().pipeThrough(new DecompressionStream("deflate-raw")), LONGEST) : data;
    found.push({ file: new File([content], path.split("/").at(-1)), path: `${archive.name}/${path}` });
  }
  return found;
}

/** All files of what was chosen or dropped, each with its team: folders and archives are opened. */
export async function handedIn(files) {
  const [found, chosen] = [[], []];
  for (const file of files) {
    const path = file.webkitRelativePath || file.name;
    if (/\.zip$/i.test(file.name)) found.push(...withTeams(await unzipped(file)));
    else if (!file.webkitRelativePath || isHandedIn(path)) chosen.push({ file, path });
  }
  return [...found, ...withTeams(chosen)];
}

/** The files that were dropped, those of folders with their paths. */
export async function dropped({ items, files }) {
  const entries = [...items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (!entries.some(({ isDirectory }) => isDirectory)) return [...files];
  const every = [];
  const walk = async (entry) => {
    if (!entry.isDirectory) {
      const file = await new Promise((resolve, reject) => entry.file(resolve, reject));
      Object.defineProperty(file, "webkitRelativePath", { value: entry.fullPath.slice(1) });
      return every.push(file);
    }
    const reader = entry.createReader();
    for (let some; (some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject))).length; ) for (const one of some) await walk(one);
  };
  for (const entry of entries) await walk(entry);
  return every;
}

/** A digest of a file, by which equal ones are known; empty where the browser computes none. */
async function digestOf(file) {
  if (!crypto.subtle) return "";
  return [...new Uint8Array(await crypto.subtle.digest("SHA-256", await file.arrayBuffer()))].map((byte) => byte.toString(16).padStart(2, "0")).join("");
}

/** A row of the table for the service. graded: its answer about the file; null if it refused it */
export async function rowOf({ file, team }, graded) {
  const sum = (name) => (graded?.sheets ?? []).reduce((all, sheet) => all + sheet[name], 0);
  const finding = graded?.diagnosis[0]?.words ?? graded?.notes[0] ?? "";
  return { team: (team || file.name).slice(0, 200), file: file.name.slice(-200), workbook: graded?.workbook ?? null, verdict: graded?.verdict ?? "unreadable", cells: sum("cells"), right: sum("right"), rounded: sum("rounded"), missing: sum("missing"), finding: finding.slice(0, 1_000), unusual: graded?.unusual ?? [], digest: await digestOf(file) };
}

/** The table of a class. */
export class ClassTable {
  box = make("div", { className: "class" });
  #rubric = "";
  #rows = [];
  #sorted = { column: -1, down: false };

  /**
   * show(k): shows what is said of file k
   * @param {Service} service
   */
  constructor(service, show) {
    this.service = service;
    this.show = show;
  }

  /** Show the files with the points of a rubric; one that is refused changes nothing. rows: as rowOf() gives them */
  async fill(rows, rubric = this.#rubric) {
    const isNew = rows !== this.#rows;
    this.#rows = rows;
    try {
      this.table = await this.service.ask("class", "class-table", { body: { files: rows, rubric } });
      this.#rubric = rubric;
      this.#draw();
    } catch (error) {
      if (isNew) this.box.replaceChildren();
      announceRefusal(error);
    }
  }

  /** The rows in the order in which they are shown, each with its place in the class. */
  #order() {
    const { column, down } = this.#sorted;
    const order = this.table.rows.map((row, k) => ({ row, k }));
    if (column >= 0) order.sort((a, b) => (down ? -1 : 1) * (typeof a.row[column] === "number" ? a.row[column] - b.row[column] : String(a.row[column]).localeCompare(String(b.row[column]))));
    return order;
  }

  #draw() {
    const { heads, rows, teams, notes } = this.table;
    const { column, down } = this.#sorted;
    const head = (words, k) => make("th", { scope: "col", "aria-sort": k === column ? (down ? "descending" : "ascending") : "none" }, button({ textContent: words }, () => this.#sort(k)));
    const line = ({ row, k }) => make("tr", {}, ...row.map((cell, place) => make("td", { className: typeof cell === "number" ? "number" : "" }, place === 1 ? button({ textContent: cell }, () => this.show(k)) : String(cell))));
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...heads.map(head))), make("tbody", {}, ...this.#order().map(line)));
    const points = make("ol", { className: "teams" }, ...teams.map(([team, value]) => make("li", { textContent: say("{team}: {points} points", { team, points: value }) })));
    const chosen = make("input", { type: "file", accept: ".csv", hidden: true });
    chosen.addEventListener("change", async () => {
      const [file] = chosen.files;
      chosen.value = "";
      if (file) await this.fill(this.#rows, (await file.text()).replaceAll("\0", ""));
    });
    const buttons = [...Object.keys(TYPES).map((form) => button({ textContent: say("Save as {form}", { form: form.toUpperCase() }) }, () => this.#save(form))), button({ textContent: say("Save the rubric, to edit it") }, () => this.#saveRubric()), button({ textContent: say("Use a rubric …") }, () => chosen.click())];
    const parts = [make("p", { className: "buttons" }, ...buttons), chosen, ...notes.map((textContent) => make("p", { className: "hint", textContent })), make("div", { className: "scrolls", tabIndex: 0, role: "region", ariaLabel: say("Table of the class") }, table)];
    this.box.replaceChildren(make("h3", { textContent: say("Class: {count} files", { count: rows.length }) }), ...parts, make("details", {}, make("summary", { textContent: say("Points of each team") }), points));
  }

  #sort(column) {
    this.#sorted = { column, down: this.#sorted.column === column && !this.#sorted.down };
    this.#draw();
  }

  async #save(form) {
    const name = `class.${form}`;
    try {
      download(await this.service.ask(`class ${form}`, "class-table", { body: { files: this.#order().map(({ k }) => this.#rows[k]), rubric: this.#rubric }, accept: TYPES[form] }), name);
      announceSaved(name);
    } catch (error) {
      announceRefusal(error);
    }
  }

  #saveRubric() {
    download(new Blob(["\ufeff", this.table.rubric], { type: "text/csv" }), "rubric.csv");
    announceSaved("rubric.csv");
  }
}
