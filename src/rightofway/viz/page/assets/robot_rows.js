"use strict";

const MOST_ROWS = 60;

/** A row for each robot: a line while it drives, a frame while it waits, a block while it works. */
class RobotRows {
  constructor(plan, theme) {
    Object.assign(this, { plan, theme });
    this.title = "Robots over time: a line is driving, a frame waiting, a block working or turning";
  }

  paint(context, area) {
    this.area = area;
    this.rowHeight = Math.min(area.height / this.plan.robots.length, 24);
    const names = this.plan.robots.map((robot) => robot.name);
    paintRowNames(context, area, this.theme, names, this.rowHeight, (row) => this.#middle(row));
    for (const robot of this.plan.robots) this.#row(context, robot);
  }

  /** The robot whose row is there, or -1. */
  robotAt(y) {
    const row = Math.floor((y - this.area.top) / this.rowHeight);
    return this.plan.robots[row] ? row : -1;
  }

  #middle(row) {
    return this.area.top + (row + 0.5) * this.rowHeight;
  }

  #row(context, robot) {
    const { phases } = robot;
    const middle = this.#middle(robot.index);
    const full = Math.max(this.rowHeight * 0.68, 1.5);
    context.fillStyle = context.strokeStyle = robot.colour;
    const begin = this.area.x(0);
    context.fillRect(begin, middle - full * 0.16, this.area.x(robot.completion) - begin, full * 0.32);
    for (let i = 0; i < phases.begin.length; i++) {
      const left = this.area.x(phases.begin[i]);
      this.#bar(context, phases.activity[i], left, this.area.x(phases.end(i)) - left, middle, full);
    }
  }

  #bar(context, activity, left, width, middle, full) {
    if (activity === DONE || activity === DRIVE) return;
    const colour = context.fillStyle;
    context.fillStyle = this.theme.paper;
    context.fillRect(left, middle - full / 2, width, full);
    context.fillStyle = colour;
    context.globalAlpha = activity === TURN ? 0.55 : 1;
    if (activity !== WAIT) context.fillRect(left, middle - full / 2, width, full);
    else if (full > 4) this.#frame(context, left, width, middle, full);
    context.globalAlpha = 1;
  }

  #frame(context, left, width, middle, full) {
    context.lineWidth = 1.25;
    context.strokeRect(left + 0.6, middle - full / 2 + 0.6, Math.max(width - 1.2, 0.5), full - 1.2);
  }
}
