import { chevron, disc, dot, field, line, ring } from "../drawing/shapes.js";

/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Roadmap, Zone } from "../plan/roadmap.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Viewport } from "../drawing/viewport.js" */
/** @import { CloseData } from "../payload.d.ts" */

const AXIS = 34; // pixels, of the axes of the site's frame

/** What is marked on a map: zones, closures, speed limits, stations, parking places, crossings. */
export class MapMarks {
  /**
   * @param {Site} site
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   * @param {Theme} theme
   */
  constructor(site, viewport, sizes, theme) {
    this.site = site;
    this.viewport = viewport;
    this.sizes = sizes;
    this.theme = theme;
    this.zones = site.roadmap.zones.map((zone) => tracedZone(zone, site.roadmap));
  }

  /**
   * Paint in map units; with `withNear` also what is nearer than robots need.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {boolean} withNear
   */
  paint(context, withNear) {
    this.#zones(context);
    const { close } = this.site.roadmap;
    if (close) {
      if (withNear) this.#near(context, close);
      this.#crossings(context, close.crossings);
    }
    this.#signs(context);
    if (this.site.isStill || this.site.roadmap.background) this.#frame(context);
  }

  /**
   * The axes of the site's frame at its origin, x in red and y in blue.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #frame(context) {
    const { roadmap } = this.site;
    const [x, y] = roadmap.toDrawing(0, 0);
    const length = this.#pixels(AXIS);
    context.lineWidth = this.#pixels(2);
    for (const { colour, toX, toY } of [
      { colour: this.theme.held, toX: 1, toY: 0 },
      { colour: this.theme.drive, toX: 0, toY: 1 },
    ]) {
      const [endX, endY] = roadmap.toDrawing(toX, toY);
      const [right, down] = [endX - x, endY - y];
      const share = length / Math.hypot(right, down);
      const [tipX, tipY] = [x + right * share, y + down * share];
      context.strokeStyle = colour;
      context.beginPath();
      line(context, x, y, tipX, tipY);
      chevron(context, tipX, tipY, Math.atan2(down, right), this.#pixels(4));
      context.stroke();
    }
  }

  /** @param {number} length */
  #pixels(length) {
    return length / this.viewport.scale;
  }

  /**
   * The members of each zone, as a band below the lanes' middles.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #zones(context) {
    context.lineCap = context.lineJoin = "round";
    context.lineWidth = this.#pixels(this.sizes.zone);
    context.strokeStyle = this.theme.zone;
    context.globalAlpha = 0.3;
    for (const path of this.zones) context.stroke(path);
    context.globalAlpha = 1;
    context.lineCap = "butt";
  }

  /**
   * Where two lanes cross without a vertex: a small cross in a ring.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {[number, number, number, number][]} crossings
   */
  #crossings(context, crossings) {
    const radius = this.#pixels(Math.min(Math.max(this.sizes.lane * 0.5, 3), 7));
    context.strokeStyle = this.theme.muted;
    context.fillStyle = this.theme.paper;
    context.lineWidth = this.#pixels(1.25);
    for (const lanes of crossings) {
      const [x, y] = crossingOf(this.site.roadmap, lanes);
      disc(context, x, y, radius);
      ring(context, x, y, radius);
      context.beginPath();
      const reach = radius * 0.5;
      line(context, x - reach, y - reach, x + reach, y + reach);
      line(context, x - reach, y + reach, x + reach, y - reach);
      context.stroke();
    }
  }

  /**
   * A dashed line between what is nearer than the largest robots need.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Required<CloseData>} options
   */
  #near(context, { beside, vertices }) {
    const { roadmap } = this.site;
    const { x, y } = roadmap;
    context.strokeStyle = this.theme.held;
    context.lineWidth = this.#pixels(1.25);
    context.setLineDash([this.#pixels(3), this.#pixels(3)]);
    context.beginPath();
    for (const [one, other] of vertices) line(context, x[one], y[one], x[other], y[other]);
    for (const [vertex, tail, head] of beside) {
      const [footX, footY] = footOn(roadmap, vertex, tail, head);
      line(context, x[vertex], y[vertex], footX, footY);
    }
    context.stroke();
    context.setLineDash([]);
  }

  /**
   * A square sign: S for a station, P for parking, a bolt for charging.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #signs(context) {
    const { x, y, stations, parking, charging } = this.site.roadmap;
    const half = this.sizes.sign;
    for (const { vertex, kind } of [
      ...Array.from(stations.keys(), (at) => ({ vertex: at, kind: "S" })),
      ...Array.from(parking, (at) => ({ vertex: at, kind: "P" })),
      ...Array.from(charging, (at) => ({ vertex: at, kind: "" })),
    ]) {
      const side = this.#pixels(2 * half);
      context.fillStyle = this.theme.muted;
      field(context, x[vertex], y[vertex], side);
      context.fill();
      context.fillStyle = this.theme.paper;
      if (kind) letter(context, kind, x[vertex], y[vertex], this.theme, side);
      else bolt(context, x[vertex], y[vertex], side);
    }
  }
}

/**
 * A zone's lanes and vertices as one path, in map units.
 *
 * @param {Zone} options
 * @param {Roadmap} other
 */
function tracedZone({ vertices, edges }, { x, y }) {
  const path = new Path2D();
  for (const [tail, head] of edges) line(path, x[tail], y[tail], x[head], y[head]);
  for (const vertex of vertices) dot(path, x[vertex], y[vertex]);
  return path;
}

/**
 * Where the straight lines of two lanes cross.
 *
 * @param {Roadmap} options
 * @param {[number, number, number, number]} other
 */
export function crossingOf({ x, y }, [a, b, c, d]) {
  const [right, down] = [x[b] - x[a], y[b] - y[a]];
  const [otherRight, otherDown] = [x[d] - x[c], y[d] - y[c]];
  const cross = right * otherDown - down * otherRight;
  const share = ((x[c] - x[a]) * otherDown - (y[c] - y[a]) * otherRight) / cross;
  return [x[a] + right * share, y[a] + down * share];
}

/**
 * The point of a lane that is nearest to a vertex.
 *
 * @param {Roadmap} options
 * @param {number} vertex
 * @param {number} tail
 * @param {number} head
 */
export function footOn({ x, y }, vertex, tail, head) {
  const [right, down] = [x[head] - x[tail], y[head] - y[tail]];
  const square = right * right + down * down || 1;
  const along = ((x[vertex] - x[tail]) * right + (y[vertex] - y[tail]) * down) / square;
  const share = Math.min(Math.max(along, 0), 1);
  return [x[tail] + right * share, y[tail] + down * share];
}

/**
 * A letter in a square, drawn in pixels: fonts of less than a pixel are not drawn well.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @param {Theme} theme
 * @param {number} side
 */
function letter(context, text, x, y, theme, side) {
  context.save();
  context.translate(x, y);
  context.scale(side / 20, side / 20);
  context.font = theme.font(14, 700);
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(text, 0, 1);
  context.restore();
}

/**
 * The sign for electricity, in a square.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 * @param {number} side
 */
export function bolt(context, x, y, side) {
  context.beginPath();
  for (const [right, down] of [
    [0.1, -0.4],
    [-0.25, 0.08],
    [-0.02, 0.08],
    [-0.1, 0.4],
    [0.25, -0.08],
    [0.02, -0.08],
  ]) {
    context.lineTo(x + right * side, y + down * side);
  }
  context.fill();
}
