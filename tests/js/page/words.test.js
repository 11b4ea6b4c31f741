/** Sentences about a plan. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Words } from "../../../src/rightofway/viz/page/assets/words.js";
import { Use } from "../../../src/rightofway/viz/page/assets/use.js";
import { planOf } from "../made.js";

/** @import { Theme } from "../../../src/rightofway/viz/page/assets/theme.js" */

/** Three cells of a measured floor: N0 is the home of R1, N1 has a station, N2 nothing. */
const R1 = { name: "R1", home: 0 };
const PLAN = {
  robots: [R1, { name: "R2" }],
  planned: [R1],
  stops: new Map(),
  quantities: { duration: (ticks) => `${ticks} s` },
  roadmap: {
    isMeasured: true,
    stations: new Map([[1, ["Press"]]]),
    name: (vertex) => `N${vertex}`,
    where: (vertex) => `(${vertex}.5, 0.5)`,
    label: (vertex) => (vertex === 1 ? "Press" : `(${vertex}.5, 0.5)`),
  },
};

test("a cell of a measured floor has its number beside its name, as in tables", () => {
  const words = new Words(PLAN);
  assert.deepEqual(
    [0, 1, 2].map((vertex) => words.vertex(vertex)),
    ["the home of R1 (N0)", "Press (N1)", "N2 (2.5, 0.5)"],
  );
  assert.equal(words.where(0), "N0 (0.5, 0.5)");
  assert.equal(words.short(2), "(2.5, 0.5)");
});

test("a delay is no second point in time", () => {
  assert.equal(new Words(PLAN).cost({ ticks: 6 }), "loses 6 s");
});

test("of an only choice it is said what the other one leads to", () => {
  const decision = { level: "only", robots: [0, 1], waits: 0, completionSums: null };
  assert.equal(
    new Words(PLAN).reason(decision),
    "R2 cannot wait here: with the decisions taken before, no plan is possible then.",
  );
});

test("a decision is explained with the figures of both choices", () => {
  const decision = {
    kind: "vertex",
    vertices: [2],
    robots: [0, 1],
    waits: 1,
    waitsAt: 2,
    ticks: 3,
    level: "robot",
    conflictsLeft: [4, 4],
    completionSums: [60, 47],
  };
  const said = new Words({
    ...PLAN,
    quantities: { duration: (ticks) => `${ticks} s`, short: (ticks) => `${ticks} s` },
  }).explained(decision);
  assert.match(said, /R2 waits 3 s in N2 /);
  assert.equal(
    said.slice(said.indexOf("Conflicts left")),
    "Conflicts left: 4 if R1 waits, 4 if R2 waits. " +
      "Sum of completion times: 60 s if R1 waits, 47 s if R2 waits.",
  );
});

test("a closure is said with its lane and its times", () => {
  const plan = planOf("closed");
  assert.equal(plan.closures.length, 1);
  assert.equal(
    new Words(plan).closure(plan.closures[0]),
    "C to D closed from time 8 until time 24",
  );
});

test("homes and stops are called after their robots, stations keep their names", () => {
  const words = new Words(planOf("measured"));
  assert.deepEqual(
    [0, 1, 2, 3, 4, 5, 6].map((vertex) => words.vertex(vertex)), // N0, N1, N2, N4, N6, N7 and N8
    [
      "the home of R1 (N0)",
      "N1 (1.5,\u00a00.5)",
      "the home of R2 (N2)",
      "N4 (1.5,\u00a01.5)",
      "the stop of R1 (N6)",
      "N7 (1.5,\u00a02.5)",
      "the stop of R2 (N8)",
    ],
  );
  assert.equal(new Words(planOf("yard")).vertex(0), "dock");
});

test("the heat map is linear in the time that a vertex is held", () => {
  const use = new Use(planOf("door"));
  // N1 is held for 4 ticks in all: a tick by each robot, out and back; N0, N6, N8 for 2
  assert.deepEqual([...use.held], [2, 4, 1, 4, 2, 4, 2]);
  const theme = { heatLow: "#000000", heatHigh: "#ffffff" };
  assert.equal(use.heat(0, /** @type {Theme} */ (theme)), "#808080"); // half as long as N1
  assert.equal(use.heat(1, /** @type {Theme} */ (theme)), "#ffffff");
});
