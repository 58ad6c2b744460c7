/** A path drawn in one stroke of a finger or a mouse on the picture; a second finger makes it a pinch of the picture instead. */

import { $ } from "./elements.js";
import { trace } from "./pen.js";

/** Largest distance of the stroke from the line through its points, and least length of a stroke [px]. */
const [OFF, SHORTEST] = [10, 24];

/** The places of a line that keep it within OFF: its ends, and between them the farthest one again and again (Douglas and Peucker, 1973). */
export function fewer(places) {
  const [[ax, ay], [bx, by]] = [places[0], places.at(-1)];
  const length = Math.hypot(bx - ax, by - ay);
  const far = places.map(([x, y]) => (length ? Math.abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) / length : Math.hypot(x - ax, y - ay)));
  const most = Math.max(...far);
  if (most <= OFF) return [places[0], places.at(-1)];
  const k = far.indexOf(most);
  return [...fewer(places.slice(0, k + 1)), ...fewer(places.slice(k)).slice(1)];
}

export class Stroke {
  /** The finger or mouse that draws, and its places [px]; null: none draws. @type {{ pointer: number, places: number[][] } | null} */
  #line = null;

  /** take(points): extends the path by these points [m] */
  constructor(dance, take) {
    this.dance = dance;
    const canvas = $("#canvas");
    canvas.addEventListener("pointerdown", ({ pointerId }) => pointerId !== this.#line?.pointer && this.#end());
    canvas.addEventListener("pointermove", ({ pointerId, offsetX, offsetY }) => {
      if (pointerId !== this.#line?.pointer) return;
      this.#line.places.push([offsetX, offsetY]);
      dance.draw();
    });
    canvas.addEventListener("pointercancel", () => this.#end());
    canvas.addEventListener("pointerup", ({ pointerId }) => {
      if (pointerId !== this.#line?.pointer) return;
      const { places } = this.#line;
      this.#end();
      const [[ax, ay]] = places;
      if (places.every(([x, y]) => Math.hypot(x - ax, y - ay) < SHORTEST)) return;
      take(fewer(places).map((place) => dance.view.toWorld(...place)));
    });
    dance.above.push((pen, colours) => this.#line && pen.stroke(trace(this.#line.places.map((place) => dance.view.toWorld(...place)), new Path2D(), false), colours.pick, 3));
  }

  /** Draw from where the pointer is pressed, while the picture stays. */
  begin({ pointerId, offsetX, offsetY }) {
    this.#line = { pointer: pointerId, places: [[offsetX, offsetY]] };
    this.dance.view.fitted = false;
    this.dance.view.stays = true;
  }

  #end() {
    this.#line = null;
    this.dance.view.stays = false;
    this.dance.draw();
  }
}
