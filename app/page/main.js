/** The page: a person's actions change the state, and the service's answers change the screen. */

import * as answers from "./answers.js";
import { Service } from "./api.js";
import { BenchTable } from "./bench_table.js";
import { boxes } from "./boxes.js";
import { Controls } from "./controls.js";
import { Dance, spanOf, speedRange } from "./dance.js";
import { Doors } from "./doors.js";
import { $, $$, onClick } from "./elements.js";
import { CONTACT, FIELDS, strayOf } from "./fields.js";
import { Graphs } from "./graphs.js";
import { addLook } from "./look.js";
import { announce, announceAgain, endMessage, lost, markContact, placeInset, showPrinted, tell } from "./overlays.js";
import { fixed, formatNumber } from "./numbers.js";
import { Pace } from "./pace.js";
import { timeOfDay } from "./passages.js";
import { OF_FILES, Parts, whenReached } from "./parts.js";
import { pending } from "./pending.js";
import { Player } from "./player.js";
import { Questions } from "./questions.js";
import { EXTRAS, State } from "./state.js";
import { Table } from "./table.js";
import { handleName, language, languageOf, learn, say, setLanguage, writeTexts } from "./text.js";
import { showRefusals } from "./refusal_boxes.js";

const NUMBERS = [...FIELDS.map((field) => field.name), ...EXTRAS, "path", "drawing"];
/** The boxes that wait for each kind of answer. */
const BUSY = {
  contact: ["#first-contact", "#run-end"],
  pose: ["#stage"],
  minimum: ["#minimum-pitch"],
  tolerance: ["#tolerance"],
  shortest: ["#shortest-turn"],
  quickest: ["#quickest-turn"],
  time: ["#turn-time"],
  head: ["#head-speed"],
  fastest: ["#highest-speed"],
  clearance: ["#clearance"],
  curve: ["#curve"],
  scan: ["#scan"],
  grade: ["#grade"],
};
/** What a tab leads to while nothing is drawn, so that there are no people and no files yet. */
const INSTEAD = { people: "#controls", keep: "#answers" };
const ZOOM = 1.5;
/** In a run that ends in a fold: a handle this many times faster than the head shows that the fold is near [1]. */
const FAST = 2;

// A card that is kept on a device needs the names of all files of the page.
performance.setResourceTimingBufferSize(10_000);
const state = new State();
const service = new Service({
  busy(channel, busy) {
    // Answers come while a hand drags: signs of waiting would only make each of them later.
    if (busy && questions.isHeld()) return;
    for (const box of BUSY[channel] ?? []) $(box).setAttribute("aria-busy", busy);
    if (channel === "look" && busy) $("#scan").classList.remove("coarse"); // The view drawn so far is no longer of these numbers.
    if (channel === "contact") $("main").classList.toggle("waiting", busy && Boolean(questions.dance));
  },
  lost(seconds) {
    lost(seconds);
    carrier?.network(false);
  },
  back() {
    $("#lost").hidden = true;
    carrier?.network(true);
    if (questions.dance) announce(() => say("The service is back.")); // before a first answer nobody has missed it
  },
});
const parts = new Parts(service);
const questions = new Questions(service, state, (kind, detail) => {
  (SHOW[kind] ?? TELL[kind])(detail);
  if (kind === "minimum") challenge?.show();
});
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
const benches = new BenchTable($("[data-group=dragon]"), state, service, parts);
const pace = new Pace($("[data-field=head_speed]"), state);
const table = new Table($("#rows"), { choose, chosen: (handle) => state.set({ handle }) });
const graphs = new Graphs(state, questions, (time) => player.seek(time));
const doors = new Doors(state, parts);
addLook();
/** What belongs to a drawn dance, what stands below the dance, the five questions, a carrier's view, several dragons, sharing, and a challenge; null until they have loaded. @type {any} */
let [route, below, strip, carrier, dragons, sharing, challenge] = [null, null, null, null, null, null, null];
/** Language of the first view. */
let begun = "";
/** The language of the sentences that the service has sent. */
let spoken = "";
const DRAWING = Symbol("drawing");
let drawing = false;
let opened = false;

function draw() {
  if (drawing) return;
  pending(DRAWING, true);
  drawing = true;
  requestAnimationFrame(() => {
    drawing = false;
    pending(DRAWING, false);
    const { pose } = dance.scene;
    const bench = state.get("bench");
    if (pose && bench !== null) dance.view.centre(pose, bench);
    else if (pose && state.get("follow")) dance.view.set(pose.x[0], pose.y[0]);
    dance.draw();
    if (dance.scene.pose) placeInset((rectangles) => dance.covered(rectangles));
  });
}

/** Choose the handle a number of places further. */
function choose(step) {
  const last = (dance.scene.pose?.x.length ?? 1) - 1;
  state.set({ handle: Math.min(Math.max((state.get("handle") ?? -Math.sign(step)) + step, 0), last) });
}

/** Show a pose: interpolated in motion, or the service's own (with `dance`) for the table and at rest. */
function showPose(pose) {
  const { answer, end, kind, numbers } = questions.dance;
  if (kind !== (state.get("dances") ? "dances" : state.get("path"))) return; // of the former kind of path
  const contact = answer.benches && pose.time === end ? answer : null;
  // Inner and outer refer to the centre of a spiral; other paths have none.
  const drawn = contact && kind !== "spiral" ? { ...contact, edge: null } : contact;
  const several = pose.poses?.map((one, k) => ({ ...questions.dance.parts[k], pose: one, dragon: questions.dance.parts[k].numbers })) ?? null;
  Object.assign(dance.scene, { pose, dragon: numbers, contact: drawn, parts: several });
  $("#halo").hidden = !(strayOf(numbers) > 0);
  $("#inset").hidden = !contact?.point;
  if (contact) $("#inset figcaption").textContent = contact.words?.meeting ?? contact.sentences[0];
  const [low, high] = dance.scene.speeds ?? speedRange(pose);
  const [least, largest] = $$("#legend span");
  // As few decimals as tell the two speeds apart.
  const isEqual = low === null || low.toFixed(6) === high.toFixed(6);
  const few = isEqual ? 2 : [2, 3, 4, 5, 6].find((count) => low.toFixed(count) !== high.toFixed(count));
  const [speed, slowest] = [high, low].map((one) => one === null ? null : formatNumber(one, 6, few));
  least.textContent = isEqual ? say("all equal") : slowest;
  largest.textContent = answers.foldOf(questions.dance.answer) === null ? `${speed} m/s` : say("{speed} m/s → ∞", { speed });
  showHandle();
  if (pose.dance) showTable(pose);
  route?.posed(pose);
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

/** Time of the fold [s] if speeds already grow without bound towards it; else null. */
const nearFold = (pose) => (speedRange(pose)[1] > FAST * questions.dance.numbers.top_speed ? answers.foldOf(questions.dance.answer) : null);

function showTable(pose) {
  table.show(pose);
  const fold = nearFold(pose);
  const last = fold !== null && pose.time === questions.dance.end;
  const { clock } = questions.dance;
  const time = (last ? fold : pose.time).toFixed(6);
  $("#table-time").textContent = say(last ? "Handles 1e-6 s before the fold at {time} s" : "Handles at {time} s", { time }) + (clock ? ` · ${timeOfDay(Number(time), clock)}` : "");
  Object.assign($("#table-fold"), { hidden: fold === null, textContent: fold === null ? "" : questions.dance.answer.words.fold.near });
}

function showTime() {
  const { time } = player;
  // At rest an instant has the same digits everywhere; in motion they would be unreadable.
  const text = `${player.playing || !questions.dance ? fixed(time, 2) : answers.instantWords(time, questions.dance)} s`;
  $("#time").value = time;
  $("#time").setAttribute("aria-valuetext", text);
  const clock = questions.dance?.clock;
  $("#clock").textContent = clock ? `${text}\n${timeOfDay(Number.parseFloat(text), clock)}` : text;
  graphs.time(time);
}

/** How each kind of answer changes the screen; called again after a change of language. */
const SHOW = {
  dance() {
    const { answer, begin, end } = questions.dance;
    Object.assign($("#time"), { min: begin, max: end });
    markContact(answer, begin, end);
    pace.begun(questions.dance);
    if (questions.dance.parts) {
      below?.show();
      player.update();
      carrier?.show();
      return dragons.showDance();
    }
    Object.assign($("#verdict"), { hidden: false, textContent: answers.verdictWords(answer) });
    answers.showFirstContact($("#first-contact"), answer);
    if ($("#judgement").hidden) tell($("#first-contact"));
    answers.showEnd($("#run-end"), questions.dance);
    graphs.pitch();
    below?.show();
    route?.judged();
    player.update();
    carrier?.show();
    openChallenge();
    if (state.opensInMotion && !opened) player.open();
    opened = true;
  },
  ...boxes({ questions, state, graphs }),
  speeds() {
    const { speeds, fastest } = questions.answers;
    const [low, high] = spanOf(speeds.answer.speed); // of some instants, which may miss the highest speed of all
    const most = (fastest?.dance === speeds.dance && fastest.answer.highest_speed?.speed) || high; // none in a run to a fold
    // Towards a fold speeds have no bound.
    const bound = answers.foldOf(speeds.dance.answer) === null ? Infinity : FAST * speeds.dance.numbers.top_speed;
    dance.scene.speeds = [low, Math.min(Math.max(high, most), bound)];
    if (dance.scene.pose) showPose(dance.scene.pose);
  },
  fastest() {
    const { answer, dance: of } = questions.answers.fastest;
    route?.certified(answer, of);
    if (questions.answers.speeds) SHOW.speeds();
    answers.showHighestSpeed($("#highest-speed"), answer);
    // A refusal of the numbers that are entered now stays.
    if (of !== questions.dance || questions.refusals.has("contact")) return;
    // At rest the engines check the whole dragon; while a slider is dragged, only the pair.
    const { engines } = answer.first_contact.words;
    answers.showFirstContact($("#first-contact"), { ...of.answer, words: { ...of.answer.words, engines } });
  },
  clearance() {
    graphs.clearance();
    showTime();
  },
};

/** Other events. */
const TELL = {
  pose: (pose) => player.exact(pose),
  track() {
    player.update(false);
    carrier?.hold();
  },
  path(points) {
    dance.setPath(points, route?.around(), route?.yard());
    route?.knotted();
    route?.judged();
    route?.refused();
    draw();
  },
  refused() {
    const { refusals } = questions;
    controls.refuse(questions.errors());
    benches.refuse(questions.errors().get("csv"));
    pace.refuse(questions.errors().get("passages"));
    const [isStale, isRefused] = [Boolean(questions.dance), !questions.dance].map((is) => is && refusals.has("contact"));
    dance.scene.faded = isStale;
    $("main").classList.toggle("stale", isStale);
    $("main").classList.toggle("refused", isRefused);
    // Without a dance there are no further questions.
    if (isRefused) for (const box of $$("[aria-busy=true]")) box.setAttribute("aria-busy", false);
    showRefusals(questions, graphs, (kind) => BUSY[kind][0]);
    route?.refused();
    carrier?.show();
    if (state.get("dances")) dragons?.judged();
    draw();
  },
};

/** How each part of the state is shown; door and language come first, because all numbers and texts depend on them. */
const SHOW_STATE = {
  door() {
    doors.show();
    translate();
    restyle();
    openChallenge();
  },
  lang: translate,
  follow: (follow) => $("#follow").setAttribute("aria-pressed", follow),
  rate: (rate) => ($("#rate").value = rate),
  handle: () => announce(showHandle),
  view: (view) => (view ? dance.view.set(...view) : (dance.view.fitted = true)),
  turning_diameter: (diameter) => (dance.scene.circle = Number(diameter) / 2),
  path(path) {
    press("path", path);
    // Nothing of the former kind of path stays, nor does its motion.
    if (player.playing) player.stop();
    dance.scene.pose = null;
    dance.setPath(null, route?.around(), route?.yard());
    $("#inset").hidden = true;
    for (const box of ["#shortest-turn", "#quickest-turn", "#turn-time", "#head-speed"]) $(box).hidden = path !== "turn";
    dance.scene.circle = path === "route" ? null : Number(state.get("turning_diameter")) / 2;
    showRoute();
    if (questions.answers.minimum) SHOW.minimum();
  },
  drawing: showRoute,
  bench(bench) {
    if (bench !== null) openCarrier();
    else {
      carrier?.show();
      player.update();
    }
    refresh();
  },
  dances(dances) {
    if (dances) openDragons().then((one) => one.show());
    else dragons?.show();
    challenge?.show();
  },
  start_clock: showTime,
  time() {
    showTime();
    player.update();
  },
};

function showState(changed) {
  for (const [name, show] of Object.entries(SHOW_STATE)) if (changed.has(name)) show(state.get(name));
  if (CONTACT.some((name) => changed.has(name))) graphs.help();
  if (["dragon", "path", "drawing"].some((name) => changed.has(name))) dragons?.show();
  if ([...NUMBERS, "dances"].some((name) => changed.has(name))) refresh();
  draw();
}

/** Ask about what the numbers describe: one dance, or several. */
function refresh() {
  if (state.get("dances")) openDragons().then((one) => state.get("dances") && one.refresh());
  else questions.refresh();
}

/** Mark the button of this value as pressed, among buttons that choose between values. */
function press(name, value) {
  for (const button of $$(`[data-${name}]`)) button.setAttribute("aria-pressed", button.dataset[name] === value);
}

function translate() {
  const chosen = languageOf(state.get("lang"));
  const loading = learn(service, chosen, "first");
  if (loading) return loading.then(translate);
  setLanguage(chosen);
  press("lang", chosen);
  for (const link of $$("[data-how]")) link.href = `how?lang=${chosen}`;
  if (chosen !== (begun ||= chosen)) for (const open of [openRoute, openBelow]) open();
  graphs.help();
  controls.translate();
  benches.show();
  pace.show();
  player.translate();
  below?.translate(chosen);
  challenge?.show();
  strip?.translate();
  for (const [kind, show] of Object.entries(SHOW)) if (kind === "dance" ? questions.dance : questions.answers[kind]) show();
  if (dance.scene.pose) showPose(dance.scene.pose);
  TELL.refused();
  route?.translate();
  carrier?.show();
  dragons?.show();
  // The sentences of the service are in the other language; a carrier has them in all, and may have no network.
  if (spoken && spoken !== chosen && state.get("bench") === null) refresh();
  spoken = chosen;
  announceAgain();
}

/** What belongs to a drawn dance. */
async function openRoute() {
  const { Drawn } = await parts.load("drawn");
  if (route) return route;
  const several = async (...all) => (await openDragons()).open(...all);
  const placed = async () => state.get("dances") && (await openDragons()).waits();
  route = new Drawn({ state, service, questions, dance, draw, several, placed });
  writeTexts();
  route.translate();
  const { course } = questions;
  if (state.get("path") === "route" && course) TELL.path(course);
  return route;
}

/** The view of one carrier. */
async function openCarrier() {
  const { Carrier } = await parts.load("carrier");
  const choose = (k) => openDragons().then((one) => one.choose(k));
  carrier ??= new Carrier({ state, service, questions, dance, show: showPose, choose });
  writeTexts();
  carrier.show();
}

/** The challenge of those who just look. */
async function openChallenge() {
  if (!challenge && state.get("door") !== "look") return;
  const { Challenge } = await parts.load("challenge");
  challenge ??= new Challenge({ state, questions });
  challenge.show();
}

/** The list of keys, with what comes next. */
async function openKeys() {
  const box = await parts.load("keys");
  box.openKeys(state.get("path") === "route" ? route?.next : null);
}

async function openSharing() {
  const { Sharing } = await parts.load("sharing");
  sharing ??= new Sharing(state);
  sharing.open();
}

/** The list of several dragons. */
async function openDragons() {
  const { Dragons } = await parts.load("dragons");
  if (dragons) return dragons;
  dragons = new Dragons({ state, service, questions, dance, draw, player });
  writeTexts();
  dragons.show();
  return dragons;
}

function showRoute() {
  if (state.get("path") === "route") openRoute();
  route?.show();
}

async function openBelow() {
  const { Below } = await parts.load("below");
  if (below) return;
  below = new Below({ state, service, questions, names: NUMBERS, canvas: $("#canvas"), player });
  writeTexts();
  below.translate(language());
}

/** The five questions of the contest. */
async function openStrip() {
  const { Strip } = await parts.load("strip");
  strip ??= new Strip({ service, state, show: () => scrollTo(0, 0), jobs: () => openBelow().then(() => below.jobs) });
  strip.translate();
}

/** Scroll to a section, and once more where what loads only now has moved it. */
async function showSection(name) {
  if (name === "dance") return scrollTo(0, 0); // the picture stays in sight everywhere, so this leads to the top
  const section = $(`#${name}`);
  const place = section.checkVisibility() ? section : $(INSTEAD[name]);
  place.scrollIntoView();
  if (below || !(name in INSTEAD || name === "grade")) return;
  await openBelow();
  place.scrollIntoView();
}

function listen() {
  state.listen(showState);
  for (const button of $$("[data-share]")) button.addEventListener("click", openSharing);
  onClick("#lost button", () => service.retry());
  for (const button of $$("[data-lang]")) button.addEventListener("click", () => state.set({ lang: button.dataset.lang }));
  for (const button of $$("[data-path]")) button.addEventListener("click", () => (button.dataset.path === "route" ? openRoute().then((one) => one.choose()) : state.choosePath(button.dataset.path)));
  for (const { dataset } of $$("[data-section]")) onClick(`[data-section=${dataset.section}]`, () => showSection(dataset.section));
  onClick("#keep-drawing", () => $(state.get("dances") ? "#dragons-save" : "#save").click());
  onClick("#to-keep", async () => {
    await showSection("keep");
    $("#keep-title").focus({ preventScroll: true });
  });
  document.addEventListener("safety", async () => {
    await showSection("keep");
    $("#keepSafety-A4").click();
  });
  // The reasons of the verdict are not on the whole screen.
  $("#verdict").addEventListener("click", async (event) => {
    if (!document.fullscreenElement) return;
    event.preventDefault();
    await document.exitFullscreen();
    $("#answers").scrollIntoView();
  });
  whenReached(["#people", "#keep", "#sweeps", "#grade"], openBelow);
  whenReached(["#five"], openStrip);
  whenReached(["#stage"], openRoute, OF_FILES);
  onClick("#several", () => openDragons().then((one) => one.add()));
  addEventListener("keydown", (event) => {
    const { key, target } = event;
    if (key === "Escape") endMessage();
    // A number has no such character.
    if (key !== "?" || (target instanceof Element && target.matches("input:not([inputmode=decimal]), textarea, select"))) return;
    event.preventDefault();
    openKeys();
  });
  onClick("#keys-open", openKeys);
  // A tap on a number chooses all of it, so that typing replaces it; later than the tap, which sets the cursor.
  const chooseNumber = (target) => /decimal|numeric/.test(target.inputMode) && setTimeout(() => document.activeElement === target && target.select());
  addEventListener("focusin", ({ target }) => chooseNumber(target));
  addEventListener("look", restyle);
  // "How it works" leads back to this dance; without storage, to the page as it begins.
  addEventListener("pagehide", () => {
    try {
      sessionStorage.setItem("bench-dragon-dance", location.search);
    } catch {}
  });
  matchMedia("print").addEventListener("change", restyle);
  new ResizeObserver(draw).observe($("#stage"));
  const all = () => {
    dance.showAll();
    state.set({ view: null, follow: false });
    draw();
  };
  const follow = () => state.set({ follow: !state.get("follow") });
  const full = () => (document.fullscreenElement ? document.exitFullscreen() : $("#front").requestFullscreen()).catch(() => {});
  $("#full").hidden = !document.fullscreenEnabled;
  const views = { full, "zoom-in": () => dance.view.zoom(ZOOM), "zoom-out": () => dance.view.zoom(1 / ZOOM), "show-all": all, follow };
  for (const [id, act] of Object.entries(views)) onClick(`#${id}`, act);
  const others = { " ": () => player.toggle(), Escape: () => state.set({ handle: null }) };
  dance.view.listen({ 0: all, f: follow, F: follow, "[": () => choose(-1), "]": () => choose(1), ...others });
}

function restyle() {
  dance.restyle();
  graphs.restyle();
  below?.restyle();
  const { kind, answer, end = 0, clock } = questions.dance ?? {};
  const last = answer?.end?.time ?? end;
  showPrinted(["route", "dances"].includes(kind) ? `${last.toFixed(2)} s${clock ? ` (${timeOfDay(last, clock)})` : ""}` : "");
  dragons?.recolour();
  // Printing does not wait for the next frame.
  dance.draw();
}

await learn(service, languageOf(state.get("lang")), "first");
listen();
showState(new Set([...Object.keys(SHOW_STATE), "pitch"]));
doors.refuse();
doors.begin();
