/** Texts of the studio: each key in both languages. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { GERMAN } from "../../../src/rightofway/studio/assets/words/de.js";
import { ENGLISH } from "../../../src/rightofway/studio/assets/words/en.js";

/** Where the texts of a table are: "tabs.map", and how many values each takes. */
function keysOf(table, path = "") {
  return Object.entries(table).flatMap(([key, value]) =>
    value && typeof value === "object"
      ? keysOf(value, `${path}${key}.`)
      : [`${path}${key} ${typeof value === "function" ? value.length : typeof value}`],
  );
}

test("both languages have the same texts of as many values", () => {
  assert.deepEqual(keysOf(GERMAN).sort(), keysOf(ENGLISH).sort());
});

test("counts have a singular and a plural in English", () => {
  assert.equal(ENGLISH.counted.vertices(1), "1 vertex");
  assert.equal(ENGLISH.counted.vertices(2), "2 vertices");
});
