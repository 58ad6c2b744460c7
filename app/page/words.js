/** Every word of the page in English and in Simplified Chinese, with the terms of the contest. */

import { ANSWERS } from "./words/answers.js";
import { COLUMNS } from "./words/columns.js";
import { DANCE } from "./words/dance.js";
import { MORE } from "./words/more.js";
import { SQUARE } from "./words/square.js";

const columns = Object.fromEntries(Object.entries(COLUMNS).map(([name, words]) => [`column_${name}`, words]));

export const WORDS = { ...DANCE, ...ANSWERS, ...MORE, ...SQUARE, ...columns };
