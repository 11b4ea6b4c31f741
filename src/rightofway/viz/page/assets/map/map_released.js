import { line } from "../drawing/shapes.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Driven } from "../live/driven.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { Site } from "../plan/site.js" */

const HORIZONS = 12; // robots of which each has its horizon drawn

/** What is released to robots that are driven: their base as a band, what is only planned as a dotted line. */
export class MapReleased {
  /**
   * @param {Site} plan
   * @param {Driven} driven
   * @param {Motion} motion
   * @param {MapSizes} sizes
   * @param {Choice} choice
   */
  constructor(plan, driven, motion, sizes, choice) {
    this.plan = plan;
    this.driven = driven;
    this.motion = motion;
    this.sizes = sizes;
    this.choice = choice;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   * @param {number} tick
   */
  paint(context, scale, tick) {
    if (this.choice.mode === "plan") return;
    context.lineCap = context.lineJoin = "round";
    for (const { index, colour } of this.choice.robots) {
      const isShown = this.choice.standsOut(index);
      const { base, horizon } = this.driven.way(index, tick);
      context.strokeStyle = colour;
      context.globalAlpha = isShown ? 0.5 : 0.15;
      context.lineWidth = (0.8 * this.sizes.route.line + 4) / scale;
      this.#way(context, index, base, true);
      const isAlone = this.choice.robot !== null && isShown;
      if (!isAlone && this.plan.robots.length > HORIZONS) continue;
      context.globalAlpha = isShown ? 0.8 : 0.2;
      context.lineWidth = 2 / scale;
      context.setLineDash([0, 7 / scale]);
      this.#way(context, index, horizon, false);
      context.setLineDash([]);
    }
    context.globalAlpha = 1;
    this.#waits(context, scale, tick);
    context.lineCap = "butt";
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} robot
   * @param {number[]} vertices
   * @param {boolean} fromRobot whether the way begins where the robot is
   */
  #way(context, robot, vertices, fromRobot) {
    if (vertices.length < 2) return;
    const { x, y } = this.plan.roadmap;
    const [first, ...rest] = vertices;
    context.beginPath();
    if (fromRobot) context.moveTo(this.motion.x[robot], this.motion.y[robot]);
    else context.moveTo(x[first], y[first]);
    for (const vertex of rest) context.lineTo(x[vertex], y[vertex]);
    context.stroke();
  }

  /**
   * A line from a robot that waits to each that it waits for.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   * @param {number} tick
   */
  #waits(context, scale, tick) {
    const { x, y } = this.motion;
    context.lineWidth = 1.5 / scale;
    context.setLineDash([5 / scale, 4 / scale]);
    for (const { index, colour } of this.choice.robots) {
      const wait = this.driven.waitAt(index, tick);
      if (!wait || !this.choice.standsOut(index)) continue;
      context.strokeStyle = colour;
      context.beginPath();
      for (const other of wait.others) line(context, x[index], y[index], x[other], y[other]);
      context.stroke();
    }
    context.setLineDash([]);
  }
}
