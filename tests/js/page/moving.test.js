/** Where robots are and what they do, of plans that the package gives. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Motion } from "../../../src/rightofway/viz/page/assets/plan/motion.js";
import {
  DONE,
  DRIVE,
  HELD,
  TURN,
  WAIT,
  WORK,
} from "../../../src/rightofway/viz/page/assets/plan/phases.js";
import { Plan } from "../../../src/rightofway/viz/page/assets/plan/plan.js";
import { made, planOf, positions } from "../made.js";

const ACTIVITIES = ["drive", "wait", "work", "turn", "done"];

/** @import { Robot } from "../../../src/rightofway/viz/page/assets/plan/robot.js" */

/**
 * When each phase begins, what it is, and in which visit.
 *
 * @param {Robot} robot
 */
function phasesOf({ phases: { begin, activity, visit } }) {
  return Array.from(begin, (tick, i) => [tick, activity[i], visit[i]]);
}

for (const name of ["door", "loop", "crowd"])
  test(`the page has the robots of the ${name} where the pictures have them`, () => {
    const { payload, moments } = positions()[name];
    const motion = new Motion(new Plan(payload));
    for (const { tick, robots } of moments) {
      motion.moveTo(tick);
      for (const [index, [x, y, activity]] of robots.entries()) {
        assert.ok(Math.abs(motion.x[index] - x) < 1e-3, `x of robot ${index} at ${tick}`);
        assert.ok(Math.abs(motion.y[index] - y) < 1e-3, `y of robot ${index} at ${tick}`);
        assert.equal(ACTIVITIES[motion.activity[index]], activity);
      }
    }
  });

test("a robot turns at corners and at stops, and does not wait there", () => {
  // at 45 degrees per time unit: 2 for a corner, 4 to come back
  assert.deepEqual(phasesOf(planOf("corner").robots[0]), [
    [0, DRIVE, 0],
    [1, DRIVE, 1],
    [2, TURN, 2],
    [4, DRIVE, 2],
    [5, WORK, 3],
    [8, TURN, 3],
    [12, DRIVE, 3],
    [13, TURN, 4],
    [15, DRIVE, 4],
    [16, DRIVE, 5],
    [17, DONE, 6],
  ]);
});

test("turns of a late robot take their share of its stay", () => {
  // twice as long for all: the turn at the first corner lasts 4, from 4 to 8
  assert.deepEqual(phasesOf(planOf("corner_late").robots[0]).slice(0, 7), [
    [0, DRIVE, 0],
    [2, DRIVE, 1],
    [4, TURN, 2],
    [8, DRIVE, 2],
    [10, WORK, 3],
    [16, TURN, 3],
    [24, DRIVE, 3],
  ]);
});

test("what holds a robot up interrupts its work", () => {
  // R1 works from 1, stands still from 3 to 7, works on until 8, turns, and drives home at 9
  const found = phasesOf(planOf("late").robots[0]).map(([tick, activity]) => [tick, activity]);
  assert.deepEqual(found.slice(0, 7), [
    [0, DRIVE],
    [1, WORK],
    [3, HELD],
    [7, WORK],
    [8, TURN],
    [9, DRIVE],
    [10, TURN],
  ]);
  assert.deepEqual(found.slice(-2), [
    [20, TURN],
    [21, WAIT],
  ]);
});

test("robots are where the next period has them", () => {
  const motion = new Motion(planOf("laps"));
  for (const tick of [6, 7.5, 10.25, 15.9]) {
    motion.moveTo(tick);
    const before = [...motion.x, ...motion.activity];
    motion.moveTo(tick + 10);
    assert.deepEqual(
      [...motion.x, ...motion.activity].map((value) => Math.round(value * 1e9)),
      before.map((value) => Math.round(value * 1e9)),
    );
  }
});

test("while time runs on nobody is searched for in a plan; a jump back searches", () => {
  const plan = planOf("door");
  const [robot] = plan.robots;
  // A phase for each tick until a million: a search by halves looks at some twenty of them.
  const begin = Array.from({ length: 2 ** 20 }, (_, tick) => tick);
  let looks = 0;
  const watched = new Proxy(begin, {
    get(target, key, receiver) {
      if (typeof key === "string" && /^\d+$/.test(key)) looks++;
      return Reflect.get(target, key, receiver);
    },
  });
  const phases = Object.create(robot.phases, {
    begin: { value: watched },
    activity: { value: begin.map(() => WAIT) },
    visit: { value: begin.map(() => 0) },
    end: { value: (/** @type {number} */ phase) => phase + 1 },
  });
  const slow = Object.create(robot, { phases: { value: phases } });
  const motion = new Motion({ robots: [slow], roadmap: plan.roadmap });
  motion.moveTo(500_000);
  looks = 0;
  motion.moveTo(500_001);
  assert.ok(looks <= 6, `${looks} looks for the next phase`);
  looks = 0;
  motion.moveTo(3);
  assert.ok(looks >= 20, `${looks} looks after a jump`);
});

test("a robot that goes another way than planned has no lateness", () => {
  const plan = new Plan(made("rerouted"));
  const [robot] = plan.happened ?? [];
  // R1 turns back in N1: by plan it leaves N1 at 3, so at 5 it is 2 late; at 6 it is home
  assert.equal(robot.lateness(5, 1), 2);
  assert.equal(robot.lateness(6, 2), null);
});
