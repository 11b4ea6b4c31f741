"use strict";

const RULED_CELL = 13; // cells have lines between them from this size on [pixels]
const MANY_ROBOTS = 200; // of more, homes and stops are faint, or they would hide the robots
const ARROW_GAP = 56; // pixels between two arrow heads of a lane
const MOST_SIGNED = 3000; // lanes in sight; of more, none has arrow heads or a dashed middle

/** What does not move: background, floor, walls, lanes, heat, homes, stops. */
class MapBase {
  constructor(plan, viewport, sizes, theme, choice, use, bottleneck) {
    Object.assign(this, { plan, viewport, sizes, theme, choice, use, bottleneck });
  }

  /** Paint everything in map units: one unit is a cell. */
  paint(context) {
    const { scale, left, top } = this.viewport;
    context.save();
    context.translate(left, top);
    context.scale(scale, scale);
    if (this.plan.roadmap.rows) this.#grid(context);
    else {
      if (this.plan.roadmap.sides) this.#squares(context);
      this.#picture(context);
      if (!this.plan.roadmap.sides) this.#network(context);
    }
    if (this.choice.heat) this.#heat(context);
    this.bottleneck.paintMap(context, scale);
    this.#corridor(context, this.choice.corridor ?? this.choice.picked ?? []);
    this.#homes(context);
    this.#stops(context);
    context.restore();
  }

  /** A length in pixels, in map units. */
  #pixels(length) {
    return length / this.viewport.scale;
  }

  /** The picture under the map; the map is painted again once that is there. */
  #picture(context) {
    const { background } = this.plan.roadmap;
    if (!background) return;
    if (!this.image) {
      this.image = new Image();
      this.image.addEventListener("load", () => this.viewport.tell("view"));
      this.image.src = background.href;
    }
    if (!this.image.complete) return;
    const isDark = inkOn(this.theme.paper) === "#ffffff"; // a white floor plan would glare there
    context.globalAlpha = background.opacity * (isDark ? 0.4 : 1);
    context.drawImage(this.image, background.x, background.y, background.width, background.height);
    context.globalAlpha = 1;
  }

  #grid(context) {
    const { width, height, rows } = this.plan.roadmap;
    context.fillStyle = this.theme.floor;
    context.fillRect(-0.5, -0.5, width, height);
    this.#picture(context);
    if (this.viewport.scale >= RULED_CELL) this.#rules(context, width, height);
    context.fillStyle = this.theme.wall;
    context.globalAlpha = this.plan.roadmap.background ? 0.6 : 1;
    rows.forEach((row, y) => {
      for (const run of row.matchAll(/[^.]+/g)) {
        const more = y + 1 < height ? this.#pixels(0.6) : 0; // no hairline between two rows
        context.fillRect(run.index - 0.5, y - 0.5, run[0].length, 1 + more * (rows[y + 1]?.[run.index] !== "."));
      }
    });
    context.globalAlpha = 1;
    context.strokeStyle = this.theme.wall;
    context.lineWidth = this.#pixels(1);
    context.strokeRect(-0.5, -0.5, width, height);
  }

  /** The cells of a quadtree; what is not free between them is wall. */
  #squares(context) {
    const { width, height, x, y, sides } = this.plan.roadmap;
    const gap = this.viewport.scale >= RULED_CELL / 2 ? this.#pixels(1) : 0;
    context.fillStyle = this.theme.wall;
    context.fillRect(-0.5, -0.5, width, height);
    context.fillStyle = this.theme.line;
    const fill = (less) => sides.forEach((side, vertex) => context.fillRect(x[vertex] - side / 2, y[vertex] - side / 2, side - less, side - less));
    fill(this.#pixels(-0.3)); // no hairline between two cells
    context.fillStyle = this.theme.floor;
    fill(gap);
  }

  #rules(context, width, height) {
    context.strokeStyle = this.theme.line;
    context.lineWidth = this.#pixels(1);
    context.beginPath();
    for (let x = 1; x < width; x++) line(context, x - 0.5, -0.5, x - 0.5, height - 0.5);
    for (let y = 1; y < height; y++) line(context, -0.5, y - 0.5, width - 0.5, y - 0.5);
    context.stroke();
  }

  /** Lanes: broad with a dashed middle where both ways are driven, narrower with arrow heads for one way. */
  #network(context) {
    const { x, y } = this.plan.roadmap;
    const [oneWay, bothWays] = [this.plan.roadmap.lanes.oneWay, this.plan.roadmap.lanes.bothWays].map((lanes) => this.#inSight(lanes));
    const { lane } = this.sizes;
    const draw = (lanes, width, colour) => {
      context.strokeStyle = colour;
      context.lineWidth = this.#pixels(width);
      context.beginPath();
      for (const [tail, head] of lanes) line(context, x[tail], y[tail], x[head], y[head]);
      context.stroke();
    };
    context.lineCap = "round";
    draw(bothWays, lane, this.theme.wall);
    draw(oneWay, lane * 0.7, this.theme.wall);
    context.lineCap = "butt";
    if (lane < 3.5) return;
    if (oneWay.length + bothWays.length <= MOST_SIGNED) {
      context.setLineDash([this.#pixels(5), this.#pixels(5)]);
      draw(bothWays, 1, this.theme.paper);
      context.setLineDash([]);
      this.#arrows(context, oneWay);
    }
    this.#vertices(context, [...oneWay, ...bothWays]);
  }

  /** The lanes of which something may be seen. */
  #inSight(lanes) {
    const { x, y } = this.plan.roadmap;
    const { viewport } = this;
    const { clientWidth: width, clientHeight: height } = viewport.canvas;
    const [left, top, right, bottom] = [viewport.toX(-20), viewport.toY(-20), viewport.toX(width + 20), viewport.toY(height + 20)];
    return lanes.filter(([tail, head]) =>
      Math.max(x[tail], x[head]) >= left && Math.min(x[tail], x[head]) <= right &&
      Math.max(y[tail], y[head]) >= top && Math.min(y[tail], y[head]) <= bottom);
  }

  /** The ends of lanes, and vertices without any. */
  #vertices(context, lanes) {
    const { x, y, lonely } = this.plan.roadmap;
    const isMany = lanes.length > MOST_SIGNED; // then they are plain dots, which are drawn sooner
    const side = this.#pixels(this.sizes.vertex);
    context.fillStyle = isMany ? this.theme.muted : this.theme.paper;
    context.strokeStyle = this.theme.muted;
    context.lineWidth = this.#pixels(1.25);
    for (const vertex of new Set([...lanes.flat(), ...lonely])) {
      if (isMany) context.fillRect(x[vertex] - side / 2, y[vertex] - side / 2, side, side);
      else {
        disc(context, x[vertex], y[vertex], side);
        context.stroke();
      }
    }
  }

  #arrows(context, lanes) {
    const { x, y } = this.plan.roadmap;
    const size = Math.min(Math.max(this.sizes.lane * 0.32, 3), 5);
    context.strokeStyle = this.theme.muted;
    context.lineWidth = this.#pixels(1.75);
    context.lineCap = context.lineJoin = "round";
    context.beginPath();
    for (const [tail, head] of lanes) {
      const [right, down] = [x[head] - x[tail], y[head] - y[tail]];
      const length = Math.hypot(right, down) * this.viewport.scale;
      if (length < 2 * this.sizes.vertex + 3 * size) continue;
      const count = Math.max(Math.floor(length / ARROW_GAP), 1);
      for (let i = 0; i < count; i++) {
        const share = (i + 0.5) / count;
        chevron(context, x[tail] + right * share, y[tail] + down * share, Math.atan2(down, right), this.#pixels(size));
      }
    }
    context.stroke();
    context.lineCap = "butt";
  }

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

  /** The corridor that the diagram is drawn along, or the end of it that is chosen. */
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

  #strength(robot) {
    return (this.choice.standsOut(robot.index) ? 1 : 0.25) * (this.plan.robots.length > MANY_ROBOTS ? 0.45 : 1);
  }

  /** A home is a frame in the robot's colour. */
  #homes(context) {
    const { x, y } = this.plan.roadmap;
    const side = this.#pixels(2 * this.sizes.home);
    context.lineWidth = this.#pixels(Math.min(Math.max(this.sizes.home * 0.1, 1.5), 3));
    for (const robot of this.plan.robots) {
      const strength = this.#strength(robot);
      field(context, x[robot.home], y[robot.home], side);
      context.fillStyle = this.theme.floor;
      context.globalAlpha = this.choice.heat ? 0 : strength;
      context.fill();
      context.fillStyle = context.strokeStyle = robot.colour;
      context.globalAlpha *= 0.12;
      context.fill();
      context.globalAlpha = strength;
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  /** A stop is a diamond in the robot's colour; those of several robots stand side by side. */
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
