/** Where a vertex comes to lie: in line with others, else at round lengths. */

import assert from "node:assert/strict";
import { test } from "node:test";
import { roundStep, snapped } from "../../../src/rightofway/studio/assets/draw/snapping.js";

/** @import { DrawnOn } from "../../../src/rightofway/studio/assets/draw/snapping.js" */
/** @import { ScenarioDocument } from "../../../src/rightofway/studio/assets/types.js" */

/** @type {DrawnOn["roadmap"]} */
const roadmap = { unit: 1, toSite: (x, y) => [x, y] };
const stage = { view: { viewport: { scale: 20 } } }; // a pixel is 0.05 length units
/** @type {ScenarioDocument} */
const document = { map: { roadmap: { vertices: { A: [2.03, 7] }, edges: [] } }, robots: [] };
const editor = { roadmap, stage, document };

test("the step is the power of ten below 24 pixels", () => {
  assert.equal(roundStep(editor), 1); // 24 pixels are 1.2 length units
});

test("a point within eight pixels keeps in line with a vertex", () => {
  const { at, guides } = snapped({ x: 2.3, y: 3.6 }, editor);
  assert.deepEqual(at, [2.03, 4]); // 0.27 is within 0.4; 3.6 is not near 7
  assert.deepEqual(guides, [
    [
      [2.03, 7],
      [2.03, 4],
    ],
  ]);
});

test("nothing holds a point that is set free, nor what is moved itself", () => {
  assert.deepEqual(snapped({ x: 2.3, y: 3.6, isFree: true }, editor).at, [2.3, 3.6]);
  assert.deepEqual(snapped({ x: 2.3, y: 3.6 }, editor, ["A"]).at, [2, 4]);
});
