// The mutants of one file of JavaScript, as StrykerJS makes them: node mutants.mjs FILE prints a list in JSON.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

// The package stands where npm was called, not beside this file.
const found = createRequire(`${process.cwd()}/`).resolve("@stryker-mutator/instrumenter");
const { createInstrumenter } = await import(pathToFileURL(found));
const silent = { debug() {}, info() {}, isDebugEnabled: () => false };
const parts = {};
const injector = {
  provideValue(name, value) {
    parts[name] = value;
    return injector;
  },
  injectClass: (Class) => new Class(silent, ...Class.inject.slice(1).map((name) => parts[name])),
};
const file = { name: process.argv[2], mutate: true, content: readFileSync(process.argv[2], "utf8") };
const options = { ignorers: [], excludedMutations: [], plugins: null };
const { mutants } = await createInstrumenter(injector).instrument([file], options);
console.log(JSON.stringify(mutants.map(({ location, mutatorName, replacement }) => ({ location, mutatorName, replacement }))));
