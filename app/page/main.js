/** The page: a person's actions change the state, and the service's answers change the screen. */

import * as answers from "./answers.js";
import { Problem, Service } from "./api.js";
import { Controls } from "./controls.js";
import { Dance, speedRange } from "./dance.js";
import { $, $$, onClick } from "./elements.js";
import { Graphs } from "./graphs.js";
import { Jobs } from "./jobs.js";
import { Grader } from "./grade.js";
import { Keep } from "./keep.js";
import { Player } from "./player.js";
import { Questions } from "./questions.js";
import { SweepMap } from "./map.js";
import { CONTACT, FIELDS, State, strayOf } from "./state.js";
import { QUESTIONS, SweepForm } from "./sweeps.js";
import { Table } from "./table.js";
import { handleName, say, setLanguage } from "./text.js";

const NUMBERS = [...FIELDS.map((field) => field.name), "path"];
/** The boxes that wait for each kind of answer. */
const BUSY = {
  contact: ["#first-contact", "#run-end"],
  pose: ["#stage"],
  minimum: ["#minimum-pitch"],
  tolerance: ["#tolerance"],
  shortest: ["#shortest-turn"],
  fastest: ["#highest-speed"],
  clearance: ["#clearance"],
  curve: ["#curve"],
  scan: ["#scan"],
  grade: ["#grade"],
};
/** Titles of the boxes that show a refusal. */
const TITLES = { contact: "firstContact", minimum: "minimumPitch", tolerance: "tolerance", shortest: "shortestTurn", fastest: "highest" };
const ZOOM = 1.5;
/** On a run that ends in a fold, a handle this many times faster than the head shows that the fold is near [1]. */
const FAST = 2;

const state = new State();
const service = new Service({
  busy(channel, busy) {
    for (const box of BUSY[channel] ?? []) $(box).setAttribute("aria-busy", busy);
  },
  lost(seconds) {
    $("#lost").hidden = false;
    $("#lost span").textContent = say("lost", { seconds });
  },
  back() {
    $("#lost").hidden = true;
    announce(say("back"));
  },
});
const questions = new Questions(service, state, (kind, detail) => (SHOW[kind] ?? TELL[kind])(detail));
const dance = new Dance($("#canvas"), $("#inset canvas"), {
  moved(panned) {
    const { x, y, scale } = dance.view;
    state.set({ view: [x, y, scale], follow: state.get("follow") && !panned });
    draw();
  },
  picked: (handle) => state.set({ handle }),
});
const player = new Player(state, questions, showPose, showTable);
const controls = new Controls($("#controls"), state);
const table = new Table($("#rows"), { choose, chosen: (handle) => state.set({ handle }) });
const graphs = new Graphs(state, questions, (time) => player.seek(time));
const keep = new Keep(state, service, questions, $("#canvas"), announce);
const map = new SweepMap($("#map"), openDesign);
const jobs = new Jobs($("#jobs"), service, showMap, announce);
new SweepForm($("#sweep"), state, (spec) => jobs.start(spec));
let swept = null;
const grader = new Grader(service);
let limits = {};
let drawing = 0;

function announce(words) {
  $("#status").textContent = words;
}

function draw() {
  drawing ||= requestAnimationFrame(() => {
    drawing = 0;
    const { pose } = dance.scene;
    if (state.get("follow") && pose) dance.view.set(pose.x[0], pose.y[0]);
    dance.draw();
  });
}

/** Move the choice by a number of handles. */
function choose(step) {
  const last = (dance.scene.pose?.x.length ?? 1) - 1;
  state.set({ handle: Math.min(Math.max((state.get("handle") ?? -Math.sign(step)) + step, 0), last) });
}

/** Show a pose: interpolated while the dance moves, or the service's own (it has `dance`) for the table and at rest. */
function showPose(pose) {
  const { answer, end, kind, numbers } = questions.dance;
  const contact = answer.benches && pose.time === end ? answer : null;
  // Inner and outer refer to the centre of a spiral, which other paths do not have.
  const drawn = contact && kind !== "spiral" ? { ...contact, edge: null } : contact;
  Object.assign(dance.scene, { pose, dragon: numbers, contact: drawn });
  $("#halo").hidden = !(strayOf(numbers) > 0);
  $("#inset").hidden = !contact?.point;
  const { answer: touching, dance: of } = questions.answers.gap ?? {};
  const gap = of === questions.dance ? touching.clearance[0] : null;
  if (contact) $("#inset figcaption").textContent = answers.insetWords(contact, gap, numbers);
  const [low, high] = speedRange(pose);
  const [least, largest] = $$("#legend span");
  least.textContent = low === null ? say("allEqual") : low.toFixed(6);
  const speed = high.toFixed(6);
  largest.textContent = nearFold(pose) ? say("legendFold", { speed }) : `${speed} m/s`;
  showHandle();
  if (pose.dance) showTable(pose);
  showTime();
  draw();
}

/** Name of the chosen handle, or an empty text. */
function showHandle() {
  const handle = state.get("handle");
  const name = handle !== null && questions.dance ? handleName(handle, questions.dance.numbers.benches) : "";
  Object.assign(dance.scene, { handle, headName: say("head"), handleName: name });
  table.select(handle);
  return name;
}

/** Time of the fold [s] if the dance ends in one and speeds already grow without bound towards it; else null. */
function nearFold(pose) {
  const { answer, numbers } = questions.dance;
  const folds = answer.outcome === "clear" && answer.end?.reason === "fold";
  return folds && speedRange(pose)[1] > FAST * numbers.head_speed ? answer.end.time : null;
}

function showTable(pose) {
  table.show(pose);
  const fold = nearFold(pose);
  const last = fold !== null && pose.time === questions.dance.end;
  $("#table-time").textContent = say(last ? "tableAtFold" : "tableAt", { time: (last ? fold : pose.time).toFixed(6) });
  $("#table-fold").hidden = fold === null;
  $("#table-fold").textContent = fold === null ? "" : say("nearFold", { time: fold.toFixed(6) });
}

function showTime() {
  const { time } = player;
  const text = `${time.toFixed(2)} s`;
  $("#time").value = time;
  $("#time").setAttribute("aria-valuetext", text);
  $("#clock").textContent = text;
  graphs.time(time);
}

/** How each kind of answer changes the screen; called again after a change of language. */
const SHOW = {
  dance() {
    const { answer, numbers, begin, end } = questions.dance;
    Object.assign($("#time"), { min: begin, max: end });
    answers.showFirstContact($("#first-contact"), answer, numbers);
    answers.showEnd($("#run-end"), answer, end, numbers);
    graphs.pitch();
    keep.show();
    player.update();
  },
  minimum() {
    const { answer, query } = questions.answers.minimum;
    answers.showMinimumPitch($("#minimum-pitch"), answer, query, (pitch) => state.set({ pitch: String(pitch) }));
    graphs.curve();
  },
  tolerance() {
    const { answer, query, body } = questions.answers.tolerance;
    answers.showTolerance($("#tolerance"), answer, Number(query?.benches ?? body.dragon.benches), query?.turning_diameter);
    graphs.curve();
  },
  curve: () => graphs.curve(),
  scan: () => graphs.scan(),
  shortest() {
    const { answer, query } = questions.answers.shortest;
    answers.showShortestTurn($("#shortest-turn"), answer, query);
  },
  fastest() {
    const { answer, dance: of } = questions.answers.fastest;
    answers.showHighestSpeed($("#highest-speed"), answer.highest_speed, of.numbers);
    if (of !== questions.dance) return;
    // At rest the engines check the whole dragon; while a slider is dragged, only the pair.
    const { cross_check } = answer.first_contact;
    answers.showFirstContact($("#first-contact"), { ...of.answer, cross_check }, of.numbers);
  },
  clearance() {
    graphs.clearance();
    showTime();
  },
};

/** Other events. */
const TELL = {
  pose: (pose) => player.exact(pose),
  track: () => player.update(false),
  gap: () => dance.scene.pose && showPose(dance.scene.pose),
  path(points) {
    dance.setPath(points);
    draw();
  },
  refused() {
    const { refusals } = questions;
    controls.refuse(questions.errors());
    $("main").classList.toggle("stale", refusals.has("contact"));
    // Without a dance there are no further questions.
    if (refusals.has("contact") && !questions.dance) for (const box of $$("[aria-busy=true]")) box.setAttribute("aria-busy", false);
    for (const [kind, { message }] of refusals) {
      if (kind in TITLES) answers.showRefusal($(BUSY[kind][0]), TITLES[kind], message);
      graphs.refuse(kind, message);
    }
  },
};

/** How each part of the state is shown; lang comes first because all texts depend on it. */
const SHOW_STATE = {
  lang: translate,
  follow: (follow) => $("#follow").setAttribute("aria-pressed", follow),
  rate: (rate) => ($("#rate").value = rate),
  handle: () => announce(showHandle()),
  view: (view) => (view ? dance.view.set(...view) : (dance.view.fitted = true)),
  turning_diameter: (diameter) => (dance.scene.circle = Number(diameter) / 2),
  path(path) {
    press("path", path);
    $("#shortest-turn").hidden = path !== "turn";
  },
  time() {
    showTime();
    player.update();
  },
};

function showState(changed) {
  for (const [name, show] of Object.entries(SHOW_STATE)) if (changed.has(name)) show(state.get(name));
  if (CONTACT.some((name) => changed.has(name))) graphs.help();
  if (NUMBERS.some((name) => changed.has(name))) questions.refresh();
  draw();
}

/** Show the map of a sweep. spec: null if another browser asked for it */
function showMap(columns, spec) {
  swept = spec ?? null;
  map.show(columns, QUESTIONS[spec?.question]?.value, `value_${spec?.question}`);
}

/** Show the dance of one design. over: its parameters; row: all columns of it */
function openDesign(over, row) {
  const { path, value } = QUESTIONS[swept?.question] ?? { path: "spiral" };
  const answered = value === "pitch" && row.pitch !== null ? { pitch: row.pitch } : {};
  const known = Object.entries({ ...swept?.request, ...over, ...answered }).filter(([name]) => NUMBERS.includes(name));
  state.set({ path, time: null, view: null, ...Object.fromEntries(known.map(([name, number]) => [name, String(number)])) });
  $("#canvas").scrollIntoView({ block: "nearest" });
}

/** Mark the button of this value as pressed, among buttons that choose between values. */
function press(name, value) {
  for (const button of $$(`[data-${name}]`)) button.setAttribute("aria-pressed", button.dataset[name] === value);
}

function translate() {
  const language = setLanguage(state.get("lang"));
  press("lang", language);
  grader.translate(language);
  graphs.help();
  controls.translate(limits);
  player.translate();
  jobs.render();
  map.draw();
  for (const [kind, show] of Object.entries(SHOW)) if (kind === "dance" ? questions.dance : questions.answers[kind]) show();
  if (dance.scene.pose) showPose(dance.scene.pose);
  TELL.refused();
}

function listen() {
  state.listen(showState);
  onClick("#lost button", () => service.retry());
  for (const button of $$("[data-lang]")) button.addEventListener("click", () => state.set({ lang: button.dataset.lang }));
  for (const button of $$("[data-path]")) button.addEventListener("click", () => state.choosePath(button.dataset.path));
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", restyle);
  new ResizeObserver(draw).observe($("#stage"));
  const all = () => {
    dance.view.fitted = true;
    state.set({ view: null, follow: false });
    draw();
  };
  const follow = () => state.set({ follow: !state.get("follow") });
  onClick("#zoom-in", () => dance.view.zoom(ZOOM));
  onClick("#zoom-out", () => dance.view.zoom(1 / ZOOM));
  onClick("#show-all", all);
  onClick("#follow", follow);
  const keys = {
    0: all,
    f: follow,
    F: follow,
    "[": () => choose(-1),
    "]": () => choose(1),
    " ": () => player.toggle(),
    Escape: () => state.set({ handle: null }),
  };
  $("#canvas").addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (dance.view.key(event.key)) event.preventDefault();
    else if (keys[event.key]) {
      event.preventDefault();
      keys[event.key]();
    }
  });
}

function restyle() {
  dance.restyle();
  graphs.restyle();
  map.draw();
  grader.show();
  draw();
}

/** Limits and unit of every number, from the service's OpenAPI document. */
async function readLimits() {
  const { paths } = await service.ask("openapi", "openapi.json");
  const parameters = ["/collision-time", "/minimum-pitch"].flatMap((path) => paths[path].get.parameters);
  const range = ({ minimum, exclusiveMinimum, maximum, "x-unit": unit }) => [minimum ?? exclusiveMinimum, maximum, unit];
  limits = Object.fromEntries(parameters.map(({ name, schema }) => [name, range(schema)]));
  map.units = Object.fromEntries(Object.entries(limits).map(([name, [, , unit]]) => [name, unit]));
  controls.translate(limits);
}

listen();
showState(new Set([...Object.keys(SHOW_STATE), "pitch"]));
readLimits().catch((error) => {
  // Without the document the page lacks only the limits and units.
  if (!(error instanceof Problem)) throw error;
});
