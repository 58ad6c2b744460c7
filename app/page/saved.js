/** What is said of a saved file. */

import { unfinishedOf } from "./drawing.js";
import { announce } from "./overlays.js";
import { between, say, sentencesOf } from "./text.js";

/** Say that a file was saved, and which things of its drawing it lacks, because they have too few corners. drawing: or none; words(): sentences about it */
export function announceSaved(name, drawing = null, words = () => [say("Saved {name}.", { name })]) {
  const names = drawing ? unfinishedOf(drawing) : [];
  announce(() => sentencesOf([...words(), names.length && say("Left out, because corners are missing: {names}.", { names: names.map((one) => say("“{name}”", { name: one })).join(between()) })]));
}
