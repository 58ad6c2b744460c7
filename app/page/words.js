/** Every word of the page in English and in Simplified Chinese, with the terms of the contest; later parts bring their own. */

import { ANSWERS } from "./words/answers.js";
import { DANCE } from "./words/dance.js";
import { MORE } from "./words/more.js";

export const WORDS = { ...DANCE, ...ANSWERS, ...MORE };

/** Take the words of a part that has loaded. */
export const learn = (words) => Object.assign(WORDS, words);
