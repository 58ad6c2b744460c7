/** Names of the values in the table of a sweep. */

import { sense } from "./text.js";

/** Name of a value in the table of a sweep: the words of its parts, of which numbers count from 1. */
export const columnName = (name) => name.split(".").map((part) => (/^\d+$/.test(part) ? String(Number(part) + 1) : sense("column", part))).join(" · ");
