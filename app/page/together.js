/** Several dragons as texts of an address, presets of them, and what is loaded of each: its samples and its path. */

import { tableOf } from "./read_table.js";
import { drawingOf, toAddress } from "./drawing.js";
import { CONTACT, DRAGON, FIELDS } from "./fields.js";
import { paceTexts } from "./passages.js";
import { Track } from "./track.js";

/** Parts of a dance in an address: its numbers, a table of benches, passages, beats, and its path; all else is common to all dragons. */
const NUMBERS = FIELDS.map(({ name }) => name).filter((name) => !CONTACT.includes(name));
export const PARTS = [...NUMBERS, "csv", "passages", "beats", "path"];
export const LEGS = ["route", "corner", "begin", "raw", "walk", "start"];
/** What a dragon has in addition to its dance. */
export const OWN = ["name", "colour", "delay", "rotation"];
/** Time before a fold of the last instant that is shown [s]; step of a path [m], and its most samples. */
const [BEFORE_FOLD, STEP, SAMPLES] = [1e-6, 0.5, 2_000];

const escaped = (text) => text.replace(/[%!~]/g, (one) => `%${one.charCodeAt(0).toString(16)}`);
/** A dragon {name: text} as the text of an address. */
export const recordText = (record) => Object.entries(record).filter(([, text]) => text !== "").map(([name, text]) => `${name}:${escaped(String(text))}`).join("!");

/** The dragons in the text of an address, each {name: text}; what cannot be read is left out. */
export function recordsIn(text) {
  const known = [...OWN, ...PARTS, ...LEGS];
  return text.split("~").map((one) => {
    const pairs = one.split("!").map((pair) => [pair.slice(0, pair.indexOf(":")), pair.slice(pair.indexOf(":") + 1)]);
    try {
      return Object.fromEntries(pairs.filter(([name]) => known.includes(name)).map(([name, value]) => [name, decodeURIComponent(value)]));
    } catch {
      return {};
    }
  });
}

/** The drawn legs of a path as texts of an address. */
export const legsOf = (drawing) => toAddress(drawing).filter(([name]) => LEGS.includes(name)).map(([name, text]) => [name, String(text)]);

/** True for a spiral that this page cannot show: with another centre, or counter-clockwise. */
export const isForeign = ({ kind = "spiral", centre = [0, 0], clockwise = true } = {}) => kind === "spiral" && (!clockwise || centre.some(Boolean));

/** A dance of a FILE as a dragon of an address. */
export function recordOf(/** @type {any} */ { name, colour, delay, dragon = {}, path: own, head_speed: speed, ...paces }) {
  const path = { kind: "spiral", ...own };
  // A turn with clothoids has no fields of its own: it is shown as any path.
  const isCoil = path.kind === "spiral" || (path.kind === "turn" && (path.middle ?? null) === null);
  const known = { ...dragon, ...(isCoil && path), head_speed: speed };
  const numbers = NUMBERS.filter((one) => typeof known[one] === "number").map((one) => [one, String(known[one])]);
  const turned = isCoil && path.rotation ? String(Number(((path.rotation * 180) / Math.PI).toFixed(9))) : "";
  const others = { name: name ?? "", colour: colour ?? "", delay: delay ? String(delay) : "", rotation: turned, csv: tableOf(dragon), ...paceTexts(paces), path: isCoil ? path.kind : "route" };
  return Object.fromEntries([...Object.entries(others), ...numbers, ...(isCoil ? [] : legsOf(drawingOf(/** @type {any} */ ({ path }))))].filter(([, text]) => text !== ""));
}

const street = (from, to, begin) => ({ path: "route", route: `*${from}_${to}`, begin });
/** Performances to begin with: what is common, and each dragon. */
export const PRESETS = {
  spiral: [{ benches: "60", pitch: "1.1", start_turns: "8" }, { benches: "60", pitch: "1.1", start_turns: "8", rotation: "180" }],
  streets: [{ ...street("-40,0", "40,0", 16), benches: "9" }, { ...street("0,-40", "0,40", 16), benches: "9", delay: "4" }],
  parade: [
    { path: "route", route: "*-40,0_30,0_45,8_*60,16_130,16", begin: 24, benches: "12" },
    { path: "route", route: "*-75,0_30,0_45,8_*60,16_95,16", begin: 24, benches: "9", delay: "5" },
    { path: "route", route: "*-110,0_30,0_45,8_*60,16_64,16", begin: 24, benches: "9", delay: "10" },
  ],
};

/** The tracks of all dragons as that of the performance. */
export class Tracks {
  /** tracks: each {track, delay}; active: number of the chosen one */
  constructor(tracks, active) {
    this.tracks = tracks;
    this.active = active;
  }

  at(time) {
    const poses = this.tracks.map(({ track, delay }) => track.at(time - delay));
    return poses.every(Boolean) ? { ...poses[this.active], time, poses } : null;
  }

  retry() {
    for (const { track } of this.tracks) track.retry?.();
  }

  /** Those that move: a dragon that stands has only one place. */
  get #moving() {
    return this.tracks.map(({ track }) => track).filter((track) => track.hold);
  }

  get cells() {
    return this.#moving.reduce((sum, track) => sum + track.cells, 0);
  }

  get isWhole() {
    return this.#moving.every((track) => track.isWhole);
  }

  async hold() {
    for (const track of this.#moving) await track.hold();
  }

  get refusal() {
    return this.tracks.find(({ track }) => track.refusal)?.track.refusal ?? null;
  }

  set stopped(is) {
    for (const { track } of this.tracks) track.stopped = is;
  }
}

/** The samples of dragon k in the stretch of its own dance that it dances. ready(): called when some have arrived */
export async function trackOf(service, dance, k, ready) {
  const { kind, body, numbers, delay, top } = dance.parts[k];
  const report = dance.report.reports[k];
  if (!report) return { track: await standing(service, dance, k), delay };
  const last = kind === "spiral" ? report.stop - BEFORE_FOLD : report.stop;
  const ask = (chunk, times, decimals) => service.ask(`track ${k} ${chunk}`, "trajectory", { body: { ...body, times, decimals } });
  return { track: new Track(ask, [report.start, last], numbers.benches + 1, top, ready), delay };
}

/** Dragon k, which stands during the whole time: before its beginning, or after its end. */
async function standing(service, dance, k) {
  const { body, delay } = dance.parts[k];
  const { start, stop } = await service.ask(`standing ${k}`, "check", { body: { ...body, details: false, cross_check: "none" } });
  const time = dance.report.stop <= start + delay ? start : stop;
  const { x, y, speed } = await service.ask(`standing ${k}`, "trajectory", { body: { ...body, times: [time] } });
  return { at: () => ({ x: x[0], y: y[0], speed: speed[0] }), refusal: null };
}

/** The path of dragon k: {x, y} [m]; that of a spiral is the way of the head of a single bench. */
export async function wayOf(service, dance, k) {
  const { kind, body, numbers } = dance.parts[k];
  if (kind === "route") return service.ask(`way ${k}`, "course", { body });
  const { start, stop } = dance.report.reports[k] ?? { start: 0, stop: 1 };
  const [first, last] = [start - (numbers.head_length + numbers.benches * numbers.body_length) / numbers.head_speed, stop - BEFORE_FOLD];
  const times = { start: first, stop: last, step: Math.max(STEP / numbers.head_speed, (last - first) / SAMPLES) };
  const dragon = { ...Object.fromEntries(DRAGON.map((name) => [name, numbers[name]])), benches: 1 };
  const table = await service.ask(`way ${k}`, "trajectory", { body: { ...body, dragon, times, decimals: 3 } });
  return { x: table.x.map((row) => row[0]), y: table.y.map((row) => row[0]) };
}
