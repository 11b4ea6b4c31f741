/** Places and cells as a document writes them, and rules. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { cellsOfBox, cellsOfLine } from "../../../src/rightofway/studio/assets/draw/ground.js";
import {
  numberOf,
  placeOfText,
  textOfPlace,
} from "../../../src/rightofway/studio/assets/draw/places.js";
import { withHeadway } from "../../../src/rightofway/studio/assets/runs/rules.js";
import { speak } from "../texts.js";

test("a headway is written beside rules that had a name", () => {
  const document = { map: {}, robots: [], rules: "classic" };
  assert.deepEqual(withHeadway(document, 2).rules, { turn: 0, return: "none", headway: 2 });
  assert.deepEqual(withHeadway({ map: {}, robots: [] }, 2).rules, { headway: 2 });
});

test("places are read as they are written, and cells lie on a line", () => {
  assert.equal(numberOf("3/4"), 0.75);
  for (const text of ["N3", "1.25, 0.75", "[2, 3]"])
    assert.equal(textOfPlace(placeOfText(text)), text);
  assert.deepEqual(cellsOfLine([0, 0], [3, 1]), [
    [0, 0],
    [1, 0],
    [2, 1],
    [3, 1],
  ]);
  assert.equal(cellsOfBox([2, 1], [0, 0]).length, 6);
});

test("a point is written and read with decimal commas in German", () => {
  speak("de");
  assert.equal(textOfPlace({ x: 1.25, y: 0.75 }), "1,25 | 0,75");
  assert.deepEqual(placeOfText("1,25 | 0,75"), { x: 1.25, y: 0.75 });
  assert.deepEqual(placeOfText("1,25; 0,75"), { x: 1.25, y: 0.75 });
  assert.deepEqual(placeOfText("1.25, 0.75"), { x: 1.25, y: 0.75 });
  speak("en");
});
