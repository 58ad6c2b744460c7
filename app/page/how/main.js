/** The page "How it works": its figures, asked one after another, in the language of the address or of the browser. */

import { Service } from "../api.js";
import { $, $$, onClick } from "../elements.js";
import { addLook } from "../look.js";
import { lost } from "../overlays.js";
import { Pause } from "../pending.js";
import { Sharing } from "../sharing.js";
import { languageOf, languages, learn, say, setLanguage } from "../text.js";
import { Figure } from "./figure.js";
import { PLANS } from "./plans.js";

const address = new URL(location.href);

const service = new Service({
  busy: () => {},
  lost(seconds) {
    lost(seconds);
    for (const figure of figures) figure.lost(say(seconds ? "The service does not answer; the figure is older than your numbers. Next try in {seconds} s." : "The service does not answer; the figure is older than your numbers. Trying again now.", { seconds }));
  },
  back() {
    $("#lost").hidden = true;
    for (const figure of figures) figure.lost("");
  },
});
const figures = Object.entries(PLANS).map(([id, plan]) => new Figure($(`#${id}`), plan, service, () => keep(id)));

/** Each number to drag with its name in the address, such as chord_turns. */
const dials = figures.flatMap(({ section, dials: own }) => Object.entries(own).map(([name, dial]) => [`${section.id}_${name}`, dial]));
const writing = new Pause("address");

/** The figure of which a person has moved a number last: the address leads to it. */
let moved = "";

/** Keep the numbers in the address after a pause: browsers refuse more than a few changes of it per second. */
function keep(id) {
  moved = id;
  if (!writing.lasts) writing.begin(300, write);
}

function write() {
  writing.end();
  for (const [name, { value, plan }] of dials) {
    if (value === plan.value) address.searchParams.delete(name);
    else address.searchParams.set(name, String(value));
  }
  const query = address.searchParams.toString();
  history.replaceState(null, "", `${location.pathname}${query && `?${query}`}${moved ? `#${moved}` : location.hash}`);
}

/** Take over the numbers of the address; what is no number there leaves the figure as it is. */
function read() {
  for (const [name, dial] of dials) {
    const text = address.searchParams.get(name)?.trim();
    if (text && Number.isFinite(Number(text))) dial.take(Number(text));
  }
}

/** The address of the dance from which this page was opened in this tab, from its ? on; empty without one. */
function cameFrom() {
  try {
    return sessionStorage.getItem("bench-dragon-dance") ?? "";
  } catch {
    return ""; // storage is forbidden here
  }
}

async function translate(choice) {
  const language = languageOf(choice);
  await learn(service, language, "how");
  setLanguage(language);
  document.title = `${say("How it works")} · ${say("Bench Dragon")}`;
  for (const button of $$("[data-lang]")) button.setAttribute("aria-pressed", button.dataset.lang === language);
  const back = new URLSearchParams(cameFrom());
  if (choice) back.set("lang", choice);
  $("#name a").href = back.size ? `.?${back}` : ".";
  for (const figure of figures) figure.translate();
}

for (const button of $$("[data-lang]")) {
  button.addEventListener("click", () => {
    const { lang } = button.dataset;
    address.searchParams.set("lang", lang);
    write();
    translate(lang);
  });
}
onClick("#lost button", () => service.retry());
addEventListener("look", () => figures.forEach((figure) => figure.draw()));
addLook();
new Sharing({ write, fits: true });
read();

const language = address.searchParams.get("lang");
await translate(languages().includes(language) ? language : undefined);
// The sections get their texts only now, so the browser could not scroll to the section in the address.
const linked = figures.find(({ section }) => `#${section.id}` === location.hash);
linked?.section.scrollIntoView();
// The visible figure comes first; one question at a time leaves the service free for a drag.
for (const figure of [...new Set([linked ?? figures[0], ...figures])]) await figure.change();
for (const figure of figures) await figure.refine();
