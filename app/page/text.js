/** Texts of the page: its words in the chosen language, and the service's refusals. */

import { $$ } from "./elements.js";
import { strayOf } from "./fields.js";
import { ANSWERS } from "./words/answers.js";
import { DANCE } from "./words/dance.js";
import { MORE } from "./words/more.js";

/** Every word of the page in English and in Simplified Chinese, with the terms of the contest; later parts bring their own. */
const WORDS = { ...DANCE, ...ANSWERS, ...MORE };
/** Take the words of a part that has loaded. */
export const learn = (words) => Object.assign(WORDS, words);

let column = 0;
/** Names of the benches, such as households, head first; empty for benches without a name. */
let households = [];

/** Set the language to the choice, en or zh, or to the browser's preference. */
export function setLanguage(choice) {
  const language = choice ?? (navigator.language.toLowerCase().startsWith("zh") ? "zh" : "en");
  column = language === "zh" ? 1 : 0;
  document.documentElement.lang = language === "zh" ? "zh-Hans" : "en";
  document.title = say("title");
  writeTexts();
  return language;
}

/** Attribute -> element -> the text that was written, which others may have replaced since. */
const WRITTEN = { text: new WeakMap(), label: new WeakMap() };

/** Write the text or the label of every element that has a key and not yet that text; those of a part that has not loaded stay as the service wrote them. */
export function writeTexts() {
  const due = (name) => $$(`[data-${name}]`).filter((element) => {
    const key = element.dataset[name];
    if (!(key in WORDS) || WRITTEN[name].get(element) === say(key)) return false;
    WRITTEN[name].set(element, say(key));
    return true;
  });
  for (const element of due("text")) element.textContent = say(element.dataset.text);
  for (const element of due("label")) {
    element.setAttribute("aria-label", say(element.dataset.label));
    if (element.tagName === "BUTTON") element.title = say(element.dataset.label);
  }
}

/** The language of the page for the service: en or zh. */
export const language = () => document.documentElement.lang.slice(0, 2);

/** The text of this key, with {names} replaced. */
export const say = (key, values = {}) => filled(WORDS[key][column], values);

/** The same in a language: en or zh. */
export const sayIn = (lang, key, values = {}) => filled(WORDS[key][lang === "zh" ? 1 : 0], values);

function filled(text, values) {
  return text.replace(/\{(\w+)\}/g, (_, name) => values[name]);
}

/** Sentences one after the other, as the language writes them. */
export const sentencesOf = (sentences) => sentences.filter(Boolean).reduce((first, second) => (first ? say("sentences", { first, second }) : second), "");

/**
 * The text of this key for a question: with a margin benches in contact may be apart, and with a stray they only may
 * touch. {touch} and {meet} in a text are the words for a contact. request: {margin, stray, hole, pin}, [m]
 * @param {any} request
 */
export function sayOf(key, request, values = {}) {
  const [near, strays] = [Number(request.margin) > 0, strayOf(request) > 0];
  const form = (name) => [strays && `${name}Stray`, near && `${name}Near`].find((one) => one in WORDS) ?? name;
  const { margin } = request;
  const touch = say(near ? "touchNear" : "touch", { margin });
  return say(form(key), { margin, touch, meet: say(form("meet"), { margin, touch }), ...values });
}

/** A title with the stray of the answer. */
export function titleOf(key, request) {
  const [title, stray] = [sayOf(key, request), strayOf(request)];
  return stray > 0 ? say(request.hole > 0 ? "withinPlay" : "within", { title, stray: Number((100 * stray).toPrecision(9)) }) : title;
}

/** Name of a value in the table of a sweep: the words of its parts, of which numbers count from 1; others stay. */
export function columnName(name) {
  const parts = name.split(".");
  const words = parts.map((part) => (/^\d+$/.test(part) ? String(Number(part) + 1) : `column_${part}` in WORDS ? say(`column_${part}`) : part));
  return words.join(" · ");
}

/** The function of refusals.js; null until it has loaded. */
let refusalIn = null;
export const learnRefusals = (module) => (refusalIn = module.refusalIn);

/** A refusal of the service in the language of the page: the properties of an element. problem: a problem or one of its errors */
export function refusalWords(problem) {
  const one = problem.errors?.[0] ?? problem;
  return refusalIn ? refusalIn(one, column === 1, say) : { textContent: one.detail, lang: "en" };
}

export const nameBenches = (names) => (households = names);
const withHousehold = (words, k) => (households[k] ? say("named", { words, name: households[k] }) : words);

/** Name of bench k in a sentence. */
export function benchName(k, benches) {
  return withHousehold(k === 0 ? say("theHead") : k === benches - 1 ? say("theTail") : say("body", { k }), k);
}

/** Name of bench k by itself, as on a card. */
export function benchTitle(k, benches) {
  return withHousehold(k === 0 ? say("head") : k === benches - 1 ? say("tail") : say("body", { k }), k);
}

/** Name of handle k, after the bench that it leads. */
export function handleName(k, benches) {
  return k === benches ? say("tailRear") : say("frontHandle", { bench: benchTitle(k, benches) });
}
