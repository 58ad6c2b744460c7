/** The page: what a person does goes into the state, what the service answers goes onto the screen. */

import { insetWords, millimetres, showEnd, showFirstContact } from "./answers.js";
import { showHighestSpeed, showMinimumPitch, showProvenSpeed, showRefusal } from "./answers.js";
import { Problem, Service } from "./api.js";
import { ClearanceChart, ScanChart } from "./charts.js";
import { Controls } from "./controls.js";
import { Dance, speedRange } from "./dance.js";
import { Keep } from "./keep.js";
import { Player } from "./player.js";
import { Questions } from "./questions.js";
import { FIELDS, State } from "./state.js";
import { Table } from "./table.js";
import { handleName, say, setLanguage } from "./text.js";

const $ = (selector) => document.querySelector(selector);
const NUMBERS = new Set([...FIELDS.map((field) => field.name), "path"]);
/** A turn needs a wider spiral: the contest's pitch. */
const PITCHES = { spiral: "0.55", turn: "1.7" };
/** Which boxes wait for which answers. */
const BUSY = {
  contact: ["#first-contact", "#run-end"],
  pose: ["#stage"],
  minimum: ["#minimum-pitch"],
  overview: ["#highest-speed"],
  clearance: ["#clearance"],
  scan: ["#scan"],
};
const PITCH_DECIMALS = 4;

const state = new State();
const service = new Service();
const questions = new Questions(service, state);
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
const table = new Table($("#rows"), (handle) => state.set({ handle }));
const clearanceChart = new ClearanceChart($("#clearance .plot"), (time) => player.seek(time));
const scanChart = new ScanChart($("#scan .plot"), (pitch) => state.set({ pitch: pitch.toFixed(PITCH_DECIMALS) }));
const keep = new Keep(state, service, questions, $("#canvas"), announce);
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

/** A pose between samples while the dance moves, or the service's own (it has `dance`) for the table and at rest. */
function showPose(pose) {
  const shown = questions.dance;
  const contact = shown.answer.benches && pose.time === shown.end ? shown.answer : null;
  // Inner and outer are told by the centre of a spiral, which other paths have not.
  const drawn = contact && shown.kind !== "spiral" ? { ...contact, edge: null } : contact;
  Object.assign(dance.scene, { pose, dragon: shown.numbers, contact: drawn, ...names() });
  $("#inset").hidden = !contact?.point;
  if (contact) $("#inset figcaption").textContent = insetWords(contact, shown.gap, shown.numbers.benches);
  const [low, high] = speedRange(pose);
  const ends = $("#legend").querySelectorAll("span");
  ends[0].textContent = high - low > 1e-9 ? low.toFixed(6) : say("allEqual");
  ends[1].textContent = `${high.toFixed(6)} m/s`;
  if (pose.dance) showTable(pose);
  showTime(player.time());
  draw();
}

function names() {
  const handle = state.get("handle");
  return { headName: say("head"), handleName: handle === null ? "" : handleName(handle, questions.dance.numbers.benches) };
}

function showTable(pose) {
  table.show(pose);
  table.select(state.get("handle"));
  $("#table-time").textContent = say("tableAt", { time: pose.time.toFixed(6) });
}

function showTime(time) {
  $("#time").value = time;
  $("#time").setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
  $("#clock").textContent = `${time.toFixed(2)} s`;
  clearanceChart.now(time);
  const { answer, dance: of } = questions.answers.clearance ?? {};
  if (!answer || of !== questions.dance) return;
  const step = (of.end - of.begin) / (answer.time.length - 1) || 1;
  const k = Math.min(Math.round((time - of.begin) / step), answer.time.length - 1);
  const [a, b] = answer.benches[k].map((bench) => handleName(bench, of.numbers.benches));
  const gap = millimetres(answer.clearance[k]);
  $("#clearance .reading").textContent = say("clearanceAt", { time: answer.time[k].toFixed(2), gap, a, b });
}

/** Each kind of answer and what it changes on the screen; also called again after a change of language. */
const SHOW = {
  dance() {
    const { answer, numbers, begin, end } = questions.dance;
    Object.assign($("#time"), { min: begin, max: end });
    dance.scene.circle = Number(state.get("turning_diameter")) / 2;
    showFirstContact($("#first-contact"), answer, numbers);
    showEnd($("#run-end"), answer, end);
    scanChart.now(numbers.pitch);
    showScanReading();
    keep.show();
    player.update();
  },
  minimum() {
    const { answer, query } = questions.answers.minimum;
    const numbers = { benches: Number(query.benches), diameter: query.turning_diameter };
    showMinimumPitch($("#minimum-pitch"), answer, numbers, (pitch) => state.set({ pitch: String(pitch) }));
  },
  overview() {
    const { answer, dance: of } = questions.answers.overview;
    if (of.fastest) showProvenSpeed($("#highest-speed"), of.fastest, of.numbers);
    else showHighestSpeed($("#highest-speed"), answer, of.answer, of.numbers);
  },
  clearance() {
    const { answer, dance: of } = questions.answers.clearance;
    clearanceChart.show({ ...answer, margin: of.numbers.margin, contact: of.answer.time });
    showTime(player.time());
  },
  scan() {
    const { answer, query } = questions.answers.scan;
    scanChart.show({ ...answer, circle: Number(query.turning_diameter) / 2, least: answer.minimum_pitch });
    scanChart.now(questions.dance?.numbers.pitch ?? null);
    showScanReading();
  },
};

function showScanReading() {
  const { answer, numbers, kind } = questions.dance ?? {};
  if (!questions.answers.scan || !answer) return;
  $("#scan .reading").textContent = kind !== "spiral" ? "" : answer.head
    ? say("scanAt", { pitch: numbers.pitch, radius: answer.head.radius.toFixed(6) })
    : `${say("pitch")} ${numbers.pitch} m: ${say(answer.outcome)}`;
}

function showRefusals() {
  const { refusals } = questions;
  controls.refuse(questions.errors());
  $("main").classList.toggle("stale", refusals.has("contact"));
  if (refusals.has("contact") && !questions.dance)
    for (const box of document.querySelectorAll("[aria-busy=true]")) box.setAttribute("aria-busy", false);
  if (refusals.has("contact")) showRefusal($("#first-contact"), "firstContact", refusals.get("contact").message);
  if (refusals.has("minimum")) showRefusal($("#minimum-pitch"), "minimumPitch", refusals.get("minimum").message);
  for (const [kind, chart] of [["clearance", clearanceChart], ["scan", scanChart]]) {
    if (!refusals.has(kind)) continue;
    chart.show(null);
    $(`#${kind} .reading`).textContent = refusals.get(kind).message;
  }
}

function showState(changed) {
  if (changed.has("follow")) $("#follow").setAttribute("aria-pressed", state.get("follow"));
  if (changed.has("rate")) $("#rate").value = state.get("rate");
  if (changed.has("handle")) {
    const handle = state.get("handle");
    dance.scene.handle = handle;
    if (questions.dance) Object.assign(dance.scene, names());
    table.select(handle);
    if (handle !== null && questions.dance) announce(handleName(handle, questions.dance.numbers.benches));
  }
  if (changed.has("view") && state.get("view")) dance.view.set(...state.get("view"));
  if (changed.has("view") && !state.get("view")) dance.view.fitted = true;
  if (changed.has("turning_diameter")) dance.scene.circle = Number(state.get("turning_diameter")) / 2;
  if (changed.has("path")) showPath();
  if (changed.has("lang")) translate();
  if (changed.has("time")) showTime(player.time());
  if (changed.has("time")) player.update();
  if ([...changed].some((name) => NUMBERS.has(name))) questions.refresh();
  draw();
}

function choosePath(path) {
  if (path !== state.get("path")) state.set({ path, pitch: PITCHES[path], time: null, view: null });
}

function showPath() {
  for (const button of document.querySelectorAll("[data-path]"))
    button.setAttribute("aria-pressed", button.dataset.path === state.get("path"));
}

function translate() {
  const language = setLanguage(state.get("lang"));
  for (const button of document.querySelectorAll("[data-lang]"))
    button.setAttribute("aria-pressed", button.dataset.lang === language);
  controls.translate(limits);
  player.translate();
  for (const [kind, show] of Object.entries(SHOW)) if (kind === "dance" ? questions.dance : questions.answers[kind]) show();
  if (dance.scene.pose) showPose(dance.scene.pose);
  showRefusals();
}

function listen() {
  for (const [kind, show] of Object.entries(SHOW)) questions.addEventListener(kind, show);
  questions.addEventListener("pose", ({ detail }) => player.exact(detail));
  questions.addEventListener("track", () => player.update(false));
  questions.addEventListener("gap", () => dance.scene.pose && showPose(dance.scene.pose));
  questions.addEventListener("path", ({ detail }) => (dance.setPath(detail), draw()));
  questions.addEventListener("refused", showRefusals);
  state.addEventListener("change", ({ detail }) => showState(detail));
  service.addEventListener("busy", ({ detail: [channel, busy] }) => {
    for (const box of BUSY[channel] ?? []) $(box).setAttribute("aria-busy", busy);
  });
  service.addEventListener("lost", ({ detail }) => {
    $("#lost").hidden = false;
    $("#lost span").textContent = say("lost", { seconds: detail });
  });
  service.addEventListener("back", () => {
    $("#lost").hidden = true;
    announce(say("back"));
  });
  $("#lost button").addEventListener("click", () => service.retry());
  for (const button of document.querySelectorAll("[data-lang]"))
    button.addEventListener("click", () => state.set({ lang: button.dataset.lang }));
  for (const button of document.querySelectorAll("[data-path]"))
    button.addEventListener("click", () => choosePath(button.dataset.path));
  listenToView();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", restyle);
  new ResizeObserver(draw).observe($("#stage"));
}

function listenToView() {
  const all = () => {
    dance.view.fitted = true;
    state.set({ view: null, follow: false });
    draw();
  };
  const follow = () => state.set({ follow: !state.get("follow") });
  $("#zoom-in").addEventListener("click", () => dance.view.zoom(1.5));
  $("#zoom-out").addEventListener("click", () => dance.view.zoom(1 / 1.5));
  $("#show-all").addEventListener("click", all);
  $("#follow").addEventListener("click", follow);
  const choose = (step) => {
    const last = (dance.scene.pose?.x.length ?? 1) - 1;
    state.set({ handle: Math.min(Math.max((state.get("handle") ?? -step) + step, 0), last) });
  };
  const [back, on] = [() => choose(-1), () => choose(1)];
  const [none, play] = [() => state.set({ handle: null }), () => player.toggle()];
  const keys = { 0: all, f: follow, F: follow, "[": back, "]": on, " ": play, Escape: none };
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
  clearanceChart.show();
  scanChart.show();
  draw();
}

/** Limits of every number, from the service's own description of itself. */
async function readLimits() {
  const { paths } = await service.ask("openapi", "openapi.json");
  const parameters = ["/collision-time", "/minimum-pitch"].flatMap((path) => paths[path].get.parameters);
  const range = ({ minimum, exclusiveMinimum, maximum }) => [minimum ?? exclusiveMinimum, maximum];
  limits = Object.fromEntries(parameters.map(({ name, schema }) => [name, range(schema)]));
  controls.translate(limits);
}

listen();
translate();
showState(new Set(["follow", "rate", "handle", "view", "turning_diameter"]));
showPath();
questions.refresh();
readLimits().catch((error) => {
  // Without it the page only lacks the limits.
  if (!(error instanceof Problem)) throw error;
});
