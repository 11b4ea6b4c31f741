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

/** "N3", or "A – B" for a lane; with the times of one that ends: "N3, 0–12". */
export function textOfClosure({ at, edge, from = 0, until }) {
  const what = (edge ?? [at]).map(textOfPlace).join(" – ");
  return until === undefined ? what : `${what}, ${from}–${until}`;
}
