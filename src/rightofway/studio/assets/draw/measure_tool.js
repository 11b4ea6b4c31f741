/** The distance between two places, from vertices and ends of walls where they are near. */

import { nearest } from "../../../viz/page/assets/arrays.js";
import { wayText } from "./readout.js";

const REACH = 12; // pixels

export class MeasureTool {
  static called = "measure";
  isDrawn = true;

  constructor(editor) {
    this.editor = editor;
    this.cancel();
  }

  get isBusy() {
    return this.isHeld;
  }

  press(point) {
    this.isHeld = true;
    this.start = this.end = this.#aimed(point);
  }

  drag(point) {
    if (this.isHeld) this.end = this.#aimed(point);
    this.over = this.#aimed(point);
  }

  hover(point) {
    this.over = this.#aimed(point);
  }

  leave() {
    this.over = null;
  }

  release(point) {
    this.end = this.#aimed(point);
    this.isHeld = false;
  }

  cancel() {
    Object.assign(this, { isHeld: false, start: null, end: null, over: null });
  }

  /** The vertex or the corner of a block that is near a point, or the point itself. */
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
    if (!start) return "";
    const [from, to] = [start, end].map(({ x, y }) => editor.roadmap.toSite(x, y));
    return wayText(editor, [to[0] - from[0], to[1] - from[1]]);
  }

  paint(context, theme, scale) {
    context.strokeStyle = theme.drive;
    context.lineWidth = 2 / scale;
    context.beginPath();
    if (this.start) {
      context.moveTo(this.start.x, this.start.y);
      context.lineTo(this.end.x, this.end.y);
    }
    const reach = 6 / scale;
    for (const at of [this.start, this.end, this.isHeld ? null : this.over].filter(Boolean)) {
      context.moveTo(at.x - reach, at.y);
      context.lineTo(at.x + reach, at.y);
      context.moveTo(at.x, at.y - reach);
      context.lineTo(at.x, at.y + reach);
    }
    context.stroke();
  }
}
