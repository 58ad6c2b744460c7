/** Passages in addition to the head speed, and times of day. */

import { numberIn } from "./elements.js";

const DAY = 86_400;
const [HOUR, MINUTE] = [3_600, 60];
const CLOCK = /^([01]\d|2[0-3]):[0-5]\d(:[0-5]\d)?$/;
/** End of a passage by its sign in an address: a place [m], a time [s], or its duration [s]. */
export const ENDS = { m: "until_s", s: "until_time", d: "duration" };

/** Passages of an address, such as 0.5@20m_0@100s_0@10d, in the service's format; the service refuses wrong numbers. */
export function passagesIn(text) {
  return text.split("_").filter(Boolean).map((one) => {
    const [, speed, until, unit] = /^(.*?)@(.*?)([msd]?)$/.exec(one) ?? [null, one, "", ""];
    return { speed: numberIn(speed), [ENDS[unit] ?? ENDS.s]: numberIn(until) };
  });
}

/** The end of a passage: [its sign, its value]. */
export function endOf(passage) {
  const [sign, name] = Object.entries(ENDS).find(([, one]) => (passage[one] ?? null) !== null) ?? ["s", ENDS.s];
  return [sign, passage[name]];
}

/** Passages as the text of an address. */
export const passagesText = (passages) =>
  passages.map((one) => {
    const [sign, value] = endOf(one);
    return `${one.speed}@${value}${sign}`;
  }).join("_");

/** A number as people read it, without the last digits, which are of rounding. */
const shortened = (number) => Number(number.toPrecision(12));

/** The passages of a FILE, or those that its beats of a drum give; undefined without. */
export const pacesOf = (/** @type {any} */ { passages, beats }) => passages ?? beats?.map(({ bars, tempo, step, beats: count = 4 }) => ({ speed: shortened((tempo * step) / 60), duration: shortened((60 * bars * count) / tempo) }));

/** Beats of an address, such as 16,96,0.6_4,96,0,3: bars, tempo, step and, if not 4, beats in a bar; in the service's format, null if they cannot be read. */
export function beatsIn(text) {
  const all = text.split("_").map((one) => one.split(",").map(Number));
  if (!all.every((one) => [3, 4].includes(one.length) && one.every(Number.isFinite))) return null;
  return all.map(([bars, tempo, step, beats = 4]) => ({ bars, tempo, step, beats }));
}

/** Beats as the text of an address. */
export const beatsText = (beats) => beats.map(({ bars, tempo, step, beats: count = 4 }) => [bars, tempo, step, ...(count === 4 ? [] : [count])].join()).join("_");

/** The beats of texts of an address, if its passages are those that they give; else null. */
export function beatsOf({ beats, passages }) {
  const all = beats ? beatsIn(beats) : null;
  return all && passagesText(pacesOf({ beats: all })) === passages ? all : null;
}

/** The speeds of a FILE as texts of an address: its passages, or its beats with the passages that they give. */
export const paceTexts = (content) => ({ passages: passagesText(pacesOf(content) ?? []), beats: content.passages ? "" : beatsText(content.beats ?? []) });

/** The passages of the dance made faster by a factor. */
export const quickened = (passages, factor) =>
  passages.map(({ speed, ...ends }) => ({ speed: speed * factor, ...Object.fromEntries(Object.entries(ends).map(([name, end]) => [name, name === ENDS.m ? end : Number(end) / factor])) }));

/** The passages of a dance whose head is this far and this late at its new time 0 [m], [s]; those that are over are left out. */
export function laterBy(passages, gone, time) {
  const begins = beginsOf(passages, 1);
  return passages.flatMap(({ speed, until_s: place, until_time: until, duration }, k) => {
    if (begins[k + 1].time <= time) return [];
    if (place !== undefined) return [{ speed, until_s: place - gone }];
    const end = until ?? begins[k].time + duration;
    return [duration !== undefined && begins[k].time >= time ? { speed, duration } : { speed, until_time: end - time }];
  });
}

/** A time of day as people write it: its hour, its minutes, its seconds or nothing, and am, pm or nothing. */
const TYPED = /^(\d{1,2})[:.]?(\d\d)(?:[:.](\d\d))?(?: ?([ap]m))?$/i;

/** A typed time of day, such as 19:30, 7.30, 1930, 7:30 pm or 19:30:15, in the service's format; null if it is none. */
export function clockIn(text) {
  const typed = text.trim().replaceAll("：", ":");
  const [, hour, minutes, seconds, half] = TYPED.exec(typed) ?? [];
  const hours = half ? (Number(hour) % 12) + (half.toLowerCase() === "pm" ? 12 : 0) : hour;
  const full = hour ? [String(hours).padStart(2, "0"), minutes, ...(seconds ? [seconds] : [])].join(":") : typed;
  return full === "" || CLOCK.test(full) ? full : null;
}

/** Time at which the head has travelled this far since time 0 [s]. */
export function timeAfter(distance, speed, passages) {
  const { time, gone, speed: own } = beginsOf(passages, speed).findLast(({ gone }) => gone < distance);
  return time + (distance - gone) / own;
}

/** Time [s], way of the head since time 0 [m] and speed [m/s] where each passage begins, and what comes after them. */
export function beginsOf(passages, after) {
  const begins = [{ time: 0, gone: 0 }];
  for (const { speed, until_s: place, until_time: until, duration } of passages) {
    const { time, gone } = Object.assign(begins.at(-1), { speed });
    const stop = until ?? (duration === undefined ? time + (place - gone) / speed : time + duration);
    begins.push({ time: stop, gone: place ?? gone + speed * (stop - time) });
  }
  Object.assign(begins.at(-1), { speed: after });
  return begins;
}

/** Way of the head at a time since time 0 [m]. */
export function wayAt(time, speed, passages) {
  const { time: begun, gone, speed: own } = beginsOf(passages, speed).findLast((one) => one.time <= time) ?? { time: 0, gone: 0, speed };
  return gone + own * (time - begun);
}

/** The time of day at time 0 of a dance that begins at `begin` [s]; extras: {clock: then, or beginClock: when it begins}; null without one */
export function clockAtZero({ clock, beginClock }, begin) {
  if (!beginClock) return clock || null;
  const [hours, minutes, seconds = 0] = beginClock.split(":").map(Number);
  const now = Number(((((HOUR * hours + MINUTE * minutes + seconds - begin) % DAY) + DAY) % DAY).toFixed(6)) % DAY;
  const rest = now % MINUTE;
  return [Math.floor(now / HOUR), Math.floor((now / MINUTE) % MINUTE)].map((part) => String(part).padStart(2, "0")).join(":") + `:${rest < 10 ? "0" : ""}${Number(rest.toFixed(6))}`;
}

/** Seconds from one time of day to the next occurrence of another, or back to one less than half a day before. */
export function secondsBetween(from, to) {
  const [start, end] = [from, to].map((clock) => clock.split(":").reduce((sum, part, k) => sum + Number(part) * [HOUR, MINUTE, 1][k], 0));
  return ((end - start + 1.5 * DAY) % DAY) - DAY / 2;
}

/** The time of day at a time of the dance [s], down to the whole second; clock: that at time 0, such as 19:30 */
export function timeOfDay(time, clock) {
  const [hours, minutes, seconds = 0] = clock.split(":").map(Number);
  const now = (((Math.floor(Number((HOUR * hours + MINUTE * minutes + seconds + time).toFixed(6))) % DAY) + DAY) % DAY);
  return [now / HOUR, (now / MINUTE) % MINUTE, now % MINUTE].map((part) => String(Math.floor(part)).padStart(2, "0")).join(":");
}
