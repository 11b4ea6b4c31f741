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
   * Marks below the robots, in units of the map.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   * @param {(vertex: number) => number} cover the radius of the robot at a vertex, 0 for none
   */
  paintBelow(context, scale, cover) {
    if (this.choice.bottleneck) this.#bottleneck(context, scale);
    this.#open(context, scale, cover);
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
   * The first stop of each job that is known and not begun; beside a robot that covers it.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   * @param {(vertex: number) => number} cover
   */
  #open(context, scale, cover) {
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
      const radius = cover(vertex);
      const away = radius ? (radius + 4 / scale) * Math.SQRT1_2 : 0;
      diamond(context, x[vertex] + away, y[vertex] + away, 5 / scale);
      context.fill();
      context.stroke();
    }
  }
}
