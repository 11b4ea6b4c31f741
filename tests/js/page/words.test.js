/** Sentences about a plan. */

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { said, texts } from "../../../src/rightofway/viz/page/assets/language/language.js";
import { Phrases } from "../../../src/rightofway/viz/page/assets/language/phrases.js";
import { Plan } from "../../../src/rightofway/viz/page/assets/plan/plan.js";
import { Words } from "../../../src/rightofway/viz/page/assets/language/words.js";
import { Use } from "../../../src/rightofway/viz/page/assets/plan/use.js";
import { made, planOf } from "../made.js";
import { speak } from "../texts.js";

/** @import { Theme } from "../../../src/rightofway/viz/page/assets/drawing/theme.js" */

const MEASURED = made("measured");

/** Cells of a measured floor, in metres and seconds: N0 is the home of R1, N1 has a station, N4 nothing. */
const PLAN = new Plan({ ...MEASURED, map: { ...MEASURED.map, stations: [["Press", 1]] } });

test("a cell of a measured floor has its number beside its name, as in tables", () => {
  const words = new Words(PLAN);
  assert.deepEqual(
    [0, 1, 3].map((vertex) => words.vertex(vertex)),
    ["the home of R1 (N0)", "Press (N1)", "N4 (1.5,\u00a01.5)"],
  );
  assert.equal(words.where(0), "N0 (0.5,\u00a00.5)");
  assert.equal(words.short(3), "(1.5,\u00a01.5)");
});

test("a closure is said with its lane and its times", () => {
  const plan = planOf("closed");
  assert.equal(plan.closures.length, 1);
  assert.equal(said(plan.closures[0].text), "C to D closed from time 8 until time 24");
});

test("a phrase by index is said with its values, in the language that is spoken", () => {
  const phrases = new Phrases([
    "R1",
    "named station",
    "Dock",
    [1, 2],
    "decision: waits",
    "R2",
    [4, 5, 3, 0], // the robot that goes first, the place, the robot that waits
  ]);
  assert.equal(phrases.said(0), "R1");
  assert.equal(phrases.said(6), "R1 waits for R2, station Dock");
  speak("de");
  assert.equal(phrases.said(6), "R1 wartet auf R2, Station Dock");
  speak("en");
});

test("texts are those of the package for the same phrases, in both languages", () => {
  const url = new URL("../../data/templates.json", import.meta.url);
  for (const { phrase, ...expected } of JSON.parse(readFileSync(url, "utf8")))
    for (const [code, text] of Object.entries(expected)) {
      speak(code);
      assert.equal(said(phrase), text);
    }
  speak("en");
});

test("labels are text, or functions of the values that their templates name", () => {
  assert.equal(texts.home, "Home");
  assert.equal(texts.doneAt({ isHome: true }), "Home at");
  assert.equal(texts.doneAt({ isHome: false }), "Done at");
  assert.deepEqual(texts.of({ time: "3 s", all: "9 s" }), ["3 s", " of 9 s"]);
  assert.equal(
    texts.lapsEvery({ laps: 1, period: "4 s", start: "0 s" }),
    "1 lap every 4 s, from 0 s on",
  );
  speak("de");
  assert.equal(
    texts.lapsEvery({ laps: 1.5, period: "4 s", start: "0 s" }),
    "1,5 Umläufe alle 4 s, ab 0 s",
  );
  speak("fr"); // unknown
  assert.equal(texts.home, "Home");
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
