/** @import { Site } from "../plan/site.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Viewport } from "../drawing/viewport.js" */

const READABLE_RADIUS = 10; // pixels; a robot need not be larger to be seen from afar
const SMALLEST_CAP = { many: 4.5, few: 7 }; // pixels; robots may be as large where cells are smaller
const SMALLEST_RADIUS = 2; // pixels, of a robot that is drawn at its true size
const MANY = 100; // robots; homes of more are not larger than their cells
const SMALLEST_HOME = 3; // pixels, half of its side
const IN_CELL = 0.35; // of a cell's side: robots that follow each other round a corner do not touch
const LARGEST_RADIUS = { grid: 44, network: 20 }; // pixels

/**
 * How large things are on the map, in pixels. A robot with a radius has its true size. Points and
 * marks grow with large cells; where cells are small, they stay large enough to be seen, as far as
 * there is room.
 */
export class MapSizes {
  /**
   * @param {Site} plan
   * @param {Viewport} viewport
   */
  constructor(plan, viewport) {
    this.plan = plan;
    this.viewport = viewport;
  }

  /**
   * Radius of a robot: its own, if it has one, as long as that can be seen.
   *
   * @param {{ radius: number }} robot
   */
  of(robot) {
    return robot.radius
      ? Math.max((robot.radius / this.plan.roadmap.unit) * this.viewport.scale, SMALLEST_RADIUS)
      : this.#point;
  }

  /** Radius of the largest robot. */
  get robot() {
    return this.plan.largestRadius ? this.of({ radius: this.plan.largestRadius }) : this.#point;
  }

  /** Radius of a robot that has none. */
  get #point() {
    const { scale } = this.viewport;
    const { roadmap, robots } = this.plan;
    const apart = Math.sqrt((roadmap.width * roadmap.height) / robots.length) * scale; // on average
    const cap = Math.max(SMALLEST_CAP.many, Math.min(SMALLEST_CAP.few, apart * 0.1), scale * 0.95);
    const least = Math.min(apart * 0.16, READABLE_RADIUS, cap);
    const most = roadmap.hasCells
      ? Math.min(LARGEST_RADIUS.grid, Math.max(scale * IN_CELL, SMALLEST_CAP.many))
      : LARGEST_RADIUS.network;
    return Math.min(Math.max(scale * 0.31, least, 1.8), most);
  }

  /**
   * Half the side of a robot's home.
   *
   * @param {Robot} robot
   */
  homeOf(robot) {
    const inCell = this.plan.roadmap.rows ? this.viewport.scale * 0.345 : 0;
    if (this.plan.roadmap.rows && robot.radius) return inCell;
    const round = Math.max(inCell, this.of(robot) + 1.5); // a robot at home
    const isSmall = this.plan.roadmap.rows && this.plan.robots.length > MANY;
    return isSmall ? Math.min(round, Math.max(inCell, SMALLEST_HOME)) : round;
  }

  /** Half the side of the sign of a station, a parking place or a charger. */
  get sign() {
    return Math.min(Math.max(this.lane * 0.55, 5), 10);
  }

  /** Half the width of a stop's diamond. */
  get stop() {
    const { robots, largestRadius } = this.plan;
    const isSized = largestRadius && robots.every(({ radius }) => radius);
    const size = isSized ? Math.min(this.robot, this.#point) : this.#point;
    return Math.max(Math.min(size * 0.75, 17), 3);
  }

  /** Width of a lane of a roadmap that is driven both ways. */
  get lane() {
    const { scale } = this.viewport;
    return Math.min(Math.max(scale * 0.42, 7), Math.max(scale * 0.8, 1.5), 18);
  }

  /** Width of the band of a zone. */
  get zone() {
    return this.plan.roadmap.rows ? this.viewport.scale : this.lane * 1.5 + 8;
  }

  /** Radius of a vertex of a roadmap. */
  get vertex() {
    return Math.min(this.lane * 0.45, 5.5);
  }

  /** Width of a route, and how far two routes on one way are apart. */
  get route() {
    const line = Math.min(Math.max(this.viewport.scale * 0.06, 2.5), 5);
    return { line, apart: line + 1.5 };
  }
}
