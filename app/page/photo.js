/** A photo or a plan behind the square: a file of the person's own, which stays on the device, with a scale from a measured distance. */

import { $, button, hide, make, numberIn, textButton } from "./elements.js";
import { announce } from "./overlays.js";
import { Pause } from "./pending.js";
import { addHands, carried, ringOf } from "./photo_place.js";
import { extent } from "./square.js";
import { phrase, say } from "./text.js";

/** Largest file [bytes] and, of what is kept of it, the longer side [px]; width on the ground before it has a scale [m]. */
const [LARGEST, SIDE, WIDTH] = [50_000_000, 4_096, 60];
/** Where a device keeps it. */
const [STORE, KEY] = ["bench-dragon-photo", "photo"];
/** Largest distance between two points of it [m]; rest after which a device keeps a new place [ms]. */
const [FAR, REST] = [10_000, 300];

/** The store of this device. */
const openStore = () =>
  new Promise((resolve, reject) => {
    const request = indexedDB.open(STORE, 1);
    request.onupgradeneeded = () => request.result.createObjectStore(STORE);
    Object.assign(request, { onsuccess: () => resolve(request.result), onerror: () => reject(request.error) });
  });

/** Do something with the store: act(store) gives a request, whose result comes back. */
async function inStore(mode, act) {
  const database = await openStore();
  try {
    return await new Promise((resolve, reject) => {
      const transaction = database.transaction(STORE, mode);
      const request = act(transaction.objectStore(STORE));
      Object.assign(transaction, { oncomplete: () => resolve(request.result), onerror: () => reject(transaction.error), onabort: () => reject(transaction.error) });
    });
  } finally {
    database.close();
  }
}

/** Why a file is not opened, in words; null for one that may be opened. */
export function refusalOf({ name, type, size }) {
  if (size > LARGEST) return () => say("“{name}” has {size} MB; a photo may have at most {most} MB. Save it smaller, and open it again.", { name, size: Math.ceil(size / 1e6), most: LARGEST / 1e6 });
  if (/heic|heif/i.test(`${type} ${name}`)) return () => say("Browsers cannot show HEIC photos such as “{name}”. Save it as JPEG or PNG, or take it with the setting “most compatible”.", { name });
  return null;
}

/** Degrees of an angle. */
const DEGREE = Math.PI / 180;

export class Photo {
  /** id -> {image, blob}. @type {Map<string, any>} */
  #images = new Map();
  #isHidden = false;
  #keeping = new Pause("photo");

  /**
   * changed(): called when it is shown or moved
   * @param {State} state
   * @param {Editor} editor
   * @param {() => void} changed
   */
  constructor(state, editor, changed) {
    this.state = state;
    this.editor = editor;
    this.changed = changed;
    this.input = make("input", { type: "file", id: "photo-file", accept: "image/*", hidden: true, "data-label": phrase("Photo or plan …"), onchange: () => this.#take() });
    const field = (id, words, act) => make("input", { id, inputMode: "decimal", autocomplete: "off", "data-label": words, onchange: ({ target }) => this.#typed(target, act) });
    const text = (words) => make("span", { "data-text": words });
    this.metres = field("photo-metres", phrase("Distance of the two points [m]"), (metres) => metres > 0 && metres <= FAR && this.#measured(metres));
    this.angle = field("photo-angle", phrase("Turned to the left by [°]"), (angle) => Math.abs(angle) <= 360 && { angle: angle * DEGREE - this.#place.angle });
    this.wide = field("photo-wide", phrase("Width on the ground [m]"), (wide) => wide > 0 && wide <= FAR && { scale: wide / this.#wide });
    // Near the fingers that have measured or moved it.
    this.size = make("p", { id: "photo-size", className: "bar", hidden: true }, text(phrase("On the ground these are")), this.metres, text(phrase("m apart.")));
    const done = button({ textContent: "✓", "data-label": "Leave the photo (Escape)" }, () => editor.leave());
    this.moving = make("p", { id: "photo-moving", className: "bar", hidden: true }, "∠ ", this.angle, " ° · ↔ ", this.wide, " m ", done);
    $("#stage").append(this.size, this.moving);
    this.hint = make("span", { className: "hint", "data-text": phrase("The photo has its scale from two points of which you know the distance.") });
    this.toggle = textButton("Hide it", () => this.#show(!this.#isHidden), { id: "photo-hide" });
    const tools = [textButton("Measure", () => this.#begin("measure"), { id: "photo-measure" }), textButton("Move and turn", () => this.#begin("photo"), { id: "photo-move" })];
    this.line = make("p", { className: "buttons", id: "photo", hidden: true }, this.hint, ...tools, this.toggle, textButton("Remove", () => this.#remove(), { id: "photo-remove" }));
    addHands(editor);
    state.listen((names) => names.has("photo") && this.#placed());
    this.#restore();
  }

  /** The button that opens one, and the line about it. */
  parts() {
    return [textButton("Photo or plan …", () => this.input.click(), { id: "photo-open" }), this.input, this.line];
  }

  get #place() {
    return this.state.get("photo");
  }

  /** What is seen of it; undefined without. */
  get #image() {
    return this.#images.get(this.#place?.id);
  }

  get #isShown() {
    return Boolean(this.#image) && !this.#isHidden;
  }

  /** Width on the ground [m]. */
  get #wide() {
    return this.#place.scale * this.#place.width;
  }

  /** Corners on the ground [m]. */
  get corners() {
    return this.#isShown ? ringOf(this.#place) : [];
  }

  /** Draw it below all else. */
  draw({ context }) {
    if (!this.#isShown) return;
    const { x, y, scale, angle } = this.#place;
    context.save();
    context.translate(x, y);
    context.rotate(angle);
    context.scale(scale, -scale);
    context.drawImage(this.#image.image, 0, 0);
    context.restore();
  }

  /** After a change of what is edited. */
  show() {
    const { measured, photo } = this.editor;
    const isMeasured = measured.length === 2;
    hide(this.line, !this.#image);
    hide(this.size, !isMeasured || !this.#isShown);
    hide(this.moving, !photo);
    const put = (field, value) => document.activeElement !== field && (field.value = value);
    if (isMeasured) put(this.metres, this.editor.distance.toFixed(2));
    if (!photo) return;
    put(this.angle, String(Number((photo.angle / DEGREE).toFixed(1))));
    put(this.wide, String(Number(this.#wide.toFixed(2))));
  }

  async #take() {
    const [file] = this.input.files;
    this.input.value = "";
    if (!file) return;
    const refusal = refusalOf(file);
    if (refusal) return announce(refusal, true, true);
    let whole;
    try {
      whole = await createImageBitmap(file);
    } catch {
      return announce(() => say("“{name}” is no picture that this browser can show. Save it as JPEG or PNG.", { name: file.name }), true, true);
    }
    const share = Math.min(SIDE / Math.max(whole.width, whole.height), 1);
    const [width, height] = [whole.width, whole.height].map((side) => Math.max(Math.round(share * side), 1));
    const image = await createImageBitmap(whole, { resizeWidth: width, resizeHeight: height, resizeQuality: "high" });
    const points = this.state.get("drawing").things.flatMap((thing) => thing.points);
    const ground = points.length > 1 ? extent(points) : { width: WIDTH, height: 0, middle: [0, 0] };
    const scale = Math.max(ground.width / width, ground.height / height, 1 / width);
    const id = String(Date.now());
    this.#images.set(id, { image });
    this.editor.steps.change({ photo: { id, x: ground.middle[0] - (scale * width) / 2, y: ground.middle[1] + (scale * height) / 2, scale, angle: 0, width, height } });
    this.#begin("measure");
    announce(() => say("The photo stays on this device. Tap two points of it whose distance you know, and type the distance: that is its scale."), false, true);
  }

  /** After a change of its place: the device keeps it, or forgets it. */
  #placed() {
    this.changed();
    this.#keeping.begin(REST, () => this.#keep());
  }

  async #keep() {
    const [place, shown] = [this.#place, this.#image];
    if (place && !shown) return;
    try {
      if (!place) return await inStore("readwrite", (store) => store.delete(KEY));
      const canvas = make("canvas", { width: place.width, height: place.height });
      if (!shown.blob) canvas.getContext("2d").drawImage(shown.image, 0, 0);
      shown.blob ??= await new Promise((resolve) => canvas.toBlob(resolve, "image/jpeg", 0.85));
      await inStore("readwrite", (store) => store.put({ blob: shown.blob, place }, KEY));
    } catch {
      if (place) announce(() => say("This browser has no room to keep the photo: it is shown until the page is closed."), false, true);
    }
  }

  /** Show what the device has kept. */
  async #restore() {
    try {
      const kept = await inStore("readonly", (store) => store.get(KEY));
      if (!kept) return;
      const image = await createImageBitmap(kept.blob);
      // What was kept before a photo could be turned has no angle.
      const place = { id: KEY, angle: 0, width: image.width, height: image.height, ...kept.place };
      this.#images.set(place.id, { image, blob: kept.blob });
      if (this.#place?.id !== place.id) this.state.set({ photo: place });
      else this.changed();
    } catch {
      // A browser without such a store shows none.
    }
  }

  #show(isHidden) {
    this.#isHidden = isHidden;
    Object.assign(this.toggle.dataset, { text: isHidden ? phrase("Show it") : phrase("Hide it") });
    this.toggle.textContent = say(this.toggle.dataset.text);
    if (isHidden && this.editor.photo) this.editor.leave();
    this.changed();
  }

  /** Measure the photo, or move it: by keys at once, from the button in its middle. */
  #begin(tool) {
    this.#show(false);
    this.editor.turn(true);
    this.editor.take(tool);
    $("#dance").scrollIntoView({ block: "nearest" });
    if (tool === "photo") $(".grip.move").focus({ preventScroll: true });
  }

  /** Change it by a typed number. act(number): the change, or false for a number that it cannot have */
  #typed(field, act) {
    const number = numberIn(field.value);
    const change = typeof number === "number" && act(number);
    field.setAttribute("aria-invalid", !change);
    if (change) this.editor.steps.change({ photo: carried(this.#place, { about: extent(ringOf(this.#place)).middle, ...change }) });
  }

  /** The change after which the measured points are so far apart [m]; the first of them stays. */
  #measured(metres) {
    const { measured: [about], distance } = this.editor;
    this.editor.take("measure");
    return { about, scale: metres / distance };
  }

  /** The photo is away only when the device has forgotten it, so that no reload brings it back. */
  async #remove() {
    await inStore("readwrite", (store) => store.delete(KEY)).catch(() => {});
    this.editor.steps.change({ photo: null });
    this.editor.leave();
  }
}
