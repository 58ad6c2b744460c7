/** The words of the page: each in both languages, and each with the part of the page that needs it. */

import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { test } from "node:test";

const PAGE = new URL("../../../app/page/", import.meta.url);
const read = (name) => readFileSync(new URL(name, PAGE), "utf8");
const scripts = readdirSync(PAGE).filter((name) => name.endsWith(".js"));
const PARTS = ["answers", "below", "carrier", "columns", "dance", "dragons", "more", "route", "square"];
const words = Object.fromEntries(await Promise.all(PARTS.map(async (part) => [part, Object.assign({}, ...Object.values(await import(new URL(`words/${part}.js`, PAGE))))])));
// The names of columns have a prefix when they are learnt.
words.columns = Object.fromEntries(Object.entries(words.columns).map(([key, both]) => [`column_${key}`, both]));
const all = Object.values(words).flatMap(Object.entries);
/** Names of programs. */
const NAMES = ["shapely"];
/** Keys of words in a script. */
const used = (text) => [...text.matchAll(/(?:\bsay(?:Of)?|\btitleOf|\btextButton)\("([\w-]+)"|"data-(?:text|label)": "([\w-]+)"/g)].map(([, a, b]) => a ?? b);
const gaps = (text) => [...new Set(text.match(/\{\w+\}/g))].toSorted();

test("every word is there in both languages, once, with the same gaps", () => {
  assert.ok(all.length > 400, `${all.length} words`);
  assert.equal(new Set(all.map(([key]) => key)).size, all.length);
  for (const [key, both] of all) {
    assert.equal(both.length, 2, key);
    assert.ok(both.every(Boolean), key);
    assert.deepEqual(gaps(both[0]), gaps(both[1]), key);
  }
});

test("English is written in Latin letters and Chinese in Chinese ones", () => {
  for (const [key, [english, chinese]] of all) {
    assert.doesNotMatch(english.replaceAll("中文", ""), /[\u4e00-\u9fff]/, key);
    if (!NAMES.includes(key) && /[a-z]{4}/.test(english.replaceAll(/\{\w+\}/g, ""))) assert.match(chinese, /[\u4e00-\u9fff]/, key);
  }
});

test("a button that shows words or a number has a name with them, so that a voice finds it", () => {
  const buttons = [...read("index.html").matchAll(/<button[^>]*data-label="(\w+)"[^>]*>([^<]+)</g)].filter(([, , text]) => /[\p{L}\p{N}]/u.test(text));
  assert.ok(buttons.length > 1);
  for (const [, key, text] of buttons) for (const name of Object.fromEntries(all)[key]) assert.ok(name.includes(text), `${text}: ${name}`);
});

test("every key that a script or the page uses has its words in some part", () => {
  const known = new Set(all.map(([key]) => key));
  const labels = [...read("index.html").matchAll(/data-(?:text|label)="(\w+)"/g)].map(([, key]) => key);
  assert.ok(labels.length > 100);
  const keys = [...labels, ...scripts.flatMap((name) => used(read(name)))];
  assert.deepEqual(keys.filter((key) => !known.has(key)), []);
});

test("the words of the first view come with it", () => {
  const found = new Set();
  const follow = (url) => {
    if (found.has(url)) return;
    found.add(url);
    for (const [, name] of readFileSync(new URL(url), "utf8").matchAll(/(?:from|import) "(\.{1,2}\/[\w./-]+\.js)"/g)) follow(new URL(name, url).href);
  };
  follow(new URL("main.js", PAGE).href);
  const first = [...found].map((url) => url.slice(PAGE.href.length));
  const known = new Set(first.filter((name) => name.startsWith("words/")).flatMap((name) => Object.keys(words[name.slice(6, -3)])));
  const keys = new Set(first.filter((name) => !name.includes("/")).flatMap((name) => used(read(name))));
  assert.ok(keys.size > 100);
  assert.deepEqual([...keys].filter((key) => !known.has(key)), []);
});

test("the page of how it works has its words in both languages too", async () => {
  const rooms = Object.values(await import(new URL("how/words.js", PAGE))).filter((one) => typeof one === "object");
  const texts = rooms.flatMap(Object.entries).filter(([, both]) => Array.isArray(both));
  assert.ok(texts.length > 30, `${texts.length} words`);
  for (const [key, [english, chinese]] of texts) {
    assert.ok(english && chinese, key);
    assert.deepEqual(gaps(english), gaps(chinese), key);
  }
});
