/** Jobs of a document, and the cells of their table. */

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  headingsOf,
  pasted,
  rowsOfText,
} from "../../../src/rightofway/studio/assets/robots/block.js";
import { JOB_COLUMNS, JOB_TABLE } from "../../../src/rightofway/studio/assets/jobs/columns.js";
import {
  addJobs,
  jobBetween,
  jobsOf,
  stopsOfJob,
  withJobs,
} from "../../../src/rightofway/studio/assets/jobs/jobs.js";
import { COLUMNS, columnOf } from "../../../src/rightofway/studio/assets/robots/columns.js";

const DOCUMENT = {
  map: { grid: ["..."] },
  robots: [
    { name: "R1", home: "N0", target: "N1", work: 3, laps: 2 },
    { name: "R2", home: "N2", stops: [{ at: "N0" }, { at: "N1", work: "1/2" }] },
  ],
};

/** @param {string} key */
const column = (key) => {
  const found = JOB_COLUMNS.find((each) => each.key === key);
  assert.ok(found);
  return found;
};

test("a trip becomes a job of its robot", () => {
  const { robots, jobs } = withJobs(DOCUMENT);
  assert.deepEqual(robots, [
    { name: "R1", home: "N0" },
    { name: "R2", home: "N2" },
  ]);
  assert.deepEqual(jobs, [
    { name: "J1", at: "N1", work: 3, robot: "R1" },
    { name: "J2", stops: [{ at: "N0" }, { at: "N1", work: "1/2" }], robot: "R2" },
  ]);
  assert.equal(withJobs({ ...DOCUMENT, jobs: [] }).robots, DOCUMENT.robots); // it has jobs already
});

test("a job that is drawn gets the first name that no other job has", () => {
  const grown = addJobs({ ...DOCUMENT, jobs: [{ name: "J2" }] }, [jobBetween("N0", "N2", false)]);
  assert.deepEqual(jobsOf(grown)?.[1], { name: "J3", pickup: "N0", dropoff: "N2" });
  assert.deepEqual(jobBetween("N0", "N0", true), { at: "N0" });
});

test("stops of a job are found however they are written", () => {
  assert.deepEqual(stopsOfJob({ pickup: "N0", dropoff: "N1" }), [{ at: "N0" }, { at: "N1" }]);
  assert.deepEqual(stopsOfJob({ at: "N0", work: 2 }), [{ at: "N0", work: 2 }]);
  assert.deepEqual(stopsOfJob({ pickup: "N0" }), [{ at: "N0" }]);
});

test("cells say stops with work and load, and are read as they are written", () => {
  const stops = column("stops");
  const job = {
    stops: [
      { at: "N3", work: 4, load: 2 },
      { at: "N7", load: -2, latest: 9 },
    ],
  };
  assert.equal(stops.text(job), "N3 (4) +2; N7 -2");
  assert.deepEqual(stops.set(job, "N3 (2,5) +1; N8 -1"), {
    stops: [
      { at: "N3", work: 2.5, load: 1 },
      { at: "N8", load: -1, latest: 9 }, // a time that the cell does not show stays
    ],
  });
  assert.deepEqual(stops.set(job, ""), {});
});

test("names stand with commas between, and numbers are read with commas", () => {
  assert.deepEqual(column("after").set({}, "J1, J2"), { after: ["J1", "J2"] });
  assert.equal(column("types").text({ types: ["fork", "cart"] }), "fork, cart");
  assert.deepEqual(column("due").set({}, "4,5"), { due: 4.5 });
  assert.deepEqual(column("due").set({ due: 3 }, ""), {});
});

test("rows with headings are told from cells", () => {
  assert.ok(headingsOf(JOB_TABLE, rowsOfText("name\tpickup\tdropoff\nA\tN0\tN1")));
  assert.equal(headingsOf(JOB_TABLE, rowsOfText("A\tN0\tN1")), null);
  const document = { ...DOCUMENT, jobs: [] };
  const grown = pasted(document, JOB_TABLE, JOB_COLUMNS, [["A", "N0", "N1"]], {
    row: 0,
    column: 0,
  });
  assert.deepEqual(jobsOf(grown), [{ name: "A", pickup: "N0", dropoff: "N1" }]);
});

test("the start of a robot is there as long as something of it is", () => {
  const [start, soc] = ["start", "soc"].map((key) => COLUMNS.find((each) => each.key === key));
  assert.ok(start && soc);
  const begun = soc.set(start.set({ name: "R1" }, "N4"), "0,5");
  assert.deepEqual(begun, { name: "R1", start: { at: "N4", soc: 0.5 } });
  assert.deepEqual(start.set(soc.set(begun, ""), ""), { name: "R1" });
  assert.equal(columnOf({ path: ["robots", 0, "start", "soc"] }), "soc");
});

test("cells keep times of day, and the actions of stops", () => {
  const job = { name: "J", stops: [{ at: "N0", work: 1, actions: ["pick"] }, { at: "N1" }] };
  assert.deepEqual(column("stops").set(job, "N2 (3); N1"), {
    name: "J",
    stops: [{ at: "N2", work: 3, actions: ["pick"] }, { at: "N1" }],
  });
  assert.deepEqual(column("due").set({ name: "J", due: 3 }, "10:30"), { name: "J", due: "10:30" });
  assert.equal(column("due").text({ name: "J", due: "10:30" }), "10:30");
  const [stops, work] = ["stops", "work"].map((key) => COLUMNS.find((each) => each.key === key));
  assert.ok(stops && work);
  const robot = { name: "R1", home: "N0", target: "N1", actions: "wash" };
  assert.deepEqual(work.set(robot, "5"), { ...robot, work: 5 });
  assert.deepEqual(stops.set(robot, "N2"), { ...robot, target: "N2" });
  assert.deepEqual(stops.set(robot, "N2; N0"), {
    name: "R1",
    home: "N0",
    stops: [{ at: "N2", actions: "wash" }, { at: "N0" }],
  });
});
