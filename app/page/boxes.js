/** The boxes of answers that need no picture: each shows its answer again after a change of language. */

import { show } from "./answers.js";
import { $ } from "./elements.js";
import { passagesText, quickened } from "./passages.js";
import { phrase } from "./text.js";

/**
 * Functions by the kind of answer.
 * @param {{ questions: Questions, state: State, graphs: any }} parts
 */
export function boxes({ questions, state, graphs }) {
  const answerTo = (kind) => questions.answers[kind].answer;
  const turn = ({ entry_radius: entry, exit_radius: exit }) => state.set({ entry_radius: String(entry), exit_radius: String(exit) });
  return {
    minimum() {
      const answer = answerTo("minimum");
      // In a turn the pitch of the spiral inwards would lead to a collision.
      const turns = state.get("path") === "turn";
      const use = () => {
        if (turns) state.choosePath("spiral");
        state.set({ pitch: String(answer.pitch_bracket[1]) });
      };
      show($("#minimum-pitch"), answer, [turns ? phrase("Dance the spiral of this pitch") : phrase("Use this pitch"), use]);
      graphs.curve();
    },
    tolerance() {
      show($("#tolerance"), answerTo("tolerance"));
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
    shortest: () => show($("#shortest-turn"), answerTo("shortest"), [phrase("Dance this turn"), () => turn(answerTo("shortest"))]),
    quickest: () => show($("#quickest-turn"), answerTo("quickest"), [phrase("Dance the quickest turn"), () => turn(answerTo("quickest"))]),
    time: () => show($("#turn-time"), answerTo("time")),
    head() {
      const answer = answerTo("head");
      const speed = answer.head_speed_bracket[0] ?? answer.head_speed;
      // The whole dance becomes faster or slower.
      const passages = () => passagesText(quickened(state.extras().passages, speed / Number(state.get("head_speed"))));
      show($("#head-speed"), answer, [phrase("Dance at this speed"), () => state.set({ head_speed: String(speed), passages: passages() })]);
    },
  };
}
