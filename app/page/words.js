/** Every word of the page in English and in Simplified Chinese, with the terms of the contest. */

import { ANSWERS } from "./words/answers.js";
import { DANCE } from "./words/dance.js";
import { MORE } from "./words/more.js";
import { SQUARE } from "./words/square.js";

export const WORDS = { ...DANCE, ...ANSWERS, ...MORE, ...SQUARE };
