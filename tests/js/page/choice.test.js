/** Which robots are shown. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Choice } from "../../../src/rightofway/viz/page/assets/player/choice.js";
import { Clock } from "../../../src/rightofway/viz/page/assets/player/clock.js";
import { Motion } from "../../../src/rightofway/viz/page/assets/plan/motion.js";
import { Use } from "../../../src/rightofway/viz/page/assets/plan/use.js";
import { Plan } from "../../../src/rightofway/viz/page/assets/plan/plan.js";
import { made, planOf } from "../made.js";

test("a choice shows the plan or the floor and writes nothing into the plan", () => {
  const plan = planOf("late");
  Object.freeze(plan);
  const choice = new Choice(plan);
  assert.equal(choice.mode, "both");
  assert.equal(choice.robots, plan.happened);
  choice.show("plan");
  assert.equal(choice.robots, plan.planned);
  choice.show("floor");
  assert.equal(choice.robots, plan.happened);
});

test("robots with an alarm are marked like those with a fault", () => {
  const choice = new Choice(planOf("late"));
  assert.deepEqual(choice.faulty, []);
  choice.alarmed = () => [1];
  assert.deepEqual(choice.faulty, [1]);
});

test("the robot chosen is the one that is shown", () => {
  const plan = planOf("late");
  const choice = new Choice(plan);
  choice.chooseRobot(1);
  assert.equal(choice.robot, plan.happened?.[1]);
  choice.show("plan");
  assert.equal(choice.robot, plan.planned[1]);
});

test("two views of one plan show what each has chosen", () => {
  const plan = planOf("late");
  const [one, other] = [new Choice(plan), new Choice(plan)];
  one.show("plan");
  const [first, second] = [new Motion(one), new Motion(other)];
  // At 8 R1 still works in N1, where R2 should be; R2 waits in N2, and R1 should be at home.
  for (const motion of [first, second]) motion.moveTo(8);
  assert.deepEqual([...first.x], [0, 1]);
  assert.deepEqual([...second.x], [1, 2]);
});

test("positions, events and use of vertices follow the robots shown", () => {
  const plan = planOf("late");
  const choice = new Choice(plan);
  const [motion, clock, use] = [new Motion(choice), new Clock(plan, choice), new Use(choice)];
  motion.moveTo(8);
  clock.seek(5);
  clock.stepEvent(1, null); // R1 works on at 7
  // N1 is held from 1 to 10, 10 to 15 and 15 to 20; who stays for ever is not counted
  assert.deepEqual([motion.x[0], clock.tick, use.held[1]], [1, 7, 9 + 5 + 5]);
  choice.show("plan");
  motion.moveTo(8);
  clock.seek(5);
  clock.stepEvent(1, null); // R2 comes to N1 when R1 is home, at 6; it is held for 5 in each of 8 laps
  assert.deepEqual([motion.x[0], clock.tick, use.held[1]], [0, 6, 40]);
});

test("a job is chosen with the robot that does it, one that nobody does without a robot", () => {
  const choice = new Choice(planOf("jobs"));
  choice.chooseJob(0);
  assert.deepEqual([choice.job?.name, choice.robotIndex], ["J1", 0]);
  choice.chooseJob(3);
  assert.deepEqual([choice.job?.name, choice.robotIndex], ["J4", -1]);
  choice.chooseRobot(1);
  assert.equal(choice.job, null);
});

test("a robot waits until the work of its job begins", () => {
  const [{ phases }] = planOf("jobs").planned;
  // R1 comes to N1 at 1 and works there from 3 to 5.
  const spans = Array.from(phases.visit.keys(), (i) => [phases.begin[i], phases.activity[i]]);
  assert.deepEqual(spans.filter((_, i) => phases.visit[i] === 1).slice(0, 2), [
    [1, 1],
    [3, 2],
  ]);
});

test("on the floor a robot begins its work when it comes, whenever the plan had it begin", () => {
  const raw = made("jobs");
  const robots = raw.robots.map(({ stages, enter }) => ({
    stages,
    enter,
    drive: enter.map(() => 1),
    still: /** @type {[number, number | null][]} */ ([]),
    completion: 15,
  }));
  const { happened } = new Plan({ ...raw, floor: { end: 15, robots, losses: [] } });
  const { phases } = present(happened)[0];
  const first = phases.visit.indexOf(1); // at N1, where the plan has it wait from 1 to 3
  assert.deepEqual([phases.begin[first], phases.activity[first]], [1, 2]);
});

/**
 * @template T
 * @param {T | null} value
 * @returns {T}
 */
function present(value) {
  assert.ok(value);
  return value;
}
