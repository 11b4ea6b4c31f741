/** Places of a document, vertices of the map, and points of its drawing. */

import { figure, texts } from "../../../viz/page/assets/language/language.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { MapData, Numeral, Place, Point, ScenarioDocument } from "../types.js" */

/**
 * Both axes of a point.
 * @type {[0, 1]}
 */
export const AXES = [0, 1];

/**
 * A number of a document, which may be written as a fraction.
 * @param {Numeral | null | undefined} value
 * @param {number} [otherwise]
 * @returns {number}
 */
export function numberOf(value, otherwise = NaN) {
  if (value === undefined || value === null || value === "") return otherwise;
  const [top, bottom = 1] = String(value).split("/").map(Number);
  return top / bottom;
}

/**
 * A length without the noise of floating point: to a millionth.
 * @param {number} value
 * @returns {number}
 */
export const rounded = (value) => Number(value.toFixed(6));

/**
 * Where a point of the site [length unit] is in the drawing; undoes `Roadmap.toSite`.
 * @param {Roadmap} roadmap
 * @param {number} right
 * @param {number} up
 * @returns {Point}
 */
export function toDrawing({ frame, unit }, right, up) {
  const [cos, sin] = [Math.cos(frame.yaw ?? 0), Math.sin(frame.yaw ?? 0)];
  const [x, y] = [right - frame.x, up - frame.y];
  const [u, v] = [cos * x + sin * y, cos * y - sin * x];
  return [u / unit, (frame.yUp ? -v : v) / unit];
}

/**
 * Whether places are written as points: where cells come from lengths, and may become others.
 * @param {{map: MapData}} document
 * @returns {boolean}
 */
const isByPoint = ({ map }) =>
  Boolean(map.floor) || (Boolean(map.layout) && map.cell_size !== undefined);

/**
 * A vertex of the map as the document names it.
 * @param {number} vertex
 * @param {Roadmap} roadmap
 * @param {ScenarioDocument} document
 * @returns {Place}
 */
export function placeOf(vertex, roadmap, document) {
  if (!isByPoint(document) || !roadmap.hasCells) return roadmap.name(vertex);
  const [x, y] = roadmap.toSite(roadmap.x[vertex], roadmap.y[vertex]).map(rounded);
  return { x, y };
}

/**
 * The vertex of a place in a document, or -1.
 * @param {Place | null | undefined} place
 * @param {Roadmap} roadmap
 * @returns {number}
 */
export function vertexOf(place, roadmap) {
  if (place === undefined || place === null) return -1;
  if (Array.isArray(place)) return roadmap.near(numberOf(place[1]), numberOf(place[0]));
  if (typeof place === "object")
    return roadmap.near(...toDrawing(roadmap, numberOf(place.x), numberOf(place.y)));
  const named = roadmap.vertexNamed(String(place));
  if (named >= 0) return named;
  for (const [vertex, names] of roadmap.stations) if (names.includes(String(place))) return vertex;
  return -1;
}

/**
 * A place as one reads it in a table: "N3", "1.25, 0.75" ("1,25 | 0,75" in German), "row 2, column 3".
 * @param {Place | null | undefined} place
 * @returns {string}
 */
export function textOfPlace(place) {
  if (place === undefined || place === null) return "";
  if (Array.isArray(place)) return `[${place.join(", ")}]`;
  if (typeof place !== "object") return String(place);
  return texts
    .pair({ x: figure(String(place.x)), y: figure(String(place.y)) })
    .replaceAll("\u00a0", " ");
}

/**
 * The place that somebody has typed; undefined for nothing.
 * @param {string} text
 * @returns {Place | undefined}
 */
export function placeOfText(text) {
  const written = text.trim();
  if (!written) return undefined;
  const cell = /^\[\s*(\d+)\s*[,;]\s*(\d+)\s*\]$/.exec(written);
  if (cell) return [Number(cell[1]), Number(cell[2])];
  const point =
    /^(-?[\d.,]+)\s*[|;]\s*(-?[\d.,]+)$/.exec(written) ?? // a comma is a decimal point then
    /^(-?[\d.]+)\s*,\s*(-?[\d.]+)$/.exec(written);
  if (!point) return written;
  const [x, y] = point.slice(1).map((part) => Number(part.replace(",", ".")));
  return { x, y };
}
