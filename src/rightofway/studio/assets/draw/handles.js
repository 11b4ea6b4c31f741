/** Handles of the lane that is selected: its middle bends it, and each control point of a curve is moved. */

import {
  bendLane,
  bezierAt,
  controlsOf,
  endsOf,
  isNetwork,
  lanesOf,
  positionOf,
  roadmapOf,
} from "./network.js";
import { AXES, toDrawing } from "./places.js";
import { present } from "../given.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { DrawingPoint, HandledLane, Point } from "../types.js" */
/** @import { Editor } from "./editor.js" */

const REACH = 11; // pixels round a handle
const TOUCH_REACH = 24;
const STRAIGHT = 7; // pixels from the straight line within which a lane is straight
const CORNER = 14; // pixels within which the curve turns a right corner

export class Handles {
  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
    /** @type {{index: number, number: number | null} | null} */
    this.held = null; // { index, number }: the lane, and which control point; null for its middle
    /** @type {Point[] | null} */
    this.controls = null; // of the curve while a handle is dragged, on the site
  }

  /**
   * The lane that has handles, or null.
   * @returns {HandledLane | null}
   */
  get #lane() {
    const { selection, document } = this.editor;
    const [index] = selection.of("lane");
    if (selection.size !== 1 || index === undefined || !isNetwork(document)) return null;
    const lane = lanesOf(document)[index];
    const ends = lane && endsOf(lane).map((name) => roadmapOf(document).vertices[name]);
    if (!ends?.every(Boolean)) return null;
    const [tail, head] = ends.map(positionOf);
    return { index, tail, head, controls: this.controls ?? controlsOf(lane) };
  }

  /**
   * Take the handle at a point of the drawing; returns whether there is one.
   * @param {DrawingPoint} point
   * @returns {boolean}
   */
  take(point) {
    const lane = this.#lane;
    if (!lane) return false;
    const { roadmap, stage } = this.editor;
    const reach = (point.isTouch ? TOUCH_REACH : REACH) / stage.view.viewport.scale;
    /**
     * @param {Point} at
     * @returns {boolean}
     */
    const isNear = (at) => {
      const [x, y] = toDrawing(roadmap, ...at);
      return Math.hypot(point.x - x, point.y - y) <= reach;
    };
    const number = lane.controls.findIndex(isNear);
    if (number < 0 && !isNear(middleOf(lane))) return false;
    this.held = { index: lane.index, number: number < 0 ? null : number };
    return true;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  drag(point) {
    const lane = present(this.#lane);
    const at = this.editor.roadmap.toSite(point.x, point.y);
    const { number } = present(this.held);
    if (number !== null) this.controls = lane.controls.map((each, i) => (i === number ? at : each));
    else if (lane.controls.length === 2) this.controls = pulled(lane, at);
    else this.controls = this.#bent(lane, at, point.isFree);
  }

  /**
   * The control point that lets the middle of a lane be at a place; none near the straight line.
   * @param {HandledLane} lane
   * @param {Point} at
   * @param {boolean | undefined} isFree
   * @returns {Point[]}
   */
  #bent({ tail, head }, at, isFree) {
    const { roadmap, stage } = this.editor;
    const pixel = roadmap.unit / stage.view.viewport.scale;
    const control = AXES.map((axis) => 2 * at[axis] - (tail[axis] + head[axis]) / 2);
    if (isFree) return [control];
    const [right, up] = [head[0] - tail[0], head[1] - tail[1]];
    const off =
      Math.abs((at[0] - tail[0]) * up - (at[1] - tail[1]) * right) / (Math.hypot(right, up) || 1);
    if (off < STRAIGHT * pixel) return [];
    /** @type {Point[]} */
    const corners = [
      [tail[0], head[1]],
      [head[0], tail[1]],
    ];
    const corner = corners.find(
      ([x, y]) => Math.hypot(control[0] - x, control[1] - y) < CORNER * pixel,
    );
    return [corner ?? control];
  }

  release() {
    const { held, controls, editor } = this;
    this.cancel();
    if (held && controls)
      editor.store.change((document) => bendLane(document, held.index, controls));
  }

  cancel() {
    this.held = this.controls = null;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    const lane = this.#lane;
    if (!lane) return;
    const { roadmap } = this.editor;
    /**
     * @param {Point} at
     * @returns {Point}
     */
    const drawn = (at) => toDrawing(roadmap, ...at);
    /** @type {Point[]} */
    const line = [lane.tail, ...lane.controls, lane.head];
    context.strokeStyle = theme.ink;
    context.fillStyle = theme.paper;
    if (this.controls) {
      context.lineWidth = 2 / scale;
      context.beginPath();
      for (let i = 0; i <= 24; i++) context.lineTo(...drawn(bezierAt(line, i / 24)));
      context.stroke();
    }
    if (lane.controls.length) {
      context.lineWidth = 1 / scale;
      context.setLineDash([3 / scale, 3 / scale]);
      context.beginPath();
      for (const at of line) context.lineTo(...drawn(at));
      context.stroke();
      context.setLineDash([]);
    }
    context.lineWidth = 1.75 / scale;
    const side = 8 / scale;
    for (const at of lane.controls) {
      const [x, y] = drawn(at);
      context.fillRect(x - side / 2, y - side / 2, side, side);
      context.strokeRect(x - side / 2, y - side / 2, side, side);
    }
    context.beginPath();
    context.arc(...drawn(middleOf(lane)), 6 / scale, 0, 2 * Math.PI);
    context.fill();
    context.stroke();
  }
}

/**
 * @param {HandledLane} lane
 * @returns {Point}
 */
const middleOf = ({ tail, controls, head }) => bezierAt([tail, ...controls, head], 0.5);

/**
 * Both control points, so that the middle of the curve is at a place: it goes 3/4 as far as they do.
 * @param {HandledLane} lane
 * @param {Point} at
 * @returns {Point[]}
 */
function pulled(lane, at) {
  const middle = middleOf(lane);
  return lane.controls.map((point) =>
    point.map((length, axis) => length + (at[axis] - middle[axis]) / 0.75),
  );
}
