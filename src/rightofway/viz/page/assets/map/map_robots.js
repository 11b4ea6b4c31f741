import { FloorRobot } from "../plan/floor.js";
import { BROKEN, CHARGE, DONE, HELD, TURN, WAIT, WORK } from "../plan/phases.js";
import { bolt } from "./map_marks.js";
import { inkOn } from "../drawing/theme.js";
import { arc, disc, line, ring } from "../drawing/shapes.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Motion } from "../plan/motion.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */

const FEW = 80; // up to here, waiting robots point to where they want to go

/** The robots at their true size, if they have one: a disc that drives, a ring that waits, an arc that counts work, two that turn, a bolt that charges. */
export class MapRobots {
  /**
   * @param {Site} plan
   * @param {Motion} motion
   * @param {Motion} ghosts
   * @param {MapSizes} sizes
   * @param {Theme} theme
   * @param {Choice} choice
   */
  constructor(plan, motion, ghosts, sizes, theme, choice) {
    this.plan = plan;
    this.motion = motion;
    this.ghosts = ghosts;
    this.sizes = sizes;
    this.theme = theme;
    this.choice = choice;
  }

  /**
   * Paint all robots in map units; those that stand out come last, and so on top.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  paint(context, scale) {
    if (this.choice.ghosts)
      for (const robot of this.#haunted)
        this.#ghost(context, robot, this.#radius(robot, scale), scale);
    if (this.choice.robotIndex < 0) {
      if (this.choice.robots.length <= FEW)
        for (const robot of this.choice.robots) this.#wish(context, robot, scale);
      for (const robot of this.choice.robots)
        this.#robot(context, robot, this.#radius(robot, scale), scale);
    } else {
      context.globalAlpha = 0.4;
      for (const robot of this.choice.robots) {
        if (!this.choice.standsOut(robot.index))
          this.#robot(context, robot, this.#radius(robot, scale), scale);
      }
      context.globalAlpha = 1;
      const chosen = this.choice.decision?.robots ?? [this.choice.robotIndex];
      for (const index of chosen) this.#chosen(context, this.choice.robots[index], scale);
    }
    this.#faulty(context, scale);
  }

  /**
   * @param {Robot} robot
   * @param {number} scale
   */
  #radius(robot, scale) {
    return this.sizes.of(robot) / scale;
  }

  /**
   * A red ring round the robots that break a rule.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  #faulty(context, scale) {
    context.strokeStyle = this.theme.held;
    context.lineWidth = Math.max(0.03, 2 / scale);
    const { faulty } = this.choice;
    for (const index of faulty) {
      const robot = this.choice.robots[index];
      const radius = this.#radius(robot, scale);
      const wide = robot.radius
        ? radius + 4 / scale
        : faulty.length > FEW
          ? radius * 1.3
          : Math.max(radius * 1.75, 9 / scale);
      ring(context, this.motion.x[index], this.motion.y[index], wide);
    }
  }

  /** The robots shown with their ghosts: those chosen; all of a small fleet where none is. */
  get #haunted() {
    if (this.choice.robot)
      return this.choice.robots.filter(({ index }) => this.choice.standsOut(index));
    return this.choice.robots.length <= FEW ? this.choice.robots : [];
  }

  /**
   * A dashed ring where the plan has a robot that is elsewhere, and a line to where it is.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} radius
   * @param {number} scale
   */
  #ghost(context, robot, radius, scale) {
    const i = robot.index;
    const [x, y] = [this.ghosts.x[i], this.ghosts.y[i]];
    const [right, down] = [this.motion.x[i] - x, this.motion.y[i] - y];
    const apart = Math.hypot(right, down);
    if (apart < 0.02) return;
    context.strokeStyle = robot.colour;
    context.lineWidth = Math.max(0.045, 1.25 / scale);
    const outer = radius * 1.14; // seen round another robot, too
    if (radius * scale >= 5) context.setLineDash([outer * 0.34, outer * 0.284]); // ten dashes
    ring(context, x, y, outer);
    context.setLineDash([]);
    if (apart > outer + radius) {
      const share = outer / apart;
      context.globalAlpha = 0.6;
      context.beginPath();
      line(
        context,
        x + right * share,
        y + down * share,
        x + right * (1 - share),
        y + down * (1 - share),
      );
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} scale
   */
  #chosen(context, robot, scale) {
    const radius = this.#radius(robot, scale);
    const [x, y] = [this.motion.x[robot.index], this.motion.y[robot.index]];
    const grown = Math.max(radius, 7 / scale);
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 2.5 / scale;
    ring(
      context,
      x,
      y,
      grown + (this.#dialled(robot.index) && !robot.radius ? 0.42 * grown : 0) + 4 / scale,
    );
    this.#robot(context, robot, grown, scale);
  }

  /**
   * Whether work or turning is drawn round a robot.
   *
   * @param {number} index
   */
  #dialled(index) {
    const activity = this.motion.activity[index];
    return activity === WORK || activity === TURN;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} radius
   * @param {number} scale
   */
  #robot(context, robot, radius, scale) {
    const i = robot.index;
    const [x, y, activity] = [this.motion.x[i], this.motion.y[i], this.motion.activity[i]];
    const alpha = context.globalAlpha;
    if (this.#outlined) this.#outline(context, x, y, radius, scale);
    if (activity === WAIT) this.#waiting(context, robot, x, y, radius, scale);
    else if (activity === HELD || activity === BROKEN)
      this.#trouble(context, robot, x, y, radius, scale);
    else {
      if (activity === DONE) context.globalAlpha = alpha * 0.45;
      context.fillStyle = robot.colour;
      disc(context, x, y, radius);
      context.globalAlpha = alpha;
      if (activity === CHARGE) {
        context.fillStyle = inkOn(robot.colour);
        bolt(context, x, y, radius * 2);
      }
    }
    if (this.#dialled(i)) this.#dial(context, robot, x, y, radius, scale);
  }

  /** Whether robots are set apart from what lies behind; of a crowd only on the heat map. */
  get #outlined() {
    return this.choice.heat || this.choice.robots.length <= FEW;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   * @param {number} scale
   */
  #outline(context, x, y, radius, scale) {
    const alpha = context.globalAlpha;
    context.globalAlpha = 1;
    context.fillStyle = this.theme.floor;
    disc(context, x, y, radius + 1.5 / scale);
    context.globalAlpha = alpha;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   * @param {number} scale
   */
  #waiting(context, robot, x, y, radius, scale) {
    const width = Math.max(radius * 0.26, 1 / scale);
    context.fillStyle = this.theme.floor;
    disc(context, x, y, radius);
    context.strokeStyle = robot.colour;
    context.lineWidth = width;
    ring(context, x, y, radius - width / 2);
  }

  /**
   * Held up: a ring, half of it filled. Broken down: a ring with a cross.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   * @param {number} scale
   */
  #trouble(context, robot, x, y, radius, scale) {
    const broken = this.motion.activity[robot.index] === BROKEN;
    const width = Math.max(radius * 0.2, 1 / scale);
    context.fillStyle = this.theme.floor;
    disc(context, x, y, radius);
    context.fillStyle = context.strokeStyle = robot.colour;
    context.lineWidth = width;
    ring(context, x, y, radius - width / 2);
    context.beginPath();
    if (!broken) {
      context.arc(x, y, radius, Math.PI / 4, (5 * Math.PI) / 4);
      context.fill();
      return;
    }
    const reach = radius * 1.15;
    context.strokeStyle = this.theme.broken;
    context.lineWidth = Math.max(radius * 0.24, 1.5 / scale);
    line(context, x - reach, y - reach, x + reach, y + reach);
    line(context, x - reach, y + reach, x + reach, y - reach);
    context.stroke();
  }

  /**
   * A dotted line to the vertex that a waiting robot is kept from, below all robots.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} scale
   */
  #wish(context, robot, scale) {
    if (this.motion.activity[robot.index] !== WAIT) return;
    const [x, y] = [this.motion.x[robot.index], this.motion.y[robot.index]];
    const visit = robot.phases.visit[this.motion.phase[robot.index]];
    const planned = robot instanceof FloorRobot ? robot.planned : robot;
    const next = robot.vertices[visit + 1] ?? planned.vertices[visit + 1];
    if (next === undefined) return;
    const { x: xs, y: ys } = this.plan.roadmap;
    context.strokeStyle = robot.colour;
    context.lineWidth = Math.min(Math.max(0.06, 2.5 / scale), 5 / scale);
    context.lineCap = "round";
    context.setLineDash([0, 2.4 * context.lineWidth]);
    context.beginPath();
    line(context, x, y, xs[next], ys[next]);
    context.stroke();
    context.setLineDash([]);
    context.lineCap = "butt";
  }

  /**
   * Work fills a circle; turning sweeps two arcs round half of it. A true size has it inside.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} x
   * @param {number} y
   * @param {number} robotRadius
   * @param {number} scale
   */
  #dial(context, robot, x, y, robotRadius, scale) {
    const i = robot.index;
    const share = this.motion.share[i];
    const start = -Math.PI / 2;
    const radius = robot.radius ? robotRadius * 0.62 : robotRadius;
    context.strokeStyle = robot.radius ? this.theme.floor : robot.colour;
    context.lineWidth = Math.max(robotRadius * (robot.radius ? 0.12 : 0.17), 1 / scale);
    if (this.motion.activity[i] === WORK) {
      arc(context, x, y, radius * 1.3, start, start + 2 * Math.PI * share);
      context.globalAlpha *= 0.25;
      ring(context, x, y, radius * 1.3);
      context.globalAlpha *= 4;
    } else {
      for (const side of [0, Math.PI]) {
        const angle = start + side + Math.PI * share;
        arc(context, x, y, radius * 1.3, angle, angle + 0.9);
      }
    }
  }
}
