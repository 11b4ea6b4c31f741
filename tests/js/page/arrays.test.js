import assert from "node:assert/strict";
import { test } from "node:test";
import {
  fromDifferences,
  lastAtMost,
  nearest,
} from "../../../src/rightofway/viz/page/assets/common/arrays.js";

test("first differences add up", () => {
  assert.deepEqual(fromDifferences([3, 1, 2, -6], Int32Array), Int32Array.of(3, 4, 6, 0));
  assert.deepEqual(fromDifferences([], Float64Array), new Float64Array(0));
});

test("the last number at most a limit is found; the first where all are greater", () => {
  const numbers = [0, 2, 2, 5];
  assert.deepEqual(
    [-1, 0, 1.9, 2, 4.9, 5, 9].map((limit) => lastAtMost(numbers, limit)),
    [0, 0, 0, 2, 2, 3, 3],
  );
});

test("the nearest point is found within reach, the later one of two that are as near", () => {
  const [xs, ys] = [
    [0, 2, 4],
    [0, 0, 3],
  ];
  assert.equal(nearest(xs, ys, 0.5, 0, 1), 0);
  assert.equal(nearest(xs, ys, 1, 0, 1), 1); // both are 1 away
  assert.equal(nearest(xs, ys, 4, 0, 1.9), -1); // (2, 0) is 2 away, (4, 3) is 3 away
  assert.equal(nearest(xs, ys, 4, 0, 2), 1);
});
