/** A fleet that is driven: how late its robots are, also on other ways than planned. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Driven } from "../../../src/rightofway/viz/page/assets/live/driven.js";
import { Plan } from "../../../src/rightofway/viz/page/assets/plan/plan.js";
import { made } from "../made.js";

/** @import { DrivenRow } from "../../../src/rightofway/viz/page/assets/payload.d.ts" */

const payload = made("door");
const { planned } = new Plan(payload);

/**
 * The first robot after it has driven so many visits, each later than planned, with other vertices from a visit on.
 *
 * @param {number} from
 * @param {number} visits
 * @param {number} late
 */
function driven(from, visits, late) {
  const fleet = new Driven(payload.robots, planned);
  const [robot] = planned;
  const stops = new Set(robot.stages.map(({ visit }) => visit));
  const other = Array.from(robot.vertices, (vertex, visit) =>
    visit >= from && !stops.has(visit) ? 100 + visit : vertex,
  );
  /** @type {DrivenRow[]} */
  const rows = [
    [0, 0, "arrived", 0],
    [0, 0, "route", 0, Array.from(robot.vertices)],
    [0, 0, "route", from, other.slice(from)],
  ];
  let now = 0;
  for (let visit = 1; visit <= visits; visit++) {
    now = robot.enter[visit] + late;
    rows.push([now, 0, "released", visit], [now, 0, "arrived", visit]);
    if (stops.has(visit)) rows.push([robot.leave(visit) + late, 0, "done", visit]);
  }
  fleet.take({ number: 1, now, runs: true, begins: true, rows });
  return { fleet, robot: fleet.robots[0], now };
}

const [{ vertices, enter, stages, completion }] = planned;
const [stop] = stages;

for (let from = 1; from < vertices.length - 1; from++)
  for (const late of [0, 3, 50])
    test(`a robot on another way from visit ${from} on, ${late} late, has a lateness everywhere`, () => {
      for (let visits = from; visits < vertices.length - 1; visits++) {
        const { robot, now } = driven(from, visits, late);
        const found = robot.lateness(now, visits);
        assert.ok(found !== null, `none in visit ${visits}`);
        if (visits === stop.visit) assert.equal(found, late);
        const due = visits < stop.visit ? enter[stop.visit] : completion;
        assert.ok((robot.lateness(due + 90, visits) ?? 0) >= 90, `not overdue in visit ${visits}`);
      }
    });

test("work and turning of a stop are told apart as in the plan", () => {
  const { robot } = driven(1, vertices.length - 1, 3);
  const [worked] = robot.stages;
  const ticks = robot.leave(stop.visit) - robot.enter[stop.visit];
  assert.ok(stop.turn > 0);
  assert.deepEqual([worked.work, worked.turn], [ticks - stop.turn, stop.turn]);
});

test("a jam is told by the robot at its head, with all that wait behind it", () => {
  const fleet = new Driven(Array(5).fill(payload.robots[0]), Array(5).fill(planned[0]));
  /** @type {(tick: number, robot: number, ...others: number[]) => DrivenRow} */
  const wait = (tick, robot, ...others) => [tick, robot, "says", "wait", "waits", others];
  const rows = [wait(2, 1, 0), wait(3, 2, 1), wait(4, 3, 4)];
  fleet.take({ number: 1, now: 9, runs: true, begins: true, rows });
  assert.deepEqual(fleet.holdUpsAt(10), [
    { robot: 0, victims: [1, 2], since: 2, waited: 15 },
    { robot: 4, victims: [3], since: 4, waited: 6 },
  ]);
  assert.deepEqual(fleet.holdUpsAt(1), []);
});

test("of robots that wait for each other none is at the head", () => {
  const fleet = new Driven(Array(2).fill(payload.robots[0]), Array(2).fill(planned[0]));
  /** @type {DrivenRow[]} */
  const rows = [
    [1, 0, "says", "wait", "waits", [1]],
    [1, 1, "says", "wait", "waits", [0]],
  ];
  fleet.take({ number: 1, now: 9, runs: true, begins: true, rows });
  assert.deepEqual(fleet.holdUpsAt(5), []);
});

test("a robot has the job and the charge of the moment shown", () => {
  const fleet = new Driven(payload.robots, planned);
  /** @type {DrivenRow[]} */
  const rows = [
    [0, 0, "arrived", 0],
    [0, 0, "route", 0, Array.from(vertices)],
    [2, 0, "task", "drives to stop 1 of J1"],
    [3, 0, "charge", 57],
    [5, 0, "task", ""],
  ];
  fleet.take({ number: 1, now: 6, runs: true, begins: true, rows });
  assert.deepEqual(fleet.workAt(0, 1), { task: "", percent: null });
  assert.deepEqual(fleet.workAt(0, 4), { task: "drives to stop 1 of J1", percent: 57 });
  assert.deepEqual(fleet.workAt(0, 6), { task: "", percent: 57 });
});
