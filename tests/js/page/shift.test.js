import assert from "node:assert/strict";
import { test } from "node:test";
import { Shift } from "../../../src/rightofway/viz/page/assets/shift/shift.js";

/** @import { JobData, ShiftData } from "../../../src/rightofway/viz/page/assets/payload.d.ts" */

/** @type {ShiftData} */
const EMPTY = {
  until: 100,
  done: 0,
  late: 0,
  underWay: 0,
  unserved: [],
  slices: [],
  known: [],
  robots: [],
  waits: [],
  bottlenecks: [],
  rounds: [],
  told: [],
  happened: [],
};

/** J1 is known at 0 and done from 3 to 9, J2 at 4 and begun at 6, J3 at 4 and never begun. */
function shift() {
  /** @type {JobData[]} */
  const jobs = [
    {
      name: "J1",
      stops: [
        [1, 1, 3, 5],
        [3, -1, 8, 9],
      ],
      robot: 0,
      times: [3, 9, 9, 0],
    },
    {
      name: "J2",
      stops: [
        [2, 1, 6, 7],
        [4, -1, -1, -1],
      ],
      robot: 1,
    },
    { name: "J3", stops: [[5, 0, -1, -1]] },
  ];
  return new Shift({ ...EMPTY, known: [0, 4, 4] }, jobs);
}

test("jobs are counted from the tick at which they become known", () => {
  assert.deepEqual(
    [0, 3, 4, 9].map((tick) => shift().countKnown(tick)),
    [1, 1, 3, 3],
  );
  assert.equal(new Shift(EMPTY, []).countKnown(5), 0);
});

test("a job is open, under way from its first work on, and done", () => {
  const states = [2, 3, 8, 9].map((tick) => shift().stateOf(0, tick));
  assert.deepEqual(states, ["open", "underWay", "underWay", "done"]);
  assert.equal(shift().stateOf(1, 100), "underWay");
  assert.equal(shift().stateOf(2, 100), "open");
});
