/** Sentences about a plan. */

import assert from "node:assert/strict";
import { test } from "node:test";
import {
  LANGUAGES,
  setLanguage,
  texts,
} from "../../../src/rightofway/viz/page/assets/language/language.js";
import { Phrases, learn, said } from "../../../src/rightofway/viz/page/assets/language/library.js";
import { ENGLISH } from "../../../src/rightofway/viz/page/assets/texts/en.js";
import { Plan } from "../../../src/rightofway/viz/page/assets/plan/plan.js";
import { Words } from "../../../src/rightofway/viz/page/assets/language/words.js";
import { Use } from "../../../src/rightofway/viz/page/assets/plan/use.js";
import { made, planOf } from "../made.js";

/** @import { Texts } from "../../../src/rightofway/viz/page/assets/texts/en.js" */
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
    "not said",
    "R1",
    "station {name}",
    "Dock",
    [2, 3],
    "{waits} waits for {first}, {place}",
    "R2",
    [5, 1, 6, 4],
  ]);
  assert.equal(phrases.said(1), "R1");
  assert.equal(phrases.said(7), "R1 waits for R2, station Dock");
  learn({ de: { "station {name}": "Station {name}" } });
  learn({ de: { "{waits} waits for {first}, {place}": "{waits} wartet auf {first}, {place}" } });
  setLanguage("de", /** @type {HTMLElement} */ ({}));
  assert.equal(phrases.said(7), "R1 wartet auf R2, Station Dock");
  assert.deepEqual(
    [7, 1].map((index) => phrases.languageOf(index)),
    ["de", "en"],
  );
  setLanguage("en", /** @type {HTMLElement} */ ({}));
});

test("a third language is a line of its own, and a sentence in it a line of one table", () => {
  const phrase =
    /** @type {import("../../../src/rightofway/viz/page/assets/payload.d.ts").PhraseData} */ ([
      "works at {place}",
      { place: ["station {name}", { name: "Dock" }] },
    ]);
  LANGUAGES.fr = { name: "Français", texts: /** @type {Texts} */ ({}) };
  learn({ fr: { "works at {place}": "travaille à {place}" } });
  setLanguage("fr", /** @type {HTMLElement} */ ({}));
  assert.equal(said(phrase), "travaille à station Dock"); // what it lacks is English
  assert.equal(texts.home, ENGLISH.home);
  setLanguage("en", /** @type {HTMLElement} */ ({}));
  delete LANGUAGES.fr;
  assert.equal(said(phrase), "works at station Dock");
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
