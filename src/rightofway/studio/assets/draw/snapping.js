/** Where a point or a moved selection comes to lie: in line with what is there, else at round lengths. */

import { positionOf, roadmapOf } from "./network.js";
import { rounded, toDrawing } from "./places.js";
import { present } from "../given.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { Cell, DrawingPoint, Guide, Point, Rect, ScenarioDocument, Shift } from "../types.js" */
/** @import { Editor } from "./editor.js" */

/**
 * What a point snaps to: the document, and at which scale the stage shows it.
 * @typedef {{
 *   roadmap: Pick<Roadmap, "unit" | "toSite">,
 *   stage: { view: { viewport: { scale: number } } },
 *   document: ScenarioDocument,
 * }} DrawnOn
 */

const ALIGNED = 8; // pixels within which something keeps in line with something else
const SAME = 1e-6; // length units

/**
 * Length units in a pixel of the screen.
 * @param {Pick<DrawnOn, "roadmap" | "stage">} editor
 * @returns {number}
 */
const pixelOf = ({ roadmap, stage }) => roadmap.unit / stage.view.viewport.scale;

/**
 * The round length that things keep to at the present scale [length units].
 * @param {Pick<DrawnOn, "roadmap" | "stage">} editor
 * @returns {number}
 */
export const roundStep = (editor) => 10 ** Math.floor(Math.log10(24 * pixelOf(editor)));

/**
 * Lines from a place to the nearest of some others in its column, and in its row.
 * @param {Point} at
 * @param {Point[]} others
 * @returns {Guide[]}
 */
function guidesOf(at, others) {
  return [0, 1].flatMap((axis) => {
    /**
     * @param {Point} other
     * @returns {number}
     */
    const off = (other) => Math.abs(other[1 - axis] - at[1 - axis]);
    /** @type {Point | null} */
    let best = null;
    for (const other of others)
      if (Math.abs(other[axis] - at[axis]) < SAME && off(other) > SAME)
        if (!best || off(other) < off(best)) best = other;
    return best ? [[best, at]] : [];
  });
}

/**
 * Where on the site a vertex is put: in line with other vertices, else at a round length; or just there.
 * @param {DrawingPoint} point
 * @param {DrawnOn} editor
 * @param {string[]} [without]
 * @returns {{at: Point, guides: Guide[]}}
 */
export function snapped(point, editor, without = []) {
  const there = editor.roadmap.toSite(point.x, point.y);
  if (point.isFree) return { at: there.map(rounded), guides: [] };
  const step = roundStep(editor);
  const gone = new Set(without);
  const known = Object.entries(roadmapOf(editor.document).vertices)
    .filter(([name]) => !gone.has(name))
    .map(([, vertex]) => positionOf(vertex));
  const reach = ALIGNED * pixelOf(editor);
  const at = there.map((length, axis) => {
    const near = nearestOf(known, axis, length);
    return Math.abs(near - length) < reach ? near : rounded(Math.round(length / step) * step);
  });
  return { at, guides: guidesOf(at, known) };
}

/**
 * @param {Point[]} places
 * @param {number} axis
 * @param {number} wanted
 * @returns {number}
 */
const nearestOf = (places, axis, wanted) =>
  places.reduce(
    (best, place) =>
      Math.abs(place[axis] - wanted) < Math.abs(best - wanted) ? place[axis] : best,
    Infinity,
  );

/**
 * The corners of the floor's obstacles, but for some, on the site; moved inwards by a part of a cell.
 * @param {Editor} editor
 * @param {number[]} without
 * @param {number} [inwards]
 * @returns {Point[]}
 */
function cornersOf({ hits, roadmap }, without, inwards = 0) {
  const gone = new Set(without);
  return hits.obstacles.flatMap(([left, top, width, height], index) =>
    gone.has(index)
      ? []
      : [left + inwards, left + width - inwards].flatMap((x) =>
          [top + inwards, top + height - inwards].map((y) => roadmap.toSite(x, y)),
        ),
  );
}

/**
 * How far a block goes [length units] that was dragged some way: by whole cells, and so that an edge of
 * it lies in line with another block's; any way at all where snapping is held off.
 * @param {Editor} editor
 * @param {Rect} block
 * @param {Point} shift
 * @param {boolean | undefined} isFree
 * @param {number[]} [without]
 * @returns {Shift}
 */
export function blockShift(editor, [x, y, width, height], shift, isFree, without = []) {
  const step = (editor.ground?.side ?? 1) * editor.roadmap.unit;
  if (isFree) return { shift: shift.map(rounded), guides: [] };
  const corners = cornersOf(editor, without);
  const reach = ALIGNED * pixelOf(editor);
  const sides = [
    [x, x + width],
    [y, y + height],
  ];
  const moved = shift.map((length, axis) => {
    const whole = rounded(Math.round(length / step) * step);
    if (step <= reach) return whole;
    const near = sides[axis]
      .map((side) => nearestOf(corners, axis, side + length) - side)
      .sort((one, other) => Math.abs(one - length) - Math.abs(other - length))[0];
    return Math.abs(near - length) < reach ? rounded(near) : whole;
  });
  const own = sides[0].flatMap((right) =>
    sides[1].map((up) => /** @type {Point} */ ([right + moved[0], up + moved[1]])),
  );
  return { shift: moved, guides: own.flatMap((corner) => guidesOf(corner, corners)) };
}

/**
 * Lines from the cell of a wall to ends of other blocks in its row and its column.
 * @param {Editor} editor
 * @param {Cell} cell
 * @returns {Guide[]}
 */
export function guidesOfCell(editor, [column, row]) {
  if (!editor.document.map.floor) return [];
  const { roadmap } = editor;
  const ground = present(editor.ground);
  const [left, top, width, height] = ground.boxOf([column, row]);
  const at = roadmap.toSite(left + width / 2, top + height / 2);
  return guidesOf(at, cornersOf(editor, [], ground.side / 2));
}

/**
 * Thin lines from what is drawn to what it is in line with.
 * @param {CanvasRenderingContext2D} context
 * @param {Editor} editor
 * @param {Guide[]} guides
 * @param {number} scale
 * @returns {void}
 */
export function paintGuides(context, { roadmap, stage }, guides, scale) {
  if (!guides.length) return;
  context.strokeStyle = stage.theme.drive;
  context.lineWidth = 1.25 / scale;
  context.setLineDash([4 / scale, 4 / scale]);
  context.beginPath();
  for (const [from, to] of guides) {
    context.moveTo(...toDrawing(roadmap, ...from));
    context.lineTo(...toDrawing(roadmap, ...to));
  }
  context.stroke();
  context.setLineDash([]);
}
