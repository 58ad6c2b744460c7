/** Dances to begin with: paths of a straight street, an S, a figure eight, a spiral in and out, and a village square. */

import { EMPTY } from "./drawing.js";
import { announceStep } from "./overlays.js";
import { phrase, say } from "./text.js";

/** Drawings to begin with. @type {Phrases} */
export const PRESET_NAMES = {
  empty: "Nothing",
  street: "Straight street",
  s: "S",
  eight: "Figure eight",
  inout: "Spiral in and out",
  village: "Village square",
};

/** When the dragon of the village is in its square [s]. */
const IN_SQUARE = 75;
const box = (left, low, right, high) => [[left, low], [right, low], [right, high], [left, high]];

const drawings = {
  street: { points: [[-80, 0], [80, 0]], straight: [0] },
  s: { points: [[-80, -16], [0, -16], [16, -8], [0, 0], [-16, 8], [0, 16], [80, 16]], straight: [0, 5] },
  eight: {
    points: [
      [0, 0], [12, 10.4], [20.8, 10.4], [24, 0], [20.8, -10.4], [12, -10.4], [0, 0], [-12, 10.4], [-20.8, 10.4], [-24, 0],
      [-20.8, -10.4], [-12, -10.4], [0, 0], [12, 10.4], [20.8, 10.4], [24, 0], [20.8, -10.4], [12, -10.4],
    ],
  },
  inout: {
    points: [
      [-21, 0], [-14.3, 14.3], [0, 19.5], [13.3, 13.3], [18, 0], [12.2, -12.2], [0, -16.5], [-11.1, -11.1], [-15, 0],
      [-10.1, 10.1], [0, 13.5], [9, 9], [12, 0], [8, -8], [0, -10.5], [-6.9, -6.9], [-9, 0], [-5.8, 5.8], [0, 7.5], [4.8, 4.8],
      [6, 0], [5.1, -2.1], [3, -3], [0.9, -2.1], [0, 0], [-0.9, 2.1], [-3, 3], [-5.1, 2.1], [-6, 0], [-4.8, -4.8], [0, -7.5], [5.8, -5.8], [9, 0], [6.9, 6.9], [0, 10.5], [-8, 8],
      [-12, 0], [-9, -9], [0, -13.5], [10.1, -10.1], [15, 0], [11.1, 11.1], [0, 16.5], [-12.2, 12.2], [-18, 0], [-13.3, -13.3],
      [0, -19.5], [14.3, -14.3], [21, 0],
    ],
  },
  /** The dance of examples/village_square.toml, with its trees and its well as circles. */
  village: {
    points: [
      [-67, -8], [-12, -8], [-3, -9], [6, -8], [10.5, -3], [7, 2.5], [0, 3.5], [-4.5, 7], [-1, 10.5], [6, 10.5], [12, 15], [12, 62],
    ],
    straight: [0, 10],
    begin: 45,
    limit: 1.5,
    yard: box(-20, -15, 20, 15),
    things: [
      {
        kind: "area",
        name: phrase("square"),
        points: [
          [-70, -11], [-20, -11], [-20, -15], [20, -15], [20, 15], [15, 15], [15, 65], [9, 65], [9, 15], [-20, 15], [-20, -5], [-70, -5],
        ],
      },
      { kind: "circle", name: phrase("well"), points: [[2.5, -2.5]], radius: 1.5 },
      { kind: "block", name: phrase("stage"), points: box(-17, 1.5, -6, 9.5) },
      { kind: "circle", name: phrase("linden tree"), points: [[11, -7]], radius: 0.4 },
      { kind: "circle", name: phrase("chestnut tree"), points: [[10.5, 3.5]], radius: 0.5 },
    ],
  },
};

/** Things of a preset have English names. */
export const PRESETS = Object.fromEntries(Object.entries(drawings).map(([name, drawing]) => [name, { ...EMPTY, ...drawing }]));

/** What stands in a square, without names and without the streets, which may be longer. */
const shapes = ({ things, yard }) => JSON.stringify(things.map(({ name: _, ...shape }) => (yard && shape.kind === "area" ? { ...shape, points: yard } : shape)));
/** Time at which to show the dance of a drawing: of one in a square with streets an instant in the square, else its end [s]. */
export const shownAt = ({ yard }) => (yard ? IN_SQUARE : null);
/** True if these things, or this path, are those of a preset; without any they are too. */
export const isPresetVenue = (drawing) => Object.values(PRESETS).some((one) => shapes(one) === shapes(drawing));
export const isPresetPath = ({ points, path }) => !path && Object.values(PRESETS).some((one) => JSON.stringify(one.points) === JSON.stringify(points));

/** Say what of a drawing another one has replaced, if it has. */
export function announceReplaced(before, now) {
  const differ = (/** @type {string[]} */ ...names) => names.some((name) => JSON.stringify(before[name]) !== JSON.stringify(now[name]));
  const path = (before.points.length > 0 || Boolean(before.path)) && differ("points", "path");
  const square = before.things.length > 0 && differ("things");
  if (path && square) announceStep(() => say("The example has taken the place of the path and the square; Undo brings them back."));
  else if (square) announceStep(() => say("The example has taken the place of the square; Undo brings it back."));
  else if (path) announceStep(() => say("The example has taken the place of the path; Undo brings it back."));
}
