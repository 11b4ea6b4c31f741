import { readFileSync } from "node:fs";
import { Plan } from "../../src/rightofway/viz/page/assets/plan.js";

/**
 * What the package gives to a page, see tests/builders/payloads.py.
 *
 * @param {string} name
 */
export function made(name) {
  const file = new URL(`../data/pages/${name}.json`, import.meta.url);
  return JSON.parse(readFileSync(file, "utf8")).made;
}

/**
 * The plan that a page makes of it.
 *
 * @param {string} name
 */
export function planOf(name) {
  return new Plan(made(name));
}
