/** The five questions of the contest on one strip: each with its answer, why, a picture, what is handed in, and a check of one's own. */

import { Problem, Superseded } from "./api.js";
import { TYPES, chosenOf, handedIn } from "./class.js";
import { $, button, download, make } from "./elements.js";
import { FIELDS } from "./fields.js";
import { judge } from "./grade.js";
import { showShare } from "./jobs.js";
import { announce, announceRefusal } from "./overlays.js";
import { announceSaved } from "./saved.js";
import { EXTRAS } from "./state.js";
import { language, say } from "./text.js";

const QUESTIONS = [1, 2, 3, 4, 5];
/** Size of a picture, its margin, and the radius of a point [px]. */
const [WIDTH, HEIGHT, MARGIN, DOT] = [240, 150, 8, 4];
/** Rows up and columns to the right by the key, and the ratio of the contest's turn. */
const STEPS = { ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, -1], ArrowRight: [0, 1] };
const RATIO = 2;
const SVG = "http://www.w3.org/2000/svg";
/** What may be dropped to be checked. */
const FORM = ".xlsx,.xlsm,.xls,.csv,.zip";
/** Endings of what is judged of an archive: workbooks if there are any, else tables. */
const JUDGED = [/\.xls[xm]?$/i, /\.csv$/i];

const shape = (tag, attributes) => {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  return element;
};

/** A picture from its lines: a map keeps one scale, a curve fills the box. */
function drawn({ words, equal, strokes }) {
  const points = strokes.flatMap((one) => one.points);
  const [xs, ys] = [0, 1].map((axis) => points.map((point) => point[axis]));
  const [left, low] = [Math.min(...xs), Math.min(...ys)];
  const [wide, high] = [Math.max(...xs) - left || 1, Math.max(...ys) - low || 1];
  const fits = [(WIDTH - 2 * MARGIN) / wide, (HEIGHT - 2 * MARGIN) / high];
  const [across, up] = equal ? [Math.min(...fits), Math.min(...fits)] : fits;
  const at = ([x, y]) => [WIDTH / 2 + (x - left - wide / 2) * across, HEIGHT / 2 - (y - low - high / 2) * up].map((one) => one.toFixed(1));
  const picture = shape("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "img", "aria-label": words });
  for (const { role, points: line } of strokes) {
    const [[x, y]] = [at(line[0])];
    picture.append(line.length > 1 ? shape("polyline", { class: `is-${role}`, points: line.map(at).join(" ") }) : shape("circle", { class: `is-${role}`, cx: x, cy: y, r: DOT }));
  }
  return make("figure", {}, picture, make("figcaption", { textContent: words }));
}

/** The map of turns: a touch on a cell takes its turn, arrow keys move a marker and Enter takes it. take(ratio, entry): of that cell */
function mapOf({ words, axes: axisWords, ratios, entry_radii: entries, lengths }, take) {
  const every = lengths.flat().filter((length) => length !== null);
  const [least, most] = [Math.min(...every), Math.max(...every)];
  const [wide, high] = [WIDTH / ratios.length, HEIGHT / entries.length];
  const map = shape("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "application", "aria-label": words, tabindex: 0, class: "turns", preserveAspectRatio: "none" });
  const told = make("output", {});
  // The contest's turn is on the circle, in the uppermost row.
  let [row, column] = [entries.length - 1, ratios.indexOf(RATIO)];
  const cells = lengths.map((line, k) =>
    line.map((length, j) => {
      const cell = shape("rect", { x: j * wide, y: HEIGHT - (k + 1) * high, width: wide - 1, height: high - 1, class: length === null ? "tight" : "turn", "fill-opacity": length === null ? 1 : 0.25 + (0.75 * (length - least)) / (most - least) });
      cell.addEventListener("click", () => choose(k, j));
      return cell;
    }),
  );
  map.append(...cells.flat());
  const mark = (k, j) => {
    cells[row][column].classList.remove("marked");
    [row, column] = [Math.min(Math.max(k, 0), entries.length - 1), Math.min(Math.max(j, 0), ratios.length - 1)];
    cells[row][column].classList.add("marked");
    const length = lengths[row][column];
    told.textContent = `${ratios[column]} : 1, ${entries[row]} m: ${length === null ? say("too tight") : `${length.toFixed(3)} m`}`;
  };
  const choose = (k, j) => {
    mark(k, j);
    if (lengths[k][j] !== null) take(ratios[j], entries[k]);
  };
  map.addEventListener("keydown", (event) => {
    const step = STEPS[event.key];
    if (step) mark(row + step[0], column + step[1]);
    else if (event.key === "Enter") choose(row, column);
    else return;
    event.preventDefault();
  });
  mark(row, column);
  const ends = (className, values) => make("span", { className }, ...values.map((textContent) => make("span", { textContent })));
  const axes = [
    make("span", { className: "up", textContent: axisWords[1] }),
    ends("rows", [entries.at(-1), entries[0]]),
    map,
    ends("columns", [ratios[0], ratios[(ratios.length - 1) / 2], ratios.at(-1)]),
    make("span", { className: "right", textContent: axisWords[0] }),
    ends("shades", [`${least.toFixed(2)} m`, `${most.toFixed(2)} m`]),
  ];
  return make("figure", {}, make("div", { className: "axes" }, ...axes), told, make("figcaption", { textContent: words }));
}

const paragraph = (textContent) => make("p", { textContent });

/** Name of the archive that is handed in. */
const archiveOf = (question) => `bench-dragon-question-${question}.zip`;

/** What is judged of a file: itself, or of an archive the workbook of this name, else its workbooks, else its tables. */
async function judgedOf(file, workbook) {
  if (!/\.zip$/i.test(file.name)) return [file];
  const files = (await handedIn(chosenOf([file]))).map((one) => one.file).filter(Boolean);
  const kinds = [files.filter(({ name }) => name === workbook), ...JUDGED.map((ending) => files.filter(({ name }) => ending.test(name)))];
  return kinds.find((some) => some.length) ?? [];
}

export class Strip {
  #language = "";

  /**
   * show(): brings the picture of the dance into sight; jobs(): Promise of the list of jobs
   * @param {{ service: Service, state: State, show: () => void, jobs: () => Promise<Jobs> }} parts
   */
  constructor({ service, state, show, jobs }) {
    this.service = service;
    this.state = state;
    this.show = show;
    this.jobs = jobs;
    this.cards = QUESTIONS.map((number) => make("li", { id: `question-${number}` }));
    $("#five-cards").append(...this.cards);
    /** Of each question: with what takes seconds; the typed text; what was judged; the button that hands in, and the link to the archive once it is there. @type {any[]} */
    this.kept = QUESTIONS.map((number) => {
      const hand = button({}, () => this.#handIn(number), make("span"), make("span", { className: "share" }));
      return { further: false, text: "", asked: null, hand, made: make("p", { className: "made" }) };
    });
  }

  /** Ask the service for its words in the language of the page, if they are in another one. */
  translate() {
    if (this.#language === language()) return;
    this.#language = language();
    for (const [k, card] of this.cards.entries()) this.#fill(card, QUESTIONS[k]);
  }

  async #fill(card, question) {
    const title = make("h3", { textContent: say("Question {number}", { number: question }) });
    const kept = this.kept[question - 1];
    const { further } = kept;
    if (!card.firstChild) card.append(title);
    card.setAttribute("aria-busy", true);
    try {
      const answer = await this.service.ask(`five-${question}`, "contest-answer", { query: { question, ...(further && { further }) } });
      card.replaceChildren(title, ...this.#parts(answer, kept, () => this.#ask(card, question)));
    } catch (error) {
      if (error instanceof Superseded) return;
      if (!(error instanceof Problem)) throw error;
      kept.further = false;
      if (further) announceRefusal(error);
      else card.replaceChildren(title, make("p", { className: "error", textContent: error.problem.sentence }));
    }
    card.setAttribute("aria-busy", false);
  }

  /** Ask for what takes seconds, whose reasons are then open. */
  async #ask(card, question) {
    this.kept[question - 1].further = true;
    await this.#fill(card, question);
    card.querySelector("summary")?.focus();
  }

  #parts({ question, asks, text, sentences: [first, ...others], more, turns, picture, offers, workbook, number, unit }, kept, askMore) {
    const why = make("details", { open: kept.further }, make("summary", { textContent: say("Why") }), ...others.map(paragraph));
    const buttons = offers.map((offer) => button({ textContent: offer.words }, () => this.#take(offer)));
    if (more) buttons.push(button({ textContent: more }, askMore));
    kept.hand.firstChild.textContent = workbook ? say("With tables and figures (.zip)") : say("Hand in: {files}", { files: say("figure") });
    if (workbook) buttons.push(button({ textContent: say("Hand in: {files}", { files: workbook }) }, ({ target }) => this.#handWorkbook(question, workbook, target)));
    if (turns) why.append(mapOf(turns, (ratio, entry) => this.#take({ path: "turn", numbers: { ratio, entry_radius: entry, exit_radius: entry, time: 0 } })));
    const value = make("p", { className: "value", textContent: text });
    return [make("p", { className: "asks", textContent: asks }), drawn(picture), value, paragraph(first), why, make("p", { className: "buttons" }, ...buttons, kept.hand), kept.made, this.#check(question, kept, { workbook, number, unit })];
  }

  /** The dance of an offer, with the contest's numbers for all else. */
  #take({ path, numbers }) {
    const { time = null, handle = null, ...own } = numbers;
    const names = [...FIELDS.map((field) => field.name), ...EXTRAS];
    const plain = Object.fromEntries(names.map((name) => [name, this.state.initial(name, path)]));
    const texts = Object.fromEntries(Object.entries(own).map(([name, value]) => [name, String(value)]));
    this.state.push({ ...plain, ...texts, path, time, handle, view: null, dances: "", bench: null });
    this.show();
  }

  /** Save the workbook alone. */
  async #handWorkbook(question, name, pressed) {
    pressed.disabled = true;
    try {
      download(await this.service.ask(`workbook-${question}`, "contest-kit", { body: { question, language: language() }, accept: TYPES.xlsx }), name);
      announceSaved(name);
    } catch (error) {
      announceRefusal(error);
    } finally {
      pressed.disabled = false;
    }
  }

  /** Make the archive as a job; a service that takes none from this client makes it at once. */
  async #handIn(question) {
    const { hand, made } = this.kept[question - 1];
    if (hand.classList.contains("going") || hand.disabled) return;
    const name = archiveOf(question);
    hand.disabled = true;
    made.replaceChildren();
    const asked = { body: { question, language: language() }, accept: "application/zip" };
    try {
      const jobs = await this.jobs();
      const isJob = await jobs.begin("contest-kit", { ...asked, number: question }, (now) => this.#follow(question, now)).then(() => true, () => false);
      announce(() => say("Being made: “{name}”. It is saved as soon as it is ready.", { name }), true);
      if (isJob) return;
      download(await this.service.ask(`hand-in-${question}`, "contest-kit", asked), name);
      announceSaved(name);
    } catch (error) {
      announceRefusal(error);
    } finally {
      hand.disabled = false;
    }
  }

  /** Show how far an archive is; then it is saved, and a link leads to it. */
  #follow(question, status) {
    const { hand, made } = this.kept[question - 1];
    showShare(hand, status);
    if (status.problem) announce(() => status.problem.sentence, true);
    if (status.status !== "successful") return;
    const name = archiveOf(question);
    const link = make("a", { href: `jobs/${status.jobID}/result`, download: name, textContent: name });
    made.replaceChildren(link);
    link.click();
    announceSaved(name);
  }

  /** A number to type, a workbook to drop, and what the service says of it, in place. */
  #check(question, kept, { workbook, number, unit }) {
    const verdict = make("div", { className: "verdicts", "aria-live": "polite" });
    const ask = async (asked) => {
      kept.asked = asked;
      verdict.replaceChildren(paragraph(say("Checking …")));
      const { file } = asked;
      const parts = file ? (await judgedOf(file, workbook)).map((one) => ({ file: one })) : [asked];
      const boxes = parts.length ? [] : [paragraph(say("“{name}” holds no workbook and no table (.xlsx or .csv).", { name: file.name }))];
      for (const part of parts) {
        const found = await judge(this.service, `check-${question}`, { ...part, language: language() });
        if (!found || kept.asked !== asked) return;
        boxes.push(...found.boxes);
      }
      if (kept.asked === asked) verdict.replaceChildren(...boxes);
    };
    const parts = [];
    if (number) {
      const typed = make("input", { id: `mine-${question}`, inputMode: "text", autocomplete: "off", placeholder: `… ${unit}`, value: kept.text, ariaLabel: say("Your answer to question {number}", { number: question }) });
      // A verdict is of the number that stands there.
      typed.addEventListener("input", () => {
        [kept.text, kept.asked] = [typed.value, null];
        verdict.replaceChildren();
      });
      parts.push(typed, make("button", { textContent: say("Check mine") }));
    }
    if (workbook) {
      const chosen = make("input", { type: "file", accept: FORM, ariaLabel: workbook });
      chosen.addEventListener("change", () => chosen.files[0] && ask({ file: chosen.files[0] }));
      parts.push(make("label", { className: "mine" }, make("span", { textContent: say("or drop {workbook} here, also as .csv or in a .zip", { workbook }) }), chosen));
    }
    const form = make("form", { className: "check" }, ...parts);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const text = kept.text.trim();
      if (text) ask({ name: number, text });
      else verdict.replaceChildren(paragraph(say("Type your answer first, in {unit}.", { unit })));
    });
    for (const type of ["dragenter", "dragover"]) form.addEventListener(type, (event) => event.preventDefault());
    form.addEventListener("drop", (event) => {
      event.preventDefault();
      if (event.dataTransfer.files[0]) ask({ file: event.dataTransfer.files[0] });
    });
    if (kept.asked) ask(kept.asked); // in the language of the page
    return make("div", {}, form, verdict);
  }
}
