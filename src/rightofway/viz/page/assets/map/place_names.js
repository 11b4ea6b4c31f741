import { FleetMemo } from "../plan/fleet_memo.js";
import { LabelBoard, SIDES, TextWidths, boxBeside, cut } from "../drawing/label_board.js";
import { figure } from "../language/language.js";
import { decimal, fraction } from "../language/quantities.js";
import { LONGEST_BAR } from "../drawing/scale_bar.js";
import { haloed, ringed } from "../drawing/shapes.js";
import { inkOn } from "../drawing/theme.js";
import { usedPlaces } from "../plan/used_places.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Box } from "../drawing/label_board.js" */
/** @import { MapSizes } from "./map_sizes.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Lane } from "../plan/roadmap.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Use } from "../plan/use.js" */
/** @import { Viewport } from "../drawing/viewport.js" */
/** @import { Mark, Marks } from "../plan/used_places.js" */

const MOST_PLACES = 300; // names of places in sight
const MOST_VERTICES = 1500; // in sight; of more, only homes and stops have names
const NAMED_CELL = 40; // vertices of a grid have their names from this size on [pixels]
const SIGNED_LANE = 44; // pixels; a shorter lane has no sign of its speed limit
const FEW_MARKS = 24; // robots up to which homes and stops with a name on a grid have it at any size
const PLACE_TYPE = 12; // pixels
const MOST_ANCHORS = 24; // vertices of a zone that its name may stand beside
const LONGEST_MARK = 34; // characters of the name of a home, a stop or a station

/** @typedef {{ name: string, box: Box, font: string, ink: string, halo: string, isUpright?: boolean, isRinged?: boolean }} Spot Where a name stands. */

/**
 * Names of vertices, obstacles and zones, and signs of speed limits, none over another: homes and
 * stops first. Each keeps its spot until `refresh`.
 */
export class PlaceNames {
  names = new LabelBoard();
  marks = new LabelBoard(); // homes and stops
  routes = new LabelBoard(); // of the robots chosen
  #lanes = new LabelBoard();
  #widths = new TextWidths();
  /** @type {FleetMemo<Marks>} */
  #marksOf;
  /** @type {Spot[] | null} */
  #spots = null;

  /**
   * @param {Site} plan
   * @param {Viewport} viewport
   * @param {MapSizes} sizes
   * @param {Theme} theme
   * @param {Choice} choice
   * @param {Use} use
   */
  constructor(plan, viewport, sizes, theme, choice, use) {
    this.plan = plan;
    this.viewport = viewport;
    this.sizes = sizes;
    this.theme = theme;
    this.choice = choice;
    this.use = use;
    this.#marksOf = new FleetMemo(plan, () => usedPlaces(this.plan));
  }

  /** The size of names [pixels]. */
  get #type() {
    return PLACE_TYPE * this.theme.zoom;
  }

  refresh() {
    this.#spots = null;
  }

  /**
   * Find the spots on a canvas of a given size; return how many there are.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   * @param {number} height
   */
  find(context, width, height) {
    this.#spots ??= this.#findSpots(context, width, height);
    return this.#spots.length;
  }

  /**
   * Write the names that no robot covers; return them with their boxes.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {LabelBoard} robots
   */
  write(context, robots) {
    /** @type {{ name: string, box: Box }[]} */
    const written = [];
    context.textBaseline = "middle";
    for (const { name, box, ink, font, halo, isUpright, isRinged } of this.#spots ?? []) {
      if (!robots.isFree(...box)) continue;
      context.font = font;
      context.textAlign = "left";
      if (isRinged) ringed(context, name, box, this.theme);
      else if (isUpright) {
        context.save();
        context.translate((box[0] + box[2]) / 2 + 0.5, box[3]);
        context.rotate(-Math.PI / 2);
        haloed(context, name, 0, 0, ink, halo, 3);
        context.restore();
      } else haloed(context, name, box[0], (box[1] + box[3]) / 2 + 0.5, ink, halo, 3);
      written.push({ name, box });
    }
    return written;
  }

  /**
   * The names of places in sight and where they stand, the important ones first.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {number} width
   * @param {number} height
   */
  #findSpots(context, width, height) {
    const { roadmap } = this.plan;
    const marks = this.#marksOf.value;
    this.#keepFree(marks, width, height);
    /** @param {number} vertex */
    const isInSight = (vertex) => {
      const [x, y] = this.#pointOf(vertex);
      return x >= 0 && x <= width && y >= 0 && y <= height;
    };
    const inSight = [...this.#named(marks)].filter(isInSight);
    /** @type {Spot[]} */
    const spots = [];
    for (const vertex of inSight.length > MOST_VERTICES
      ? inSight.filter((it) => marks.has(it) || this.choice.lit.includes(it))
      : inSight) {
      const mark = marks.get(vertex);
      const font = this.theme.font(this.#type, mark ? 600 : 400);
      const isNamed = mark || this.choice.lit.includes(vertex);
      const laneName = isNamed ? undefined : roadmap.laneNames.get(vertex);
      if (laneName === "") continue; // a split lane has one name
      const name = cut(laneName ?? roadmap.label(vertex), mark && LONGEST_MARK);
      const box = this.#spot(vertex, this.#widths.of(context, name, font), mark);
      if (!box) continue;
      this.names.take(...box);
      spots.push({ name, box, font, ...this.#colours(vertex, Boolean(mark)) });
      if (spots.length >= MOST_PLACES) break;
    }
    this.#nameObstacles(context, spots);
    this.#nameZones(context, spots);
    this.#signLimits(context, spots);
    return spots;
  }

  /**
   * Beside one of its vertices, or of the ends of its lanes.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Spot[]} spots
   */
  #nameZones(context, spots) {
    const font = this.theme.font(this.#type, 600);
    for (const { name: whole, vertices, edges } of this.plan.roadmap.zones) {
      const name = cut(whole);
      const wide = this.#widths.of(context, name, font);
      const anchors = new Set([...vertices, ...edges.flat()]);
      const boxes = [...anchors].slice(0, MOST_ANCHORS).flatMap((vertex) => {
        const [x, y] = this.#pointOf(vertex);
        return SIDES.map((side) =>
          boxBeside(x, y, this.sizes.zone / 2, wide, this.#type + 2, side),
        );
      });
      const free = boxes.filter((box) => this.names.isFree(...box) && this.marks.isFree(...box));
      const box = free.find((each) => this.#lanes.isFree(...each)) ?? free[0];
      if (!box) continue;
      this.names.take(...box);
      spots.push({ name, box, font, ink: this.theme.ink, halo: this.#halo });
    }
  }

  /**
   * The speed limit of a lane, in a ring on its middle or beside it.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Spot[]} spots
   */
  #signLimits(context, spots) {
    const { limits, usualLimit, x: xs, y: ys } = this.plan.roadmap;
    const font = this.theme.font(11, 600);
    for (const { tail, head, limit } of limits ?? []) {
      if (limit === usualLimit) continue;
      if (Math.hypot(xs[head] - xs[tail], ys[head] - ys[tail]) * this.viewport.scale < SIGNED_LANE)
        continue;
      const name = figure(decimal(fraction(limit)));
      const radius = Math.max(this.#widths.of(context, name, font) / 2 + 4, 9);
      const [one, other] = [this.#pointOf(tail), this.#pointOf(head)];
      /** @type {Box[]} */
      const boxes = [0.5, 0.3, 0.7].map((share) => {
        const [x, y] = [one[0] + (other[0] - one[0]) * share, one[1] + (other[1] - one[1]) * share];
        return [x - radius, y - radius, x + radius, y + radius];
      });
      const box = boxes.find((each) => this.names.isFree(...each) && this.marks.isFree(...each));
      if (!box) continue;
      this.names.take(...box);
      spots.push({ name, box, font, ink: this.theme.ink, halo: this.theme.paper, isRinged: true });
      if (spots.length >= 2 * MOST_PLACES) break;
    }
  }

  get #halo() {
    return this.plan.roadmap.hasCells ? this.theme.floor : this.theme.paper;
  }

  /**
   * Along an obstacle or upwards in it, where there is room.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Spot[]} spots
   */
  #nameObstacles(context, spots) {
    const { left, top, scale } = this.viewport;
    const font = this.theme.font(this.#type);
    for (const it of this.plan.roadmap.obstacles) {
      const name = cut(it.name);
      const wide = this.#widths.of(context, name, font) / 2;
      const isUpright = 2 * wide > it.width * scale && it.height > it.width;
      const [across, down] = isUpright ? [this.#type / 2 + 1, wide] : [wide, this.#type / 2 + 1];
      if (2 * across > it.width * scale || 2 * down > it.height * scale) continue;
      const x = left + (it.left + it.width / 2) * scale;
      /** @type {Box[]} */
      const boxes = [0.5, 1, 0].map((share) => {
        const y =
          top +
          it.top * scale +
          Math.min(Math.max(it.height * scale * share, down), it.height * scale - down);
        return [x - across, y - down, x + across, y + down];
      });
      const box = boxes.find((each) => this.names.isFree(...each) && this.marks.isFree(...each));
      if (!box) continue;
      this.names.take(...box);
      spots.push({ name, box, font, ink: this.theme.ink, halo: this.theme.wall, isUpright });
    }
  }

  /**
   * @param {number} vertex
   * @param {boolean} isMark
   */
  #colours(vertex, isMark) {
    const {
      theme,
      plan: { roadmap },
    } = this;
    const heat = this.choice.heat && roadmap.hasCells ? this.use.heat(vertex, theme) : null;
    if (heat && this.viewport.scale >= NAMED_CELL) return { ink: inkOn(heat), halo: heat };
    return { ink: isMark ? theme.ink : theme.muted, halo: this.#halo };
  }

  /**
   * @param {number} vertex
   * @returns {[number, number]}
   */
  #pointOf(vertex) {
    const { left, top, scale } = this.viewport;
    return [left + this.plan.roadmap.x[vertex] * scale, top + this.plan.roadmap.y[vertex] * scale];
  }

  /**
   * Marks, routes that are drawn, and on a roadmap lanes, that names rather do not cover.
   *
   * @param {Marks} marks
   * @param {number} width
   * @param {number} height
   */
  #keepFree(marks, width, height) {
    for (const board of [this.names, this.marks, this.routes, this.#lanes])
      board.clear(width, height);
    this.names.take(
      width - LONGEST_BAR - (this.plan.roadmap.usualLimit ? 240 : 40),
      height - 28,
      width,
      height,
    ); // scale bar
    for (const [vertex, mark] of marks) {
      const [x, y] = this.#pointOf(vertex);
      this.marks.takeDisc(x, y, this.#reach(mark));
    }
    this.#keepRoutesFree(width, height);
    if (this.plan.roadmap.hasCells) return;
    const { bothWays, oneWay } = this.plan.roadmap.lanes;
    for (const lane of [...bothWays, ...oneWay])
      this.#takeLane(this.#lanes, lane, this.sizes.lane / 2, width, height);
  }

  /**
   * The routes that are drawn, each way once: as wide as their lines side by side.
   *
   * @param {number} width
   * @param {number} height
   */
  #keepRoutesFree(width, height) {
    const { routed } = this.choice;
    const half = routed.length * this.sizes.route.apart;
    const { size } = this.plan.roadmap;
    /** @type {Map<number, Lane>} */
    const ways = new Map();
    for (const { vertices } of routed.map((index) => this.choice.robots[index])) {
      for (let visit = 1; visit < vertices.length; visit++) {
        const [tail, head] = [vertices[visit - 1], vertices[visit]].sort((a, b) => a - b);
        ways.set(tail * size + head, [tail, head]);
      }
    }
    for (const way of ways.values()) this.#takeLane(this.routes, way, half, width, height);
  }

  /**
   * Take a straight way on a board, in discs of a radius, where it may be in sight.
   *
   * @param {LabelBoard} board
   * @param {Lane} options
   * @param {number} radius
   * @param {number} width
   * @param {number} height
   */
  #takeLane(board, [tail, head], radius, width, height) {
    const [[x, y], [toX, toY]] = [this.#pointOf(tail), this.#pointOf(head)];
    if (Math.max(x, toX) < 0 || Math.min(x, toX) > width) return;
    if (Math.max(y, toY) < 0 || Math.min(y, toY) > height) return;
    const pieces = Math.min(Math.ceil(Math.hypot(toX - x, toY - y) / radius), 600);
    for (let i = 0; i < pieces; i++) {
      const share = (i + 0.5) / pieces; // beyond its ends a name may stand
      board.takeDisc(x + (toX - x) * share, y + (toY - y) * share, radius);
    }
  }

  /**
   * How far a mark reaches from its vertex.
   *
   * @param {Mark} options
   */
  #reach({ homeOf, isStop }) {
    if (homeOf) return this.sizes.homeOf(homeOf);
    return isStop ? this.sizes.stop : this.sizes.sign;
  }

  /**
   * A box for the name of a place, or null without room; names of homes and stops may cover a lane.
   *
   * @param {number} vertex
   * @param {number} wide
   * @param {Mark | undefined} mark
   * @returns {Box | null}
   */
  #spot(vertex, wide, mark) {
    const [x, y] = this.#pointOf(vertex);
    const high = this.#type + 2;
    const { scale } = this.viewport;
    const { hasCells } = this.plan.roadmap;
    const mayCover = hasCells || (mark && (mark.robots.length > 0 || scale >= NAMED_CELL));
    if (this.plan.roadmap.rows && scale >= NAMED_CELL) {
      const inset = Math.min(Math.max((scale - 60) * 0.1, 1.5), 7); // beside the corner of a home
      const [left, top] = [x - scale / 2 + inset, y - scale / 2 + inset - 3]; // letters are lower
      return wide < scale - 2 * inset ? [left, top, left + wide, top + high] : null;
    }
    const radius = Math.max(this.sizes.lane / 2, this.sizes.vertex, mark ? this.#reach(mark) : 0);
    const boxes = SIDES.map((side) => boxBeside(x, y, radius, wide, high, side));
    const free = boxes.filter((box) => this.names.isFree(...box) && this.marks.isFree(...box));
    const apart = free.filter((box) => this.#lanes.isFree(...box));
    /** @param {Box[]} some */
    const beside = (some) => some.find((box) => this.routes.isFree(...box));
    return beside(apart) ?? apart[0] ?? (mayCover ? (beside(free) ?? free[0] ?? null) : null);
  }

  /**
   * The vertices that may have a name, in the order of their importance.
   *
   * @param {Marks} marks
   * @returns {Set<number>}
   */
  #named(marks) {
    const { roadmap } = this.plan;
    /** @param {number} vertex */
    const isChosen = (vertex) =>
      (marks.get(vertex)?.robots ?? []).some(
        (index) => this.choice.robotIndex >= 0 && this.choice.standsOut(index),
      );
    if (roadmap.hasCells && this.viewport.scale < NAMED_CELL) {
      /** @param {number} vertex */
      const hasName = (vertex) => !roadmap.isMeasured || roadmap.stations.has(vertex);
      const shown = [...marks.keys()].filter(
        (vertex) => (this.plan.robots.length <= FEW_MARKS && hasName(vertex)) || isChosen(vertex),
      );
      return new Set([...this.choice.lit, ...(this.choice.decision?.vertices ?? []), ...shown]);
    }
    const chosenFirst = [...marks.keys()].sort(
      (one, other) => Number(isChosen(other)) - Number(isChosen(one)),
    );
    return new Set([...chosenFirst, ...Array(roadmap.size).keys()]);
  }
}
