import assert from "node:assert/strict";
import { test } from "node:test";
import { MapSizes } from "../../../src/rightofway/viz/page/assets/map/map_sizes.js";

/** @import { Robot } from "../../../src/rightofway/viz/page/assets/plan/robot.js" */
/** @import { Site } from "../../../src/rightofway/viz/page/assets/plan/site.js" */
/** @import { Viewport } from "../../../src/rightofway/viz/page/assets/drawing/viewport.js" */

/**
 * Half the side of a home on a grid of 161 by 63 cells, and the radius of a robot [pixels].
 *
 * @param {number} robots
 * @param {number} scale pixels for a cell
 */
function sizesOf(robots, scale) {
  const roadmap = { width: 161, height: 63, rows: 63, hasCells: true, unit: 1 };
  const fleet = Array.from({ length: robots }, () => ({ radius: 0 }));
  const site = /** @type {Site} */ (
    /** @type {unknown} */ ({ roadmap, robots: fleet, largestRadius: 0 })
  );
  const sizes = new MapSizes(site, /** @type {Viewport} */ ({ scale }));
  const robot = /** @type {Robot} */ (/** @type {unknown} */ (fleet[0]));
  return { home: sizes.homeOf(robot), robot: sizes.of(robot) };
}

test("homes of many robots stay within their cells, or are as small as can be seen", () => {
  for (const robots of [101, 400, 1000])
    for (const scale of [2, 6.4, 10, 20, 60])
      assert.ok(sizesOf(robots, scale).home <= Math.max(scale / 2, 3), `${robots} at ${scale}`);
});

test("homes of few robots can be seen round them, whatever the size of a cell", () => {
  for (const scale of [2, 6.4, 10, 20, 60]) {
    const { home, robot } = sizesOf(20, scale);
    assert.ok(home > robot, `at ${scale}`);
  }
});
