/** Bookings of robots, and how near they come. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { crossingOf } from "../../../src/rightofway/viz/page/assets/map/map_marks.js";
import { Motion } from "../../../src/rightofway/viz/page/assets/plan/motion.js";
import { Space } from "../../../src/rightofway/viz/page/assets/plan/space.js";
import { planOf } from "../made.js";

/**
 * The bookings of a plan at a time [time unit].
 *
 * @param {string} name
 * @param {number} time
 */
function spaceAt(name, time) {
  const plan = planOf(name);
  const motion = new Motion(plan);
  motion.moveTo((time * plan.tick.denominator) / plan.tick.numerator);
  return { plan, space: new Space(plan, motion) };
}

test("a robot books what it drives on, from and to", () => {
  /**
   * @param {number} robot
   * @param {number} time
   */
  const held = (robot, time) => {
    const { plan, space } = spaceAt("cross", time);
    const { vertices, edges } = space.heldBy(plan.robots[robot]);
    /** @param {number[]} named */
    const names = (named) => named.map((vertex) => plan.roadmap.name(vertex)).join("");
    return [names(vertices), ...edges.map(names)];
  };
  assert.deepEqual(held(0, 3), ["AB", "AB"]);
  assert.deepEqual(held(1, 3), ["C"]);
  assert.deepEqual(held(1, 9), ["CD", "CD"]);
  assert.deepEqual(held(0, 9), ["B"]);
});

test("the closest approach is exact", () => {
  const { plan, space } = spaceAt("cross", 0);
  const [{ distance, room, other }] = space.encounters(plan.robots[0]);
  // R1 is nearest to C, where R2 waits, at (4, 0): 4 m; they need 1 + 1/2 + 1/10
  assert.ok(Math.abs(distance - 4) < 1e-9);
  assert.ok(Math.abs(room - 1.6) < 1e-9);
  assert.equal(other.name, "R2");
});

test("closest approaches in a plan are never below what robots need", () => {
  const { plan, space } = spaceAt("packed", 0); // the planner keeps to it; the page measures by itself
  const spare = plan.robots
    .flatMap((robot) => space.encounters(robot))
    .map(({ distance, room }) => distance - room);
  assert.equal(spare.length, 12); // each of four with each other one
  assert.ok(Math.min(...spare) > -1e-9);
});

test("a zone is held by the robot in it, until it has left", () => {
  /** @param {number} time */
  const holders = (time) =>
    [...spaceAt("aisle", time).space.zoneHolders].map(([zone, { name }]) => [zone, name]);
  assert.deepEqual(holders(0), [[0, "R2"]]);
  assert.deepEqual(holders(16), []); // it has left the lane and C
});

test("lanes cross where they cross", () => {
  const { roadmap } = planOf("cross");
  assert.ok(roadmap.close);
  const found = roadmap.close.crossings.map((lanes) => crossingOf(roadmap, lanes));
  assert.deepEqual(
    found.map(([x, y]) => roadmap.toSite(x, y)),
    [[4, 0]],
  );
});
