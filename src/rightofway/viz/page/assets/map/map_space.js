import { lastOf } from "../common/arrays.js";
import { footOn } from "./map_marks.js";
import { disc, dot, haloed, line, ring } from "../drawing/shapes.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Moments } from "../player/clock.js" */
/** @import { MapMarks } from "./map_marks.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Lane, Roadmap } from "../plan/roadmap.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Closure } from "../plan/site.js" */
/** @import { Encounter, Space } from "../plan/space.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Viewport } from "../drawing/viewport.js" */
/** @import { Words } from "../language/words.js" */

const LEAST_GAP = 2; // pixels between a robot and the ring of the room that it needs, for both to be seen

/**
 * Space on request: what each robot books as a band as wide as the robot and its share of the
 * clearance, so that bands of two robots that do not meet are safe; zones in the colour of their
 * holder; and for the robot chosen what it excludes, and how near the next robot is.
 */
export class MapSpace {
  /**
   * @param {Site} plan
   * @param {Motion} motion
   * @param {Moments} clock
   * @param {Space} space
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   * @param {Theme} theme
   * @param {Choice} choice
   * @param {MapMarks} marks
   */
  constructor(plan, motion, clock, space, viewport, sizes, theme, choice, marks) {
    this.plan = plan;
    this.motion = motion;
    this.clock = clock;
    this.space = space;
    this.viewport = viewport;
    this.sizes = sizes;
    this.theme = theme;
    this.choice = choice;
    this.marks = marks;
  }

  /**
   * Paint in map units, below the robots.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  paint(context, scale) {
    this.#zones(context, scale);
    if (this.choice.space) {
      for (const each of this.choice.robots) this.#band(context, each, scale);
      if (this.choice.robot) this.#excluded(context, this.choice.robot, scale);
    }
    for (const closure of this.plan.closures) this.#closure(context, closure, scale);
  }

  /**
   * Paint in map units, over the robots: the room that each needs, and the line to the nearest.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  paintOver(context, scale) {
    if (!this.choice.space) return;
    const { x, y } = this.motion;
    context.lineWidth = 1.25 / scale;
    for (const robot of this.choice.robots) {
      if (!robot.radius || this.#half(robot) * scale - this.sizes.of(robot) < LEAST_GAP) continue;
      context.strokeStyle = robot.colour;
      context.setLineDash([4 / scale, 3 / scale]);
      ring(context, x[robot.index], y[robot.index], this.#half(robot));
    }
    context.setLineDash([]);
    this.#encounter = this.#findEncounter();
    if (!this.#encounter) return;
    const [one, other] = [this.choice.robotIndex, this.#encounter.other.index];
    for (const { colour, width } of [
      { colour: this.theme.paper, width: 5 },
      { colour: this.theme.ink, width: 2 },
    ]) {
      context.strokeStyle = colour;
      context.lineWidth = width / scale;
      context.beginPath();
      line(context, x[one], y[one], x[other], y[other]);
      context.stroke();
    }
  }

  /** @type {Omit<Encounter, "tick"> | null} */
  #encounter = null;

  /**
   * Write the distance above both robots, or below, in pixels of the canvas.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Words} words
   */
  write(context, words) {
    if (!this.choice.space || !this.#encounter) return;
    const { left, top, scale } = this.viewport;
    const { x, y } = this.motion;
    const [one, other] = [this.choice.robotIndex, this.#encounter.other.index];
    context.font = this.theme.font(13, 600);
    context.textAlign = "center";
    context.textBaseline = "bottom";
    const middle = left + ((x[one] + x[other]) / 2) * scale;
    const ends = [one, other].map((index) => [
      top + y[index] * scale,
      this.sizes.of(this.choice.robots[index]),
    ]);
    const above = Math.min(...ends.map(([at, radius]) => at - radius)) - 8;
    const below = Math.max(...ends.map(([at, radius]) => at + radius)) + 24;
    haloed(
      context,
      words.apart(this.#encounter),
      middle,
      above < 20 ? below : above,
      this.theme.ink,
      this.theme.paper,
      4,
    );
  }

  /** The robot that is looked at with the one chosen, or the nearest one. */
  #findEncounter() {
    const { robot, pair } = this.choice;
    if (!robot) return null;
    const nearest = this.space.nearestTo(robot);
    if (pair < 0 || !nearest) return nearest;
    const other = this.choice.robots[pair];
    const { x, y } = this.motion;
    const distance =
      Math.hypot(x[robot.index] - x[pair], y[robot.index] - y[pair]) * this.plan.roadmap.unit;
    return { other, distance, room: this.plan.room(robot, other) };
  }

  /**
   * Half the width of what a robot books, in map units.
   *
   * @param {Robot} robot
   */
  #half(robot) {
    return robot.radius
      ? (robot.radius + this.plan.clearance / 2) / this.plan.roadmap.unit
      : this.sizes.of(robot) / this.viewport.scale;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  #zones(context, scale) {
    context.lineCap = context.lineJoin = "round";
    context.lineWidth = this.sizes.zone / scale;
    for (const [zone, robot] of this.space.zoneHolders) {
      context.strokeStyle = robot.colour;
      context.globalAlpha = 0.55;
      context.stroke(this.marks.zones[zone]);
    }
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }

  /**
   * A closed vertex or lane has a sign; while it is not closed, the sign is an outline.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Closure} options
   * @param {number} scale
   */
  #closure(context, { vertices, from, until, radius }, scale) {
    const { x, y, unit } = this.plan.roadmap;
    const isNow = from <= this.clock.tick && this.clock.tick < until;
    context.strokeStyle = context.fillStyle = this.theme.held;
    context.lineCap = context.lineJoin = "round";
    context.beginPath();
    for (const vertex of vertices) context.lineTo(x[vertex], y[vertex]);
    dot(context, x[lastOf(vertices)], y[lastOf(vertices)]);
    if (isNow && radius) {
      context.globalAlpha = 0.14;
      context.lineWidth = (2 * radius) / unit;
      context.stroke();
    }
    context.globalAlpha = isNow ? 1 : 0.35;
    context.lineWidth = 2.5 / scale;
    context.setLineDash([6 / scale, 5 / scale]);
    context.stroke();
    context.setLineDash([]);
    context.lineCap = "butt";
    const [one, other] = [vertices[(vertices.length - 1) >> 1], vertices[vertices.length >> 1]];
    const [middleX, middleY] = [(x[one] + x[other]) / 2, (y[one] + y[other]) / 2];
    const size = Math.max(this.sizes.sign, 7) / scale;
    if (isNow) disc(context, middleX, middleY, size);
    else ring(context, middleX, middleY, size);
    context.fillStyle = isNow ? this.theme.paper : this.theme.held;
    context.fillRect(middleX - 0.6 * size, middleY - 0.2 * size, 1.2 * size, 0.4 * size);
    context.globalAlpha = 1;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} scale
   */
  #band(context, robot, scale) {
    const { x, y } = this.plan.roadmap;
    const { vertices, edges } = this.space.heldBy(robot);
    context.beginPath();
    for (const [tail, head] of edges) line(context, x[tail], y[tail], x[head], y[head]);
    for (const vertex of vertices) dot(context, x[vertex], y[vertex]);
    context.lineCap = context.lineJoin = "round";
    context.lineWidth = Math.max(2 * this.#half(robot), 3 / scale);
    context.strokeStyle = robot.colour;
    context.globalAlpha = this.choice.standsOut(robot.index) ? 0.3 : 0.14;
    context.stroke();
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }

  /**
   * Vertices and lanes that the smallest other robot may not book now because of this one.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} scale
   */
  #excluded(context, robot, scale) {
    const { roadmap } = this.plan;
    const others = this.choice.robots.filter((other) => other !== robot);
    if (!robot.radius || !others.length) return;
    const least = others.reduce((smallest, other) =>
      other.radius < smallest.radius ? other : smallest,
    );
    const limit = this.plan.room(robot, least) / roadmap.unit - 1e-9;
    const { vertices, edges } = this.space.heldBy(robot);
    const points = vertices.map((vertex) => /** @type {Lane} */ ([vertex, vertex]));
    const shapes = [...points, ...edges];
    const { x: xs, y: ys } = roadmap;
    const corners = shapes.flat();
    const [left, right] = [
      Math.min(...corners.map((at) => xs[at])) - limit,
      Math.max(...corners.map((at) => xs[at])) + limit,
    ];
    const [top, bottom] = [
      Math.min(...corners.map((at) => ys[at])) - limit,
      Math.max(...corners.map((at) => ys[at])) + limit,
    ];
    /**
     * @param {number} tail
     * @param {number} head
     */
    const isAround = (tail, head) =>
      Math.max(xs[tail], xs[head]) > left &&
      Math.min(xs[tail], xs[head]) < right &&
      Math.max(ys[tail], ys[head]) > top &&
      Math.min(ys[tail], ys[head]) < bottom;
    /**
     * @param {number} tail
     * @param {number} head
     */
    const isNear = (tail, head) =>
      isAround(tail, head) &&
      shapes.some((shape) => lanesApart(roadmap, shape, [tail, head]) < limit);
    /**
     * @param {number} tail
     * @param {number} head
     */
    const isOwn = (tail, head) =>
      edges.some(([from, to]) => (from === tail && to === head) || (from === head && to === tail));
    context.strokeStyle = this.theme.held;
    context.lineWidth = 2 / scale;
    context.setLineDash([5 / scale, 4 / scale]);
    context.beginPath();
    for (const [tail, head] of [...roadmap.lanes.bothWays, ...roadmap.lanes.oneWay]) {
      if (!isOwn(tail, head) && isNear(tail, head))
        line(context, xs[tail], ys[tail], xs[head], ys[head]);
    }
    context.stroke();
    context.setLineDash([]);
    context.beginPath();
    const reach = Math.max(4 / scale, Math.min(0.12, 7 / scale));
    for (let vertex = 0; vertex < roadmap.size; vertex++) {
      if (vertices.includes(vertex) || !isNear(vertex, vertex)) continue;
      const [x, y] = [xs[vertex], ys[vertex]];
      line(context, x - reach, y - reach, x + reach, y + reach);
      line(context, x - reach, y + reach, x + reach, y - reach);
    }
    context.stroke();
  }
}

/**
 * How far apart two lanes or vertices are, each given by its ends, in map units.
 *
 * @param {Roadmap} roadmap
 * @param {Lane} options
 * @param {Lane} other
 */
function lanesApart(roadmap, [a, b], [c, d]) {
  const { x, y } = roadmap;
  /**
   * @param {number} p
   * @param {number} q
   * @param {number} r
   */
  const turn = (p, q, r) => (x[q] - x[p]) * (y[r] - y[p]) - (y[q] - y[p]) * (x[r] - x[p]);
  if (turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0) return 0;
  /**
   * @param {number} vertex
   * @param {number} tail
   * @param {number} head
   */
  const gap = (vertex, tail, head) => {
    const [footX, footY] = footOn(roadmap, vertex, tail, head);
    return Math.hypot(x[vertex] - footX, y[vertex] - footY);
  };
  return Math.min(gap(a, c, d), gap(b, c, d), gap(c, a, b), gap(d, a, b));
}
