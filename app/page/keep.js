/** Everything to save: the cue cards, which stand with the people, files of every kind, a film, and the commands that give the same. */

import { Problem, TOO_LONG, commandFor } from "./api.js";
import { keptVenueOf, lanesOf, venueOf } from "./drawing.js";
import { $, $$, button, download, hide, make, onClick, textButton } from "./elements.js";
import { CONTACT, DRAGON, FIELDS, LABELS, TURN, numbersOf, strayOf } from "./fields.js";
import { showShare } from "./jobs.js";
import { announce, announceRefusal, copy } from "./overlays.js";
import { fitsQuery } from "./questions.js";
import { announceSaved } from "./saved.js";
import { between, language, phrase, say, sentencesOf } from "./text.js";

const CSV_STEP = 1;
/** Sizes of paper. */
const PAPERS = { A4: "application/pdf", A3: "application/pdf" };
const TYPES = {
  CSV: "text/csv",
  XLSX: "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
  Arrow: "application/vnd.apache.arrow.file",
  JSON: "application/json",
  SVG: "image/svg+xml",
  PNG: "image/png",
  MP4: "video/mp4",
  GIF: "image/gif",
  GeoJSON: "application/geo+json",
  DXF: "image/vnd.dxf",
  KML: "application/vnd.google-earth.kml+xml",
  ...PAPERS,
  ZIP: "application/zip",
};
/** Items to save, in the order of the page: formats, and the name of the request; slow ones become a job; hint: a button of its own; among: the list in which it stands, if not that of the files. */
const ITEMS = [
  { key: "keepKit", title: phrase("The whole contest kit"), forms: ["ZIP"], ask: "kit", file: "contest-kit", job: true, hint: phrase("Five answers, workbooks, tables, figures, films and a report as ZIP. It takes one to ten minutes, as fast as the machine; the button shows how far it is.") },
  { key: "keepTrajectory", title: phrase("Every handle, every second"), forms: ["CSV", "XLSX", "Arrow", "JSON"], ask: "trajectory", file: "trajectory" },
  { key: "keepPicture", title: phrase("The picture as it is"), forms: ["PNG"], file: "dance" },
  { key: "keepInstant", title: phrase("Figure of this instant"), forms: ["SVG", "PNG"], ask: "instant", file: "instant" },
  { key: "keepContact", title: phrase("Figure of the first contact"), forms: ["SVG", "PNG"], ask: "contact", file: "first-contact" },
  { key: "keepStairs", title: phrase("Figure of the pitch chart"), forms: ["SVG", "PNG"], ask: "stairs", file: "pitch-scan" },
  { key: "keepFilm", title: phrase("Film of the dance"), forms: ["MP4", "GIF"], ask: "film", file: "dance", job: true },
  { key: "keepGround", title: phrase("Ground that benches sweep"), forms: ["GeoJSON", "DXF", "JSON"], ask: "ground", file: "envelope" },
  { key: "keepPlan", title: phrase("Plan on paper, true to scale"), forms: ["A4", "A3"], ask: "plan", file: "plan" },
  { key: "keepSafety", title: phrase("Safety sheet, for whoever permits it"), forms: ["A4", "A3"], ask: "safety", file: "safety-sheet" },
  { key: "keepCues", title: phrase("A cue card for each bench"), forms: ["A4", "A3", "CSV"], ask: "cues", file: "cues", among: "#cues" },
  { key: "keepLabels", title: phrase("Labels with a QR code for each bench"), forms: ["A4", "A3"], ask: "labels", file: "labels", among: "#cues" },
  { key: "keepMap", title: phrase("Map with chalk marks"), forms: ["GeoJSON", "KML", "DXF"], ask: "map", file: "map" },
  { key: "keepAnswer", title: phrase("First contact with its certificate"), forms: ["JSON"], ask: "answer", file: "first-contact" },
  { key: "keepVerdict", title: phrase("The verdict on the whole dance"), forms: ["JSON"], ask: "verdict", file: "check" },
  { key: "keepPitch", title: phrase("Minimum pitch with its proof"), forms: ["JSON"], ask: "pitch", file: "minimum-pitch" },
  { key: "keepStray", title: phrase("How far people may stray, with its proof"), forms: ["JSON"], ask: "stray", file: "tolerance" },
  { key: "keepClearance", title: phrase("Clearance, every second"), forms: ["JSON"], ask: "clearance", file: "clearance" },
  { key: "keepPaper", title: phrase("The paper's numbers beside these"), forms: ["JSON"], ask: "paper", file: "paper" },
];
const BESIDES = [...CONTACT, "entry_radius", "exit_radius"];
/** Longest address that stands as a code on a safety sheet, and on a card or a label: a phone reads it from a hand's breadth. */
const [ADDRESS_MOST, CARD_ADDRESS_MOST] = [300, 600];
/** Whether the address of the page leads there from another device too, and fits on paper. */
const isPrintable = (most = ADDRESS_MOST) => location.href.length < most && !/^(localhost|127\.[\d.]+|\[::1\])$/.test(location.hostname);
/** Name of a file in this format. */
const fileName = (file, form) => (form in PAPERS ? `${file}-${form}.pdf` : `${file}.${form}`).toLowerCase();
/** Commands in addition to those of the items: for the shown answer, and for a proof. */
const [ON_SCREEN, PROOF] = ["keepShown", "keepProof"];
const MORE = [{ key: ON_SCREEN, title: phrase("What is shown") }, { key: PROOF, title: phrase("A proof in ball arithmetic") }];

/** What a question about cards has beside the dance. */
const cardsOf = ({ cued }, form) => ({ ...cued, ...(form in PAPERS && { paper: form }), language: language(), ...(isPrintable(CARD_ADDRESS_MOST) && { address: location.href }), ...($("#cards-turned").ariaPressed === "true" && { map_up: "way" }) });

/** A figure with its words in the language of the page. */
function figure(name, form, /** @type {any} */ { query, body }) {
  const words = (values) => ({ ...values, language: language() });
  return { path: `figures/${name}.${form.toLowerCase()}`, ...(query ? { query: words(query) } : { body: words(body) }) };
}
/** Whole seconds of a dance. */
const seconds = ({ begin, end }) => ({ start: Math.min(Math.ceil(begin), end), stop: end, step: CSV_STEP });
/** The request of a map. drawing: that has what a map keeps and no other question needs; null: of a dance without a square */
function mapOf(form, body, drawing) {
  const [venue, origin] = [drawing && keptVenueOf(drawing), drawing?.origin];
  return { path: `maps.${form.toLowerCase()}`, body: { ...body, ...(venue && { venue }), ...(origin && { origin }) } };
}
/** The request of a safety sheet, with the gates and the lanes of the square. drawing: of a dance in a square, else null */
function safetyOf(body, drawing, paper) {
  const drawn = drawing && (venueOf(drawing) ? { venue: keptVenueOf(drawing) } : { lanes: lanesOf(drawing) });
  return { path: "safety-sheet", body: { ...body, paper, language: language(), ...drawn, ...(isPrintable() && { address: location.href }) } };
}
/** The request of each item in a format: {path, query or body}. */
const REQUESTS = {
  /** The contest's problem with the numbers of the page, of which the pitch is that of the spiral or of the turn. */
  kit({ state }) {
    const own = numbersOf(state.texts([...DRAGON, "start_turns", "head_speed", "turning_diameter", "ratio", "speed_limit"]));
    const pitch = state.get("path") === "turn" ? "turn_pitch" : "pitch";
    return { path: "contest-kit", body: { ...own, [pitch]: Number(state.get("pitch")), language: language() } };
  },
  trajectory: (questions) => ({ path: "trajectory", body: questions.body({ times: seconds(questions.dance) }) }),
  instant(questions, form) {
    const { begin, end } = questions.dance;
    const time = Math.min(Math.max(questions.state.get("time") ?? end, begin), end);
    return figure("trajectory", form, { body: questions.placed({ time }) });
  },
  contact(questions, form) {
    const { kind, query, numbers, answer, begin, end } = questions.dance;
    // The figure of a contact shows everybody in their place: with a stray, the figure of the last shown instant replaces it.
    if (strayOf(query) > 0) return figure("trajectory", form, { body: questions.placed({ time: end }) });
    const { stray, hole, pin, ...flat } = query;
    return figure("contact", form, kind === "spiral" && fitsQuery(questions.dance) ? { query: flat } : { body: questions.placed({ margin: numbers.margin, start: begin, ...(kind === "turn" && answer.time === null && { stop: end }) }) });
  },
  stairs: (questions, form) => figure("pitch-scan", form, questions.pitchOf(["margin"])),
  film(questions) {
    const { begin, end } = questions.dance;
    return { path: "films", body: questions.placed({ start: begin, stop: end, language: language() }) };
  },
  ground: (questions) => ({ path: "envelope", body: questions.body({ start: questions.dance.begin, stop: questions.dance.end }) }),
  plan: (questions, paper) => ({ path: "plan", body: questions.danced({ paper, language: language() }) }),
  safety: (questions, paper) => safetyOf(questions.danced(), questions.dance.kind === "route" ? questions.state.get("drawing") : null, paper),
  cues: (questions, form) => ({ path: "cues", body: questions.danced(cardsOf(questions, form)) }),
  labels: (questions, form) => ({ path: "cues", body: questions.danced({ ...cardsOf(questions, form), labels: true }) }),
  map(questions, form) {
    const drawing = questions.dance.kind === "route" ? questions.state.get("drawing") : null;
    return mapOf(form, questions.danced(), drawing);
  },
  /** The answer of the command; in the shown one the engines may have judged only the pair. */
  answer(questions) {
    const { dance } = questions;
    if (dance.kind !== "spiral") return REQUESTS.verdict(questions);
    return { path: "collision-time", ...(fitsQuery(dance) ? { query: dance.query } : { body: questions.checkBody(dance) }) };
  },
  verdict: (questions) => ({ path: "check", body: questions.checkBody(questions.dance) }),
  pitch: (questions) => ({ path: "minimum-pitch", ...questions.pitchOf(CONTACT) }),
  stray: (questions) => ({ path: "tolerance", ...questions.toleranceOf() }),
  clearance: (questions) => ({ path: "clearance", body: questions.body({ times: seconds(questions.dance) }) }),
  paper: () => ({ path: "paper", query: { language: language() } }),
};

/** What there is of several dragons. The film ends at the first touch, or with the performance. */
const TOGETHER = {
  trajectory: ({ dance }) => ({ path: "trajectory", body: { dances: dance.file.dances, times: seconds(dance) } }),
  film({ dance: { file: { stray, hole, pin, margin, speed_limit, ...file } } }) {
    return { path: "films", body: { ...file, language: language() } };
  },
  plan: ({ dance }, paper) => ({ path: "plan", body: { ...dance.file, paper, language: language() } }),
  safety: ({ dance, state }, paper) => safetyOf(dance.file, state.get("drawing"), paper),
  cues: (questions, form) => ({ path: "cues", body: { ...questions.dance.file, ...cardsOf(questions, form) } }),
  labels: (questions, form) => ({ path: "cues", body: { ...questions.dance.file, ...cardsOf(questions, form), labels: true } }),
  map: ({ dance }, form) => mapOf(form, dance.file, dance.drawing),
  verdict: ({ dance }) => ({ path: "check", body: dance.file }),
};

/** Name a button after its item, its format and how far its job is. */
const nameButton = (button) => button.setAttribute("aria-label", `${say(ITEMS.find(({ key }) => key === button.dataset.keep).title)}, ${button.dataset.form}${button.querySelector(".share").textContent}`);

export class Keep {
  /** That of each item. */
  #rows;

  /**
   * jobs: makes films
   * @param {{ service: Service, questions: Questions, jobs: Jobs, canvas: any }} parts
   */
  constructor({ service, questions, jobs, canvas }) {
    this.service = service;
    this.questions = questions;
    this.jobs = jobs;
    this.canvas = canvas;
    onClick("#copy-curl", () => copy($("#curl").textContent));
    this.#rows = ITEMS.map((item) => this.#row(item));
    ITEMS.forEach(({ among = "#kept" }, k) => $(among).append(this.#rows[k]));
    const { state } = questions;
    $("#keepCues-A4").before(textButton("Follow a bench", () => state.push({ bench: state.get("handle") ?? 0 }), { id: "card-follow" }));
    const turned = textButton("Maps turned with the way", () => turned.setAttribute("aria-pressed", turned.ariaPressed !== "true"), { id: "cards-turned", "aria-pressed": false });
    $("#keepCues-A4").closest("li").append(turned);
    const commands = [MORE[0], ...ITEMS.filter(({ ask }) => ask), MORE[1]];
    $("#curl-of").append(...commands.map(({ key, title }) => make("option", { value: key, "data-text": title })));
    $("#curl-of").addEventListener("change", () => this.show());
    $("#paper").addEventListener("toggle", () => $("#paper").open && this.paper());
    this.#offer().catch((error) => {
      if (!(error instanceof Problem)) throw error;
    });
  }

  #row(item) {
    const about = (form) => ({ id: `${item.key}-${form}`, "data-keep": item.key, "data-form": form });
    const text = (form) => (item.hint ? make("span", { "data-text": item.title }) : form);
    const buttons = item.forms.map((form) => button(about(form), () => this.#save(item, form), text(form), make("span", { className: "share" })));
    if (item.hint) return make("li", { className: "whole" }, ...buttons, make("p", { className: "hint", "data-text": item.hint }));
    return make("li", {}, make("span", { "data-text": item.title }), make("span", { className: "buttons" }, ...buttons));
  }

  /** Name each button after its item. */
  translate() {
    for (const button of $$("[data-keep]")) nameButton(button);
    for (const film of $("#kept").querySelectorAll(".film")) Object.assign(film, { alt: say("Film of the dance"), ariaLabel: say("Film of the dance") });
    this.show();
    if ($("#paper").open) this.paper();
  }

  /** Offer only formats that this service can write. */
  async #offer() {
    const { paths } = await this.service.ask("openapi", "openapi.json");
    const calls = Object.values(paths).flatMap((path) => Object.values(path));
    const types = new Set(calls.flatMap(({ responses }) => Object.keys(responses?.[200]?.content ?? {})));
    for (const button of $$("[data-keep]")) button.hidden = !types.has(TYPES[button.dataset.form]);
  }

  /** The requests that there are about the dance. */
  get #requests() {
    return this.questions.dance?.parts ? TOGETHER : REQUESTS;
  }

  /** What can be saved of the dance, and the commands for the chosen item; they stay as they are while there is no dance. */
  show() {
    if (!this.questions.dance) return;
    const requests = this.#requests;
    const isThere = (key) => key === ON_SCREEN || (key === PROOF ? requests === REQUESTS : ITEMS.some((item) => item.key === key && (!item.ask || item.ask in requests)));
    this.#rows.forEach((row, k) => hide(row, !isThere(ITEMS[k].key)));
    for (const option of $("#curl-of").options) option.hidden = option.disabled = !isThere(option.value);
    if (!isThere($("#curl-of").value)) $("#curl-of").value = ON_SCREEN;
    const wanted = $("#curl-of").value;
    const item = ITEMS.find(({ key }) => key === wanted);
    const shown = "answer" in requests ? "answer" : "verdict";
    const lines = { [ON_SCREEN]: () => [shown, "trajectory"].map((name) => this.#curl(requests[name](this.questions))), [PROOF]: () => [this.#proof()] };
    $("#curl").textContent = (lines[wanted] ?? (() => [this.#curl(requests[item.ask](this.questions, item.forms[0]), item)]))().join("\n");
  }

  /**
   * The command for a question. item: its first format goes into a file; what takes long is asked as a job
   * @param {{path: string, query?: any, body?: any}} question
   * @param {any} [item]
   */
  #curl({ path, query, body }, item) {
    if (item?.job) return this.#curl({ path: "jobs", body: { question: path.replaceAll("-", "_"), request: body, accept: TYPES[item.forms[0]] } });
    const form = item?.forms[0];
    const kept = form && form !== "JSON" ? ` -H 'Accept: ${TYPES[form]}' -fo ${fileName(item.file ?? "dance", form)}` : "";
    return `${commandFor(query ? `${path}?${new URLSearchParams(query)}` : path, body)}${kept}`;
  }

  /** The command that proves the shown answer in ball arithmetic. */
  #proof() {
    const { kind, numbers, answer, begin, end } = this.questions.dance;
    if (kind === "route" || !fitsQuery(this.questions.dance)) return "bench-dragon prove dance dance.json";
    const claim = kind === "turn" ? "turn" : answer.outcome === "clear" ? "clear" : "collision-time";
    const names = [...DRAGON, "pitch", "start_turns", ...(kind === "turn" ? TURN : []), "head_speed", "margin"];
    const known = names.filter((name) => numbers[name] !== undefined).map((name) => `--${name.replaceAll("_", "-")} ${numbers[name]}`);
    if (kind === "turn") known.push(`--start=${begin}`, `--stop=${end}`);
    return `bench-dragon prove ${claim} ${known.join(" ")}\nbench-dragon prove --check ${claim}.proof.json`;
  }

  async #save(item, form) {
    if (!this.questions.dance || $(`#${item.key}-${form}`).classList.contains("going")) return;
    const { state } = this.questions;
    // The form in which a person types it is that of a drawn path.
    if (form === "KML" && state.get("path") === "route" && !state.get("drawing").origin) return this.#askPlace();
    if (item.ask === "kit" && this.questions.dance.extras.csv) return announce(() => say("The kit is for equal benches: reset the table of benches."));
    if (item.ask === "labels" && !isPrintable(CARD_ADDRESS_MOST)) return announce(() => say("Codes need an address of at most {most} characters that leads here from a phone too.", { most: CARD_ADDRESS_MOST }));
    try {
      if (item.job) await this.#begin(item, form);
      if (item.ask === "kit" && this.#besides().length) announce(() => say("The kit answers the contest's questions, without: {names}.", { names: this.#besides().map((name) => say(LABELS[name])).join(between()) }));
      if (item.job) return;
      announce(() => say("Being made: “{name}”. It is saved as soon as it is ready.", { name: say(item.title) }), true);
      this.#mark(item, form, true);
      const { blob, inMetres } = item.ask ? await this.#fetch(this.#requests[item.ask](this.questions, form), form) : { blob: await this.#picture(), inMetres: false };
      const name = fileName(item.file, form);
      download(blob, name);
      const canBePlaced = inMetres && item.ask === "map" && this.questions.dance.kind === "route";
      announceSaved(name, item.ask === "map" ? this.questions.dance.drawing : null, () => [say(inMetres ? "Saved {name}: its coordinates are metres, not longitude and latitude." : "Saved {name}.", { name }), canBePlaced && say("“Latitude, longitude of 0, 0”, below the square, turns them into these.")]);
    } catch (error) {
      // What takes too long for one answer is made as a job.
      if (error instanceof Problem && error.problem.type === TOO_LONG) this.#begin(item, form).catch(announceRefusal);
      else announceRefusal(error);
    } finally {
      if (!item.job) this.#mark(item, form, false);
    }
  }

  /** KML is in degrees: say where to type the place on earth of a drawn dance, and lead there. */
  #askPlace() {
    announce(() => say("KML is in degrees: type the latitude and longitude of x = y = 0, here in the form of the path, and save again."), false, true);
    const field = $("#latitude");
    if (!field.checkVisibility()) $("#more").click();
    field.focus();
  }

  /** Mark a button while its file is made. */
  #mark({ key }, form, going) {
    $(`#${key}-${form}`).setAttribute("aria-busy", going);
  }

  /** The numbers in use that the contest's questions do not have. */
  #besides() {
    const { state } = this.questions;
    return FIELDS.filter(({ name, only }) => BESIDES.includes(name) && Number(state.get(name)) && (!only || only === state.get("path"))).map(({ name }) => name);
  }

  /** {blob, inMetres: true for a map without a place on earth} */
  async #fetch({ path, request, ...question }, form) {
    const answer = await this.service.ask(`keep ${path} ${form}`, path, { ...question, accept: TYPES[form] });
    if (form === "JSON") return { blob: new Blob([JSON.stringify(answer, null, 2)], { type: TYPES.JSON }), inMetres: false };
    if (form === "GeoJSON") return { blob: new Blob([JSON.stringify(answer)]), inMetres: !answer.origin };
    return { blob: answer, inMetres: false };
  }

  /** Start a job, which is among the jobs too. */
  async #begin(item, form) {
    const { path, ...question } = this.#requests[item.ask](this.questions, form);
    await this.jobs.begin(path, { ...question, accept: TYPES[form] }, (now) => this.#follow(item, form, now));
  }

  /** Show on its button how far a job is; then a film opens there, and any other result is saved. */
  #follow({ key, file }, form, { jobID, status, progress, problem }) {
    const button = $(`#${key}-${form}`);
    showShare(button, { status, progress });
    nameButton(button);
    if (problem) announce(() => problem.sentence, true);
    if (status !== "successful") return;
    const result = `jobs/${jobID}/result`;
    const name = fileName(file, form);
    if (key !== "keepFilm") {
      make("a", { href: result, download: name }).click();
      return announce(() => say("Saved {name}.", { name }));
    }
    const row = button.closest("li");
    row.querySelector(".film")?.remove();
    row.append(form === "GIF" ? make("img", { className: "film", src: result }) : make("video", { className: "film", src: result, controls: true }));
    this.translate();
    announce(() => say("The film is below its button."));
  }

  async #picture() {
    const { width, height } = this.canvas;
    const copy = make("canvas", { width, height });
    const context = copy.getContext("2d");
    context.fillStyle = getComputedStyle(this.canvas).backgroundColor;
    context.fillRect(0, 0, width, height);
    context.drawImage(this.canvas, 0, 0);
    return new Promise((resolve) => copy.toBlob(resolve, "image/png"));
  }

  /** The paper's numbers beside ours, requested when the section is opened. */
  async paper() {
    const answer = await this.service.ask("paper", "paper", REQUESTS.paper()).catch(announceRefusal);
    if (!answer) return;
    const { rows, literature } = answer;
    const head = [phrase("quantity"), phrase("source"), phrase("published"), phrase("here")].map((words) => make("th", { scope: "col", "data-text": words, textContent: say(words) }));
    const line = ({ quantity, unit, source, paper, published, ours, reason, diagnosis }) => {
      const cells = [source, `${paper ?? published} ${unit}`, `${ours.toFixed(9)} ${unit}`].map((textContent, k) => make("td", { textContent, className: k ? "number" : "" }));
      const why = reason ?? sentencesOf(diagnosis.map(({ words }) => words));
      const row = make("tr", {}, make("th", { scope: "row", textContent: quantity }), ...cells);
      return why ? [row, make("tr", {}, make("td", { colSpan: 4, className: "hint", textContent: why }))] : [row];
    };
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...[...rows, ...literature].flatMap(line)));
    $("#paper div").replaceChildren(table);
  }
}
