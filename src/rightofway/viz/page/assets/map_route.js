"use strict";

const LANE = 0.11; // how far a route runs to the right of the middle, so that the way back is another line

/** Where two lanes beside a route meet, seen from its vertex; two points where it turns back. */
function corner(before, after) {
  const along = (before.x * after.x + before.y * after.y) / LANE ** 2;
  if (along < -0.5) return [before, after];
  return [{ x: (before.x + after.x) / (1 + along), y: (before.y + after.y) / (1 + along) }];
}

/** The route of the chosen robot and the place of the chosen decision. */
class MapRoute {
  constructor(plan, motion, theme, choice) {
    Object.assign(this, { plan, motion, theme, choice });
  }

  paint(context, scale) {
    const { robot, decision } = this.choice;
    if (decision) this.#place(context, decision, scale);
    const chosen = decision?.robots ?? (robot ? [robot.index] : []);
    for (const index of chosen) this.#route(context, this.plan.robots[index], scale);
  }

  /** What lies behind is faint, what lies ahead is strong. */
  #route(context, robot, scale) {
    const now = robot.phases.visit[this.motion.phase[robot.index]];
    context.strokeStyle = robot.colour;
    context.lineJoin = context.lineCap = "round";
    context.lineWidth = Math.max(0.08, 1.5 / scale);
    context.globalAlpha = 0.28;
    this.#lane(context, robot, 0, now);
    context.globalAlpha = 0.9;
    this.#lane(context, robot, now, robot.vertices.length - 1);
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }

  #lane(context, robot, from, to) {
    if (from === to) return;
    const { x, y } = this.plan.roadmap;
    let before = this.#side(robot, from);
    context.beginPath();
    context.moveTo(x[robot.vertices[from]] + before.x, y[robot.vertices[from]] + before.y);
    for (let visit = from + 1; visit <= to; visit++) {
      const vertex = robot.vertices[visit];
      const after = visit < to ? this.#side(robot, visit) : before;
      for (const turn of corner(before, after)) context.lineTo(x[vertex] + turn.x, y[vertex] + turn.y);
      before = after;
    }
    context.stroke();
  }

  /** To the right of the way from a visit to the next: a vector as long as a lane is off. */
  #side(robot, visit) {
    const { x, y } = this.plan.roadmap;
    const [tail, head] = [robot.vertices[visit], robot.vertices[visit + 1]];
    const [across, down] = [x[head] - x[tail], y[head] - y[tail]];
    const length = Math.hypot(across, down) || 1;
    return { x: (-down / length) * LANE, y: (across / length) * LANE };
  }

  #place(context, decision, scale) {
    const { x, y } = this.plan.roadmap;
    const vertices = [decision.vertices[0], ...decision.vertices]; // a line of one point is drawn, too
    context.strokeStyle = this.theme.ink;
    context.lineCap = context.lineJoin = "round";
    context.lineWidth = Math.max(0.95, 12 / scale);
    context.globalAlpha = 0.22;
    context.beginPath();
    vertices.forEach((vertex, i) => (i ? context.lineTo(x[vertex], y[vertex]) : context.moveTo(x[vertex], y[vertex])));
    context.stroke();
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }
}
