import assert from "node:assert/strict";
import { test } from "node:test";
import { Motion } from "../../../src/rightofway/viz/page/assets/plan/motion.js";
import {
  CHARGE,
  DONE,
  DRIVE,
  TURN,
  WAIT,
  WORK,
} from "../../../src/rightofway/viz/page/assets/plan/phases.js";
import { Roadmap } from "../../../src/rightofway/viz/page/assets/plan/roadmap.js";
import { FOLLOWS, Loss, Robot } from "../../../src/rightofway/viz/page/assets/plan/robot.js";

/** Three cells in a row. */
const CORRIDOR = new Roadmap({
  width: 3,
  height: 1,
  frame: { x: 0, y: 0, yUp: false, unit: 1 },
  rows: ["..."],
});

/**
 * At N0 it waits until 1 and drives until 3, goes on to N2 until 5, works there for 2 and turns for 1,
 * waits until 9, and is back at N1 at 11, with nothing left to do.
 */
function robot(index = 0) {
  return new Robot(
    {
      name: "R1",
      colour: "#000000",
      speed: "1/2",
      completion: 11,
      alone: 9,
      lost: [0, 0, 2],
      vertices: [0, 1, 1, -1], // 0 1 2 1
      enter: [0, 3, 2, 6], // 0 3 5 11
      drive: 2,
      stages: [
        [2, 2, 1, 2],
        [1, 0, 0, 3],
      ],
    },
    index,
  );
}

test("a robot does one thing after the other", () => {
  const { begin, activity, visit } = robot().phases;
  assert.deepEqual([...activity], [WAIT, DRIVE, DRIVE, WORK, TURN, WAIT, DRIVE, DONE]);
  assert.deepEqual([...begin], [0, 1, 3, 5, 7, 8, 9, 11]);
  assert.deepEqual([...visit], [0, 0, 1, 2, 2, 2, 2, 3]);
});

test("a phase ends where the next begins, the last one never", () => {
  const { phases } = robot();
  assert.equal(phases.end(0), 1);
  assert.equal(phases.end(7), Infinity);
});

test("a robot that drives is between two vertices, by the share of the time", () => {
  const motion = new Motion({ robots: [robot()], roadmap: CORRIDOR });
  motion.moveTo(2); // half of the drive from 1 to 3
  assert.deepEqual([motion.x[0], motion.y[0]], [0.5, 0]);
  motion.moveTo(6); // half of the work from 5 to 7
  assert.deepEqual([motion.x[0], motion.activity[0], motion.share[0]], [2, WORK, 0.5]);
  motion.moveTo(0.5); // backwards
  assert.deepEqual([motion.x[0], motion.activity[0]], [0, WAIT]);
  assert.deepEqual([...motion.counts], [0, 1, 0, 0, 0, 0, 0, 0]);
});

test("a robot that stands still by itself needs longer for the same work", () => {
  const held = robot();
  held.still = [[6, 8]];
  assert.equal(held.stillIn(5, 2), 2); // works from 5 to 6 and from 8 to 9
  assert.equal(held.stillIn(8, 2), 0);
});

test("a wait for no robot names no second place", () => {
  assert.deepEqual(new Loss([0, 0, null, 4, 4, 5, null, 1, 2, 1, 0]).places, [4]);
  assert.deepEqual(new Loss([0, 0, 1, 4, 4, 5, 6, 1, 2, 1, 0]).places, [4, 6]);
  assert.deepEqual(new Loss([FOLLOWS, 0, 1, 4, 7, 5, 6, 1, 2, 1, 0]).places, [4, 7]);
});

/**
 * It is at its home N0 until 4 and from 10 on for a while, works at N1 from 5 to 7, and charges at N0 from
 * 8 to 9.
 */
function idler() {
  return new Robot(
    {
      name: "R1",
      colour: "#000000",
      speed: "1",
      completion: 12,
      alone: 12,
      lost: [0, 0, 0],
      vertices: [0, 1, -1, 1], // 0 1 0 1
      enter: [0, 5, 3, 4], // 0 5 8 12
      drive: 1,
      stages: [
        [1, 2, 0, 1],
        [0, 1, 0, 2],
      ],
      begins: [5, 8],
      charges: [1],
      idles: true,
    },
    0,
  );
}

test("a robot of a shift has nothing to do where it stays at home, and charges do not count as work", () => {
  const { activity, begin } = idler().phases;
  assert.deepEqual([...activity], [DONE, DRIVE, WORK, DRIVE, CHARGE, DONE, DRIVE, DONE]);
  assert.deepEqual([...begin], [0, 4, 5, 7, 8, 9, 11, 12]);
});

test("the route that is shown of a robot of a shift leads from its last stop to the one after the next", () => {
  assert.deepEqual(
    [0, 1, 2, 3].map((visit) => idler().span(visit)),
    [
      [0, 2],
      [1, 3],
      [2, 3],
      [2, 3],
    ],
  );
  assert.deepEqual(robot().span(1), [0, 3]);
});
