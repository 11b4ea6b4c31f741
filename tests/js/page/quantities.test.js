import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  Quantities,
  decimal,
  fraction,
} from "../../../src/rightofway/viz/page/assets/language/quantities.js";
import { figure, said } from "../../../src/rightofway/viz/page/assets/language/language.js";
import { roundLength } from "../../../src/rightofway/viz/page/assets/drawing/scale_bar.js";
import { times } from "../made.js";
import { speak } from "../texts.js";

/** @import { PhraseData } from "../../../src/rightofway/viz/page/assets/payload.d.ts" */

/** Values and their texts; the package is tested with the same ones. */
const CASES = JSON.parse(
  readFileSync(new URL("../../data/quantities.json", import.meta.url), "utf8"),
);

test("decimals are those of the package", () => {
  for (const [value, text] of CASES.decimal) assert.equal(decimal(fraction(value)), text);
});

test("durations are those of the package", () => {
  for (const [time, value, text] of CASES.duration)
    assert.equal(new Quantities({ time, length: null }, [1, 1]).duration(value), text);
});

test("moments after a start are times of day, as in the package", () => {
  for (const [time, start, value, text] of CASES.clock)
    assert.equal(new Quantities({ time, length: null, start }, [1, 1]).moment(value), text);
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

test("times at random are written as the package writes them", () => {
  // numbers of ticks that are whole, or in between while the clock runs
  for (const { units, tick, written } of times()) {
    const quantities = new Quantities(units, tick);
    for (const [ticks, duration, moment, cell] of written)
      assert.deepEqual(
        [quantities.duration(ticks), quantities.moment(ticks), quantities.cell(ticks)],
        [duration, moment, cell],
        `${ticks} ticks of ${tick.join("/")} ${units.time}`,
      );
  }
});

test("lengths and speeds have the units of the scenario or none", () => {
  const plain = new Quantities({ length: null, time: null }, [1, 1]);
  assert.equal(plain.length("9/20"), "0.45 length units");
  assert.equal(plain.speed("6/5"), "1.2");
});

test("a running time keeps its decimals", () => {
  const seconds = new Quantities({ length: "m", time: "s" }, [1, 2]);
  assert.deepEqual(
    [0, 1, 2.5, 120, 121.3].map((ticks) => seconds.running(ticks)),
    ["0.0 s", "0.5 s", "1.3 s", "1 min 0.0 s", "1 min 0.7 s"],
  );
  const plain = new Quantities({ length: null, time: null }, [1, 1]);
  assert.equal(plain.running(3, 2), "3.00");
});

test("the scale bar has the longest round length that 130 pixels have room for", () => {
  // maps of which 130 pixels show a length of 0.9, 4 and 13
  const lengths = [0.9, 4, 13].map((width) => roundLength(width / 130));
  assert.deepEqual(lengths, [0.5, 2, 10]);
});

/** @param {() => void} check */
function inGerman(check) {
  speak("de");
  try {
    check();
  } finally {
    speak("en");
  }
}

test("quantities have decimal commas in German", () =>
  inGerman(() => {
    const quantities = new Quantities({ time: "s", length: "m" }, [1, 4]);
    assert.equal(quantities.duration(6), "1,5 s");
    assert.equal(quantities.running(8), "2,0 s");
    assert.equal(quantities.cell(5), "1,25");
    assert.equal(quantities.speed("6/5"), "1,2 m/s");
    assert.equal(quantities.length("9/20"), "0,45 m");
    assert.equal(
      new Quantities({ time: null, length: null }, [1, 2]).duration(3),
      "1,5 Zeiteinheiten",
    );
  }));

test("marked numbers of a phrase have decimal commas in German, names keep their points", () => {
  /** @type {PhraseData} */
  const phrase = [
    "robots lose",
    { robots: "AGV 1.2", time: ["figure", { figure: "6 min 23.5 s" }] },
  ];
  assert.equal(said(phrase), "AGV 1.2 lose 6 min 23.5 s");
  inGerman(() => {
    assert.equal(said(phrase), "AGV 1.2 verlieren 6 min 23,5 s");
    assert.equal(figure("4.4%"), "4,4 %");
    assert.equal(figure("1/3"), "1/3");
  });
});
