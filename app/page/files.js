/** Files of a drawn dance: opened, dropped on the picture, and saved. */

import { tableOfFile } from "./bench_table.js";
import { tableOf } from "./read_table.js";
import { Problem } from "./api.js";
import { joined } from "./changes.js";
import { chooseParts } from "./layers.js";
import { THINGS, drawingOf, keptVenueOf } from "./drawing.js";
import { $, bearer, download, make, textButton } from "./elements.js";
import { FIELDS } from "./fields.js";
import { chooseHow } from "./opening.js";
import { MEANWHILE, announce, announceRefusal, endMeanwhile, endMessage } from "./overlays.js";
import { paceTexts, passagesText } from "./passages.js";
import { isPresetPath, isPresetVenue } from "./presets.js";
import { announceSaved } from "./saved.js";
import { isInside } from "./square.js";
import { between, language, say, sentencesOf } from "./text.js";

const ACCEPT = ".json,.geojson,.toml,.kml,.kmz,.gpx,.dxf,.csv,.tsv,.xlsx";
/** Fields of a dance's file that are numbers of the page too. */
const NUMBERS = ["head_speed", "margin", "stray", "hole", "pin"];
const DEFAULTS = Object.fromEntries(FIELDS.map(({ name, value }) => [name, value]));
const UNIFORM = ["benches", "head_length", "body_length", "width", "overhang"];

/** The advice of a refusal of more than a venue may have, which is read in part. */
const PARTLY = "read only some layers of the drawing";

/** The times of a FILE; the page shows each dance from its beginning to its end. */
export const SPAN = ["start", "stop"];

/** Say that a file was opened; if there is more to say, for as long as it takes to read it twice, or until a person closes it. unread: what of it the page leaves out; notes: what else it did not take over */
export function announceOpened(name, unread, notes = []) {
  const isLong = unread.length + notes.length > 0;
  announce(() => sentencesOf([say("Opened {name}.", { name }), unread.length && say("Left out: {names}. The page shows a dance from beginning to end.", { names: unread.join(between()) }), ...notes]), isLong, isLong);
}

/** Say which things of a file have no room beside those that are there. */
export const leftWords = (left) => (left.length ? [say("Your square stays; these of the file are left out: {names}.", { names: left.map(({ name }) => say("“{name}”", { name })).join(between()) })] : []);

/** What the next proposed dance is wished for, in a FILE; and the same of a FILE as texts of the state. */
export function wishesIn(state) {
  const { ends, laps } = state.texts(["ends", "laps"]);
  return ends || laps ? { wishes: { ...(ends && { end_by: ends }), ...(laps && { laps }) } } : {};
}
export const wishesOf = (/** @type {any} */ { wishes }) => ({ ends: wishes?.end_by ?? "", laps: wishes?.laps ?? "" });

export class Files {
  /**
   * steps: receives changes; questions: has the shown dance
   * @param {State} state
   * @param {Steps} steps
   * @param {Service} service
   * @param {Questions} questions
   * @param {any} several opens a dance of several dragons
   */
  constructor(state, steps, service, questions, several) {
    this.several = several;
    this.state = state;
    this.steps = steps;
    this.service = service;
    this.questions = questions;
    const onchange = () => {
      if (this.input.files[0]) this.open(this.input.files[0]);
      this.input.value = "";
    };
    this.input = make("input", { type: "file", id: "open-file", accept: ACCEPT, "data-label": "Open …", hidden: true, onchange });
    const stage = $("#stage");
    for (const type of ["dragenter", "dragover"])
      stage.addEventListener(type, (event) => {
        if (!event.dataTransfer.types.includes("Files")) return;
        event.preventDefault();
        stage.classList.add("over");
      });
    for (const type of ["dragleave", "drop"]) stage.addEventListener(type, () => stage.classList.remove("over"));
    stage.addEventListener("drop", (event) => {
      event.preventDefault();
      if (event.dataTransfer.files[0]) this.open(event.dataTransfer.files[0]);
    });
  }

  /** Buttons that open and save. */
  buttons() {
    /** Takes the times of a track that was walked as passages; shown after such a track was opened. */
    this.times = textButton("Use the walked times", () => this.#useTimes(), { id: "use-times", hidden: true });
    return [textButton("Open …", () => this.input.click(), { id: "open" }), this.input, textButton("Save", () => this.save(), { id: "save" }), this.times];
  }

  /** Open a dance, or a map with a venue and a path. */
  async open(file) {
    endMessage();
    const reading = () => say("Reading {name} …", { name: file.name });
    try {
      if (/\.(csv|tsv|xlsx?|ods)$/i.test(file.name)) {
        const { text: csv, notes } = await tableOfFile(file, this.service);
        if (csv === null) return announce(() => sentencesOf(notes), true, true);
        this.steps.change({ csv });
        return announceOpened(file.name, [], notes);
      }
      announce(reading, MEANWHILE, true);
      const content = (await ownDance(file)) ?? (await this.#places(file));
      if (content) await this.#take(content, file.name);
    } catch (error) {
      const hasParts = error instanceof Problem && (/\.dxf$/i.test(file.name) || error.problem.reason?.startsWith(PARTLY));
      if (!hasParts || !(await this.#offerParts(file, error.problem, reading))) announceRefusal(error, true);
    } finally {
      endMeanwhile(reading);
    }
  }

  /** Offer to open a part of a drawing that is refused as a whole; false for a file without layers. */
  async #offerParts(file, problem, reading) {
    const { layers } = await this.service.ask("places", "places", { query: { only_layers: true }, file, headers: bearer() }).catch(() => ({ layers: null }));
    if (!layers?.length) return false;
    endMessage();
    chooseParts(layers, problem, async (part) => {
      announce(reading, MEANWHILE, true);
      const content = await this.#places(file, part).finally(() => endMeanwhile(reading));
      this.#take(content, file.name);
    });
    return true;
  }

  async #places(file, part = {}) {
    const [head, body, overhang] = ["head_length", "body_length", "overhang"].map((name) => Number(this.state.get(name)));
    // A walked track is smoothed for the longest bench.
    const chord = Math.max(head, body) - 2 * overhang;
    const query = { language: language(), ...(chord > 0 && { longest_chord: chord }), ...part };
    const { dance, notes = [], ...content } = await this.service.ask("places", "places", { query, file, headers: bearer() });
    return { ...dance, ...content, notes, isDance: dance !== null };
  }

  #useTimes() {
    this.steps.change({ passages: passagesText(this.walked) });
    this.times.hidden = true;
  }

  /** Open what a file has: beside what a person has made, or in its place, which is asked where something would be lost. */
  async #take(content, name) {
    const opened = drawingOf({ ...content, path: content.dances ? null : content.path, venue: typeof content.venue === "object" ? content.venue : null }, (kind) => say(THINGS[kind]));
    const before = this.state.get("drawing");
    const isAlone = !this.state.get("dances") && this.state.get("path") !== "route";
    const hasPath = Boolean(this.state.get("dances") || before.points.length > 1 || before.path);
    const isDance = content.dances || (content.isDance ?? true);
    const loses = (hasPath && !isPresetPath(before) && (isDance || content.path)) || (before.things.length && !isPresetVenue(before) && (isDance || opened.things.length));
    if (loses && !isAlone) endMessage();
    const how = loses && !isAlone ? await chooseHow(name) : "instead";
    if (!how) return;
    const isBeside = how === "beside";
    if (content.dances) await this.several(content, name, isBeside);
    else if (isBeside && isDance && hasPath && content.path) await this.several({ ...content, dances: [content] }, name, true);
    else if (isBeside) this.#join(content, opened, name);
    else this.#replace(content, opened, name);
  }

  /** Bring what a file has into the drawing; what is there already stays. */
  #join(content, opened, name) {
    const before = this.state.get("drawing");
    const { drawing, left } = joined(before, opened);
    const keeps = content.path && (before.points.length > 0 || before.path);
    this.steps.change({ ...this.state.changesOf("route"), time: null, view: null, drawing });
    announceOpened(name, [], [...(content.notes ?? []), ...leftWords(left), keeps && say("Your path stays; that of the file is left out.")].filter(Boolean));
  }

  #replace(content, opened, name) {
    const { isDance = true } = content;
    this.walked = isDance ? null : content.passages;
    this.times.hidden = !this.walked;
    const { dragon = {}, path, venue } = content;
    const csv = isDance ? tableOf(dragon) : "";
    // What a dance does not state has its default, and so have the benches of which a table takes the place; a map states none of it.
    const stated = csv ? content : { ...dragon, ...content };
    const numbers = isDance ? Object.fromEntries([...UNIFORM, ...NUMBERS].map((one) => [one, typeof stated[one] === "number" ? String(stated[one]) : this.#default(one, csv)])) : {};
    // A map without a path keeps the drawn path, but not that of an example which leaves its square, and one without a venue keeps the venue; a
    // dance has its own or none.
    const before = this.state.get("drawing");
    const { points, straight, radius, begin, path: kept, start, things, origin, grid, yard, limit } = before;
    const square = opened.things.find(({ kind }) => kind === "area")?.points ?? [];
    const leaves = venue && isPresetPath(before) && points.some((point) => !isInside(square, point));
    if (!path && !leaves) Object.assign(opened, { points, straight, radius, begin, path: kept, start });
    if (!venue && !isDance) Object.assign(opened, { things, origin, grid, yard });
    if (!isDance) opened.limit = limit;
    // A dance has its own speeds, times and benches, or none.
    const others = isDance ? { csv, ...paceTexts(content), ...clocksOf(content), ...wishesOf(content) } : {};
    this.steps.change({ ...this.state.changesOf("route"), ...numbers, ...others, time: null, view: null, drawing: opened });
    const unread = SPAN.filter((one) => typeof content[one] === "number" && content[one] !== opened[one]);
    announceOpened(name, unread, content.notes);
  }

  /** That of the service; beside a table of benches that of the page. */
  #default(name, csv) {
    return csv ? this.state.initial(name, "route") : DEFAULTS[name];
  }

  /** The dance in the format of `bench-dragon check`. */
  save() {
    const dance = this.questions.drawn();
    const venue = keptVenueOf(dance.drawing);
    const text = JSON.stringify({ ...this.questions.checkBody(dance), ...(venue && { venue }), ...wishesIn(this.state) }, null, 2);
    download(new Blob([text], { type: "application/json" }), "dance.json");
    announceSaved("dance.json", dance.drawing);
  }
}

/** The times of day of a FILE; the page writes when a proposed dance begins, at 0 s, as the one at time 0. */
function clocksOf({ path, start, start_clock: clock = "", begin_clock: begins = "" }) {
  const isBeginning = clock && start === 0 && path?.kind === "route";
  return isBeginning ? { start_clock: "", begin_clock: clock } : { start_clock: clock, begin_clock: begins };
}

/** The dance in a file saved by this page; null for any other file. */
async function ownDance(file) {
  if (!/\.json$/i.test(file.name)) return null;
  try {
    const content = JSON.parse(await file.text());
    return "type" in content || typeof content.venue === "string" ? null : content;
  } catch {
    return null;
  }
}
