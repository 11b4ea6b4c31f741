/** Work that comes again. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Plan } from "../../../src/rightofway/viz/page/assets/plan/plan.js";
import { made } from "../made.js";

/** The plan of the counter, perhaps with other groups of robots. */
function steadyOf(groups = made("laps").steady) {
  const { steady } = new Plan({ ...made("laps"), steady: groups });
  assert.ok(steady);
  return steady;
}

test("the circuit takes whole periods", () => {
  const { circuit } = steadyOf().group(null);
  // R1 to N1 at 11, to N0 at 16, when R2 comes to N1; it goes to N2 at 21, when R1 comes to N1
  assert.deepEqual(
    circuit.map(({ begin, next }) => [begin, next]),
    [
      [11, 16],
      [16, 16],
      [16, 21],
      [21, 21],
    ],
  );
});

test("laps are counted, and go on in a loop", () => {
  const steady = steadyOf();
  // R1 comes home at 6, 16, 26 and 36
  assert.deepEqual(
    [5, 17, 26].map((tick) => steady.laps(0, tick)),
    [0, 2, 3],
  );
  assert.equal(steady.lapsForEver(0, 6 + 103), 11); // as at 9, and ten periods of a lap each
});

test("groups keep their own periods", () => {
  const [own] = made("laps").steady ?? [];
  // R2's group is said to repeat from 11 on with 20, as two of its laps do
  const steady = steadyOf([
    { ...own, robots: [0], critical: [] },
    { ...own, robots: [1], start: 11, period: 20, critical: [] },
  ]);
  assert.deepEqual([steady.tickOf(0, 33), steady.tickOf(1, 33)], [13, 13]);
  assert.deepEqual([steady.tickOf(0, 23), steady.tickOf(1, 23)], [13, 23]);
  assert.equal(steady.group(null).start, 6);
});
