import assert from "node:assert/strict";
import { test } from "node:test";
import { DRIVE } from "../../../src/rightofway/viz/page/assets/plan/phases.js";
import { Corridor, shortestWay } from "../../../src/rightofway/viz/page/assets/plan/corridor.js";
import { Roadmap, pointAlong } from "../../../src/rightofway/viz/page/assets/plan/roadmap.js";
import { CorridorAxis } from "../../../src/rightofway/viz/page/assets/timetable/space_axis.js";
import { roundLength } from "../../../src/rightofway/viz/page/assets/drawing/scale_bar.js";
import { planOf } from "../made.js";

const FRAME = { x: 10, y: 20, yUp: true, unit: 0.5 };

/** @import { Area } from "../../../src/rightofway/viz/page/assets/timetable/axis.js" */
/** @import { Curve } from "../../../src/rightofway/viz/page/assets/plan/roadmap.js" */

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
  /** @type {Curve} */
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

/**
 * The sections of a corridor: vertex and distance of each entry, from below.
 *
 * @param {string} name
 * @param {number[]} route
 */
function sectionsOf(name, route) {
  return new Corridor(planOf(name).roadmap, route).sections.map((section) =>
    section.map(({ vertex, at }) => [vertex, at]),
  );
}

test("in a corridor the way back is the way there", () => {
  // N0, N1, N4, N7, N6 of the door, a cell each
  assert.deepEqual(sectionsOf("door", [0, 1, 3, 5, 4, 5, 3, 1, 0]), [
    [
      [0, 0],
      [1, 1],
      [3, 2],
      [5, 3],
      [4, 4],
    ],
  ]);
});

test("a corridor that is a loop ends where it began", () => {
  // dock, gate, press, paint and dock again: 4, 3, 4 and 3 metres
  assert.deepEqual(sectionsOf("yard", [0, 1, 2, 3, 0, 1, 2]), [
    [
      [0, 0],
      [1, 4],
      [2, 7],
      [3, 11],
      [0, 14],
    ],
  ]);
});

test("what lies the other way from home is below it; a branch begins a section", () => {
  assert.deepEqual(sectionsOf("door", [1, 0, 1, 2]), [
    [
      [2, 0],
      [1, 1],
      [0, 2],
    ],
  ]);
  // from N1 to N0, N2 and N4: the third way from N1 has no room beside the first two
  assert.deepEqual(sectionsOf("door", [0, 1, 2, 1, 3]), [
    [
      [0, 0],
      [1, 1],
      [2, 2],
    ],
    [
      [1, 2],
      [3, 3],
    ],
  ]);
});

test("a corridor against one-way lanes is found the other way", () => {
  const { roadmap } = planOf("yard");
  // from paint only the dock can be driven to, 3 m; from the press, paint: 4 m
  assert.deepEqual(shortestWay(roadmap, 3, 2), [3, 0, 1, 2]);
  assert.deepEqual(shortestWay(roadmap, 2, 0), [2, 3, 0]);
});

test("slopes along a corridor are speeds", () => {
  const { roadmap, robots } = planOf("loop");
  const [{ vertices, phases }] = robots;
  const area = /** @type {Area} */ ({ bottom: 300, height: 280 });
  const axis = new CorridorAxis(new Corridor(roadmap, vertices), area);
  // the cart drives 1, 1, 3/2 and 1 time units for 2, 2, 3 and 2 length units, a tick is half a unit
  const slopes = [...phases.activity].flatMap((activity, i) => {
    if (activity !== DRIVE) return [];
    const visit = phases.visit[i];
    const way = axis.way(vertices[visit], vertices[visit + 1]);
    assert.ok(way);
    const ticks = phases.end(i) - phases.begin[i];
    return [Math.abs(way.from.y - way.to.y) / axis.perLength / ticks];
  });
  assert.equal(slopes.length, 4);
  for (const slope of slopes) assert.ok(Math.abs(slope - 1) < 1e-6);
});

test("one-way lanes of a plan and those for both ways are told apart", () => {
  assert.deepEqual(planOf("yard").roadmap.lanes, {
    oneWay: [
      [1, 2],
      [2, 3],
      [3, 0],
    ],
    bothWays: [[0, 1]],
  });
});

test("a scale bar is the longest round length of at most 130 pixels", () => {
  assert.deepEqual(
    [0.9, 4, 13].map((longest) => roundLength(longest / 130)),
    [0.5, 2, 10],
  );
});
