import { MapGround } from "./map_ground.js";
import { MapMarks } from "./map_marks.js";
import { diamond, disc, field, line, ring } from "../drawing/shapes.js";

/** @import { Bottleneck } from "../timetable/bottleneck.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Use } from "../plan/use.js" */
/** @import { Viewport } from "../drawing/viewport.js" */

const MANY_ROBOTS = 200; // of more, homes and stops are faint, or they would hide the robots

/** What does not move: the ground and its marks, heat, what is lit, homes, stops. */
export class MapBase {
  /**
   * @param {Site} plan
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   * @param {Theme} theme
   * @param {Choice} choice
   * @param {Use} use
   * @param {Bottleneck | null} bottleneck
   */
  constructor(plan, viewport, sizes, theme, choice, use, bottleneck) {
    this.plan = plan;
    this.viewport = viewport;
    this.sizes = sizes;
    this.theme = theme;
    this.choice = choice;
    this.use = use;
    this.bottleneck = bottleneck;
    this.ground = new MapGround(plan.roadmap, viewport, sizes, theme);
    this.marks = new MapMarks(plan, viewport, sizes, theme);
  }

  /**
   * Paint everything in map units: one unit is a cell.
   *
   * @param {CanvasRenderingContext2D} context
   */
  paint(context) {
    const { scale, left, top } = this.viewport;
    context.save();
    context.translate(left, top);
    context.scale(scale, scale);
    this.ground.paint(context);
    this.marks.paint(context, this.choice.space);
    if (this.choice.heat) this.#heat(context);
    this.bottleneck?.paintMap(context, scale);
    this.#corridor(context, this.choice.corridor ?? this.choice.picked ?? []);
    this.#lit(context, this.choice.lit);
    this.#homes(context);
    this.#stops(context);
    context.restore();
  }

  /**
   * A length in pixels, in map units.
   *
   * @param {number} length
   */
  #pixels(length) {
    return length / this.viewport.scale;
  }

  /** @param {CanvasRenderingContext2D} context */
  #heat(context) {
    const { x, y, size, rows, sides } = this.plan.roadmap;
    for (let vertex = 0; vertex < size; vertex++) {
      const colour = this.use.heat(vertex, this.theme);
      if (!colour) continue;
      context.fillStyle = colour;
      const side = rows ? 1 : sides?.[vertex];
      if (side) context.fillRect(x[vertex] - side / 2, y[vertex] - side / 2, side, side);
      else disc(context, x[vertex], y[vertex], this.#pixels(Math.max(this.sizes.vertex * 1.6, 5)));
    }
  }

  /**
   * The corridor that the diagram is drawn along, or the end of it that is chosen.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number[]} vertices
   */
  #corridor(context, vertices) {
    if (!vertices.length) return;
    const { x, y } = this.plan.roadmap;
    context.strokeStyle = this.theme.ink;
    context.lineCap = context.lineJoin = "round";
    context.lineWidth = this.#pixels(2 * this.sizes.robot + 6);
    context.globalAlpha = 0.16;
    context.beginPath();
    for (const vertex of [vertices[0], ...vertices]) context.lineTo(x[vertex], y[vertex]);
    context.stroke();
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }

  /**
   * The places that a finding or a wait is about, and the lanes between them.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number[]} vertices
   */
  #lit(context, vertices) {
    if (!vertices.length) return;
    const { x, y, lanes, rows } = this.plan.roadmap;
    const among = new Set(vertices);
    const radius = rows ? 0.42 : this.#pixels(Math.max(this.sizes.lane * 0.8, 9));
    context.strokeStyle = context.fillStyle = this.theme.held;
    context.lineCap = "round";
    context.lineWidth = this.#pixels(Math.max(this.sizes.lane * 0.5, 3));
    context.beginPath();
    for (const [tail, head] of [...lanes.bothWays, ...lanes.oneWay]) {
      if (among.has(tail) && among.has(head)) line(context, x[tail], y[tail], x[head], y[head]);
    }
    context.stroke();
    context.lineWidth = this.#pixels(2.5);
    for (const vertex of among) {
      context.globalAlpha = 0.18;
      disc(context, x[vertex], y[vertex], radius);
      context.globalAlpha = 1;
      ring(context, x[vertex], y[vertex], radius);
    }
    context.lineCap = "butt";
  }

  /** @param {Robot} robot */
  #strength(robot) {
    return (
      (this.choice.standsOut(robot.index) ? 1 : 0.25) *
      (this.choice.robots.length > MANY_ROBOTS ? 0.45 : 1)
    );
  }

  /**
   * A home is a frame in the robot's colour.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #homes(context) {
    const { x, y } = this.plan.roadmap;
    for (const robot of this.choice.robots) {
      const half = this.sizes.homeOf(robot);
      const side = this.#pixels(2 * half);
      context.lineWidth = this.#pixels(Math.min(Math.max(half * 0.1, 1.5), 3));
      const strength = this.#strength(robot);
      field(context, x[robot.home], y[robot.home], side);
      context.fillStyle = this.theme.floor;
      context.globalAlpha = this.choice.heat || robot.radius ? 0 : strength; // a true size may cover lanes
      context.fill();
      context.fillStyle = context.strokeStyle = robot.colour;
      context.globalAlpha = strength * 0.12;
      context.fill();
      context.globalAlpha = strength;
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /**
   * A stop is a diamond in the robot's colour; those of several robots stand side by side.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #stops(context) {
    const { x, y } = this.plan.roadmap;
    const size = this.#pixels(this.sizes.stop);
    context.lineJoin = "round";
    context.lineWidth = this.#pixels(2.5);
    context.strokeStyle = this.theme.floor;
    for (const [vertex, robots] of this.plan.stops) {
      const small = size / Math.sqrt(Math.min(robots.length, 3));
      robots.forEach((robot, i) => {
        const along = (i - (robots.length - 1) / 2) * 2.1 * small;
        context.globalAlpha = this.#strength(robot);
        context.fillStyle = robot.colour;
        diamond(context, x[vertex] + along, y[vertex], small);
        context.stroke();
        context.fill();
      });
    }
    context.globalAlpha = 1;
  }
}
