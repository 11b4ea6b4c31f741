/** Edits of a roadmap in a document. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { writtenIn } from "../../../src/rightofway/studio/assets/robots/fleet.js";
import {
  addLane,
  bendLane,
  isPassed,
  mapVertices,
  removeVertices,
  renameVertex,
  roadmapOf,
  splitLane,
  togglePass,
} from "../../../src/rightofway/studio/assets/draw/network.js";

/** @import { ScenarioDocument } from "../../../src/rightofway/studio/assets/types.js" */

/** @type {ScenarioDocument} */
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
  const renamed = renameVertex(DOCUMENT, "A", "Start");
  const { vertices, edges, zones } = roadmapOf(renamed);
  assert.deepEqual(Object.keys(vertices), ["Start", "B", "C"]);
  assert.deepEqual(edges[0], ["Start", "B"]);
  assert.deepEqual(zones, [{ name: "z", vertices: ["Start"], edges: [["Start", "B"]] }]);
  assert.equal(writtenIn(renamed)[0].home, "Start");
  assert.deepEqual(renamed.closures, [{ edge: ["B", "Start"], until: 9 }]);
  assert.equal(renameVertex(DOCUMENT, "A", "B"), DOCUMENT); // that name is taken
});

test("vertices go with their lanes, stations, zones and closures", () => {
  const left = removeVertices(DOCUMENT, ["A", "C"]);
  const { vertices, edges, stations, zones } = roadmapOf(left);
  assert.deepEqual(vertices, { B: [4, 0] });
  assert.deepEqual([edges, stations, zones], [[], {}, []]);
  assert.deepEqual(left.closures, []);
});

test("a lane is split with its zone and its closure", () => {
  const split = splitLane(DOCUMENT, 0, 0.25, "V");
  const { vertices, edges, zones } = roadmapOf(split);
  assert.deepEqual(vertices.V, [1, 0]); // a quarter of 4
  assert.deepEqual(edges.slice(0, 2), [
    ["A", "V"],
    ["V", "B"],
  ]);
  assert.deepEqual(zones?.[0].edges, [
    ["A", "V"],
    ["V", "B"],
  ]);
  assert.deepEqual(
    split.closures?.map(({ edge }) => edge),
    [
      ["B", "V"],
      ["V", "A"],
    ],
  );
});

test("a lane is bent, straightened, and its curve goes with both ends", () => {
  const bent = bendLane(DOCUMENT, 0, [[2, 1]]);
  assert.deepEqual(roadmapOf(bent).edges[0], { from: "A", to: "B", curve: [[2, 1]] });
  assert.deepEqual(roadmapOf(bendLane(bent, 0, [])).edges[0], ["A", "B"]);
  const moved = mapVertices(bent, ["A", "B"], ([x, y]) => [x + 1, y + 1]);
  assert.deepEqual(roadmapOf(moved).edges[0], { from: "A", to: "B", curve: [[3, 2]] });
});

test("a lane that is there is not added again, the other way of a one-way lane is", () => {
  assert.equal(addLane(DOCUMENT, "B", "A", true), DOCUMENT);
  const { edges } = roadmapOf(addLane(DOCUMENT, "C", "B", false));
  assert.deepEqual(edges.at(-1), { from: "C", to: "B", both_ways: false });
});

test("robots only drive through a vertex, or may stop there again", () => {
  for (const name of ["A", "C"]) {
    const passed = togglePass(DOCUMENT, name);
    assert.equal(isPassed(DOCUMENT, name), false);
    assert.equal(isPassed(passed, name), true);
    assert.deepEqual(
      togglePass(passed, name).map.roadmap?.vertices[name],
      name === "A" ? [0, 0] : [4, 2],
    );
  }
  const { vertices } = roadmapOf(togglePass(DOCUMENT, "A"));
  assert.deepEqual(vertices.A, { at: [0, 0], pass: true });
  assert.deepEqual(Object.keys(vertices), ["A", "B", "C"]);
  assert.equal(isPassed(DOCUMENT, "unknown"), false);
});
