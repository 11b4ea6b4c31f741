import assert from "node:assert/strict";
import { test } from "node:test";
import { matches } from "../../../src/rightofway/viz/page/assets/lists/find.js";
import {
  LabelBoard,
  boxBeside,
  cut,
} from "../../../src/rightofway/viz/page/assets/drawing/label_board.js";
import { blend } from "../../../src/rightofway/viz/page/assets/drawing/theme.js";
import { joined, several } from "../../../src/rightofway/viz/page/assets/language/words.js";
import "../texts.js";

test("a label is free where nothing is, inside the canvas", () => {
  const board = new LabelBoard();
  board.clear(100, 50);
  board.take(10, 10, 30, 20);
  assert.equal(board.isFree(30, 10, 40, 20), true); // they only touch
  assert.equal(board.isFree(29, 10, 40, 20), false);
  assert.equal(board.isFree(90, 40, 101, 50), false);
});

test("the corner of a box may be where a disc is not", () => {
  const board = new LabelBoard();
  board.clear(100, 100);
  board.takeDisc(50, 50, 10);
  assert.equal(board.isFree(58, 58, 70, 70), true); // 8 * sqrt(2) is more than 10
  assert.equal(board.isFree(57, 57, 70, 70), false); // 7 * sqrt(2) is less
});

test("a label stands beside its disc", () => {
  // its middle is 5 + 3 + half of 20 to the right
  assert.deepEqual(boxBeside(0, 0, 5, 20, 10, [1, 0]), [8, -5, 28, 5]);
});

test("a long name is cut", () => {
  assert.equal(cut("Loading bay", 8), "Loading…");
  assert.equal(cut("Dock", 8), "Dock");
});

test("names are joined as a sentence has them, few of many", () => {
  assert.equal(several(["R1"]), "R1");
  assert.equal(several(["R1", "R2", "R3"]), "R1, R2 and R3");
  assert.equal(several(["R1", "R2", "R3", "R4", "R5"]), "R1, R2, R3 and 2 more");
  assert.equal(several([]), "");
  assert.deepEqual(joined(["a", "b"]), ["a", " and ", "b"]);
});

test("a search finds texts with all of its words, in any order", () => {
  assert.equal(matches("R1 waits for R2", "r2 WAITS"), true);
  assert.equal(matches("R1 waits for R2", "r3"), false);
  assert.equal(matches("R1", " "), true);
});

test("a colour lies between two", () => {
  assert.equal(blend("#000000", "#ff8000", 0.5), "#804000"); // 127.5 is rounded up
});
