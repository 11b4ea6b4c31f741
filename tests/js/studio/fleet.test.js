/** Robots of a document, and blocks of their table. */

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  blockOf,
  blockText,
  cleared,
  filled,
  pasted,
  rowsOfText,
} from "../../../src/rightofway/studio/assets/robots/block.js";
import {
  COLUMNS,
  ROBOT_TABLE,
  columnOf,
} from "../../../src/rightofway/studio/assets/robots/columns.js";
import {
  addRobots,
  stopsOf,
  withStops,
  writtenIn,
} from "../../../src/rightofway/studio/assets/robots/fleet.js";
import { freeName, sortRows } from "../../../src/rightofway/studio/assets/robots/rows.js";

const DOCUMENT = {
  map: { grid: ["..."] },
  robots: [
    { name: "R1", home: "N0", target: "N1", work: 3 },
    { name: "R2", home: "N2", stops: [{ at: "N0" }, { at: "N1", work: "1/2" }] },
  ],
};
const [NAME, HOME, STOPS, WORK] = COLUMNS;

test("a new robot gets the first name that no other robot has", () => {
  assert.equal(freeName(DOCUMENT.robots, "robots"), "R3");
  assert.equal(freeName([{ name: "R2" }], "robots"), "R3"); // R2, the second one, is taken
  assert.deepEqual(writtenIn(addRobots(DOCUMENT, [{ home: "N1" }])).at(-1), {
    name: "R3",
    home: "N1",
  });
});

test("one stop is written as target and work, several as a list", () => {
  const [one, several] = DOCUMENT.robots;
  assert.deepEqual(stopsOf(one), [{ at: "N1", work: 3 }]);
  assert.deepEqual(withStops(several, [{ at: "N1" }]), { name: "R2", home: "N2", target: "N1" });
  assert.deepEqual(withStops(one, []), { name: "R1", home: "N0" });
});

test("cells say stops and work, and are read as they are written", () => {
  assert.equal(STOPS.text(DOCUMENT.robots[1]), "N0; N1 (1/2)");
  const written = STOPS.set({ name: "R3" }, "N4 (2,5); 1.5, 2");
  assert.deepEqual(written.stops, [{ at: "N4", work: 2.5 }, { at: { x: 1.5, y: 2 } }]);
  assert.equal(WORK.text(DOCUMENT.robots[1]), ""); // they differ
  assert.equal(columnOf({ path: ["robots", 2, "target"] }), "stops");
});

test("a pasted block adds robots and leaves its headings out", () => {
  const rows = rowsOfText("name\thome\r\nA\tN1\r\nB\t[0, 2]\r\n");
  const grown = pasted(DOCUMENT, ROBOT_TABLE, COLUMNS, rows, { row: 2, column: 0 });
  assert.deepEqual(writtenIn(grown).slice(2), [
    { name: "A", home: "N1" },
    { name: "B", home: [0, 2] },
  ]);
});

test("a block is cleared and filled, but names and homes stay", () => {
  const block = blockOf({ row: 1, column: 3 }, { row: 0, column: 0 });
  assert.deepEqual(block, { top: 0, bottom: 1, left: 0, right: 3 });
  assert.equal(blockText(DOCUMENT.robots, [NAME, HOME], block), "R1\tN0\nR2\tN2");
  assert.deepEqual(cleared(DOCUMENT, ROBOT_TABLE, COLUMNS, block).robots, [
    { name: "R1", home: "N0" },
    { name: "R2", home: "N2" },
  ]);
  const column = { top: 0, bottom: 1, left: 2, right: 3 };
  assert.deepEqual(writtenIn(filled(DOCUMENT, ROBOT_TABLE, COLUMNS, column))[1].target, "N1");
});

test("robots are sorted by numbers in their names", () => {
  const robots = [{ name: "R10" }, { name: "R9" }, { name: "R1" }];
  const sorted = sortRows({ ...DOCUMENT, robots }, "robots", ({ name }) => name ?? "", false);
  assert.deepEqual(sorted.robots, [{ name: "R1" }, { name: "R9" }, { name: "R10" }]);
});
