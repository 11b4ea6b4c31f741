import { Area, paintRowNames } from "./axis.js";
import { FloorRobot } from "../plan/floor.js";
import { texts } from "../language/language.js";
import { BROKEN, DONE, DRIVE, HELD, TURN, WAIT, WORK } from "../plan/phases.js";
import { crossedOut, stripes } from "../drawing/shapes.js";

/** @import { Bottleneck } from "./bottleneck.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */

export const MOST_ROWS = 60;
const HIGHEST_ROW = 52; // pixels
const THICKEST = 20; // pixels; a block
const ROW_WITH_GHOST = 9; // pixels; in lower rows only the end of the plan is marked

/** A row for each robot: a line while it drives, a frame while it waits, a block while it works. */
export class RobotRows {
  /**
   * @param {Plan} plan
   * @param {Theme} theme
   * @param {Choice} choice
   * @param {Bottleneck} bottleneck
   */
  constructor(plan, theme, choice, bottleneck) {
    this.plan = plan;
    this.theme = theme;
    this.choice = choice;
    this.bottleneck = bottleneck;
    this.area = new Area(theme.root.top, 0, 0, plan.end); // until the first frame
    this.rowHeight = HIGHEST_ROW;
  }

  get title() {
    const { mode, beside } = this.choice;
    const planned = beside ? texts.rows.grey({ isEndOnly: !this.#hasGhosts }) : "";
    return mode === "plan" ? texts.rows.title : texts.rows.floor + planned;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   */
  paint(context, area) {
    this.area = area;
    this.rowHeight = Math.min(area.height / this.choice.robots.length, HIGHEST_ROW);
    const names = this.choice.robots.map((robot) => robot.name);
    paintRowNames(context, area, this.theme, names, this.rowHeight, (row) => this.#middle(row));
    this.bottleneck.paintDiagram(context, area, ({ robot }) => this.lanes(robot)[0]);
    for (const robot of this.choice.robots) this.#row(context, robot);
    for (const robot of this.choice.beside ?? []) this.#ghost(context, robot);
  }

  /**
   * The row of a robot.
   *
   * @param {Robot} robot
   */
  lanes(robot) {
    return [{ top: this.#middle(robot.index) - this.rowHeight / 2, height: this.rowHeight }];
  }

  get #hasGhosts() {
    return this.choice.beside && this.rowHeight >= ROW_WITH_GHOST;
  }

  /**
   * The plan beside it as a thin row at the upper edge: a line, with blocks where the robot works or turns.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   */
  #ghost(context, robot) {
    const { phases } = robot;
    const thick = Math.max(this.rowHeight * 0.16, 1);
    const top = this.#middle(robot.index) - this.rowHeight * 0.46;
    context.fillStyle = this.theme.muted;
    if (this.rowHeight < ROW_WITH_GHOST) {
      context.fillRect(this.area.x(robot.completion) - 1, top, 2, this.rowHeight * 0.92);
      return;
    }
    /**
     * @param {number} from
     * @param {number} to
     * @param {number} height
     */
    const bar = (from, to, height) =>
      context.fillRect(
        this.area.x(from),
        top + (thick - height) / 2,
        this.area.x(to) - this.area.x(from),
        height,
      );
    bar(0, robot.completion, Math.max(thick * 0.3, 0.6));
    phases.activity.forEach((activity, i) => {
      if (activity === WORK || activity === TURN) bar(phases.begin[i], phases.end(i), thick);
    });
  }

  /**
   * The robot whose row is there, or -1.
   *
   * @param {number} y
   */
  robotAt(y) {
    const row = Math.floor((y - this.area.top) / this.rowHeight);
    return this.choice.robots[row] ? row : -1;
  }

  /** @param {number} row */
  #middle(row) {
    return this.area.top + (row + 0.5) * this.rowHeight;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   */
  #row(context, robot) {
    const { phases } = robot;
    const middle = this.#middle(robot.index) + (this.#hasGhosts ? this.rowHeight * 0.12 : 0);
    const full = Math.max(
      Math.min(this.rowHeight * (this.#hasGhosts ? 0.56 : 0.68), THICKEST),
      1.5,
    );
    context.fillStyle = context.strokeStyle = robot.colour;
    const begin = this.area.x(0);
    context.fillRect(
      begin,
      middle - full * 0.16,
      this.area.x(robot.completion) - begin,
      full * 0.32,
    );
    for (let i = 0; i < phases.begin.length; i++) {
      const left = this.area.x(phases.begin[i]);
      const right = this.area.x(phases.end(i));
      this.#bar(context, phases.activity[i], left, right - left, middle, full);
      if (robot instanceof FloorRobot && phases.activity[i] === WAIT)
        this.#late(context, robot, i, right, middle, full);
    }
  }

  /**
   * The part of a wait that the plan did not have.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {FloorRobot} robot
   * @param {number} phase
   * @param {number} right
   * @param {number} middle
   * @param {number} full
   */
  #late(context, robot, phase, right, middle, full) {
    const from = this.area.x(robot.unplannedFrom(phase));
    if (from >= right) return;
    const colour = context.fillStyle;
    context.fillStyle = this.theme.wait;
    context.fillRect(from, middle - full / 2, Math.max(right - from, 1), full);
    if (full > 4) this.#frame(context, from, right - from, middle, full);
    context.fillStyle = colour;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} activity
   * @param {number} left
   * @param {number} width
   * @param {number} middle
   * @param {number} full
   */
  #bar(context, activity, left, width, middle, full) {
    if (activity === DONE || activity === DRIVE) return;
    const colour = context.fillStyle;
    context.fillStyle = this.theme.paper;
    context.fillRect(left, middle - full / 2, width, full);
    context.fillStyle = colour;
    context.globalAlpha = activity === TURN ? 0.55 : 1;
    if (activity === HELD || activity === BROKEN) {
      context.fillStyle = activity === HELD ? this.theme.held : this.theme.broken;
      if (activity === HELD) stripes(context, left, middle - full / 2, Math.max(width, 1.5), full);
      else crossedOut(context, left, middle, width, full);
      context.fillStyle = colour;
    } else if (activity !== WAIT) context.fillRect(left, middle - full / 2, width, full);
    else if (full > 4) this.#frame(context, left, width, middle, full);
    context.globalAlpha = 1;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} left
   * @param {number} width
   * @param {number} middle
   * @param {number} full
   */
  #frame(context, left, width, middle, full) {
    context.lineWidth = 1.25;
    context.strokeRect(left + 0.6, middle - full / 2 + 0.6, Math.max(width - 1.2, 0.5), full - 1.2);
  }
}
