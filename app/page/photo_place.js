/** Where a photo lies on the ground: {id, x, y of its upper left corner, scale: [m] of a pixel, angle [rad], width, height [px]}. */

import { $ } from "./elements.js";

/** A place turned [rad] and scaled [1] about a point, and moved by [m]. */
export function carried(place, { about, by = [0, 0], angle = 0, scale = 1 }) {
  const [c, s] = [scale * Math.cos(angle), scale * Math.sin(angle)];
  const [dx, dy] = [place.x - about[0], place.y - about[1]];
  return { ...place, x: about[0] + c * dx - s * dy + by[0], y: about[1] + s * dx + c * dy + by[1], scale: scale * place.scale, angle: place.angle + angle };
}

/** Its four corners, from the upper left one to the right [m]. */
export function ringOf({ x, y, scale, angle, width, height }) {
  const [c, s] = [scale * Math.cos(angle), scale * Math.sin(angle)];
  return [[0, 0], [width, 0], [width, height], [0, height]].map(([right, down]) => [x + c * right + s * down, y + s * right - c * down]);
}

/** Place after the fingers on it went from some places to others [m]; the second finger turns and sizes it. */
function follow(place, [from, other], [to, next]) {
  const by = to.map((one, axis) => one - from[axis]);
  if (!other) return carried(place, { about: from, by });
  const [was, is] = [[from, other], [to, next]].map(([[ax, ay], [bx, by]]) => [Math.hypot(bx - ax, by - ay) || 1, Math.atan2(by - ay, bx - ax)]);
  return carried(place, { about: from, by, scale: is[0] / was[0], angle: is[1] - was[1] });
}

/**
 * A finger or a mouse on the picture moves the photo, and two fingers turn and size it, as long as it is held.
 * @param {Editor} editor
 */
export function addHands(editor) {
  const canvas = $("#canvas");
  /** Fingers on it: number -> [where it began, where it is] [px]; the photo when the last one came or went, and before the first. */
  const fingers = new Map();
  let [start, base] = [null, null];
  const ground = (end) => /** @type {[any, any]} */ ([...fingers.values()].map((places) => editor.dance.view.toWorld(...places[end])));
  const begin = () => {
    start = editor.state.get("photo");
    for (const places of fingers.values()) places[0] = places[1];
  };
  canvas.addEventListener("pointerdown", (event) => {
    if (!editor.photo || event.button || fingers.size > 1) return;
    event.stopPropagation();
    canvas.setPointerCapture(event.pointerId);
    editor.dance.view.fitted = false;
    base ??= editor.photo;
    fingers.set(event.pointerId, Array(2).fill([event.offsetX, event.offsetY]));
    begin();
  }, { capture: true });
  canvas.addEventListener("pointermove", ({ pointerId, offsetX, offsetY }) => {
    if (!fingers.has(pointerId)) return;
    fingers.get(pointerId)[1] = [offsetX, offsetY];
    editor.state.set({ photo: follow(start, ground(0), ground(1)) }, false);
  });
  const end = ({ pointerId }) => {
    if (!fingers.delete(pointerId)) return;
    begin();
    if (fingers.size) return;
    if (start !== base) editor.steps.change({ photo: start }, null, { photo: base });
    base = null;
  };
  for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, end);
}
