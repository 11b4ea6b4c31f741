/** Where in a document a fault lies: by its path of keys and indices, never by its text. */

/** @import { Complaint } from "./types.js" */

/**
 * What a fault is about, for people: "R1: home", not "robots[0] (R1): home".
 * @param {{about?: string, place?: string}} fault
 * @returns {string}
 */
export const nameOf = ({ about, place }) => about || place || "";

/**
 * Whether a fault lies at a place, or below it.
 * @param {Partial<Complaint>} fault
 * @param {...(string | number)} place The keys and indices that lead there.
 * @returns {boolean}
 */
export const liesIn = ({ path = [] }, ...place) => place.every((key, i) => path[i] === key);

/**
 * Whether a fault is one of a place itself.
 * @param {Partial<Complaint>} fault
 * @param {...(string | number)} place The keys and indices that lead there.
 * @returns {boolean}
 */
export const liesAt = (fault, ...place) =>
  fault.path?.length === place.length && liesIn(fault, ...place);

/**
 * The index of the item of a list in which a fault lies; -1 where it lies elsewhere.
 * @param {Partial<Complaint>} fault
 * @param {...string} list The keys that lead to the list.
 * @returns {number}
 */
export function itemOf(fault, ...list) {
  const index = fault.path?.[list.length];
  return liesIn(fault, ...list) && typeof index === "number" ? index : -1;
}
