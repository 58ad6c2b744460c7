/** What a tap does with each tool, in words. */

import { streetLength } from "./square.js";
import { say } from "./text.js";

/** What each tool does. @type {Phrases} */
const HELPS = {
  path: "Draw on the picture or tap it to extend the path, tap the path to insert a point, drag points and things to move them. Two fingers or the middle button of a mouse move the picture.",
  area: "Tap the corners of the square one after another; drag them to move them.",
  block: "Tap the corners of an obstacle one after another. Choose Obstacle again for the next one.",
  circle: "Tap where a tree, a well or a person is; its radius stands beside it.",
  wall: "Tap along the wall. Choose Wall again for the next one.",
  lane: "Tap along the middle of a lane that stays free, such as one for ambulances; its radius is half of its width. The safety sheet says when benches are in it.",
  several: "Tap things one after another, or drag a frame around them; then drag, copy, align or remove them together. With Shift, any tool does so.",
  measure: "Tap two points: their distance stands between them.",
  photo: "Drag the photo, or its handles; two fingers turn it and make it larger or smaller. Arrow keys do so on its handles, with Shift finer.",
  figure: "This path is a figure: drag it, or its handles, which turn it and make it larger or smaller. “Free it” makes points of it.",
  kit: "Tap where each of them stands; then drag its handles, or type its numbers beside it.",
  gate: "Tap the border where the dragon comes in, then where it goes out. Beyond it a straight street of about {length} m is added, as long as your dragon, which stands in it before or after the dance.",
};
/** A mouse stands beside a keyboard. */
const hasKeys = matchMedia("(pointer: fine)");

/** What a tap draws with the tool. */
export function helpOf({ kit, hasFigure, tool, state, drawing }) {
  // Of two gates each has become a way; which one is said as long as gates are put.
  const [enters, leaves] = ["in", "out"].map((use) => drawing.things.find((one) => tool === "gate" && one.use === use)?.name);
  if (enters && leaves) return say("The dragon comes in at “{enters}” and goes out at “{leaves}”. Tap one of them to change that beside it.", { enters, leaves });
  const words = say(HELPS[kit ? "kit" : hasFigure ? "figure" : tool], { length: tool === "gate" ? streetLength(state) : "" });
  return hasKeys.matches && !["measure", "photo"].includes(tool) && !hasFigure ? `${words}${say(" Keys: N puts the next point, arrows move it by 0.1 m, with Shift by 1 cm, Enter inserts one, Delete removes it.")}` : words;
}
