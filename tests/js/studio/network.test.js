/** Edits of a roadmap in a document. */

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  addLane,
  bendLane,
  mapVertices,
  removeVertices,
  renameVertex,
  splitLane,
} from "../../../src/rightofway/studio/assets/draw/network.js";

const DOCUMENT = {
  map: {
    roadmap: {
      vertices: { A: [0, 0], B: [4, 0], C: { at: [4, 2] } },
      edges: [["A", "B"], { from: "B", to: "C", both_ways: false }],
      stations: { Press: "C" },
      zones: [{ name: "z", vertices: ["A"], edges: [["A", "B"]] }],
    },
  },
  robots: [{ name: "R1", home: "A", target: "C" }],
  closures: [{ edge: ["B", "A"], until: 9 }],
};

test("a vertex is renamed wherever it is named", () => {
  const { map, robots, closures } = renameVertex(DOCUMENT, "A", "Start");
  assert.deepEqual(Object.keys(map.roadmap.vertices), ["Start", "B", "C"]);
  assert.deepEqual(map.roadmap.edges[0], ["Start", "B"]);
  assert.deepEqual(map.roadmap.zones, [
    { name: "z", vertices: ["Start"], edges: [["Start", "B"]] },
  ]);
  assert.equal(robots[0].home, "Start");
  assert.deepEqual(closures, [{ edge: ["B", "Start"], until: 9 }]);
  assert.equal(renameVertex(DOCUMENT, "A", "B"), DOCUMENT); // that name is taken
});

test("vertices go with their lanes, stations, zones and closures", () => {
  const { map, closures } = removeVertices(DOCUMENT, ["A", "C"]);
  assert.deepEqual(map.roadmap.vertices, { B: [4, 0] });
  assert.deepEqual([map.roadmap.edges, map.roadmap.stations, map.roadmap.zones], [[], {}, []]);
  assert.deepEqual(closures, []);
});

test("a lane is split with its zone and its closure", () => {
  const { map, closures } = splitLane(DOCUMENT, 0, 0.25, "V");
  assert.deepEqual(map.roadmap.vertices.V, [1, 0]); // a quarter of 4
  assert.deepEqual(map.roadmap.edges.slice(0, 2), [
    ["A", "V"],
    ["V", "B"],
  ]);
  assert.deepEqual(map.roadmap.zones[0].edges, [
    ["A", "V"],
    ["V", "B"],
  ]);
  assert.deepEqual(
    closures.map(({ edge }) => edge),
    [
      ["B", "V"],
      ["V", "A"],
    ],
  );
});

test("a lane is bent, straightened, and its curve goes with both ends", () => {
  const bent = bendLane(DOCUMENT, 0, [[2, 1]]);
  assert.deepEqual(bent.map.roadmap.edges[0], { from: "A", to: "B", curve: [[2, 1]] });
  assert.deepEqual(bendLane(bent, 0, []).map.roadmap.edges[0], ["A", "B"]);
  const moved = mapVertices(bent, ["A", "B"], ([x, y]) => [x + 1, y + 1]);
  assert.deepEqual(moved.map.roadmap.edges[0].curve, [[3, 2]]);
});

test("a lane that is there is not added again, the other way of a one-way lane is", () => {
  assert.equal(addLane(DOCUMENT, "B", "A", true), DOCUMENT);
  const { edges } = addLane(DOCUMENT, "C", "B", false).map.roadmap;
  assert.deepEqual(edges.at(-1), { from: "C", to: "B", both_ways: false });
});
