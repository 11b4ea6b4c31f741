import assert from "node:assert/strict";
import { test } from "node:test";
import { labelStep, paintAxis } from "../../../src/rightofway/viz/page/assets/timetable/axis.js";
import { Quantities } from "../../../src/rightofway/viz/page/assets/language/quantities.js";

/**
 * Labels at the first three moments after the begin.
 *
 * @param {[number, number]} tick
 * @param {string | null} time
 * @param {number} least
 * @param {boolean} hasMarks
 */
function labels([numerator, denominator], time, least, hasMarks) {
  const quantities = new Quantities({ length: null, time }, [numerator, denominator]);
  const [top, bottom] = labelStep(
    least,
    { tick: { numerator, denominator }, quantities },
    hasMarks,
  );
  return [1n, 2n, 3n].map((k) => quantities.short(`${k * top}/${bottom}`));
}

test("ticks that nobody sees do not keep a time from being round", () => {
  // 0.00361 s a tick: 30 s are 8310.2… ticks; 3610 s would be the first whole number of them
  assert.deepEqual(labels([361, 100000], "s", 6000, false), ["30 s", "1 min", "1 min 30 s"]);
  assert.deepEqual(labels([361, 100000], null, 6000, false), ["50", "100", "150"]);
});

test("where ticks have marks, a label stands at one of them", () => {
  // a third of a second: 1 s are 3 ticks, 2 s are 6; half a second is none
  assert.deepEqual(labels([1, 3], "s", 1.2, true), ["1 s", "2 s", "3 s"]);
  assert.deepEqual(labels([1, 3], "s", 3.5, true), ["2 s", "4 s", "6 s"]);
});

test("where no round time is a whole number of ticks, the ticks are round", () => {
  // 2 ticks of 7/11 are 14/11; 7 time units would be 11 ticks
  assert.deepEqual(labels([7, 11], null, 1.5, true), ["1.27", "2.55", "3.82"]);
});

test("the last label ends within the margin of the diagram", () => {
  // labels of 60 pixels at 0, 100 and 200: the last one would end at 230, the margin ends at 212
  /** @type {number[]} */
  const middles = [];
  const context = new Proxy(/** @type {any} */ ({}), {
    get: (_, name) =>
      name === "fillText"
        ? (/** @type {string} */ _text, /** @type {number} */ x) => middles.push(x)
        : () => ({ width: 60 }),
    set: () => true,
  });
  const area = {
    left: 0,
    right: 200,
    top: 0,
    bottom: 9,
    end: 20,
    x: (/** @type {number} */ k) => 10 * k,
  };
  const quantities = new Quantities({ length: null, time: "s" }, [1, 1]);
  const plan = { tick: { numerator: 1, denominator: 1 }, quantities };
  const theme = { line: "", muted: "", font: () => "" };
  const words = { time: (/** @type {string} */ exact) => exact };
  paintAxis(context, .../** @type {[any, any, any, any]} */ ([area, plan, theme, words]));
  assert.deepEqual(middles, [0, 100, 182]);
});
