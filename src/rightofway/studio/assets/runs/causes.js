/** Causes of delay as fields: each has a sentence with places for numbers, and its notation for the command. */

import { html } from "../vendor/htm-preact.js";
import { figure } from "../../../viz/page/assets/language/language.js";
import { decimal, fraction } from "../../../viz/page/assets/language/quantities.js";
import { words } from "../words.js";
import { over } from "./parameter_curve.js";
/** @import { Fraction } from "../../../viz/page/assets/language/quantities.js" */
/** @import { Cause } from "../types.js" */

/** @type {Fraction} */
const HUNDRED = [100n, 1n];

/**
 * A percentage as a share, exactly; what cannot be read stays, so that the library says why.
 * @param {string} text
 * @returns {string}
 */
function share(text) {
  const plain = String(text).trim().replace(",", ".");
  return /^-?\d+(\.\d+)?$/.test(plain) ? decimal(over(fraction(plain), HUNDRED), 9) : plain;
}

/**
 * @param {string} text
 * @returns {string}
 */
const plain = (text) => String(text).trim().replace(",", ".");

/**
 * The fields of each kind with what they hold at first, and how the command writes them.
 * @type {Record<string, {fields: ("percent" | "time" | "robot" | "factor" | string)[][], text: (values: string[]) => string}>}
 */
const KINDS = {
  exponential: { fields: [["percent", "20"]], text: ([by]) => `exponential:${share(by)}` },
  uniform: {
    fields: [
      ["percent", "0"],
      ["percent", "50"],
    ],
    text: ([from, to]) => `uniform:${share(from)}..${share(to)}`,
  },
  chance: {
    fields: [
      ["percent", "1"],
      ["time", "20"],
    ],
    text: ([chance, time]) => `chance:${share(chance)}x${plain(time)}`,
  },
  breaks: { fields: [["percent", "5"]], text: ([chance]) => `breaks:${share(chance)}` },
  stop: {
    fields: [
      ["robot", ""],
      ["time", "10"],
      ["time", "30"],
    ],
    text: ([robot, from, time]) => `stop:${robot}@${plain(from)}+${plain(time)}`,
  },
  slow: {
    fields: [
      ["robot", ""],
      ["factor", "1.5"],
    ],
    text: ([robot, factor]) => `slow:${robot}x${plain(factor)}`,
  },
};

/**
 * A new cause of a kind; one of a robot is of the first.
 * @param {string} kind
 * @param {string[]} robots
 * @returns {Cause}
 */
export const causeOf = (kind, robots) => ({
  kind,
  values: KINDS[kind].fields.map(([type, value]) => (type === "robot" ? robots[0] : figure(value))),
});

/**
 * @param {Cause} cause
 * @returns {string}
 */
export const notation = ({ kind, values }) => KINDS[kind].text(values);

/** @param {{causes: Cause[], robots: string[], unit: string | null, least?: number, set: (causes: Cause[]) => void}} props */
export function Causes({ causes, robots, unit, least = 1, set }) {
  /**
   * @param {number} index
   * @param {Cause} cause
   * @returns {void}
   */
  const change = (index, cause) => set(causes.map((each, i) => (i === index ? cause : each)));
  return html`
    <ul class="causes">${causes.map(
      (cause, index) => html`<li>
      <select aria-label=${words.cause} value=${cause.kind} onChange=${({ target }) => change(index, causeOf(target.value, robots))}>${Object.keys(
        KINDS,
      ).map((kind) => html`<option value=${kind}>${words.causes[kind].name}</option>`)}</select>
      ${KINDS[cause.kind].fields.map(([type], place) => {
        /**
         * @param {{target: {value: string}}} event
         * @returns {void}
         */
        const write = ({ target }) =>
          change(index, {
            ...cause,
            values: cause.values.map((value, i) => (i === place ? target.value : value)),
          });
        return html`<label><span>${words.causes[cause.kind].fields[place]}</span>
        ${
          type === "robot"
            ? html`<select value=${cause.values[place]} onChange=${write}>${robots.map((name) => html`<option value=${name}>${name}</option>`)}</select>`
            : html`<input inputmode="decimal" value=${cause.values[place]} onInput=${write} />`
        }${type === "percent" ? " %" : type === "time" && unit ? ` ${unit}` : ""}</label>`;
      })}
      ${causes.length > least && html`<button type="button" class="quiet" aria-label=${`${words.remove}: ${words.causes[cause.kind].name}`} onClick=${() => set(causes.filter((_, i) => i !== index))}>✕</button>`}</li>`,
    )}</ul>
    <button type="button" class="quiet" onClick=${() => set([...causes, causeOf("chance", robots)])}>${words.anotherCause}</button>`;
}
