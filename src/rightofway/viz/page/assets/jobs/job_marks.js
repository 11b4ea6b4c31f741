import { chevron, diamond, disc, ring } from "../drawing/shapes.js";
import { inkOn } from "../drawing/theme.js";
import { bolt } from "../map/map_marks.js";

/** @import { Area } from "../timetable/axis.js" */
/** @import { SpanRow } from "../timetable/bottleneck.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */

const TALLEST = 20; // pixels, of a mark in the diagram
const NAME_FROM = 11; // pixels, the height of a mark with the name of its job

/** Jobs in other views: the way of the chosen one on the map, work and charges in the diagram. */
export class JobMarks {
  /**
   * @param {Plan} plan
   * @param {Theme} theme
   * @param {Choice} choice
   */
  constructor(plan, theme, choice) {
    this.plan = plan;
    this.theme = theme;
    this.choice = choice;
  }

  /**
   * A job with a stop at a place: the next one after the job that is chosen; -1 for none.
   *
   * @param {number} vertex
   */
  jobAt(vertex) {
    const here = this.plan.jobs.flatMap(({ stops }, index) =>
      stops.some(([at]) => at === vertex) ? [index] : [],
    );
    return here.find((index) => index > this.choice.jobIndex) ?? here[0] ?? -1;
  }

  /**
   * The stops of the chosen job in their order, with arrows between them, in units of the map.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} scale
   */
  paintMap(context, scale) {
    const { job } = this.choice;
    if (!job) return;
    const { x, y } = this.plan.roadmap;
    const places = job.stops.map(([vertex]) => ({ x: x[vertex], y: y[vertex] }));
    paintStops(context, this.theme, places, scale);
  }

  /**
   * Work and charges over the lines of robots: work with the name of its job, charges with a sign.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {(robot: Robot, vertex: number) => SpanRow[]} lanesOf
   */
  paintDiagram(context, area, lanesOf) {
    if (this.choice.mode !== "plan") return;
    for (const robot of this.choice.robots) {
      if (this.choice.robot && !this.choice.standsOut(robot.index)) continue;
      for (const [job, , vertex, begin, end] of this.plan.tours[robot.index].items)
        for (const lane of lanesOf(robot, vertex))
          this.#item(context, robot, job, lane, area.x(begin), area.x(end));
    }
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {number} job
   * @param {SpanRow} lane
   * @param {number} left
   * @param {number} right
   */
  #item(context, robot, job, { top, height }, left, right) {
    const full = Math.min(height * 0.76, TALLEST);
    const [middle, width] = [top + height / 2, Math.max(right - left, 2)];
    const isChosen = job >= 0 && job === this.choice.jobIndex;
    context.lineWidth = isChosen ? 2 : 1.25;
    context.fillStyle = job < 0 ? this.theme.paper : robot.colour;
    context.strokeStyle = isChosen ? this.theme.ink : job < 0 ? robot.colour : this.theme.paper;
    if (job >= 0 && right - left < 2) {
      diamond(context, left, middle, Math.max(full * 0.42, 3));
      context.fill();
    } else {
      context.beginPath();
      context.roundRect(left, middle - full / 2, width, full, Math.min(3, full / 3, width / 3));
      context.fill();
    }
    context.stroke();
    if (job < 0) this.#bolt(context, (left + right) / 2, middle, Math.min(full, width));
    else this.#name(context, robot, this.plan.jobs[job].name, left, width, middle, full);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} x
   * @param {number} y
   * @param {number} side
   */
  #bolt(context, x, y, side) {
    if (side < 5) return;
    context.fillStyle = this.theme.ink;
    bolt(context, x, y, side);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Robot} robot
   * @param {string} name
   * @param {number} left
   * @param {number} width
   * @param {number} middle
   * @param {number} full
   */
  #name(context, robot, name, left, width, middle, full) {
    if (full < NAME_FROM) return;
    context.font = this.theme.font(Math.min(full * 0.78, 12));
    if (context.measureText(name).width > width - 6) return;
    context.fillStyle = inkOn(robot.colour);
    context.textAlign = "center";
    context.textBaseline = "middle";
    context.fillText(name, left + width / 2, middle + 0.5);
  }
}

/**
 * Stops in their order, with arrows between them, in units of the map; the first one has a dot.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {Theme} theme
 * @param {{ x: number, y: number }[]} places
 * @param {number} scale
 */
export function paintStops(context, theme, places, scale) {
  context.lineCap = context.lineJoin = "round";
  for (const { colour, width } of [
    { colour: theme.paper, width: 7 },
    { colour: theme.ink, width: 2.5 },
  ]) {
    context.strokeStyle = context.fillStyle = colour;
    context.lineWidth = width / scale;
    places.slice(1).forEach((to, i) => arrow(context, places[i], to, scale));
    for (const place of places) {
      ring(context, place.x, place.y, 7 / scale);
      context.stroke();
    }
    if (places.length) disc(context, places[0].x, places[0].y, 4 / scale);
  }
  context.lineCap = "butt";
}

/**
 * A dashed line with a head in its middle, so that the place it leads to stays in sight.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {{ x: number, y: number }} from
 * @param {{ x: number, y: number }} to
 * @param {number} scale
 */
export function arrow(context, from, to, scale) {
  const [across, down] = [to.x - from.x, to.y - from.y];
  const length = Math.hypot(across, down);
  if (length * scale < 16) return;
  const [right, below] = [across / length, down / length];
  const gap = 7 / scale; // the radius of the ring at either end
  context.setLineDash([6 / scale, 5 / scale]);
  context.beginPath();
  context.moveTo(from.x + right * gap, from.y + below * gap);
  context.lineTo(to.x - right * gap, to.y - below * gap);
  context.stroke();
  context.setLineDash([]);
  context.beginPath();
  const middle = length * 0.55;
  chevron(
    context,
    from.x + right * middle,
    from.y + below * middle,
    Math.atan2(down, across),
    7 / scale,
  );
  context.stroke();
}
