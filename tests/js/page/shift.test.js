import assert from "node:assert/strict";
import { test } from "node:test";
import { fleetBattery } from "../../../src/rightofway/viz/page/assets/shift/fleet_battery.js";
import { Shift } from "../../../src/rightofway/viz/page/assets/shift/shift.js";

/** @import { JobData, ShiftData, TourData } from "../../../src/rightofway/viz/page/assets/payload.d.ts" */

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

/**
 * @param {[number, number][]} charges
 * @returns {TourData}
 */
const tour = (charges) => ({ items: [], load: 0, capacity: 1, charges });

test("the battery of a fleet has the mean and the lowest charge", () => {
  // the first robot drives until 50 and charges then; the second is full; the third has no battery
  const tours = [
    tour([
      [0, 1],
      [50, 0.5],
      [100, 1],
    ]),
    tour([[0, 1]]),
    tour([]),
  ];
  const { mean, lowest } = fleetBattery(tours, 100, 4);
  assert.deepEqual([...lowest], [1, 0.75, 0.5, 0.75, 1]);
  assert.deepEqual([...mean], [1, 0.875, 0.75, 0.875, 1]);
});
