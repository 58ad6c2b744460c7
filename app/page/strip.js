/** The five questions of the contest on one strip: each with its answer, why, a picture, what is handed in, and a check of one's own. */

import { Problem, Superseded } from "./api.js";
import { $, button, download, make } from "./elements.js";
import { FIELDS } from "./fields.js";
import { judge } from "./grade.js";
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
/** What is handed in for a question that has no workbook. */
const FORM = ".xlsx,.xlsm,.xls,.csv";

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
function mapOf({ words, ratios, entry_radii: entries, lengths }, take) {
  const every = lengths.flat().filter((length) => length !== null);
  const [least, most] = [Math.min(...every), Math.max(...every)];
  const [wide, high] = [WIDTH / ratios.length, HEIGHT / entries.length];
  const map = shape("svg", { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: "application", "aria-label": words, tabindex: 0, class: "turns" });
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
  return make("figure", {}, map, told, make("figcaption", { textContent: words }));
}

const paragraph = (textContent) => make("p", { textContent });

export class Strip {
  #language = "";

  /**
   * show(): brings the picture of the dance into sight
   * @param {Service} service
   * @param {State} state
   */
  constructor(service, state, show) {
    this.service = service;
    this.state = state;
    this.show = show;
    this.cards = QUESTIONS.map((number) => make("li", { id: `question-${number}` }));
    $("#five-cards").append(...this.cards);
  }

  /** Ask the service for its words in the language of the page, if they are in another one. */
  translate() {
    if (this.#language === language()) return;
    this.#language = language();
    for (const [k, card] of this.cards.entries()) this.#fill(card, QUESTIONS[k]);
  }

  /** further: with what takes seconds, whose reasons are then open */
  async #fill(card, question, further = false) {
    const title = make("h3", { textContent: say("Question {number}", { number: question }) });
    if (!card.firstChild) card.append(title);
    card.setAttribute("aria-busy", true);
    try {
      const answer = await this.service.ask(`five-${question}`, "contest-answer", { query: { question, ...(further && { further }) } });
      card.replaceChildren(title, ...this.#parts(answer, further, () => this.#fill(card, question, true)));
    } catch (error) {
      if (error instanceof Superseded) return;
      if (!(error instanceof Problem)) throw error;
      if (further) announceRefusal(error);
      else card.replaceChildren(title, make("p", { className: "error", textContent: error.problem.sentence }));
    }
    card.setAttribute("aria-busy", false);
  }

  #parts({ question, asks, text, sentences: [first, ...others], more, turns, picture, offers, workbook, number, example }, open, askMore) {
    const why = make("details", { open }, make("summary", { textContent: say("Why") }), ...others.map(paragraph));
    const buttons = offers.map((offer) => button({ textContent: offer.words }, () => this.#take(offer)));
    if (more) buttons.push(button({ textContent: more }, askMore));
    const hand = button({ textContent: say("Hand in: {files}", { files: workbook ?? say("figure") }) }, () => this.#handIn(question, hand));
    if (turns) why.append(mapOf(turns, (ratio, entry) => this.#take({ path: "turn", numbers: { ratio, entry_radius: entry, exit_radius: entry, time: 0 } })));
    const value = make("p", { className: "value", textContent: text });
    return [make("p", { className: "asks", textContent: asks }), drawn(picture), value, paragraph(first), why, make("p", { className: "buttons" }, ...buttons, hand), this.#check(question, { workbook, number, example })];
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

  async #handIn(question, hand) {
    const name = `question-${question}.zip`;
    hand.disabled = true;
    announce(() => say("Being made: “{name}”. It is saved as soon as it is ready.", { name }), true);
    try {
      download(await this.service.ask(`hand-in-${question}`, "contest-kit", { body: { question, language: language() }, accept: "application/zip" }), name);
      announceSaved(name);
    } catch (error) {
      announceRefusal(error);
    } finally {
      hand.disabled = false;
    }
  }

  /** A number to type, a workbook to drop, and what the service says of it, in place. */
  #check(question, { workbook, number, example }) {
    const verdict = make("div", { className: "verdicts", "aria-live": "polite" });
    const ask = async (asked) => {
      verdict.replaceChildren(paragraph(say("Checking …")));
      const found = await judge(this.service, `check-${question}`, { ...asked, language: language() });
      if (found) verdict.replaceChildren(...found.boxes);
    };
    const parts = [];
    if (number) {
      const typed = make("input", { id: `mine-${question}`, inputMode: "text", autocomplete: "off", placeholder: example, ariaLabel: say("Your answer to question {number}", { number: question }) });
      parts.push(typed, make("button", { textContent: say("Check mine") }));
    }
    if (workbook) {
      const chosen = make("input", { type: "file", accept: FORM, ariaLabel: workbook });
      chosen.addEventListener("change", () => chosen.files[0] && ask({ file: chosen.files[0] }));
      parts.push(make("label", { className: "mine" }, make("span", { textContent: say("or drop {workbook} here", { workbook }) }), chosen));
    }
    const form = make("form", { className: "check" }, ...parts);
    form.addEventListener("submit", (event) => {
      event.preventDefault();
      const text = form.querySelector(`#mine-${question}`)?.value.trim();
      if (text) ask({ name: number, text });
    });
    for (const type of ["dragenter", "dragover"]) form.addEventListener(type, (event) => event.preventDefault());
    form.addEventListener("drop", (event) => {
      event.preventDefault();
      if (event.dataTransfer.files[0]) ask({ file: event.dataTransfer.files[0] });
    });
    return make("div", {}, form, verdict);
  }
}
