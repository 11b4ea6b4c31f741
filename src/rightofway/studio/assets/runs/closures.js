/** Places and lanes that are closed for all robots, as edits of a document. */

import { textOfPlace } from "../draw/places.js";

/** A document in which a place is closed for ever, or with another place the lane between both. */
export function withClosure(document, at, to) {
  const closure = to === undefined ? { at } : { edge: [at, to] };
  return { ...document, closures: [...(document.closures ?? []), closure] };
}

export function withoutClosure({ closures, ...rest }, index) {
  const left = closures.filter((_, i) => i !== index);
  return left.length ? { ...rest, closures: left } : rest;
}

/** "N3", or "A – B" for a lane. */
export const textOfClosure = ({ at, edge }) => (edge ?? [at]).map(textOfPlace).join(" – ");
