/** @import { Choice } from "../player/choice.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { DecisionData, FaultData } from "../payload.d.ts" */
/** @import { Site } from "../plan/site.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */

/** @typedef {{ x: number, y: number }} Vector */

/**
 * Where two lanes beside a route meet, seen from its vertex; two points where it turns back.
 *
 * @param {Vector} before
 * @param {Vector} after
 */
function corner(before, after) {
  const square = after.x ** 2 + after.y ** 2 || 1;
  const along = (before.x * after.x + before.y * after.y) / square;
  if (along < -0.5) return [before, after];
  return [{ x: (before.x + after.x) / (1 + along), y: (before.y + after.y) / (1 + along) }];
}

/** The routes of the robots chosen, and the place of the chosen decision. */
export class MapRoute {
  /**
   * @param {Site} plan
   * @param {Motion} motion
   * @param {MapSizes} sizes
   * @param {Theme} theme
   * @param {Choice} choice
   */
  constructor(plan, motion, sizes, theme, choice) {
    this.plan = plan;
    this.motion = motion;
    this.sizes = sizes;
    this.theme = theme;
    this.choice = choice;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  paint(context, scale) {
    const { decision, routed } = this.choice;
    if (decision) this.#place(context, decision, scale);
    routed.forEach((index, place) =>
      this.#route(context, this.choice.robots[index], this.aside(place), scale),
    );
  }

  /**
   * How far a route runs to the right of the middle [pixels]: each further one is further out, so
   * that routes on one way, and the way back, are lines side by side.
   *
   * @param {number} place
   */
  aside(place) {
    return (place + 0.5) * this.sizes.route.apart;
  }

  /**
   * What lies behind is faint, what lies ahead is strong.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} aside
   * @param {number} scale
   */
  #route(context, robot, aside, scale) {
    const now = robot.phases.visit[this.motion.phase[robot.index]];
    const [first, last] = robot.span(now);
    context.strokeStyle = robot.colour;
    context.lineJoin = context.lineCap = "round";
    context.lineWidth = this.sizes.route.line / scale;
    context.globalAlpha = 0.35;
    this.#lane(context, robot, first, now, aside / scale);
    context.globalAlpha = 1;
    this.#lane(context, robot, now, last, aside / scale);
    context.lineCap = "butt";
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} from
   * @param {number} to
   * @param {number} aside
   */
  #lane(context, robot, from, to, aside) {
    if (from === to) return;
    const { x, y } = this.plan.roadmap;
    let before = this.#side(robot, from, aside);
    context.beginPath();
    context.moveTo(x[robot.vertices[from]] + before.x, y[robot.vertices[from]] + before.y);
    for (let visit = from + 1; visit <= to; visit++) {
      const vertex = robot.vertices[visit];
      const after = visit < to ? this.#side(robot, visit, aside) : before;
      for (const turn of corner(before, after))
        context.lineTo(x[vertex] + turn.x, y[vertex] + turn.y);
      before = after;
    }
    context.stroke();
  }

  /**
   * To the right of the way from a visit to the next: a vector of the length `aside`.
   *
   * @param {Robot} robot
   * @param {number} visit
   * @param {number} aside
   */
  #side(robot, visit, aside) {
    const { x, y } = this.plan.roadmap;
    const [tail, head] = [robot.vertices[visit], robot.vertices[visit + 1]];
    const [across, down] = [x[head] - x[tail], y[head] - y[tail]];
    const length = Math.hypot(across, down) || 1;
    return { x: (-down / length) * aside, y: (across / length) * aside };
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {DecisionData | FaultData} decision
   * @param {number} scale
   */
  #place(context, decision, scale) {
    const { x, y } = this.plan.roadmap;
    const vertices = [decision.vertices[0], ...decision.vertices]; // a line of one point is drawn, too
    context.strokeStyle = this.theme.ink;
    context.lineCap = context.lineJoin = "round";
    context.lineWidth = Math.max(2 * this.sizes.robot + 18, 4 * this.sizes.route.apart + 8) / scale;
    context.globalAlpha = 0.2;
    context.beginPath();
    vertices.forEach((vertex, i) =>
      i ? context.lineTo(x[vertex], y[vertex]) : context.moveTo(x[vertex], y[vertex]),
    );
    context.stroke();
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }
}
