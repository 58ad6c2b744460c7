/** The boxes of answers that need no picture: each shows its answer again after a change of language. */

import * as answers from "./answers.js";
import { $ } from "./elements.js";
import { passagesText, quickened } from "./passages.js";
import { phrase } from "./text.js";

/**
 * Functions by the kind of answer.
 * @param {{ questions: Questions, state: State, graphs: any }} parts
 */
export const boxes = ({ questions, state, graphs }) => ({
  minimum() {
    const { answer, request } = questions.answers.minimum;
    // In a turn the pitch of the spiral inwards would lead to a collision.
    const turns = state.get("path") === "turn";
    const use = (pitch) => {
      if (turns) state.choosePath("spiral");
      state.set({ pitch: String(pitch) });
    };
    answers.showMinimumPitch($("#minimum-pitch"), answer, request, turns ? phrase("Dance the spiral of this pitch") : phrase("Use this pitch"), use);
    graphs.curve();
  },
  tolerance() {
    answers.showTolerance($("#tolerance"), questions.answers.tolerance.answer);
    graphs.curve();
  },
  curve: () => graphs.curve(),
  look() {
    // The former jumps belong to other numbers.
    delete questions.answers.scan;
    graphs.scan("look");
  },
  scan() {
    delete questions.answers.look;
    graphs.scan("scan");
  },
  shortest() {
    const { answer, request } = questions.answers.shortest;
    answers.showShortestTurn($("#shortest-turn"), answer, request, (entry, exit) => state.set({ entry_radius: String(entry), exit_radius: String(exit) }));
  },
  quickest() {
    answers.showQuickestTurn($("#quickest-turn"), questions.answers.quickest.answer, (entry, exit) => state.set({ entry_radius: String(entry), exit_radius: String(exit) }));
  },
  time() {
    answers.showTurnTime($("#turn-time"), questions.answers.time.answer);
  },
  head() {
    answers.showHeadSpeed($("#head-speed"), questions.answers.head.answer, (speed) => {
      // The whole dance becomes faster or slower.
      const passages = quickened(state.extras().passages, speed / Number(state.get("head_speed")));
      state.set({ head_speed: String(speed), passages: passagesText(passages) });
    });
  },
});
