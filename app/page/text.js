/** Texts of the page: its words in the chosen language, and the service's refusals. */

import { $$ } from "./elements.js";

/** Language -> English template -> its text; English needs none. */
const CATALOGUES = {};
/** The parts of catalogues that are needed so far: first, more or how. */
const PARTS = new Set();
/** Address of a part of a catalogue -> the Promise of it. */
const loads = new Map();

let spoken = "en";
/** Names of the benches, such as households, head first; empty for benches without a name. */
let households = [];

/** Codes of the languages, each of which has a button. */
export const languages = () => $$("[data-lang]").map(({ dataset }) => dataset.lang);

/** The language of a choice, or else the one that the browser prefers, or else English. */
export const languageOf = (choice) => [choice, navigator.language.toLowerCase().split("-")[0]].find((one) => languages().includes(one)) ?? "en";

/** Take texts of a language by their English templates. */
export const teach = (lang, texts) => (CATALOGUES[lang] = { ...CATALOGUES[lang], ...texts });

/**
 * The texts of a language, for this part of the page and those before it; null if they are here.
 * @param {Service} service
 */
export function learn(service, lang, part) {
  PARTS.add(part);
  // English stands in the scripts, but for the labels of columns.
  const names = [...PARTS].filter((one) => lang !== "en" || one === "columns").map((one) => `words/${lang}-${one}.json`);
  const missing = names.filter((name) => loads.get(name) !== null);
  for (const name of missing)
    if (!loads.has(name)) loads.set(name, service.ask(name, new URL(`./${name}`, import.meta.url).href).then((texts) => teach(lang, texts) && loads.set(name, null)));
  return missing.length ? Promise.all(missing.map((name) => loads.get(name))) : null;
}

/** Set the language, whose texts are here. */
export function setLanguage(lang) {
  spoken = lang;
  document.documentElement.lang = $$(`[data-lang=${lang}]`)[0]?.lang ?? lang;
  document.title = say("Bench Dragon");
  writeTexts();
}

/** Attribute -> element -> the text that was written, which others may have replaced since. */
const WRITTEN = { text: new WeakMap(), label: new WeakMap() };

/** Write the text or the label of every marked element that has not yet that text. The English one stands in the mark, or before the first time in the element. */
export function writeTexts() {
  for (const element of $$("[data-text='']")) element.dataset.text = element.textContent;
  const due = (name) => $$(`[data-${name}]`).filter((element) => {
    const words = say(element.dataset[name]);
    if (WRITTEN[name].get(element) === words) return false;
    WRITTEN[name].set(element, words);
    return true;
  });
  for (const element of due("text")) element.textContent = say(element.dataset.text);
  for (const element of due("label")) {
    element.setAttribute("aria-label", say(element.dataset.label));
    if (element.tagName === "BUTTON") element.title = say(element.dataset.label);
  }
}

/** The language of the page for the service, such as en. */
export const language = () => spoken;

/** A sentence, or a part of one, from its English template, with {names} replaced. */
export const say = (template, values = {}) => sayIn(spoken, template, values);

/** The same in a language whose texts are here. */
export const sayIn = (lang, template, values = {}) => filled(CATALOGUES[lang]?.[template] ?? template, values);

/** The same for a template that other languages put in several ways. meaning: the one that is meant */
export const sense = (meaning, template, values = {}) => filled(CATALOGUES[spoken]?.[`${meaning}\u0004${template}`] ?? template, values);

/** A template that is said elsewhere: so marked it comes into the catalogues. */
export const phrase = (template) => template;

/** What stands between the names of a list. */
export const between = () => sense("names", ", ");

function filled(text, values) {
  return text.replace(/\{(\w+)\}/g, (whole, name) => (name in values ? values[name] : whole));
}

/** Sentences one after the other, as the language writes them. */
export const sentencesOf = (sentences) => sentences.filter(Boolean).reduce((first, second) => (first ? say("{first} {second}", { first, second }) : second), "");

export const nameBenches = (names) => (households = names);
const withHousehold = (words, k) => (households[k] ? say("{words} ({name})", { words, name: households[k] }) : words);

/** Name of bench k in a sentence. */
export function benchName(k, benches) {
  return withHousehold(k === 0 ? say("the head") : k === benches - 1 ? say("the tail") : say("body {k}", { k }), k);
}

/** Name of bench k by itself, as on a card. */
export function benchTitle(k, benches) {
  return withHousehold(k === 0 ? say("head") : k === benches - 1 ? say("tail") : say("body {k}", { k }), k);
}

/** Name of handle k, after the bench that it leads. */
export function handleName(k, benches) {
  return k === benches ? say("tail (rear)") : say("{bench}", { bench: benchTitle(k, benches) });
}
