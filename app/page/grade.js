/** The grader: dropped or chosen workbooks, and typed answers, each with the service's verdict. */

import { Problem, Superseded } from "./api.js";
import { ClassTable, FILES_MOST, MARKS, TYPED, chosenOf, compare, dropped, handedIn, plain, rowOf } from "./class.js";
import { $, $$, bearer, hide, make, onClick } from "./elements.js";
import { announce } from "./overlays.js";
import { say } from "./text.js";

/** Answers that may be typed. @type {Phrases} */
const ANSWERS = {
  collision_time: "First contact",
  pitch: "Minimum pitch",
  turn_length: "Length of the turn",
  speed: "Maximum head speed",
};
/** Colour of each mark of a picture; right cells are pale. */
const COLOURS = { ".": "--line", o: "--undecided", "#": "--contact", "?": "--border" };
const OUTCOMES = { right: "clear", rounded: "clear", incomplete: "undecided", infeasible: "contact", wrong: "contact", unreadable: "contact" };
const CELL = 6;
/** Number of files after which the table of a class is drawn anew. */
const SOME = 5;
/** Meaning of each mark of a picture. @type {Phrases} */
const MEANINGS = { ".": "right", o: "rounded", "#": "wrong", "?": "missing" };
export class Grader {
  /** What is graded: files, each with its team or none, and typed answers, of a class each with its team. @type {any[]} */
  #files = [];
  #typed = [];
  #answers = [];
  #language = null;
  #working = "";
  /** The file of a class whose boxes are shown; -1: none. */
  #chosen = -1;
  /** Number of times that something was chosen or cleared: what is read meanwhile is out of date. */
  #turn = 0;

  /**
   * @param {Service} service
   */
  constructor(service) {
    this.service = service;
    const drop = $("#drop");
    for (const id of ["#files", "#folder"]) $(id).addEventListener("change", (event) => this.#take(chosenOf(event.target.files)));
    this.table = new ClassTable(service, (k) => this.#open(k));
    for (const name of ["dragover", "drop"]) drop.addEventListener(name, (event) => event.preventDefault());
    for (const name of ["dragenter", "dragover"]) drop.addEventListener(name, () => drop.classList.add("over"));
    for (const name of ["dragleave", "drop"]) drop.addEventListener(name, () => drop.classList.remove("over"));
    drop.addEventListener("drop", (event) => this.#take(dropped(event.dataTransfer)));
    $("#typed").addEventListener("submit", (event) => {
      event.preventDefault();
      this.#takeTyped();
      this.#grade();
    });
    onClick("#grade-clear", () => {
      for (const id of ["#files", "#folder"]) $(id).value = "";
      $("#typed").reset();
      this.#forget();
      this.#tell("");
    });
  }

  /** Show everything in this language; the service is asked again for its words. */
  translate(language) {
    const changed = this.#language !== null && this.#language !== language;
    this.#language = language;
    if (changed && (this.#working || this.#answers.length)) this.#grade();
  }

  show() {
    const shown = this.isClass ? [this.table.box, ...(this.#answers[this.#chosen] ?? [])] : this.#answers.flat();
    const working = this.#working ? [make("p", { className: "hint", role: "status", textContent: this.#working })] : [];
    $("#grades").replaceChildren(...working, ...shown);
  }

  /** Show everything, with what is going on. */
  #tell(working) {
    this.#working = working;
    this.show();
  }

  #forget() {
    this.#turn++;
    this.#chosen = -1;
    [this.#files, this.#typed, this.#answers] = [[], [], []];
    this.table.clear();
    this.#offer();
  }

  /** Grade what was chosen or dropped, or the Promise of it, in place of all before. */
  async #take(given) {
    this.#forget();
    const turn = this.#turn;
    this.#tell(say("Unpacking the files …"));
    let files = [];
    try {
      files = await handedIn(await given);
    } catch {
      announce(() => say("What was chosen cannot be read: choose it again."));
    }
    if (turn !== this.#turn) return;
    if (files.length > FILES_MOST) {
      announce(() => say("A class has at most {most} files, and these are {count}: choose some of its teams.", { most: FILES_MOST, count: files.length }));
      files = [];
    }
    this.#files = files;
    this.#offer();
    if (!this.isClass) this.#takeTyped();
    this.#grade();
  }

  /** Take the typed answers: of a class those of the chosen team, in place of its answers before. */
  #takeTyped() {
    const team = this.isClass ? $("#typed-team").value : "";
    const typed = Object.keys(ANSWERS).filter((name) => !team || name in TYPED).map((name) => ({ name, team, text: $(`#typed-${name}`).value.trim() })).filter(({ text }) => text);
    this.#typed = [...this.#typed.filter((one) => team && !typed.some(({ name }) => one.team === team && one.name === name)), ...typed];
    if (team) for (const name of Object.keys(TYPED)) $(`#typed-${name}`).value = "";
  }

  /** Offer the fields of a class, or those of one's own answers. */
  #offer() {
    for (const element of $$("#grade .of-team")) hide(element, !this.isClass);
    for (const element of $$("#grade .alone")) hide(element, this.isClass);
    const teams = [...new Set(this.#files.map(({ team, file, name }) => team || (file?.name ?? name)))].sort(compare);
    $("#typed-team").replaceChildren(...teams.map((team) => make("option", { textContent: team, value: team })));
  }

  /** True for files of teams, which stand on one table. */
  get isClass() {
    return this.#files.some(({ team }) => team);
  }

  /** Show what is said of one file of a class. */
  #open(k) {
    this.#chosen = k;
    this.show();
    $("#grades .class + .answer")?.scrollIntoView({ block: "nearest" });
  }

  async #grade() {
    const language = this.#language;
    const asked = this.isClass ? [...this.#files, ...this.#typed] : [...this.#typed, ...this.#files];
    /** @type {Element[][]} */
    const results = [];
    const rows = [];
    this.#answers = results;
    for (const [k, one] of asked.entries()) {
      const name = titleOf(one.text ? say(ANSWERS[one.name]) : (one.file?.name ?? one.name), one.team);
      this.#tell(say("Grading {name} ({k} of {count}) …", { name, k: k + 1, count: asked.length }));
      // What was graded in this language before stays; what was refused is asked again.
      const found = one[language] ?? (await judge(this.service, "grade", { ...one, language }));
      if (!found || this.#answers !== results) return;
      if (found.answer) one[language] = found;
      results.push(found.boxes);
      if (this.isClass) rows.push((found.row ??= await rowOf(one, found)));
      // The table grows where there is none yet: one that is there stays whole until that of another language has come.
      if (rows.length % SOME === 0 && this.table.size < rows.length) await this.table.fill([...rows], language);
      if (this.#answers !== results) return;
      this.show();
    }
    if (rows.length) await this.table.fill(rows, language);
    if (this.#answers !== results) return;
    this.#tell("");
  }
}

/**
 * What the service says of a file, or of an answer that was typed, with its boxes; null if another question took its place.
 * name: of the answer, with its text, or of what is left out for that reason; file: a workbook; team: which handed it in
 * @param {Service} service
 * @param {string} channel
 * @param {{ name?: string, text?: string, file?: File, team?: string, left?: string, language: string }} asked
 */
export async function judge(service, channel, asked) {
  const { name = "", text = "", file, team, left, language } = asked;
  const title = titleOf(file?.name ?? (text ? say(ANSWERS[name]) : name), team);
  const refused = (words) => ({ words, boxes: [refusedBox(title, words)] });
  if (left) return refused(say(left, { name }));
  if (file?.size === 0) return refused(say("The file is empty."));
  const query = file ? { name: plain(file.name, -200), language } : { [name]: text, language };
  try {
    const answer = await service.ask(channel, "grade", { query, file: file ?? new Blob(), headers: bearer() });
    return { answer, boxes: boxes(answer, team) };
  } catch (error) {
    if (error instanceof Superseded) return null;
    if (!(error instanceof Problem)) throw error;
    return refused(error.problem.sentence);
  }
}

function refusedBox(title, textContent) {
  const heading = make("h3", { textContent: title });
  return make("div", { className: "answer" }, heading, make("p", { className: "error", textContent }));
}

const paragraph = (textContent, className = "") => make("p", { textContent, className });

/** The title of a file, with the team that handed it in. */
const titleOf = (name, team) => (team ? `${team} / ${name}` : name);

/** The boxes of one answer of the service. */
function boxes({ files, answers }, team) {
  const typed = answers.map((one) => box(titleOf(one.title, team), one.verdict, one.headline, [...one.sentences.map((line) => paragraph(line)), ...diagnosis(one)]));
  return [...typed, ...files.map((file) => fileBox(file, team))];
}

function box(title, verdict, headline, content) {
  const mark = make("span", { className: "mark", "aria-hidden": "true", textContent: MARKS[verdict] });
  const value = make("p", { className: "value" }, mark, headline);
  const outcome = { className: "answer", "data-outcome": OUTCOMES[verdict] };
  return make("div", outcome, make("h3", { textContent: title }), value, ...content);
}

function diagnosis({ diagnosis: certain, possible }) {
  return [...certain, ...possible].flatMap(({ words, evidence }) => [paragraph(words, "finding"), paragraph(evidence, "evidence")]);
}

function fileBox(file, team) {
  const points = file.rubric.map(({ met, words }) => make("li", { className: `met-${met}`, textContent: words }));
  const rubric = make("details", {}, make("summary", { textContent: say("The points of the reviewers") }), make("ul", {}, ...points));
  const notes = file.notes.map((one) => paragraph(one));
  return box(titleOf(file.file, team), file.verdict, file.headline, [...notes, ...diagnosis(file), ...file.sheets.flatMap(sheetParts), ...(points.length ? [rubric] : [])]);
}

function sheetParts({ picture, sentences: [summary, ...others] }) {
  const parts = [paragraph(summary, "sheet"), ...others.map((one) => paragraph(one))];
  const marks = new Set(picture.join(""));
  // Marks that are all alike do not show where the errors are.
  if (marks.size > 1 && (marks.has("#") || marks.has("?"))) parts.push(drawn(picture), legend(picture.join("")));
  return parts;
}

/** Legend of the colours of a picture. */
function legend(marks) {
  const entries = Object.keys(MEANINGS).filter((mark) => marks.includes(mark)).flatMap((mark) => {
    const colour = make("span", { "aria-hidden": "true", textContent: "■ " });
    colour.style.color = `var(${COLOURS[mark]})`;
    return [colour, `${say(MEANINGS[mark])}  `];
  });
  return make("p", { className: "hint legend" }, ...entries);
}

/** A picture of the places of wrong cells: handles from the top, instants from the left. */
function drawn(picture) {
  const width = picture[0].length;
  const size = { width: CELL * width, height: CELL * picture.length };
  const canvas = make("canvas", { ...size, className: "marks", role: "img", "aria-label": say("Places of the wrong cells: handles from the top, instants from the left") });
  const context = canvas.getContext("2d");
  const style = getComputedStyle(document.documentElement);
  picture.forEach((line, row) =>
    [...line].forEach((mark, column) => {
      context.fillStyle = style.getPropertyValue(COLOURS[mark]);
      context.fillRect(CELL * column, CELL * row, CELL - 1, CELL - 1);
    }),
  );
  return canvas;
}
