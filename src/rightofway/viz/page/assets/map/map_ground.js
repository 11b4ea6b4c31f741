import { pointAlong } from "../plan/roadmap.js";
import { chevron, diamond, disc, line } from "../drawing/shapes.js";
import { inkOn } from "../drawing/theme.js";

/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Lane, Roadmap } from "../plan/roadmap.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Viewport } from "../drawing/viewport.js" */

const RULED_CELL = 13; // cells have lines between them from this size on [pixels]
const ARROW_GAP = 56; // pixels between two arrow heads of a lane
const MOST_SIGNED = 3000; // lanes in sight; of more, none has arrow heads or a dashed middle

/** What robots drive on: the picture below, floor and walls of a grid, lanes and vertices of a roadmap. */
export class MapGround {
  /**
   * @param {Roadmap} roadmap
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   * @param {Theme} theme
   */
  constructor(roadmap, viewport, sizes, theme) {
    this.roadmap = roadmap;
    this.viewport = viewport;
    this.sizes = sizes;
    this.theme = theme;
  }

  /**
   * Paint in map units: one unit is a cell.
   *
   * @param {CanvasRenderingContext2D} context
   */
  paint(context) {
    if (this.roadmap.rows) this.#grid(context, this.roadmap.rows);
    else {
      if (this.roadmap.sides) this.#squares(context, this.roadmap.sides);
      this.#picture(context);
      if (!this.roadmap.sides) this.#network(context);
    }
  }

  /**
   * A length in pixels, in map units.
   *
   * @param {number} length
   */
  #pixels(length) {
    return length / this.viewport.scale;
  }

  /**
   * The picture under the map; the map is painted again once that is there.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #picture(context) {
    const { background } = this.roadmap;
    if (!background) return;
    const { x, y, width, height, turn, opacity } = background;
    const image = background.image ?? this.#loaded(background.href);
    if (!image) return;
    const isDark = inkOn(this.theme.paper) === "#ffffff"; // a white floor plan would glare there
    context.save();
    const canInvert = context.filter !== undefined;
    context.globalAlpha = opacity * (isDark ? (canInvert ? 0.8 : 0.4) : 1);
    if (isDark && canInvert) context.filter = "invert(1) hue-rotate(180deg)"; // dark lines would not be seen
    context.translate(x, y);
    context.rotate(turn ?? 0);
    context.drawImage(image, 0, 0, width, height);
    context.restore();
  }

  /**
   * The picture at an address, or null until it is there; a page that has it already gives `image`.
   *
   * @param {string | undefined} href
   */
  #loaded(href) {
    if (!href) return null;
    if (!this.image) {
      this.image = new Image();
      this.image.addEventListener("load", () => this.viewport.tell("view"));
      this.image.src = href;
    }
    return this.image.complete ? this.image : null;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {string[]} rows
   */
  #grid(context, rows) {
    const { width, height } = this.roadmap;
    context.fillStyle = this.theme.floor;
    context.fillRect(-0.5, -0.5, width, height);
    this.#picture(context);
    if (this.viewport.scale >= RULED_CELL) this.#rules(context, width, height);
    context.fillStyle = this.theme.wall;
    context.globalAlpha = this.roadmap.background ? 0.6 : 1;
    rows.forEach((row, y) => {
      for (const run of row.matchAll(/[^.]+/g)) {
        const more = y + 1 < height ? this.#pixels(0.6) : 0; // no hairline between two rows
        context.fillRect(
          run.index - 0.5,
          y - 0.5,
          run[0].length,
          rows[y + 1]?.[run.index] === "." ? 1 : 1 + more,
        );
      }
    });
    context.globalAlpha = 1;
    context.strokeStyle = this.theme.wall;
    context.lineWidth = this.#pixels(1);
    context.strokeRect(-0.5, -0.5, width, height);
  }

  /**
   * The cells of a quadtree; what is not free between them is wall.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number[]} sides
   */
  #squares(context, sides) {
    const { width, height, x, y } = this.roadmap;
    const gap = this.viewport.scale >= RULED_CELL / 4 ? this.#pixels(1) : 0;
    context.fillStyle = this.theme.wall;
    context.fillRect(-0.5, -0.5, width, height);
    context.fillStyle = this.theme.line;
    /** @param {number} less */
    const fill = (less) =>
      sides.forEach((side, vertex) =>
        context.fillRect(x[vertex] - side / 2, y[vertex] - side / 2, side - less, side - less),
      );
    fill(this.#pixels(-0.3)); // no hairline between two cells
    context.fillStyle = this.theme.floor;
    fill(gap);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   * @param {number} height
   */
  #rules(context, width, height) {
    context.strokeStyle = this.theme.line;
    context.lineWidth = this.#pixels(1);
    context.beginPath();
    for (let x = 1; x < width; x++) line(context, x - 0.5, -0.5, x - 0.5, height - 0.5);
    for (let y = 1; y < height; y++) line(context, -0.5, y - 0.5, width - 0.5, y - 0.5);
    context.stroke();
  }

  /**
   * Lanes: broad with a dashed middle where both ways are driven, narrower with arrow heads for one way.
   *
   * @param {CanvasRenderingContext2D} context
   */
  #network(context) {
    const { x, y } = this.roadmap;
    const [oneWay, bothWays] = [this.roadmap.lanes.oneWay, this.roadmap.lanes.bothWays].map(
      (lanes) => this.#inSight(lanes),
    );
    const { lane } = this.sizes;
    /**
     * @param {Lane[]} lanes
     * @param {number} width
     * @param {string} colour
     */
    const draw = (lanes, width, colour) => {
      context.strokeStyle = colour;
      context.lineWidth = this.#pixels(width);
      context.beginPath();
      for (const [tail, head] of lanes) {
        const curve = this.roadmap.curve(tail, head) ?? this.roadmap.curve(head, tail);
        if (curve)
          curve.points.forEach(([atX, atY], i) => context[i ? "lineTo" : "moveTo"](atX, atY));
        else line(context, x[tail], y[tail], x[head], y[head]);
      }
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

  /**
   * The lanes of which something may be seen.
   *
   * @param {Lane[]} lanes
   */
  #inSight(lanes) {
    const { x, y } = this.roadmap;
    const { viewport } = this;
    const { clientWidth: width, clientHeight: height } = viewport.canvas;
    const [left, top, right, bottom] = [
      viewport.toX(-20),
      viewport.toY(-20),
      viewport.toX(width + 20),
      viewport.toY(height + 20),
    ];
    return lanes.filter(
      ([tail, head]) =>
        Math.max(x[tail], x[head]) >= left &&
        Math.min(x[tail], x[head]) <= right &&
        Math.max(y[tail], y[head]) >= top &&
        Math.min(y[tail], y[head]) <= bottom,
    );
  }

  /**
   * The ends of lanes, and vertices without any; those that are only driven through are open.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Lane[]} lanes
   */
  #vertices(context, lanes) {
    const { x, y, lonely, passed } = this.roadmap;
    const isMany = lanes.length > MOST_SIGNED; // then they are plain dots, which are drawn sooner
    const side = this.#pixels(this.sizes.vertex);
    context.fillStyle = isMany ? this.theme.muted : this.theme.paper;
    context.strokeStyle = this.theme.muted;
    context.lineWidth = this.#pixels(1.25);
    for (const vertex of new Set([...lanes.flat(), ...lonely])) {
      if (isMany) context.fillRect(x[vertex] - side / 2, y[vertex] - side / 2, side, side);
      else {
        if (passed.has(vertex)) diamond(context, x[vertex], y[vertex], side);
        else disc(context, x[vertex], y[vertex], side);
        context.stroke();
      }
    }
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Lane[]} lanes
   */
  #arrows(context, lanes) {
    const { x, y } = this.roadmap;
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
        const curve = this.roadmap.curve(tail, head);
        const [atX, atY, angle] = curve
          ? pointAlong(curve, share)
          : [x[tail] + right * share, y[tail] + down * share, Math.atan2(down, right)];
        chevron(context, atX, atY, angle, this.#pixels(size));
      }
    }
    context.stroke();
    context.lineCap = "butt";
  }
}
