/** A photo or a plan behind the square: a file of the person's own, which stays on the device, with a scale from a measured distance. */

import { $, hide, make, numberIn, textButton } from "./elements.js";
import { announce } from "./overlays.js";
import { extent } from "./square.js";
import { phrase, say } from "./text.js";

/** Largest file [bytes] and, of what is kept of it, the longer side [px]; width on the ground before it has a scale [m]. */
const [LARGEST, SIDE, WIDTH] = [50_000_000, 4_096, 60];
/** Where a device keeps it. */
const [STORE, KEY] = ["bench-dragon-photo", "photo"];
/** Largest distance between two points of it [m]. */
const FAR = 10_000;

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

/** Place of a photo of which the distance of two points on the ground is known; the first of them stays. place: {x, y of its upper left corner, scale: [m] of a pixel} */
export function scaled({ x, y, scale }, [[ax, ay], [bx, by]], metres) {
  const times = metres / Math.hypot(bx - ax, by - ay);
  return { x: ax + times * (x - ax), y: ay + times * (y - ay), scale: times * scale };
}

export class Photo {
  /** {image, place}; null without. @type {any} */
  #shown = null;
  #isHidden = false;

  /**
   * changed(): called when it is shown or moved
   * @param {Editor} editor
   * @param {() => void} changed
   */
  constructor(state, editor, changed) {
    this.state = state;
    this.editor = editor;
    this.changed = changed;
    this.input = make("input", { type: "file", id: "photo-file", accept: "image/*", hidden: true, "data-label": phrase("Photo or plan …"), onchange: () => this.#take() });
    const metres = make("input", { id: "photo-metres", inputMode: "decimal", autocomplete: "off", "data-label": phrase("Distance of the two points [m]"), onchange: ({ target }) => this.#measured(target) });
    this.metres = metres;
    // Near the fingers that have measured.
    this.size = make("p", { id: "photo-size", hidden: true }, make("label", { htmlFor: metres.id, "data-text": phrase("On the ground these are") }), " ", metres, make("span", { "data-text": phrase("m apart.") }));
    $("#stage").append(this.size);
    this.hint = make("span", { className: "hint", "data-text": phrase("The photo has its scale from two points of which you know the distance.") });
    this.toggle = textButton("Hide it", () => this.#show(!this.#isHidden), { id: "photo-hide" });
    const measure = textButton("Measure", () => this.#measure(), { id: "photo-measure" });
    this.line = make("p", { className: "buttons", id: "photo", hidden: true }, this.hint, measure, this.toggle, textButton("Remove", () => this.#remove(), { id: "photo-remove" }));
    this.#restore();
  }

  /** The button that opens one, and the line about it. */
  parts() {
    return [textButton("Photo or plan …", () => this.input.click(), { id: "photo-open" }), this.input, this.line];
  }

  /** Corners on the ground [m]. */
  get corners() {
    if (!this.#shown || this.#isHidden) return [];
    const { image, place: { x, y, scale } } = this.#shown;
    return [[x, y], [x + scale * image.width, y - scale * image.height]];
  }

  /** Draw it below all else. */
  draw({ context }) {
    if (!this.#shown || this.#isHidden) return;
    const { image, place: { x, y, scale } } = this.#shown;
    context.save();
    context.translate(x, y);
    context.scale(scale, -scale);
    context.drawImage(image, 0, 0);
    context.restore();
  }

  /** After a change of what is measured. */
  show() {
    const { measured } = this.editor;
    const isMeasured = measured.length === 2;
    hide(this.line, !this.#shown);
    hide(this.size, !isMeasured || !this.corners.length);
    if (isMeasured && document.activeElement !== this.metres) this.metres.value = this.editor.distance.toFixed(2);
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
    this.#shown = { image, place: { x: ground.middle[0] - (scale * width) / 2, y: ground.middle[1] + (scale * height) / 2, scale } };
    this.#show(false);
    this.#measure();
    announce(() => say("The photo stays on this device. Tap two points of it whose distance you know, and type the distance: that is its scale."), false, true);
    await this.#keep();
  }

  async #keep() {
    try {
      const { image, place } = this.#shown;
      const canvas = make("canvas", { width: image.width, height: image.height });
      canvas.getContext("2d").drawImage(image, 0, 0);
      this.#shown.blob ??= await new Promise((resolve) => canvas.toBlob(resolve, "image/jpeg", 0.85));
      const { blob } = this.#shown;
      await inStore("readwrite", (store) => store.put({ blob, place }, KEY));
    } catch {
      announce(() => say("This browser has no room to keep the photo: it is shown until the page is closed."), false, true);
    }
  }

  /** Show what the device has kept. */
  async #restore() {
    try {
      const kept = await inStore("readonly", (store) => store.get(KEY));
      if (!kept || this.#shown) return;
      this.#shown = { ...kept, image: await createImageBitmap(kept.blob) };
      this.#show(false);
    } catch {
      // A browser without such a store shows none.
    }
  }

  #show(isHidden) {
    this.#isHidden = isHidden;
    Object.assign(this.toggle.dataset, { text: isHidden ? phrase("Show it") : phrase("Hide it") });
    this.toggle.textContent = say(this.toggle.dataset.text);
    this.show();
    this.changed();
  }

  #measure() {
    this.editor.turn(true);
    this.editor.take("measure");
    $("#dance").scrollIntoView({ block: "nearest" });
  }

  #measured(field) {
    const metres = numberIn(field.value);
    const isRight = metres > 0 && metres <= FAR;
    field.setAttribute("aria-invalid", !isRight);
    if (!isRight) return;
    this.#shown.place = scaled(this.#shown.place, /** @type {[[number, number], [number, number]]} */ (this.editor.measured), metres);
    this.editor.take("measure");
    this.#show(false);
    this.#keep();
  }

  /** The photo is away only when the device has forgotten it, so that no reload brings it back. */
  async #remove() {
    await inStore("readwrite", (store) => store.delete(KEY)).catch(() => {});
    this.#shown = null;
    this.#show(false);
  }
}
