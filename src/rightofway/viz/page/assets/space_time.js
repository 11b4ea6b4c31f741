"use strict";

const TALLEST_ROW = 46;

/**
 * Space and time, as in a railway's graphic timetable: places upwards, time to the right. Fields are
 * bookings; a line is level while its robot stays, dashed while it waits, and slopes while it drives.
 */
class SpaceTime {
  constructor(plan, theme, words, use, choice, bottleneck) {
    Object.assign(this, { plan, theme, words, use, choice, bottleneck });
  }

  get title() {
    return this.choice.mode === "plan" ? this.#titleOfPlan : `Place over time; ${this.#signsOfFloor}`;
  }

  get #signsOfFloor() {
    const { robot, ghosts } = this.choice;
    const signs = ["stripes: held up", "orange: waits for a late robot"];
    if (ghosts) signs.push("thin lines: the plan");
    if (robot) signs.unshift(`along the route of ${robot.name}`);
    return signs.join(", ");
  }

  get #titleOfPlan() {
    const { robot, decision } = this.choice;
    if (decision) return "Place over time: lines are the two robots, fields what is booked";
    if (robot) return `Place over time along the route of ${robot.name}, and who else books it`;
    return "Place over time: lines are robots, fields what they book";
  }

  paint(context, area) {
    const vertices = this.#places();
    this.area = area;
    this.rows = new Map(vertices.map((vertex, row) => [vertex, row]));
    this.rowHeight = Math.min(area.height / vertices.length, TALLEST_ROW);
    this.#rowLines(context, vertices);
    const names = vertices.map((vertex) => this.words.vertex(vertex));
    paintRowNames(context, area, this.theme, names, this.rowHeight, (row) => this.#middle(row));
    for (const vertex of vertices) this.#bookings(context, vertex);
    this.bottleneck.paintDiagram(context, area, ({ vertex }) => this.#lane(vertex));
    if (this.choice.ghosts) for (const { planned } of this.#drawn()) this.#line(context, planned, true);
    for (const robot of this.#drawn()) this.#line(context, robot);
    if (this.choice.decision) this.#mark(context, this.choice.decision);
  }

  /** The rows from the bottom: the route of the chosen robot, or all places where these fit in. */
  #places() {
    const { robot, decision } = this.choice;
    if (!robot || (decision && this.plan.line.length)) return this.plan.line;
    return [...new Set(robot.vertices)];
  }

  /** The robots that have lines. */
  #drawn() {
    const { robot, decision } = this.choice;
    if (decision) return decision.robots.map((index) => this.plan.robots[index]);
    return robot ? [robot] : this.plan.robots;
  }

  #middle(row) {
    return this.area.bottom - (row + 0.5) * this.rowHeight;
  }

  /** The row of a vertex, or null. */
  #lane(vertex) {
    const row = this.rows.get(vertex);
    if (row === undefined) return null;
    const height = Math.min(Math.max(this.rowHeight * 0.5, 5), this.rowHeight);
    return { top: this.#middle(row) - height / 2, height };
  }

  #rowLines(context, vertices) {
    if (this.rowHeight < 9) return;
    context.strokeStyle = this.theme.line;
    context.lineWidth = 1;
    context.beginPath();
    vertices.forEach((_, row) => line(context, this.area.left, this.#middle(row), this.area.right, this.#middle(row)));
    context.stroke();
  }

  #bookings(context, vertex) {
    const { area, rowHeight } = this;
    const height = Math.max(rowHeight * 0.8, Math.min(rowHeight, 1));
    const top = this.#middle(this.rows.get(vertex)) - height / 2;
    for (const [robot, visit] of this.use.visitsAt(vertex)) {
      const [from, to] = this.plan.booking(robot, visit);
      const left = area.x(Math.max(from, 0));
      const width = Math.max(area.x(to) - left - 0.75, 0.75);
      context.fillStyle = robot.colour;
      context.globalAlpha = this.#strength(robot) * (robot.leave(visit) === Infinity ? 0.5 : 1);
      context.beginPath();
      context.roundRect(left, top, width, height, Math.min(3, height / 3, width / 3));
      context.fill();
    }
    context.globalAlpha = 1;
  }

  /** Where one robot is chosen, the others are what stands in its way. */
  #strength(robot) {
    if (!this.choice.robot) return 0.2;
    return robot === this.choice.robot ? 0.2 : this.choice.standsOut(robot.index) ? 0.6 : 0.4;
  }

  #line(context, robot, ghost = false) {
    const { phases, vertices } = robot;
    context.strokeStyle = robot.colour;
    context.lineJoin = "round";
    for (let i = 0; i < phases.begin.length; i++) {
      const activity = phases.activity[i];
      const from = this.rows.get(vertices[phases.visit[i]]);
      const to = activity === DRIVE ? this.rows.get(vertices[phases.visit[i] + 1]) : from;
      if (from === undefined || to === undefined) continue;
      if (ghost) this.#thin(context, phases.begin[i], phases.end(i), from, to);
      else {
        if (robot.plannedWait && activity === WAIT) this.#late(context, robot, i, from);
        this.#stroke(context, activity, phases.begin[i], phases.end(i), from, to);
      }
    }
    context.setLineDash([]);
    context.lineCap = "butt";
    context.globalAlpha = 1;
  }

  #thin(context, begin, end, from, to) {
    context.lineWidth = 1;
    context.globalAlpha = 0.75;
    context.beginPath();
    line(context, this.area.x(begin), this.#middle(from), this.area.x(end), this.#middle(to));
    context.stroke();
  }

  /** Underlay the part of a wait that the plan did not have. */
  #late(context, robot, phase, row) {
    const [from, to] = [robot.unplannedFrom(phase), robot.phases.end(phase)];
    if (from >= to) return;
    const height = Math.max(this.rowHeight * 0.34, 3);
    const left = this.area.x(from);
    context.fillStyle = this.theme.wait;
    context.fillRect(left, this.#middle(row) - height / 2, Math.max(this.area.x(to) - left, 1.5), height);
  }

  #stroke(context, activity, begin, end, from, to) {
    if (activity === HELD || activity === BROKEN) {
      this.#trouble(context, activity, begin, end, from);
      return;
    }
    const thin = Math.min(Math.max(this.rowHeight * 0.12, 1.25), 2.5);
    const heavy = activity === WORK || activity === TURN;
    context.lineWidth = heavy ? thin * 2.2 : thin;
    context.lineCap = heavy ? "butt" : "round";
    context.setLineDash(activity === WAIT ? [0.1, thin * 2.4] : []);
    context.globalAlpha = activity === DONE ? 0.4 : activity === TURN ? 0.6 : 1;
    context.beginPath();
    line(context, this.area.x(begin), this.#middle(from), this.area.x(end), this.#middle(to));
    context.stroke();
  }

  #trouble(context, activity, begin, end, row) {
    const height = Math.max(this.rowHeight * 0.4, 5);
    const left = this.area.x(begin);
    const width = Math.max(this.area.x(end) - left, 1.5);
    context.fillStyle = activity === HELD ? this.theme.held : this.theme.broken;
    if (activity === HELD) stripes(context, left, this.#middle(row) - height / 2, width, height);
    else crossedOut(context, left, this.#middle(row), width, height);
  }

  #mark(context, decision) {
    const rows = decision.vertices.map((vertex) => this.rows.get(vertex)).filter((row) => row !== undefined);
    if (!rows.length) return;
    const [low, high] = [Math.min(...rows), Math.max(...rows)];
    const height = (high - low + 1) * this.rowHeight;
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 1.5;
    context.beginPath();
    context.roundRect(this.area.x(decision.tick) - 6, this.#middle(high) - this.rowHeight / 2, 12, height, 6);
    context.stroke();
  }
}
