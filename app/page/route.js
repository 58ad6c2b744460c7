/** The form of a drawn dance: presets, its points and its venue as lists, files in and out. */

import { bent, joined, moved, removed, withThing } from "./changes.js";
import { EMPTY, THINGS, freeName } from "./drawing.js";
import { button, hide, make, numberIn, textButton } from "./elements.js";
import { chooseHow } from "./opening.js";
import { laterBy, passagesText, wayAt } from "./passages.js";
import { PRESETS, PRESET_NAMES, announceReplaced, isPresetVenue, shownAt } from "./presets.js";
import { language, phrase, say } from "./text.js";

/** The number in a field; null if there is none. */
function read(field) {
  const number = numberIn(field.value);
  return typeof number === "number" ? number : null;
}
/** An element with a text, or a label, that follows the language. */
const textElement = (tag, words, properties = {}) => make(tag, { ...properties, "data-text": words, textContent: say(words) });
const labelled = (tag, words, properties = {}) => make(tag, { ...properties, "data-label": words, "aria-label": say(words) });
/** Least and largest numbers of the fields, as the service takes them. */
export const LIMITS = { pointX: [-1e5, 1e5], pointY: [-1e5, 1e5], speedLimit: [0.001, 100], pathBegin: [-1e6, 1e6], latitude: [-90, 90], longitude: [-180, 180], cornerRadius: [0, 1e4], thingRadius: [0.001, 1e4], gateHeading: [-360, 360], street_width: [0.1, 1e4], street_length: [0.1, 1e4] };
/** Sizes of the street of a gate, and what a gate is for. @type {Phrases} */
const USES = { "": "in and out", in: "way in", out: "way out" };
const STREET = ["street_width", "street_length"];
const unitOf = (textContent) => make("span", { className: "unit", textContent });
const removing = { className: "reset", textContent: "✕" };
/** Labels of the numbers. @type {Phrases} */
export const NAMES = {
  pointX: "x of the point",
  pointY: "y of the point",
  speedLimit: "Speed limit of every handle",
  pathBegin: "Head at time 0, along the path",
  latitude: "Latitude of x = y = 0",
  longitude: "Longitude of x = y = 0",
  cornerRadius: "Radius of corners",
  thingRadius: "Radius [m]",
  gateHeading: "Direction of those who enter [°]",
  street_width: "Width of the street [m]",
  street_length: "Length of the street [m]",
  cornerNext: "to the next [m]",
};
/** Fields that may be empty. */
const OPTIONAL = ["speedLimit", "latitude", "longitude", "gateHeading", ...STREET];
const DEGREE = Math.PI / 180;
const isRefused = (field) => field.getAttribute("aria-invalid") === "true";
/** Show a value unless a person is typing there, or typed what was refused. */
const put = (field, value) => {
  field.kept = String(value);
  if (document.activeElement !== field && !isRefused(field) && field.value !== field.kept) field.value = value;
};

export class RouteForm {
  #points = [];
  #things = [];

  /**
   * editor: chooses the edited item; steps: receives changes; files, photo: have buttons
   * @param {State} state
   * @param {Steps} steps
   * @param {Editor} editor
   */
  constructor(box, state, steps, editor, files, photo) {
    this.box = box;
    this.state = state;
    this.steps = steps;
    this.editor = editor;
    // Buttons, because the arrow keys of a list would begin anew at each step.
    this.presets = make("div", { id: "presets", popover: "auto" }, ...["empty", ...Object.keys(PRESETS)].map((name) => textButton(PRESET_NAMES[name], () => this.beginWith(name), { "data-begin": name })));
    this.preset = textElement("button", "Begin with …", { id: "preset", type: "button", popoverTargetElement: this.presets });
    this.corner = this.#number("cornerRadius", (radius) => this.#take({ radius }));
    this.limit = this.#number("speedLimit", (limit) => this.#take({ limit }));
    this.begin = this.#number("pathBegin", (begin) => this.#take({ begin }));
    this.origin = ["latitude", "longitude"].map((key) => this.#number(key, () => this.#placed()));
    this.wrong = make("p", { className: "error", role: "alert" });
    this.rows = make("tbody");
    this.list = make("ul");
    this.pointsTitle = make("summary");
    this.thingsTitle = make("summary");
    this.note = make("p", { className: "hint", id: "route-note", role: "status" });
    const heads = [phrase("Point"), "x [m]", "y [m]", phrase("Straight on"), phrase("Remove")].map((words) => textElement("th", words, { scope: "col" }));
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...heads)), this.rows);
    const field = (key, input, unit) => make("label", { className: "line" }, textElement("span", NAMES[key]), input, unitOf(unit));
    const photoButtons = photo.parts();
    const photoLine = photoButtons.pop();
    box.append(
      make("p", { className: "buttons" }, this.preset, this.presets, ...files.buttons(), ...photoButtons),
      photoLine,
      this.note,
      field("speedLimit", this.limit, "m/s"),
      (this.cornerLine = field("cornerRadius", this.corner, "m")),
      field("pathBegin", this.begin, "m"),
      (this.later = make("p", { className: "hint", hidden: true }, make("span"), " ", make("button", { type: "button" }))),
      make("p", { className: "line" }, textElement("span", "Latitude, longitude of 0, 0"), ...this.origin, unitOf("°")),
      make("details", { id: "points" }, this.pointsTitle, table),
      make("details", { id: "things", open: true }, this.thingsTitle, this.list, textElement("p", "Choose one of them to move its points. Walls and trees have a radius.", { className: "hint" })),
    );
  }

  get #drawing() {
    return this.state.get("drawing");
  }

  /** A field for a number; what is none, or beyond its limits, is refused below it. act: takes the number, or null for an empty field */
  #number(key, act) {
    const [low, high] = LIMITS[key];
    const onchange = ({ target }) => {
      const number = read(target);
      const isRight = !target.value.trim() || (number !== null && low <= number && number <= high);
      this.#mark(target, isRight ? null : () => say("“{what}” must be a number from {low} to {high}; you typed “{text}”. The dance stays as it was.", { what: say(NAMES[key]), low, high, text: target.value }));
      if (!isRight) return;
      if (number === null && !OPTIONAL.includes(key)) target.value = target.kept;
      else act(number);
    };
    return labelled("input", NAMES[key], { id: ["latitude", "longitude"].includes(key) ? key : "",  inputMode: "decimal", autocomplete: "off", spellcheck: false, onchange });
  }

  /** Show why a number is refused, until it is right, another one is refused or the drawing changes. words(): why; null: it is right */
  #mark(field, words) {
    const before = this.refused?.field;
    if (!words && field !== before) return;
    before?.removeAttribute("aria-invalid");
    this.refused = words && { field, words, drawing: this.#drawing };
    if (!words) return this.wrong.remove();
    field.setAttribute("aria-invalid", "true");
    field.closest("table, ul, .line").after(this.wrong);
    this.show();
  }

  #take(changes, kind = null) {
    this.steps.take({ ...this.#drawing, ...changes }, kind);
  }

  /** Offer to begin at time 0 if the dance begins later, because the dragon does not yet fit on the path. dance: as judged, or null */
  offer(dance) {
    this.later.hidden = !(dance?.begin > 0);
    if (this.later.hidden) return;
    const { begin, numbers, extras: { passages } } = dance;
    const [words, button] = this.later.children;
    const place = Math.ceil(10 * (this.#drawing.begin + wayAt(begin, numbers.head_speed, passages))) / 10;
    const start = () => {
      // Passages keep their places, and their times after the new beginning.
      const later = passages.length ? { passages: passagesText(laterBy(passages, place - this.#drawing.begin, begin)) } : {};
      this.steps.change({ ...later, drawing: { ...this.#drawing, begin: place } });
    };
    words.textContent = say("The dance begins at {time} s: only then is the whole dragon on the path.", { time: begin.toFixed(2) });
    Object.assign(button, { textContent: say("Begin at time 0: head at {place} m", { place }), onclick: start });
  }

  /** Set the place of x = y = 0 on earth when both of its numbers are given, or none. */
  #placed() {
    const [latitude, longitude] = this.origin.map(read);
    if (latitude !== null && longitude !== null) this.#take({ origin: { longitude, latitude } });
    else if (this.origin.every(({ value }) => !value.trim())) this.#take({ origin: null });
  }

  /** Begin with a preset; a person's own square stays, which is asked where the preset has one. */
  async beginWith(name) {
    if (this.presets.matches(":popover-open")) this.presets.hidePopover();
    this.editor.edit(null);
    const preset = PRESETS[name] ?? EMPTY;
    const translated = preset.things.map((thing) => ({ ...thing, name: say(thing.name) }));
    const isOwn = !isPresetVenue(this.#drawing);
    const how = isOwn && translated.length ? await chooseHow(say(PRESET_NAMES[name])) : "";
    if (how === null) return;
    const before = this.#drawing;
    const { things, origin, grid, limit } = before;
    const example = { ...preset, ...(isOwn && !translated.length ? { things, origin, grid, limit } : { things: translated }) };
    const drawing = how === "beside" ? joined(before, example).drawing : example;
    this.steps.change({ drawing, view: null, time: drawing === example ? shownAt(preset) : null });
    announceReplaced(before, drawing);
  }

  /** Show the drawing; rows are made again only if their number changes. */
  show() {
    const { points, straight, radius, limit, begin, things, path, origin } = this.#drawing;
    if (this.refused && this.refused.drawing !== this.#drawing) this.#mark(this.refused.field, null);
    if (this.refused) this.wrong.textContent = this.refused.words();
    put(this.corner, radius);
    put(this.limit, limit ?? "");
    put(this.begin, begin);
    if (origin || !this.box.contains(document.activeElement)) this.origin.forEach((one) => put(one, origin?.[one.id] ?? ""));
    if (this.limit.placeholder !== say("none")) this.limit.placeholder = say("none");
    hide(this.cornerLine, !straight.some((leg) => straight.includes(leg + 1)));
    this.pointsTitle.textContent = path && !points.length ? say("The path is from a file; tap to draw another") : say("Points of the path: {count}", { count: points.length });
    this.thingsTitle.textContent = say("Square and obstacles: {count}", { count: things.length });
    this.note.textContent = this.state.fits ? "" : say("This drawing is too long for an address: save it as a file to share it.");
    this.#fit(this.#points, this.rows, points.length, (k) => this.#pointRow(k));
    this.#fit(this.#things, this.list, things.length, (k) => this.thingRow(() => k));
    this.#points.forEach((row, k) => {
      points[k].forEach((one, axis) => put(row.fields[axis], one));
      row.leg.checked = straight.includes(k);
      row.leg.disabled = k === points.length - 1;
    });
    this.#things.forEach((row, k) => this.fill(row, k));
  }

  /** Show the numbers of thing k in a row of fields. */
  fill(row, k) {
    const thing = this.#drawing.things[k];
    const isPressed = this.editor.item === k || this.editor.others.includes(k);
    // Hundreds of trees stand still while one is dragged; what is typed may differ from what is shown.
    const shown = [thing, isPressed, language()];
    if (row.shown?.every((one, at) => one === shown[at])) return;
    row.shown = this.refused || document.activeElement?.matches("input, select") ? null : shown;
    const { name, kind, radius, heading, points } = thing;
    put(row.name, name);
    put(row.radius, radius ?? "");
    put(row.heading, heading === null || heading === undefined ? "" : Number((heading / DEGREE).toFixed(1)));
    if (row.heading.placeholder !== say("auto")) row.heading.placeholder = say("auto");
    for (const part of [row.radius, row.unit]) hide(part, radius === undefined);
    for (const part of [row.angle, row.use, row.street]) hide(part, kind !== "gate");
    row.use.value = thing.use ?? "";
    row.sizes.forEach((field, axis) => {
      put(field, thing[STREET[axis]] ?? "");
      if (field.placeholder !== say("auto")) field.placeholder = say("auto");
    });
    row.at.forEach((field, axis) => put(field, points[0]?.[axis] ?? ""));
    hide(row.places, points.length !== 1);
    row.edit.textContent = say(THINGS[kind]);
    row.edit.setAttribute("aria-pressed", isPressed);
    row.edit.setAttribute("aria-label", say("Edit {name}", { name }));
    row.remove.setAttribute("aria-label", say("Remove {name}", { name }));
  }

  #fit(rows, box, count, make) {
    while (rows.length > count) rows.pop().box.remove();
    while (rows.length < count) {
      rows.push(make(rows.length));
      box.append(rows.at(-1).box);
    }
  }

  #pointRow(k) {
    const fields = ["pointX", "pointY"].map((key, axis) =>
      this.#number(key, (value) => this.steps.take(moved(this.#drawing, null, k, this.#drawing.points[k].with(axis, value)))),
    );
    const leg = labelled("input", "Straight on", { type: "checkbox", onchange: () => this.steps.take(bent(this.#drawing, k)) });
    const remove = labelled("button", "Remove", { type: "button", ...removing, onclick: () => this.steps.take(removed(this.#drawing, null, k)) });
    const cells = [...fields, make("label", { className: "tap" }, leg), remove].map((part) => make("td", {}, part));
    return { fields, leg, box: make("tr", {}, make("th", { scope: "row", textContent: k + 1 }), ...cells) };
  }

  /** Fields of a thing: name, radius, place, direction. at(): its number */
  thingRow(at) {
    const edit = ({ shiftKey }) => {
      if (shiftKey) return this.editor.toggle(at());
      this.editor.turn(true);
      this.editor.edit(this.editor.item === at() ? null : at());
    };
    const rename = ({ target }) => {
      const { things } = this.#drawing;
      const thing = things[at()];
      const name = target.value.trim() || say(THINGS[thing.kind]);
      this.steps.take(withThing(this.#drawing, at(), { name: freeName(things, name, thing) }));
    };
    const change = (changes) => this.steps.take(withThing(this.#drawing, at(), changes));
    const row = {
      edit: button({}, edit),
      name: labelled("input", "Name", { maxLength: 200, autocomplete: "off", spellcheck: false, onchange: rename }),
      radius: this.#number("thingRadius", (radius) => change({ radius })),
      unit: unitOf("m"),
      at: ["pointX", "pointY"].map((key, axis) => this.#number(key, (value) => this.steps.take(moved(this.#drawing, at(), 0, this.#drawing.things[at()].points[0].with(axis, value))))),
      heading: this.#number("gateHeading", (degrees) => change({ heading: degrees === null ? null : Number((degrees * DEGREE).toFixed(4)) })),
      use: labelled("select", "Use of the gate", { onchange: ({ target }) => change({ use: target.value || undefined }) }),
      sizes: STREET.map((key) => this.#number(key, (size) => change({ [key]: size ?? undefined }))),
      remove: button(removing, () => this.#take({ things: this.#drawing.things.toSpliced(at(), 1) })),
    };
    row.use.append(...Object.entries(USES).map(([value, words]) => make("option", { value, "data-text": words, textContent: say(words) })));
    const street = make("span", { className: "street" }, make("span", { "data-text": "street", textContent: say("street") }), " ", row.sizes[0], " × ", row.sizes[1], unitOf("m"));
    const places = make("span", { className: "places" }, "x ", row.at[0], " y ", row.at[1], unitOf("m"));
    const angle = make("span", { className: "angle" }, "∠ ", row.heading, unitOf("°"));
    return { ...row, places, street, angle, box: make("li", {}, row.edit, row.name, row.radius, row.unit, angle, row.remove, row.use, street) };
  }
}
