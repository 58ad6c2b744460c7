/** The picture of a proposed dance on its card. */

import { extent } from "./square.js";

/** Room around the picture and width of its lines, as parts of its larger side [1]; most points of a path. */
const [AROUND, LINE, POINTS] = [0.04, 0.006, 400];

const pointsText = (points) => points.map(([x, y]) => `${x.toFixed(2)},${y.toFixed(2)}`).join(" ");

/** The picture of a proposed dance, as the text of an SVG. yard: corners of the square; course: of /course */
export function cardPicture({ yard, things }, course) {
  const every = Math.ceil(course.x.length / POINTS);
  const path = course.x.map((x, k) => [x, course.y[k]]).filter((_, k) => k % every === 0 || k === course.x.length - 1);
  const { width, height, middle: [x, y] } = extent(yard);
  const size = Math.max(width, height) * (1 + 2 * AROUND);
  const line = size * LINE;
  const blocks = things.map(({ kind, points, radius }) => {
    if (kind === "circle") return `<circle class="thing" cx="${points[0][0]}" cy="${points[0][1]}" r="${radius}"/>`;
    if (kind === "wall") return `<polyline class="wall" points="${pointsText(points)}" stroke-width="${Math.max(2 * radius, line)}"/>`;
    return kind === "block" ? `<polygon class="thing" points="${pointsText(points)}"/>` : "";
  });
  const [box, flip] = [`${x - size / 2} ${-y - size / 2} ${size} ${size}`, 'transform="scale(1 -1)"'];
  const first = course.s.findIndex((s) => s >= 0);
  const head = `<circle class="head" cx="${course.x[first]}" cy="${course.y[first]}" r="${2.5 * line}"/>`;
  return `<svg viewBox="${box}"><g ${flip} stroke-width="${line}"><polygon class="ground" points="${pointsText(yard)}"/>${blocks.join("")}<polyline class="way" points="${pointsText(path)}"/>${head}</g></svg>`;
}
