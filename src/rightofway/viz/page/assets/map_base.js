"use strict";

const NAMED_CELL = 46; // vertices have their names from this size on [pixels]
const RULED_CELL = 13; // cells have lines between them from this size on
const MARKED = 0.84; // side of a home or stop, of a cell

/** What does not move: floor, walls, edges, heat, homes, stops, names of vertices. */
class MapBase {
  constructor(plan, viewport, theme, choice, use, bottleneck) {
    Object.assign(this, { plan, viewport, theme, choice, use, bottleneck });
  }

  /** Paint everything in map units: one unit is a cell. */
  paint(context) {
    const { scale, left, top } = this.viewport;
    context.save();
    context.translate(left, top);
    context.scale(scale, scale);
    if (this.plan.roadmap.rows) this.#grid(context);
    else this.#network(context);
    if (this.choice.heat) this.#heat(context);
    this.bottleneck.paintMap(context, scale);
    for (const robot of this.plan.robots) this.#marks(context, robot);
    context.restore();
    if (scale >= NAMED_CELL) this.#names(context);
  }

  /** A length in pixels, in map units. */
  #pixels(length) {
    return length / this.viewport.scale;
  }

  /** Whether marks are so small that they would hide the robots. */
  get #crowded() {
    return this.viewport.scale < RULED_CELL;
  }

  #grid(context) {
    const { width, height, rows } = this.plan.roadmap;
    context.fillStyle = this.theme.floor;
    context.fillRect(-0.5, -0.5, width, height);
    if (this.viewport.scale >= RULED_CELL) this.#rules(context, width, height);
    context.fillStyle = this.theme.wall;
    rows.forEach((row, y) => {
      for (const run of row.matchAll(/[^.]+/g)) {
        const more = y + 1 < height ? this.#pixels(0.6) : 0; // no hairline between two rows
        context.fillRect(run.index - 0.5, y - 0.5, run[0].length, 1 + more * (rows[y + 1]?.[run.index] !== "."));
      }
    });
    context.strokeStyle = this.theme.wall;
    context.lineWidth = this.#pixels(1);
    context.strokeRect(-0.5, -0.5, width, height);
  }

  #rules(context, width, height) {
    context.strokeStyle = this.theme.line;
    context.lineWidth = this.#pixels(1);
    context.beginPath();
    for (let x = 1; x < width; x++) line(context, x - 0.5, -0.5, x - 0.5, height - 0.5);
    for (let y = 1; y < height; y++) line(context, -0.5, y - 0.5, width - 0.5, y - 0.5);
    context.stroke();
  }

  #network(context) {
    const { x, y, tails, heads, size } = this.plan.roadmap;
    const both = new Set(tails.map((tail, edge) => tail * size + heads[edge]));
    context.strokeStyle = context.fillStyle = this.theme.wall;
    context.lineWidth = Math.max(0.07, this.#pixels(1));
    context.beginPath();
    for (let edge = 0; edge < tails.length; edge++) {
      const [tail, head] = [tails[edge], heads[edge]];
      const twoWay = both.has(head * size + tail);
      if (tail < head || !twoWay) line(context, x[tail], y[tail], x[head], y[head]);
      if (!twoWay) arrowHead(context, x[tail], y[tail], x[head], y[head]);
    }
    context.stroke();
    for (let vertex = 0; vertex < size; vertex++) disc(context, x[vertex], y[vertex], 0.13);
  }

  #heat(context) {
    const { x, y } = this.plan.roadmap;
    const { heatLow, heatHigh } = this.theme;
    this.use.held.forEach((ticks, vertex) => {
      if (!ticks) return;
      context.fillStyle = blend(heatLow, heatHigh, Math.sqrt(ticks / this.use.most));
      if (this.plan.roadmap.rows) context.fillRect(x[vertex] - 0.5, y[vertex] - 0.5, 1, 1);
      else disc(context, x[vertex], y[vertex], 0.4);
    });
  }

  /** A home is a frame, a stop a tinted field with a diamond, both in the robot's colour. */
  #marks(context, robot) {
    context.globalAlpha = (this.choice.standsOut(robot.index) ? 1 : 0.2) * (this.#crowded ? 0.45 : 1);
    const { x, y } = this.plan.roadmap;
    const strength = context.globalAlpha;
    context.strokeStyle = context.fillStyle = robot.colour;
    context.lineWidth = Math.max(0.03, this.#pixels(1));
    for (const vertex of new Set(robot.stages.map((stage) => stage.vertex))) {
      if (vertex === robot.home) continue;
      context.globalAlpha = strength * (this.choice.heat ? 0 : 0.16);
      field(context, x[vertex], y[vertex], MARKED);
      context.fill();
      context.globalAlpha = strength;
      if (this.#crowded) continue;
      diamond(context, x[vertex], y[vertex], 0.17);
      context.fill();
    }
    field(context, x[robot.home], y[robot.home], MARKED - 0.05);
    context.stroke();
    context.globalAlpha = 1;
  }

  #names(context) {
    const { roadmap } = this.plan;
    const { scale, left, top } = this.viewport;
    const [right, down] = roadmap.rows ? [-0.34, -0.35] : [0, -0.5];
    context.font = this.theme.font(Math.min(Math.max(scale * 0.14, 9.5), 13));
    context.fillStyle = this.theme.muted;
    context.textBaseline = roadmap.rows ? "top" : "bottom";
    context.textAlign = roadmap.rows ? "left" : "center";
    for (let vertex = 0; vertex < roadmap.size; vertex++) {
      const x = left + (roadmap.x[vertex] + right) * scale;
      const y = top + (roadmap.y[vertex] + down) * scale;
      context.fillText(shortened(context, roadmap.name(vertex), scale * 0.8), x, y);
    }
  }
}
