/** Texts of the studio, and of the viewer that it contains: each key in both languages. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { GERMAN } from "../../../src/rightofway/studio/assets/words/de.js";
import { ENGLISH } from "../../../src/rightofway/studio/assets/words/en.js";
import { GERMAN as OF_PAGE_IN_GERMAN } from "../../../src/rightofway/viz/page/assets/texts/de.js";
import { ENGLISH as OF_PAGE_IN_ENGLISH } from "../../../src/rightofway/viz/page/assets/texts/en.js";

/**
 * The values that a text takes, by their names.
 *
 * @param {Function} text
 */
function valuesOf(text) {
  const listed = /^\(?([^)=]*)/.exec(String(text).replaceAll(/\/\*.*?\*\//g, ""));
  assert.ok(listed);
  return listed[1]
    .split(",")
    .map((each) => each.trim())
    .filter(Boolean);
}

/**
 * Where the texts of a table are: "tabs.map", and the names of the values each takes.
 *
 * @param {object} table
 * @returns {string[]}
 */
function keysOf(table, path = "") {
  return Object.entries(table).flatMap(([key, value]) =>
    value && typeof value === "object"
      ? keysOf(value, `${path}${key}.`)
      : [`${path}${key} ${typeof value === "function" ? `(${valuesOf(value)})` : typeof value}`],
  );
}

test("both languages have the same texts of the same values", () => {
  assert.deepEqual(keysOf(GERMAN).sort(), keysOf(ENGLISH).sort());
  assert.deepEqual(keysOf(OF_PAGE_IN_GERMAN).sort(), keysOf(OF_PAGE_IN_ENGLISH).sort());
  assert.ok(keysOf(ENGLISH).includes("otherContent (names)"));
});

test("counts have a singular and a plural in English", () => {
  assert.equal(ENGLISH.counted.vertices(1), "1 vertex");
  assert.equal(ENGLISH.counted.vertices(2), "2 vertices");
});
