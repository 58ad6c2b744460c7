/** Passages in addition to the head speed, and times of day. */

import { numberIn } from "./elements.js";

const DAY = 86_400;
const [HOUR, MINUTE] = [3_600, 60];
const CLOCK = /^([01]\d|2[0-3]):[0-5]\d(:[0-5]\d)?$/;
/** End of a passage: a place [m] or a time [s]. */
export const ENDS = { m: "until_s", s: "until_time" };

/** Passages of an address, such as 0.5@20m_0@100s, in the service's format; the service refuses wrong numbers. */
export function passagesIn(text) {
  return text.split("_").filter(Boolean).map((one) => {
    const [, speed, until, unit] = /^(.*?)@(.*?)([ms]?)$/.exec(one) ?? [null, one, "", ""];
    return { speed: numberIn(speed), [ENDS[unit] ?? ENDS.s]: numberIn(until) };
  });
}

/** Passages as the text of an address. */
export const passagesText = (passages) =>
  passages.map(({ speed, until_s: place, until_time: time }) => `${speed}@${place ?? time}${place === undefined || place === null ? "s" : "m"}`).join("_");

/** The passages of the dance made faster by a factor. */
export const quickened = (passages, factor) =>
  passages.map(({ speed, until_time: time, ...place }) => ({ speed: speed * factor, ...place, ...(time !== undefined && { until_time: time / factor }) }));

/** A typed time of day, such as 19:30, 7:30 or 19:30:15, in the service's format; null if it is none. */
export function clockIn(text) {
  const typed = text.trim().replaceAll("：", ":");
  const full = /^\d:/.test(typed) ? `0${typed}` : typed;
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
  for (const { speed, until_s: place, until_time: until } of passages) {
    const { time, gone } = Object.assign(begins.at(-1), { speed });
    const stop = until ?? time + (place - gone) / speed;
    begins.push({ time: stop, gone: place ?? gone + speed * (stop - time) });
  }
  Object.assign(begins.at(-1), { speed: after });
  return begins;
}

/** Seconds from one time of day to the next occurrence of another, or back to one less than half a day before. */
export function secondsBetween(from, to) {
  const [start, end] = [from, to].map((clock) => clock.split(":").reduce((sum, part, k) => sum + Number(part) * [HOUR, MINUTE, 1][k], 0));
  return ((end - start + 1.5 * DAY) % DAY) - DAY / 2;
}

/** The time of day at a time of the dance [s], down to the whole second; clock: that at time 0, such as 19:30 */
export function timeOfDay(time, clock) {
  const [hours, minutes, seconds = 0] = clock.split(":").map(Number);
  const now = (((Math.floor(HOUR * hours + MINUTE * minutes + seconds + time) % DAY) + DAY) % DAY);
  return [now / HOUR, (now / MINUTE) % MINUTE, now % MINUTE].map((part) => String(Math.floor(part)).padStart(2, "0")).join(":");
}
