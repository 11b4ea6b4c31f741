/** Sentences about a plan. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { Words } from "../../../src/rightofway/viz/page/assets/words.js";

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
