/** Jobs by dragging: from the pickup to the dropoff; a press on one place is a job there. */

import { placeOf } from "../draw/places.js";
import { radiusAt } from "../draw/overlay.js";
import { ring } from "../../../viz/page/assets/drawing/shapes.js";
import { paintStops } from "../../../viz/page/assets/jobs/job_marks.js";
import { words } from "../words.js";
import { robotsOf } from "../robots/fleet.js";
import { addJobs, jobBetween, jobsOf } from "./jobs.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { Editor } from "../draw/editor.js" */
/** @import { DrawingPoint } from "../types.js" */

export class JobTool {
  static called = "job";
  isDrawn = true;

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
    this.from = -1;
    this.over = -1;
  }

  get isBusy() {
    return this.from >= 0;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  press(point) {
    this.hover(point);
    if (this.over < 0) this.editor.say(words.noVertexHere);
    else if (!robotsOf(this.editor.document)) this.editor.say(words.robotsElsewhere);
    else {
      this.from = this.over;
      this.editor.say(words.dragJob);
    }
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  drag(point) {
    this.hover(point);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  hover(point) {
    this.over = this.editor.vertexAt(point);
  }

  leave() {
    this.over = -1;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  release(point) {
    const { editor, from } = this;
    const to = editor.vertexAt(point);
    this.cancel();
    if (from < 0) return;
    if (to < 0) return editor.say(words.noVertexHere);
    const [one, other] = [from, to].map((vertex) =>
      placeOf(vertex, editor.roadmap, editor.document),
    );
    editor.store.change((document) => addJobs(document, [jobBetween(one, other, from === to)]));
    editor.select([{ kind: "job", id: (jobsOf(editor.document) ?? []).length - 1 }]);
    editor.say(words.pressJob);
  }

  cancel() {
    this.from = -1;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    const { x, y } = this.editor.roadmap;
    /** @param {number} vertex */
    const at = (vertex) => ({ x: x[vertex], y: y[vertex] });
    const places = [this.from, this.over].filter((vertex) => vertex >= 0);
    if (this.isBusy) return paintStops(context, theme, places.map(at), scale);
    context.strokeStyle = theme.ink;
    context.lineWidth = 2 / scale;
    const { over } = this;
    if (over >= 0)
      ring(context, x[over], y[over], radiusAt(this.editor.roadmap, over, scale) * 0.8);
  }
}
