import { diamond, ring } from "../drawing/shapes.js";
import { JobMarks } from "../jobs/job_marks.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Shift } from "./shift.js" */
/** @import { Theme } from "../drawing/theme.js" */

/** The largest radius of the ring round a place, which the margin of a map has room for [pixels]. */
const WIDEST = 28;

/** Jobs of a shift in other views: those that are not begun on the map, and where robots waited longest. */
export class ShiftMarks extends JobMarks {
  /**
   * @param {Plan} plan
   * @param {Theme} theme
   * @param {Choice} choice
   * @param {Clock} clock
   */
  constructor(plan, theme, choice, clock) {
    super(plan, theme, choice);
    this.clock = clock;
    this.shift = /** @type {Shift} */ (plan.shift);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  paintMap(context, scale) {
    if (this.choice.bottleneck) this.#bottleneck(context, scale);
    this.#open(context, scale);
    super.paintMap(context, scale);
  }

  /**
   * A ring round the place where robots waited longest.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  #bottleneck(context, scale) {
    const [first] = this.shift.raw.bottlenecks;
    if (!first) return;
    const { x, y } = this.plan.roadmap;
    for (const { colour, width } of [
      { colour: this.theme.litEdge, width: 7 },
      { colour: this.theme.lit, width: 4 },
    ]) {
      context.strokeStyle = colour;
      context.lineWidth = width / scale;
      const radius = Math.min(Math.max(0.7, 13 / scale), WIDEST / scale);
      ring(context, x[first[0]], y[first[0]], radius);
    }
  }

  /**
   * The first stop of each job that is known and not begun.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  #open(context, scale) {
    const { x, y } = this.plan.roadmap;
    const { begins, jobs } = this.shift;
    const { tick } = this.clock;
    const known = this.shift.countKnown(tick);
    const places = new Set();
    for (let job = 0; job < known; job++) if (begins[job] > tick) places.add(jobs[job].stops[0][0]);
    context.fillStyle = this.theme.ink;
    context.strokeStyle = this.theme.paper;
    context.lineWidth = 1.5 / scale;
    for (const vertex of places) {
      diamond(context, x[vertex], y[vertex], 5 / scale);
      context.fill();
      context.stroke();
    }
  }
}
