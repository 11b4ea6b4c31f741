import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  Quantities,
  decimal,
  fraction,
} from "../../../src/rightofway/viz/page/assets/quantities.js";

/** Values and their texts; the package is tested with the same ones. */
const CASES = JSON.parse(readFileSync(new URL("../../data/quantities.json", import.meta.url)));

test("decimals are those of the package", () => {
  for (const [value, text] of CASES.decimal) assert.equal(decimal(fraction(value)), text);
});

test("durations are those of the package", () => {
  for (const [time, value, text] of CASES.duration)
    assert.equal(new Quantities({ time, length: null }, [1, 1]).duration(value), text);
});

test("a number is an exact fraction, also with an exponent", () => {
  assert.deepEqual(fraction("30313/700"), [30313n, 700n]);
  assert.deepEqual(fraction(0.5), [5n, 10n]);
  assert.deepEqual(fraction(1e-7), [1n, 10n ** 7n]);
  assert.deepEqual(fraction("12e2"), [1200n, 1n]);
});

test("a tick lasts as long as the scenario says", () => {
  const quantities = new Quantities({ time: "s", length: "m" }, [1, 4]);
  assert.equal(quantities.duration(6), "1.5 s"); // 6 quarters of a second
  assert.equal(quantities.running(8), "2.0 s"); // one decimal while time runs
  assert.equal(quantities.cell(5), "1.25");
  assert.equal(quantities.speed("6/5"), "1.2 m/s");
  assert.equal(quantities.length("9/20"), "0.45 m");
});
