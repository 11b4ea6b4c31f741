import assert from "node:assert/strict";
import { test } from "node:test";
import { Corridor, shortestWay } from "../../../src/rightofway/viz/page/assets/corridor.js";
import { Roadmap, pointAlong } from "../../../src/rightofway/viz/page/assets/roadmap.js";

const FRAME = { x: 10, y: 20, yUp: true, unit: 0.5 };

/** A and B with a lane both ways of 2, and one way on to C of 3; D is alone. */
const NETWORK = new Roadmap(
  {
    width: 3,
    height: 1,
    frame: FRAME,
    names: ["A", "B", "C", "D"],
    points: [0, 0, 1, 0, 2, 0, 2, 1],
    tails: [0, 1, 0], // 0 1 1
    heads: [1, -1, 2], // 1 0 2
    lengths: [2, 2, 3],
    limits: [["0.5", [2]]],
  },
  "m",
);

test("lanes are sorted into those for one way and for both", () => {
  assert.deepEqual(NETWORK.lanes, { oneWay: [[1, 2]], bothWays: [[0, 1]] });
  assert.deepEqual(NETWORK.lonely, [3]);
  assert.deepEqual(NETWORK.limits, [{ tail: 1, head: 2, limit: "0.5" }]);
});

test("a place of the site is where it is drawn, and back", () => {
  assert.deepEqual(NETWORK.toSite(2, 4), [11, 18]); // y grows upwards there, a unit is 0.5
  assert.deepEqual(NETWORK.toDrawing(11, 18), [2, 4]);
});

test("cells of a grid are numbered row by row, walls left out", () => {
  const grid = new Roadmap({ width: 3, height: 2, frame: { ...FRAME }, rows: [".@.", "..."] });
  assert.deepEqual([...grid.cells], [0, 2, 3, 4, 5]);
  assert.equal(grid.name(1), "N2");
  assert.equal(grid.vertexNamed("N2"), 1);
  assert.equal(grid.vertexNamed("N1"), -1);
  assert.equal(grid.vertexNamed(null), -1);
  assert.deepEqual(grid.next(0), [2]); // right is a wall
  assert.equal(grid.near(0.4, 0.6), 2);
});

test("the shortest way is that of the lanes, or the way back", () => {
  assert.deepEqual(shortestWay(NETWORK, 0, 2), [0, 1, 2]);
  assert.deepEqual(shortestWay(NETWORK, 2, 0), [2, 1, 0]); // only 0 to 2 can be driven
  assert.equal(shortestWay(NETWORK, 0, 3), null);
});

test("a corridor has each way once, at its length", () => {
  const corridor = new Corridor(NETWORK, [0, 1, 2, 1, 0]);
  assert.equal(corridor.length, 5);
  assert.deepEqual(
    corridor.entries.map(({ vertex, at }) => [vertex, at]),
    [
      [0, 0],
      [1, 2],
      [2, 5],
    ],
  );
  assert.equal(corridor.way(0, 2), null);
});

test("a point along a line is found by the share of its length", () => {
  const line = {
    points: [
      [0, 0],
      [4, 0],
      [4, 4],
    ],
    shares: [0, 0.5, 1],
  };
  assert.deepEqual(pointAlong(line, 0.25), [2, 0, 0]);
  assert.deepEqual(pointAlong(line, 0.75), [4, 2, Math.PI / 2]);
});
