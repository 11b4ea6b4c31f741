/** The distance between two places, from vertices and ends of walls where they are near. */

import { nearest } from "../../../viz/page/assets/common/arrays.js";
import { wayText } from "./readout.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { DrawingPoint } from "../types.js" */
/** @import { Editor } from "./editor.js" */

const REACH = 12; // pixels

export class MeasureTool {
  static called = "measure";
  isDrawn = true;
  isHeld = false;
  /** @type {{x: number, y: number} | null} */
  start = null;
  /** @type {{x: number, y: number} | null} */
  end = null;
  /** @type {{x: number, y: number} | null} */
  over = null;

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
  }

  get isBusy() {
    return this.isHeld;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  press(point) {
    this.isHeld = true;
    this.start = this.end = this.#aimed(point);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  drag(point) {
    if (this.isHeld) this.end = this.#aimed(point);
    this.over = this.#aimed(point);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  hover(point) {
    this.over = this.#aimed(point);
  }

  leave() {
    this.over = null;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    this.end = this.#aimed(point);
    this.isHeld = false;
  }

  cancel() {
    this.isHeld = false;
    this.start = this.end = this.over = null;
  }

  /**
   * The vertex or the corner of a block that is near a point, or the point itself.
   * @param {DrawingPoint} point
   * @returns {{x: number, y: number}}
   */
  #aimed({ x, y, isFree }) {
    const { hits, roadmap, stage } = this.editor;
    const reach = REACH / stage.view.viewport.scale;
    if (isFree) return { x, y };
    const corners = hits.obstacles.flatMap(([left, top, width, height]) => [
      [left, top],
      [left + width, top],
      [left, top + height],
      [left + width, top + height],
    ]);
    const corner = corners.find(([cx, cy]) => Math.hypot(cx - x, cy - y) < reach);
    if (corner) return { x: corner[0], y: corner[1] };
    const vertex = nearest(roadmap.x, roadmap.y, x, y, reach);
    return vertex < 0 ? { x, y } : { x: roadmap.x[vertex], y: roadmap.y[vertex] };
  }

  get measure() {
    const { editor, start, end } = this;
    if (!start || !end) return "";
    const [from, to] = [start, end].map(({ x, y }) => editor.roadmap.toSite(x, y));
    return wayText(editor, [to[0] - from[0], to[1] - from[1]]);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    context.strokeStyle = theme.drive;
    context.lineWidth = 2 / scale;
    context.beginPath();
    if (this.start && this.end) {
      context.moveTo(this.start.x, this.start.y);
      context.lineTo(this.end.x, this.end.y);
    }
    const reach = 6 / scale;
    for (const at of [this.start, this.end, this.isHeld ? null : this.over]) {
      if (!at) continue;
      context.moveTo(at.x - reach, at.y);
      context.lineTo(at.x + reach, at.y);
      context.moveTo(at.x, at.y - reach);
      context.lineTo(at.x, at.y + reach);
    }
    context.stroke();
  }
}
