/** A class: the files in folders and archives, each with its team, and the table of all, which a teacher sorts and saves. */

import { Superseded } from "./api.js";
import { button, download, make } from "./elements.js";
import { announceRefusal } from "./overlays.js";
import { announceSaved } from "./saved.js";
import { phrase, say, sentencesOf } from "./text.js";

/** Endings of what is handed in, the wrong kinds included, for which the service has a sentence; and of archives. */
const [HANDED_IN, ARCHIVE] = [/\.(xlsx|xlsm|xls|csv|png|jpe?g|pdf|docx?|numbers|et|ods)$/i, /\.zip$/i];
/** Of these the service needs no more than how they begin. */
const BEGINNING = /\.(png|jpe?g|pdf|doc)$/i;
/** Longest file that is unpacked, because the service reads none that is longer, and most of a team [bytes]; archives in one another. */
const [LONGEST, MOST, DEEPEST] = [20_000_001, 1e9, 2];
/** Most files of a team, and of a class, as the service has it. */
export const FILES_MOST = 2_000;
/** Most names that a sentence lists. */
const NAMED = 10;
/** What stands in no line of plain text, or turns the direction of writing around. */
const UNPRINTABLE = /[\p{Cc}\p{Cs}\p{Zl}\p{Zp}\p{Bidi_Control}\p{Noncharacter_Code_Point}]/gu;
/** Signatures of a ZIP archive: the end of its list, and an entry of it. */
const [END, ENTRY] = [0x06054b50, 0x02014b50];
export const TYPES = { xlsx: "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet", csv: "text/csv" };
/** Why there is nothing to grade. */
const EMPTY = phrase("The folder is empty: nothing was handed in.");
const OTHER = phrase("Nothing that was handed in is a workbook or a table (.xlsx or .csv): {name}");
const LOCKED = phrase("It was not unpacked: it is locked, broken, longer than 20 MB, or an archive in too many others.");
const FULL = phrase("More than 1 GB or 2000 files were handed in together: what came after that was not unpacked.");

/** Order of two numbers, or of two names in which numbers count. */
export const compare = (a, b) => (typeof a === "number" ? a - b : a.localeCompare(b, undefined, { numeric: true }));

const foldersOf = (path) => path.split("/").slice(0, -1).filter(Boolean);
const nameOf = (path) => path.split("/").filter(Boolean).at(-1);

/** A name as one line of plain text, as the service takes it: what is none stands as \u and digits. range: of its characters, as for slice() */
export function plain(name, ...range) {
  const escaped = name.replace(UNPRINTABLE, (one) => `\\u${one.codePointAt(0).toString(16).padStart(4, "0")}`);
  return [...escaped].slice(...range).join("");
}

/** True for what has a row of its own: a file, or one that was not unpacked. */
const isGraded = ({ left }) => ![OTHER, EMPTY].includes(left);

/** Number of folders that all paths share. */
function sharedOf(/** @type {string[][]} */ [first = [], ...others]) {
  const differs = first.findIndex((name, k) => others.some((one) => one[k] !== name));
  return differs < 0 ? first.length : differs;
}

/** Paths of the files that are graded, and number of folders above those of the teams, of which a file beside them is none's. */
function rootOf(found) {
  const every = found.filter(isGraded).map(({ path }) => foldersOf(path)).filter(({ length }) => length);
  const deep = every.filter(({ length }) => length > 1);
  const graded = deep.length && sharedOf(every) ? deep : every;
  return { graded, root: sharedOf(graded) };
}

/**
 * The files, each with its team: the first folder or archive that not all of them share, else that in which all lie, or the name without an ending; empty for a file that lies alone. A team of which nothing can be graded has one entry with the reason.
 * found: {path, file}, or {path, left} with the reason
 */
function withTeams(found) {
  const { graded, root: shared } = rootOf(found);
  const others = found.filter((one) => !isGraded(one)).map(({ path }) => foldersOf(path)).filter(({ length }) => length && length >= shared);
  // If one folder holds all that is graded, the folders beside it are those of the other teams.
  const root = graded.every(({ length }) => length <= shared) ? sharedOf([...graded, ...others]) : shared;
  const isDeeper = ({ length }) => length > root;
  // Files that lie side by side are a team each, or one team's: the folders beside them hold something else.
  const hasFolders = (graded.length ? graded : others).some(isDeeper);
  const entries = found.map((one) => {
    const folders = foldersOf(one.path);
    const own = (folders[root] ?? (root > 1 || one.left === OTHER ? folders[root - 1] : undefined))?.replace(ARCHIVE, "");
    const isTeam = hasFolders ? isDeeper(folders) : !graded.length;
    return { ...one, name: plain(nameOf(one.path)), isTeam, team: plain(own ?? (folders.length ? nameOf(one.path).replace(/\.\w+$/, "") : "")) };
  });
  const full = new Set(entries.filter(isGraded).map(({ team }) => team));
  const lacking = Map.groupBy(entries.filter(({ team, isTeam }) => isTeam && !full.has(team)), ({ team }) => team);
  return [...entries.filter(isGraded), ...[...lacking.values()].map(named)];
}

/** One entry for those of a team of which nothing can be graded, with their names, of many the first ones. */
function named(entries) {
  const others = entries.filter(({ left }) => left === OTHER);
  const more = others.length - NAMED;
  const name = `${others.slice(0, NAMED).map((one) => one.name).join(", ")}${more > 0 ? ` … (+${more})` : ""}`;
  return others.length ? { ...others[0], name } : entries[0];
}

const isHidden = (path) => path.split("/").some((part) => /^(\.|~\$|__MACOSX|Thumbs\.db)/i.test(part));
const isEmpty = ({ path }, k, every) => path.endsWith("/") && !every.some((one) => one.path !== path && one.path.startsWith(path));

/** The bytes of an entry of an archive, or some at its beginning; null for one that cannot be read, or is too long. room: {bytes} that are left */
async function unpacked(data, method, room, isBeginning) {
  const parts = [];
  const stream = method === 8 ? data.stream().pipeThrough(new DecompressionStream("deflate-raw")) : data.stream();
  const reader = stream.getReader();
  let count = 0;
  try {
    while (count <= LONGEST && room.bytes >= 0) {
      const { done, value } = await reader.read();
      if (!done) parts.push(value);
      if (done || isBeginning) return new Blob(parts);
      count += value.length;
      room.bytes -= value.length;
    }
  } catch {
    // Null says it.
  } finally {
    reader.cancel().catch(() => {});
  }
  return null;
}

/** What is in a ZIP archive and in archives in it: {path, file}, {path, left} with the reason, or {path} of a folder. room: {bytes, files} that are left to a team; null: each folder has its own */
async function unzipped(archive, path, room = null, depth = 1) {
  const view = new DataView(await archive.arrayBuffer());
  const isThere = (at, size) => at + size <= view.byteLength;
  let end = view.byteLength - 22;
  while (end >= 0 && view.getUint32(end, true) !== END) end--;
  if (end < 0) return [{ path: `${path}/`, left: LOCKED }];
  const [found, rooms] = [[], {}];
  let [at, left] = [view.getUint32(end + 16, true), view.getUint16(end + 10, true)];
  for (; left && isThere(at, 46) && view.getUint32(at, true) === ENTRY; left--) {
    const [flags, method, packed, name, extra, comment, local] = [view.getUint16(at + 8, true), view.getUint16(at + 10, true), view.getUint32(at + 20, true), view.getUint16(at + 28, true), view.getUint16(at + 30, true), view.getUint16(at + 32, true), view.getUint32(at + 42, true)];
    if (!isThere(at + 46, name)) break;
    // Archives from Chinese versions of Windows have names in GB 18030.
    const inside = `${path}/${new TextDecoder(flags & 0x800 ? "utf-8" : "gb18030").decode(new Uint8Array(view.buffer, at + 46, name))}`;
    at += 46 + name + extra + comment;
    if (isHidden(inside)) continue;
    const isArchive = ARCHIVE.test(inside);
    if (inside.endsWith("/")) found.push({ path: inside });
    else if (!HANDED_IN.test(inside) && !isArchive) found.push({ path: inside, left: OTHER });
    else {
      const own = room ?? (rooms[isArchive ? inside : foldersOf(inside).join("/")] ??= { bytes: MOST, files: FILES_MOST });
      if (own.isFull) continue;
      const isRead = !(flags & 1) && [0, 8].includes(method) && isThere(local, 30);
      const begin = isRead && local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
      own.isFull = --own.files < 0;
      const content = isRead && !own.isFull && (await unpacked(archive.slice(begin, begin + packed), method, own, BEGINNING.test(inside)));
      own.isFull ||= own.bytes < 0;
      const refused = own.isFull ? FULL : !content || (isArchive && depth >= DEEPEST) ? LOCKED : "";
      if (refused) found.push({ path: isArchive ? `${inside}/` : inside, left: refused });
      else if (isArchive) found.push(...(await unzipped(content, inside, own, depth + 1)));
      else found.push({ path: inside, file: new File([content], nameOf(inside)) });
    }
  }
  // A list that ends before all that it states has lost some.
  if (left) found.push({ path: `${path}/`, left: LOCKED });
  return found.length ? found : [{ path: `${path}/` }];
}

/** All files of what was chosen or dropped, each with its team: folders and archives are opened. given: {path, file}, or {path} of a folder */
export async function handedIn(given) {
  const [found, chosen] = [[], []];
  const of = (entries) => withTeams(entries.flatMap((one, k, every) => (one.file || one.left ? [one] : isEmpty(one, k, every) ? [{ ...one, left: EMPTY }] : [])));
  const archives = given.filter(({ path }) => ARCHIVE.test(path) && !path.includes("/"));
  for (const { file, path } of given) {
    if (isHidden(path)) continue;
    const isOpened = file && ARCHIVE.test(path);
    const inside = isOpened ? await unzipped(file, path).catch(() => [{ path: `${path}/`, left: LOCKED }]) : [{ path, file, ...(file && path.includes("/") && !HANDED_IN.test(path) && { file: null, left: OTHER }) }];
    const { graded, root } = rootOf(inside);
    // Of several archives one with two folders of something to grade is a class, any other a team.
    const isTeam = archives.length > 1 && new Set(graded.map((folders) => folders[root]).filter(Boolean)).size < 2;
    if (!archives.some((one) => one.file === file) || isTeam) chosen.push(...inside);
    else found.push(...of(inside));
  }
  return [...found, ...of(chosen)];
}

/** The chosen files, with their paths. */
export const chosenOf = (files) => [...files].map((file) => ({ file, path: file.webkitRelativePath || file.name }));

/** The files that were dropped, and the folders, with their paths. */
export async function dropped({ items, files }) {
  const entries = [...items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (!entries.some(({ isDirectory }) => isDirectory)) return chosenOf(files);
  const every = [];
  const walk = async (entry) => {
    const path = entry.fullPath.slice(1);
    if (!entry.isDirectory) return every.push({ path, file: await new Promise((resolve, reject) => entry.file(resolve, reject)) });
    every.push({ path: `${path}/` });
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

/** The questions of a class, as the rubric names them, and those whose numbers are typed. */
const QUESTIONS = ["result1", "result2", "question3", "result4", "question5"];
export const TYPED = { pitch: "question3", speed: "question5" };
/** Columns of the service's table. */
const [TEAM, FILE, WORKBOOK, VERDICT, POINTS, FINDING, TEAM_POINTS, ALIKE, POINTS_MOST, TEAM_MOST] = [0, 1, 2, 3, 6, 7, 10, 11, 12, 13];
export const MARKS = { right: "✓", rounded: "✓", incomplete: "!", infeasible: "✕", wrong: "✕", unreadable: "✕" };
/** A row of the table for the service. found: what judge() gives */
export async function rowOf({ file, team, name, text }, { answer, words = "" }) {
  const [graded, typed] = [answer?.files[0], answer?.answers[0]];
  const sum = (what) => (graded?.sheets ?? []).reduce((all, sheet) => all + sheet[what], 0);
  const counts = typed ? { cells: 1, right: +(typed.verdict === "right" && !typed.rounded), rounded: +typed.rounded, missing: 0 } : { cells: sum("cells"), right: sum("right"), rounded: sum("rounded"), missing: sum("missing") };
  const title = text ? (typed?.title ?? text) : (file?.name ?? name);
  const finding = graded?.finding ?? typed?.headline ?? words;
  return { team: plain(team || title, 0, 200), file: plain(title, -200), workbook: typed ? TYPED[name] : (graded?.workbook ?? null), verdict: (graded ?? typed)?.verdict ?? "unreadable", ...counts, finding: [...finding].slice(0, 1_000).join(""), unusual: graded?.unusual ?? [], digest: file ? await digestOf(file) : "" };
}

/** The table of a class: a row for each team. */
export class ClassTable {
  box = make("div", { className: "class" });
  #rubric = { name: "", text: "" };
  /** The rubric that the newest question has, which may be refused. */
  #wanted = this.#rubric;
  #rows = [];
  /** Those of the table that is shown. */
  #shown = this.#rows;
  #language = "";
  #sorted = { column: 0, down: false };
  /** The service's answer. @type {any} */
  table = null;

  /**
   * show(k): shows what is said of file k
   * @param {Service} service
   */
  constructor(service, show) {
    this.service = service;
    this.show = show;
  }

  /** Number of its files. */
  get size() {
    return this.#rows.length;
  }

  /** Forget the class. */
  clear() {
    this.#rows = this.#shown = [];
    this.box.replaceChildren();
  }

  /** Show the files with the points of a rubric; one that is refused changes nothing, and of several questions the newest counts. rows: as rowOf() gives them, in a language */
  async fill(rows, language = this.#language, rubric = this.#wanted) {
    [this.#rows, this.#language, this.#wanted] = [rows, language, rubric];
    try {
      const table = await this.#ask("class", { files: rows, rubric: rubric.text });
      if (rows !== this.#rows) return;
      [this.table, this.#rubric, this.#shown] = [table, rubric, rows];
      this.#draw();
    } catch (error) {
      if (!(error instanceof Superseded) && rows === this.#rows && rubric === this.#wanted) {
        this.#wanted = this.#rubric;
        // The refused rubric may have taken the place of a question about these files.
        if (rows !== this.#shown && rubric !== this.#rubric) await this.fill(rows);
        else if (rows !== this.#shown) this.clear();
      }
      announceRefusal(error);
    }
  }

  /** Ask in the language in which the files were graded, because the page may have another one meanwhile. */
  #ask(channel, body, accept = "application/json") {
    return this.service.ask(channel, "class-table", { body, accept, headers: { "Accept-Language": this.#language } });
  }

  /** The teams, each with the places of its files in the class, in the order in which they are shown. */
  #teams(columns) {
    const every = this.table.rows.map((row, k) => ({ row, k }));
    const teams = [...Map.groupBy(every, ({ row }) => row[TEAM]).values()];
    const { column, down } = this.#sorted;
    const value = (files) => columns[Math.min(column, columns.length - 1)].value(files);
    return teams.sort((a, b) => (down ? -1 : 1) * compare(value(a), value(b)));
  }

  /** Columns: {head, value of a team by which it is sorted, cells} */
  #columns() {
    const { heads, rows } = this.table;
    const points = (value, most) => say("{points} of {most}", { points: value, most });
    const line = ({ row, k }) => {
      const { verdict } = this.#rows[k];
      const mark = make("span", { className: "mark", "aria-hidden": "true", textContent: MARKS[verdict] });
      const words = row[WORKBOOK] ? points(row[POINTS], row[POINTS_MOST]) : row[FILE];
      const label = `${row[TEAM]} / ${row[FILE]}: ${row[VERDICT]}`;
      return make("p", {}, button({ className: `is-${verdict}`, title: label, ariaLabel: `${label}, ${words}` }, () => this.show(k), mark, words), make("span", { textContent: row[FINDING] || row[VERDICT] }));
    };
    const files = (head, isOf) => ({ head, value: (of) => Math.max(-1, ...of.filter(({ row }) => isOf(row)).map(({ row }) => row[POINTS])), cells: (of) => of.filter(({ row }) => isOf(row)).map(line) });
    const text = (head, words, value = words) => ({ head, value, cells: (of) => [words(of)] });
    const isThere = (name) => name.startsWith("result") || rows.some((row) => row[WORKBOOK] === name);
    const known = (row) => QUESTIONS.includes(row[WORKBOOK]);
    return [
      text(heads[TEAM], ([{ row }]) => row[TEAM]),
      text(heads[TEAM_POINTS], ([{ row }]) => points(row[TEAM_POINTS], row[TEAM_MOST]), ([{ row }]) => row[TEAM_POINTS]),
      ...QUESTIONS.filter(isThere).map((name) => files(name, (row) => row[WORKBOOK] === name)),
      ...(rows.every(known) ? [] : [files(say("other files"), (row) => !known(row))]),
      ...(rows.some((row) => row[ALIKE]) ? [text(heads[ALIKE], (of) => [...new Set(of.map(({ row }) => row[ALIKE]).filter(Boolean))].join("; "))] : []),
    ];
  }

  #draw() {
    const { rows, notes, scheme } = this.table;
    const columns = this.#columns();
    const { column, down } = this.#sorted;
    const head = ({ head: words }, k) => make("th", { scope: "col", "aria-sort": k === column ? (down ? "descending" : "ascending") : "none" }, button({ textContent: words }, () => this.#sort(k)));
    const teams = this.#teams(columns);
    const line = (files) => make("tr", {}, ...columns.map(({ cells }, k) => make(k ? "td" : "th", k ? {} : { scope: "row" }, ...cells(files))));
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...columns.map(head))), make("tbody", {}, ...teams.map(line)));
    const chosen = make("input", { type: "file", accept: ".csv", hidden: true });
    chosen.addEventListener("change", async () => {
      const [file] = chosen.files;
      chosen.value = "";
      const text = file && (await file.text()).replaceAll("\0", "");
      if (file && this.size) await this.fill(this.#rows, this.#language, { name: file.name, text });
    });
    const buttons = [...Object.keys(TYPES).map((form) => button({ textContent: say("Save as {form}", { form: form.toUpperCase() }) }, () => this.#save(form))), button({ textContent: say("Save the rubric, to edit it") }, () => this.#saveRubric()), button({ textContent: say("Use a rubric …") }, () => chosen.click())];
    const rubric = this.#rubric.name ? say("The rubric is {name}.", { name: this.#rubric.name }) : say("The rubric is the usual one.");
    const remarks = [...notes, sentencesOf([rubric, scheme])].map((textContent) => make("p", { className: "hint", textContent }));
    const title = make("h3", { textContent: say("Class: {teams} teams, {count} files", { teams: teams.length, count: rows.length }) });
    this.box.replaceChildren(title, make("p", { className: "buttons" }, ...buttons), chosen, ...remarks, make("div", { className: "scrolls", tabIndex: 0, role: "region", ariaLabel: say("Table of the class") }, table));
  }

  #sort(column) {
    this.#sorted = { column, down: this.#sorted.column === column && !this.#sorted.down };
    this.#draw();
    this.box.querySelectorAll("thead button")[column].focus();
  }

  async #save(form) {
    const name = `class.${form}`;
    try {
      const files = this.#teams(this.#columns()).flat().map(({ k }) => this.#rows[k]);
      download(await this.#ask(`class ${form}`, { files, rubric: this.#rubric.text }, TYPES[form]), name);
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
