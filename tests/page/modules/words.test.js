/** The words of the page. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";

test("a button that shows words or a number has a name with them, so that a voice finds it", () => {
  const text = readFileSync(new URL("../../../app/page/index.html", import.meta.url), "utf8");
  const buttons = [...text.matchAll(/<button[^>]*data-label="([^"]+)"[^>]*>([^<]+)</g)].filter(([, , words]) => /[\p{L}\p{N}]/u.test(words));
  assert.ok(buttons.length > 1);
  for (const [, name, words] of buttons) assert.ok(name.includes(words), `${words}: ${name}`);
});
