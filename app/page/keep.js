/** Everything to save: the link, files of every kind, a film, and the commands that give the same. */

import { Problem, Superseded } from "./api.js";
import { $, make, onClick } from "./elements.js";
import { bearer } from "./jobs.js";
import { isPlain } from "./questions.js";
import { FOR_CLIENTS } from "./refusals.js";
import { CONTACT, DRAGON, TURN, strayOf } from "./state.js";
import { language, refusalWords, say } from "./text.js";

const CSV_STEP = 1;
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
  A4: "application/pdf",
  A3: "application/pdf",
};
/** Items to save, in the order of the page: formats, and the method with the request; slow ones become a job. */
const ITEMS = [
  { key: "keepTrajectory", forms: ["CSV", "XLSX", "Arrow", "JSON"], ask: "trajectory", file: "trajectory" },
  { key: "keepPicture", forms: ["PNG"], file: "dance" },
  { key: "keepInstant", forms: ["SVG", "PNG"], ask: "instant", file: "instant" },
  { key: "keepContact", forms: ["SVG", "PNG"], ask: "contact", file: "first-contact" },
  { key: "keepStairs", forms: ["SVG", "PNG"], ask: "stairs", file: "pitch-scan" },
  { key: "keepFilm", forms: ["MP4", "GIF"], ask: "film", job: true },
  { key: "keepGround", forms: ["GeoJSON", "DXF", "JSON"], ask: "ground", file: "envelope" },
  { key: "keepPlan", forms: ["A4", "A3"], ask: "plan", file: "plan" },
  { key: "keepMap", forms: ["GeoJSON", "KML", "DXF"], ask: "map", file: "map" },
  { key: "keepAnswer", forms: ["JSON"], ask: "answer", file: "first-contact" },
  { key: "keepVerdict", forms: ["JSON"], ask: "verdict", file: "check" },
  { key: "keepPitch", forms: ["JSON"], ask: "pitch", file: "minimum-pitch" },
  { key: "keepStray", forms: ["JSON"], ask: "stray", file: "tolerance" },
  { key: "keepClearance", forms: ["JSON"], ask: "clearance", file: "clearance" },
  { key: "keepPaper", forms: ["JSON"], ask: "paperAsked", file: "paper" },
];
/** Name of a file in this format. */
const named = (file, form) => (TYPES[form] === TYPES.A4 ? `${file}-${form}.pdf` : `${file}.${form}`).toLowerCase();
/** Commands in addition to those of the items: for the shown answer, and for a proof. */
const SHOWN = "keepShown";
const PROOF = "keepProof";

export class Keep {
  /** jobs: makes films; announce(words()): reports events */
  constructor({ state, service, questions, jobs, canvas, announce }) {
    Object.assign(this, { state, service, questions, jobs, canvas, announce });
    onClick("#share", () => {
      state.write();
      this.#copy(location.href);
    });
    onClick("#copy-curl", () => this.#copy($("#curl").textContent));
    $("#kept").append(...ITEMS.map((item) => this.#row(item)));
    const keys = [SHOWN, ...ITEMS.filter(({ ask }) => ask).map(({ key }) => key), PROOF];
    $("#curl-of").append(...keys.map((key) => make("option", { value: key, "data-text": key })));
    $("#curl-of").addEventListener("change", () => this.show());
    $("#paper").addEventListener("toggle", () => $("#paper").open && this.paper());
  }

  #row(item) {
    const buttons = item.forms.map((form) => {
      const button = make("button", { type: "button", id: `${item.key}-${form}`, textContent: form, "data-keep": item.key, "data-form": form });
      button.addEventListener("click", () => this.#save(item, form));
      return button;
    });
    return make("li", {}, make("span", { "data-text": item.key }), make("span", { className: "buttons" }, ...buttons));
  }

  /** Name each button after its item. */
  translate() {
    for (const button of $("#kept").querySelectorAll("button")) button.setAttribute("aria-label", `${say(button.dataset.keep)}, ${button.dataset.form}`);
    if (this.questions.dance) this.show();
    if ($("#paper").open) this.paper();
  }

  /** Offer only formats that this service can write. paths: of its OpenAPI document */
  offer(paths) {
    const types = new Set();
    for (const calls of Object.values(paths)) {
      for (const { responses } of Object.values(calls)) for (const type of Object.keys(responses?.[200]?.content ?? {})) types.add(type);
    }
    for (const button of $("#kept").querySelectorAll("button")) button.hidden = !types.has(TYPES[button.dataset.form]);
  }

  /** The commands for the chosen item. */
  show() {
    const wanted = $("#curl-of").value;
    const item = ITEMS.find(({ key }) => key === wanted);
    const lines = { [SHOWN]: () => [this.#curl(this.answer()), this.#curl(this.trajectory())], [PROOF]: () => [this.#proof()] };
    $("#curl").textContent = (lines[wanted] ?? (() => [this.#curl(this[item.ask](item.forms[0]), item)]))().join("\n");
  }

  /** The command for a question. item: its first format goes into a file */
  #curl({ path, query, body }, item) {
    const base = new URL("./", location).href;
    const url = query ? `${path}?${new URLSearchParams(query)}` : path;
    const sent = body ? ` -H 'Content-Type: application/json' -d '${JSON.stringify(body).replaceAll("'", "'\\''")}'` : "";
    const form = item?.forms[0];
    const kept = form && form !== "JSON" ? ` -H 'Accept: ${TYPES[form]}' -o ${named(item.file ?? "dance", form)}` : "";
    return `curl '${base}${url}'${sent}${kept}`;
  }

  /** The command that proves the shown answer in ball arithmetic. */
  #proof() {
    const { kind, numbers, answer, begin, end } = this.questions.dance;
    if (kind === "route" || !isPlain(this.questions.dance)) return "bench-dragon prove dance dance.json";
    const claim = kind === "turn" ? "turn" : answer.outcome === "clear" ? "clear" : "collision-time";
    const names = [...DRAGON, "pitch", "start_turns", ...(kind === "turn" ? TURN : []), "head_speed", "margin"];
    const known = names.filter((name) => numbers[name] !== undefined).map((name) => `--${name.replaceAll("_", "-")} ${numbers[name]}`);
    if (kind === "turn") known.push(`--start=${begin}`, `--stop=${end}`);
    return `bench-dragon prove ${claim} ${known.join(" ")}\nbench-dragon prove --check ${claim}.proof.json`;
  }

  async #copy(text) {
    try {
      await navigator.clipboard.writeText(text);
      this.announce(() => say("copied"));
    } catch {
      this.announce(() => say("copyFailed"));
    }
  }

  async #save(item, form) {
    if (!this.questions.dance) return;
    try {
      if (item.job) return await this.#begin(item, form);
      this.announce(() => say("making", { name: say(item.key) }), true);
      const blob = item.ask ? await this.#asked(this[item.ask](form), form) : await this.#picture();
      const link = make("a", { href: URL.createObjectURL(blob), download: named(item.file, form) });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
      this.announce(() => say("saved", { name: link.download }));
    } catch (error) {
      // What takes too long for one answer is made as a job.
      if (error instanceof Problem && FOR_CLIENTS.test(error.message)) this.#begin(item, form).catch((refused) => this.#told(refused));
      else this.#told(error);
    }
  }

  #told(error) {
    if (error instanceof Problem) this.announce(() => refusalWords(error.message).textContent);
    else if (!(error instanceof Superseded)) throw error;
  }

  async #asked({ path, asked, ...question }, form) {
    const answer = await this.service.ask(`keep ${path} ${form}`, path, { ...question, accept: TYPES[form] });
    return form === "JSON" ? new Blob([JSON.stringify(answer, null, 2)], { type: TYPES.JSON }) : form === "GeoJSON" ? new Blob([JSON.stringify(answer)]) : answer;
  }

  /** Start a job; its result appears among the jobs. */
  async #begin({ ask }, form) {
    const { path, query, body } = this[ask](form);
    const headers = { Prefer: "respond-async", ...bearer() };
    this.jobs.add(await this.service.ask(`keep ${form}`, path, { query, body, headers, accept: `${TYPES[form]}, application/json;q=0.1` }), { question: path, over: {} });
  }

  trajectory() {
    const { begin, end } = this.questions.dance;
    return { path: "trajectory", body: this.questions.body({ times: { start: Math.min(Math.ceil(begin), end), stop: end, step: CSV_STEP } }) };
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

  #figure(name, form, asked) {
    return { path: `figures/${name}.${form.toLowerCase()}`, ...asked };
  }

  instant(form) {
    const { begin, end } = this.questions.dance;
    const time = Math.min(Math.max(this.state.get("time") ?? end, begin), end);
    return this.#figure("trajectory", form, { body: this.questions.placed({ time }) });
  }

  contact(form) {
    const { kind, query, numbers, end } = this.questions.dance;
    // The figure of a contact shows everybody in their place: with a stray, the figure of the last shown instant replaces it.
    if (strayOf(query) > 0) return this.#figure("trajectory", form, { body: this.questions.placed({ time: end }) });
    const { stray, hole, pin, ...flat } = query;
    return this.#figure("contact", form, kind === "spiral" && isPlain(this.questions.dance) ? { query: flat } : { body: this.questions.placed({ margin: numbers.margin }) });
  }

  stairs(form) {
    return this.#figure("pitch-scan", form, this.questions.pitchOf(["margin"]));
  }

  film() {
    const { begin, end } = this.questions.dance;
    return { path: "films", body: this.questions.placed({ start: begin, stop: end, language: language() }) };
  }

  ground() {
    const { begin, end } = this.questions.dance;
    return { path: "envelope", body: this.questions.body({ start: begin, stop: end }) };
  }

  plan(paper) {
    return { path: "plan", body: { ...this.questions.checkBody(this.questions.dance), paper, language: language() } };
  }

  map(form) {
    const { origin } = this.questions.dance.kind === "route" ? this.state.get("drawing") : {};
    return { path: `maps.${form.toLowerCase()}`, body: { ...this.questions.checkBody(this.questions.dance), ...(origin && { origin }) } };
  }

  /** The answer of the command; in the shown one the engines may have judged only the pair. */
  answer() {
    const { dance } = this.questions;
    if (dance.kind !== "spiral") return this.verdict();
    return { path: "collision-time", ...(isPlain(dance) ? { query: dance.query } : { body: this.questions.checkBody(dance) }) };
  }

  verdict() {
    return { path: "check", body: this.questions.checkBody(this.questions.dance) };
  }

  pitch() {
    return { path: "minimum-pitch", ...this.questions.pitchOf(CONTACT) };
  }

  stray() {
    return { path: "tolerance", ...this.questions.toleranceOf() };
  }

  clearance() {
    const { begin, end } = this.questions.dance;
    return { path: "clearance", body: this.questions.body({ times: { start: Math.min(Math.ceil(begin), end), stop: end, step: CSV_STEP } }) };
  }

  paperAsked() {
    return { path: "paper", query: { language: language() } };
  }

  /** The paper's numbers beside ours, requested when the section is opened. */
  async paper() {
    const answer = await this.service.ask("paper", "paper", this.paperAsked()).catch((error) => this.#told(error));
    if (!answer) return;
    const { rows, literature } = answer;
    const head = ["paperWhat", "paperSource", "paperTheirs", "paperOurs"].map((key) => make("th", { scope: "col", "data-text": key, textContent: say(key) }));
    const line = ({ quantity, unit, source, paper, published, ours, reason, diagnosis }) => {
      const cells = [source, `${paper ?? published} ${unit}`, `${ours.toFixed(9)} ${unit}`].map((textContent) => make("td", { textContent }));
      const why = reason ?? diagnosis.map(({ words }) => words).join(" ");
      const row = make("tr", {}, make("th", { scope: "row", textContent: quantity }), ...cells);
      return why ? [row, make("tr", {}, make("td", { colSpan: 4, className: "hint", textContent: why }))] : [row];
    };
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...[...rows, ...literature].flatMap(line)));
    $("#paper div").replaceChildren(table);
  }
}
