import { readFileSync } from "node:fs";
import "./texts.js";
import { Plan } from "../../src/rightofway/viz/page/assets/plan/plan.js";

/** @import { Payload, UnitsData } from "../../src/rightofway/viz/page/assets/payload.d.ts" */

/** @typedef {[x: number, y: number, activity: string]} Place Where a robot is, and what it does there. */
/** @typedef {{ payload: Payload, moments: { tick: number, robots: Place[] }[] }} Placed A page, and what pictures show. */
/** @typedef {[ticks: number, duration: string, moment: string, cell: string]} Written A time as the package writes it. */
/** @typedef {{ units: UnitsData, tick: [number, number], written: Written[] }} Times */

/**
 * The text of a file that the package has written, see tests/builders/payloads.py.
 *
 * @param {string} name
 */
function textOf(name) {
  return readFileSync(new URL(`../data/pages/${name}.json`, import.meta.url), "utf8");
}

/**
 * What the package gives to a page.
 *
 * @param {string} name
 */
export function made(name) {
  /** @type {{ made: Payload }} */
  const file = JSON.parse(textOf(name));
  return file.made;
}

/** Where the pictures of the package have robots, by the name of the plan. */
export function positions() {
  /** @type {{ made: Record<string, Placed> }} */
  const file = JSON.parse(textOf("positions"));
  return file.made;
}

/** Times at random, in units and ticks at random. */
export function times() {
  /** @type {{ made: Times[] }} */
  const file = JSON.parse(textOf("times"));
  return file.made;
}

/**
 * The plan that a page makes of it.
 *
 * @param {string} name
 */
export function planOf(name) {
  return new Plan(made(name));
}
