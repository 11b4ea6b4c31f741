/** Rules of the whole fleet, as edits of a document. */

/** @import { Numeral, RulesData, ScenarioDocument } from "../types.js" */

/** @type {RulesData} */
const CLASSIC = { turn: 0, return: "none" }; // what the name stands for

/**
 * The rules of a document as a mapping, also where they are written as a name.
 * @param {ScenarioDocument} document
 * @returns {RulesData}
 */
const rulesOf = ({ rules }) => (typeof rules === "string" ? CLASSIC : (rules ?? {}));

/**
 * A document with another least time between two robots at a vertex.
 * @param {ScenarioDocument} document
 * @param {Numeral} headway
 * @returns {ScenarioDocument}
 */
export const withHeadway = (document, headway) => ({
  ...document,
  rules: { ...rulesOf(document), headway },
});
