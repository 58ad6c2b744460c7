/** Places of refusals on the page: each message appears once. */

import { showRefusal } from "./answers.js";
import { $ } from "./elements.js";
import { phrase } from "./text.js";

/** Titles of the boxes that show a refusal, in the order of the page. */
const TITLES = { contact: phrase("First contact"), minimum: phrase("Minimum pitch"), tolerance: phrase("How far people may stray"), shortest: phrase("Shortest turn"), quickest: phrase("Quickest turn"), time: phrase("Time through this turn"), head: phrase("Maximum head speed"), fastest: phrase("Highest speed") };

/** boxOf(kind): selector of the box of this kind of answer */
export function showRefusals(questions, graphs, boxOf) {
  // Each message appears once: beside its field, or in the first box that it concerns.
  const printed = new Set([...questions.errors().values()].map(({ sentence }) => sentence));
  const inOrder = [...Object.keys(TITLES), ...questions.refusals.keys()].filter((kind, k, all) => questions.refusals.has(kind) && all.indexOf(kind) === k);
  for (const kind of inOrder) {
    const { problem, errors } = questions.refusals.get(kind);
    const words = [problem, ...errors].map(({ sentence }) => sentence);
    const first = words.some((one) => printed.has(one)) ? null : problem;
    for (const one of words) printed.add(one);
    if (kind in TITLES) showRefusal($(boxOf(kind)), TITLES[kind], first, questions.fieldsOf(kind));
    graphs.refuse(kind, first);
  }
}
