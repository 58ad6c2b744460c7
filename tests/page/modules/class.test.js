/** The teams of what was handed in, and the table of a class. */

import assert from "node:assert/strict";
import { test } from "node:test";

const element = () => ({ addEventListener() {}, after() {}, append() {}, setAttribute() {}, replaceChildren(...inside) { this.inside = inside; } });
globalThis.document = { createElement: element, documentElement: { dataset: {} }, querySelector: element, querySelectorAll: () => [], body: element() };
globalThis.addEventListener = () => {};
globalThis.ResizeObserver = class {
  observe() {}
};
const { ClassTable, handedIn, rowOf } = await import("../../../app/page/class.js");
const { Problem, Superseded } = await import("../../../app/page/api.js");

/** An archive of these entries, {name: content}, in a list that states so many. longest: whether the last name is said to go past the end */
function zipped(entries, { count = Object.keys(entries).length, longest = false } = {}) {
  const [parts, list] = [[], []];
  let at = 0;
  for (const [name, content] of Object.entries(entries)) {
    const head = Buffer.alloc(30);
    const line = Buffer.alloc(46);
    line.writeUInt32LE(0x02014b50);
    line.writeUInt16LE(0x800, 8);
    line.writeUInt32LE(content.length, 20);
    for (const [buffer, place] of [[head, 26], [line, 28]]) buffer.writeUInt16LE(Buffer.byteLength(name), place);
    line.writeUInt32LE(at, 42);
    parts.push(head, Buffer.from(name), Buffer.from(content));
    list.push(line, Buffer.from(name));
    at += 30 + Buffer.byteLength(name) + content.length;
  }
  if (longest) list.at(-2).writeUInt16LE(60_000, 28);
  const end = Buffer.alloc(22);
  end.writeUInt32LE(0x06054b50);
  end.writeUInt16LE(count, 10);
  end.writeUInt32LE(at, 16);
  return Buffer.concat([...parts, ...list, end]);
}

/** Teams of the chosen archives, {name: bytes}, each with the names of its files; in brackets those without a file. */
async function teamsOf(archives) {
  const found = await handedIn(Object.entries(archives).map(([path, bytes]) => ({ path, file: new File([bytes], path) })));
  const of = Map.groupBy(found, ({ team }) => team);
  return Object.fromEntries([...of].map(([team, files]) => [team, files.map(({ name, file }) => (file ? name : `(${name})`)).join(" ")]));
}
const files = (...names) => zipped(Object.fromEntries(names.map((name) => [name, "x"])));

test("of several archives each is a team, whatever else lies in it, unless its folders are teams", async () => {
  const archives = { "A.zip": files("result1.xlsx", "result2.xlsx"), "B.zip": files("result1.xlsx", "code/main.py"), "C.zip": files("C/result1.xlsx", "C/q4/result4.xlsx"), "class.zip": files("Red/result1.xlsx", "Gold/result1.xlsx") };
  const teams = { A: "result1.xlsx result2.xlsx", B: "result1.xlsx", C: "result1.xlsx result4.xlsx", Red: "result1.xlsx", Gold: "result1.xlsx" };
  assert.deepEqual(await teamsOf(archives), teams);
});

test("a folder of code is no team beside files, and one beside the only team that has a file is", async () => {
  assert.deepEqual(await teamsOf({ "one.zip": files("result1.xlsx", "code/main.py", "readme.md") }), { result1: "result1.xlsx" });
  const modules = Array.from({ length: 13 }, (none, k) => `Gold/node_modules/${k}.js`);
  const listed = `(${Array.from({ length: 10 }, (none, k) => `${k}.js`).join(", ")} … (+3))`;
  assert.deepEqual(await teamsOf({ "class.zip": files("Red/result1.xlsx", "Blue/Icon\r", ...modules) }), { Red: "result1.xlsx", Blue: "(Icon\\u000d)", Gold: listed });
});

test("a broken archive, one whose list cannot be read, and one of too many files cost no other team its row", async () => {
  const many = Array.from({ length: 2_100 }, (none, k) => `${k}.csv`);
  const archive = zipped({ "A.zip": zipped({ "result1.xlsx": "x" }, { longest: true }), "B.zip": zipped({}, { count: 0xffff }), "C.zip": files(...many), "D/result1.xlsx": "x", "D/plan.png": "x".repeat(99) });
  const teams = await teamsOf({ "class.zip": archive });
  assert.deepEqual([teams.A, teams.B, teams.D], ["(A.zip)", "(B.zip)", "result1.xlsx plan.png"]);
  assert.match(teams.C, /1998\.csv \(1999\.csv\)$/);
});

test("a name that the service would refuse is written as it takes it", async () => {
  const row = await rowOf({ team: "Red\n\u202e\ud800", file: new File(["x"], `${"龙".repeat(5)}${"🐉".repeat(199)}.csv`) }, { words: "🐉".repeat(1_001) });
  assert.equal(row.team, "Red\\u000a\\u202e\\ud800");
  assert.deepEqual([row.file, row.finding], [`${"🐉".repeat(196)}.csv`, "🐉".repeat(1_000)]);
});

/** A table, and its questions {body, answer(table), refuse(error)}, which wait. */
function tableThatWaits() {
  const asked = [];
  const table = new ClassTable({ ask: (channel, path, { body }) => new Promise((answer, refuse) => asked.push({ body, answer: () => answer({ heads: [], rows: [], notes: [], scheme: "" }), refuse })) }, () => {});
  return { table, asked };
}

test("a rubric that is chosen while a question waits counts for the newest rows, and nothing shown is lost", async () => {
  const { table, asked } = tableThatWaits();
  const first = table.fill([1]);
  asked[0].answer();
  await first;
  const drawn = table.box.inside;
  const rubric = { name: "hard.csv", text: "result1,7" };
  const all = [table.fill([1, 2]), table.fill([1, 2], "zh", rubric), table.fill([1, 2, 3])];
  for (const k of [1, 2]) asked[k].refuse(new Superseded());
  await all[0];
  await all[1];
  assert.deepEqual([table.box.inside, asked[3].body], [drawn, { files: [1, 2, 3], rubric: rubric.text }]);
  asked[3].answer();
  await all[2];
  const refused = table.fill([1, 2, 3, 4], "zh", { name: "bad", text: "?" });
  asked[4].refuse(new Problem(422, { sentence: "No." }));
  await new Promise(setImmediate);
  assert.deepEqual(asked[5].body, { files: [1, 2, 3, 4], rubric: rubric.text });
  asked[5].answer();
  await refused;
  assert.equal(table.size, 4);
});
