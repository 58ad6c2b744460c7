/** What the page asks the service, and when: first contact and the pose at once, the rest when the hand rests. */

import { Problem, Superseded } from "./api.js";
import { DRAGON } from "./state.js";
import { Track } from "./track.js";

/** A hand rests when nothing changed for so long [ms]. */
const REST = 250;
const CLEARANCE_SAMPLES = 400;
/** Instants looked at for the highest speed, and how many numbers they may be. */
const [OVERVIEW_INSTANTS, OVERVIEW_CELLS] = [101, 60_000];
/** The end of a run is a fold, where the chain is about to break: shown is the instant this long before [s]. */
const BEFORE_END = 1e-6;
/** The path is sampled every so many metres, or in so many samples when it is long. */
const [PATH_STEP, PATH_SAMPLES] = [0.3, 6_000];

/** Of a turn, which has coils without end, so much of the head's way before and after its beginning is danced [m]. */
const TURN_TRAVEL = 100;

const MOTION = [...DRAGON, "pitch", "start_turns", "head_speed"];
const LIMITS = [...DRAGON, "turning_diameter", "start_turns", "margin"];

/** The last instant that is shown: first contact, or as far as nothing touches. */
function lastInstant({ time, time_bracket, end }) {
  return time ?? (end ? end.time - BEFORE_END : time_bracket[0]);
}

const numbersOf = (texts) => Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, Number(text)]));

/** Events: each answer by its kind, `refused` when a channel's refusal came or went; errors: name -> words. */
export class Questions extends EventTarget {
  dance = null;
  answers = {};
  refusals = new Map();
  #rest = 0;
  #asked = new Map();

  constructor(service, state) {
    super();
    Object.assign(this, { service, state });
  }

  /** Everything that depends on the numbers of the state. */
  async refresh() {
    clearTimeout(this.#rest);
    this.#rest = setTimeout(() => this.#atRest(), REST);
    const kind = this.state.get("path");
    const query = this.state.texts([...MOTION, "margin"]);
    const circle = kind === "turn" ? this.state.texts(["turning_diameter"]) : {};
    if (!this.#isNew("contact", { kind, ...query, ...circle })) return;
    const asked = { kind, query, numbers: numbersOf({ ...query, ...circle }) };
    if (kind === "turn") {
      const body = this.checkBody(asked);
      const report = await this.#answer("contact", "check", { body });
      if (report) this.#accept({ ...report.first_contact, end: null }, asked, [report.start, report.stop], report.highest_speed);
    } else {
      const answer = await this.#answer("contact", "collision-time", { query });
      if (answer) this.#accept(answer, asked, [0, lastInstant(answer)]);
    }
  }

  /** Body of a request about the dance that is shown, or about another one. */
  body(more, { numbers, kind } = this.dance) {
    const dragon = Object.fromEntries(DRAGON.map((name) => [name, numbers[name]]));
    const path = { kind, pitch: numbers.pitch, start_turns: numbers.start_turns };
    if (kind === "turn") path.turning_diameter = numbers.turning_diameter;
    return { dragon, path, head_speed: numbers.head_speed, ...more };
  }

  /** Body of /check for a turn. */
  checkBody(asked) {
    const time = TURN_TRAVEL / asked.numbers.head_speed;
    return this.body({ margin: asked.numbers.margin, start: -time, stop: time }, asked);
  }

  /** The service's own numbers at one instant. */
  async pose(time) {
    const { dance } = this;
    const table = await this.#answer("pose", "trajectory", { body: this.body({ times: [time] }) });
    if (!table || dance !== this.dance) return;
    this.#tell("pose", { time, dance, x: table.x[0], y: table.y[0], speed: table.speed[0] });
  }

  errors() {
    const all = [...this.refusals.values()].flatMap(({ errors }) => errors);
    return new Map(all.map(({ name, pointer, detail }) => [(name ?? pointer).split("/").at(-1), detail]));
  }

  /** asked: kind, query, numbers; fastest: as /check answers, null where the page looks at samples */
  #accept(answer, asked, [begin, end], fastest = null) {
    if (this.dance?.track) this.dance.track.stopped = true;
    this.dance = { ...asked, answer, begin, end: answer.time ?? end, fastest, track: null, gap: null };
    this.#tell("dance", this.dance);
    this.#askPath();
    if (!this.#rest) this.#askDance();
  }

  /** The head's way from behind the tail to the end: one bench dances it alone. */
  async #askPath() {
    const { numbers, begin, end } = this.dance;
    // Lengths exceed chords by more than chords fall short of the arc, so this reaches behind the tail.
    const start = begin - (numbers.head_length + numbers.benches * numbers.body_length) / numbers.head_speed;
    const step = Math.max(PATH_STEP / numbers.head_speed, (end - start) / PATH_SAMPLES);
    const body = this.body({ times: { start, stop: end, step }, decimals: 4 });
    body.dragon = { ...body.dragon, benches: 1 };
    const table = await this.#answer("path", "trajectory", { body });
    if (table) this.#tell("path", { x: table.x.map((row) => row[0]), y: table.y.map((row) => row[0]) });
  }

  #atRest() {
    this.#rest = 0;
    const limits = this.state.texts(LIMITS);
    this.#askDance();
    if (this.#isNew("limits", limits)) this.#askLimits(limits);
  }

  /** One after the other: both are long, and the service computes only so many at once. */
  async #askLimits(query) {
    this.service.cancel("scan");
    if (await this.#keep("minimum", "minimum-pitch", { query })) this.#keep("scan", "pitch-scan", { query });
  }

  /** What belongs to the dance that is shown, once. */
  #askDance() {
    const { dance } = this;
    if (!dance || dance.track) return;
    this.#startTrack(dance);
    this.#askGap(dance);
    const { begin, end } = dance;
    this.#keep("clearance", "clearance", this.#clearanceOf(dance, begin, end, (end - begin) / CLEARANCE_SAMPLES || 1), dance);
    if (dance.fastest) return this.#tell("overview", (this.answers.overview = { answer: null, dance }));
    const instants = Math.min(OVERVIEW_INSTANTS, Math.max(5, Math.floor(OVERVIEW_CELLS / (dance.numbers.benches + 1))));
    const times = Array.from({ length: instants }, (_, k) => begin + ((end - begin) * k) / (instants - 1));
    this.#keep("overview", "trajectory", { body: this.body({ times, decimals: 9 }) }, dance);
  }

  /** The question of a clearance: flat on a spiral, in a body on other paths. */
  #clearanceOf({ kind, query }, start, stop, step) {
    if (kind !== "spiral") return { body: this.body({ times: { start, stop, step } }) };
    return { query: { ...Object.fromEntries(MOTION.map((name) => [name, query[name]])), start, stop, step } };
  }

  #startTrack(dance) {
    const ask = (chunk, times, decimals) => this.service.ask(`track ${chunk}`, "trajectory", { body: this.body({ times, decimals }) });
    const ready = () => dance === this.dance && this.#tell("track", dance);
    dance.track = new Track(ask, [dance.begin, dance.end], dance.numbers.benches + 1, dance.numbers.head_speed, ready);
    this.#tell("track", dance);
  }

  /** The gap of the two benches at first contact. */
  async #askGap(dance) {
    if (dance.answer.time === null) return;
    const table = await this.#answer("gap", "clearance", this.#clearanceOf(dance, dance.end, dance.end, 1));
    if (!table) return;
    dance.gap = table.clearance[0];
    this.#tell("gap", dance);
  }

  /** Whether an answer came; it is kept, to be shown again in another language. */
  async #keep(kind, path, question, dance = null) {
    const answer = await this.#answer(kind, path, question);
    if (!answer) return false;
    this.answers[kind] = { answer, dance, query: question.query };
    this.#tell(kind, this.answers[kind]);
    return true;
  }

  #isNew(kind, query) {
    const key = JSON.stringify(query);
    if (this.#asked.get(kind) === key) return false;
    this.#asked.set(kind, key);
    return true;
  }

  /** The answer, or undefined when it was refused or superseded. */
  async #answer(channel, path, question) {
    try {
      const answer = await this.service.ask(channel, path, question);
      if (this.refusals.delete(channel)) this.#tell("refused", channel);
      return answer;
    } catch (error) {
      if (error instanceof Superseded) return undefined;
      if (!(error instanceof Problem)) throw error;
      this.refusals.set(channel, error);
      this.#tell("refused", channel);
      return undefined;
    }
  }

  #tell(type, detail) {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}
