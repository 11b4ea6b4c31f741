"use strict";

const READABLE_RADIUS = 10; // pixels; a robot need not be larger to be seen from afar
const SMALLEST_CAP = { many: 4.5, few: 7 }; // pixels; robots may be as large where cells are smaller
const LARGEST_RADIUS = { grid: 44, network: 20 }; // pixels

/**
 * How large things are on the map, in pixels. Where cells are large, robots and marks grow with
 * them; where cells are small, what moves stays large enough to be seen, as far as there is room.
 */
class MapSizes {
  constructor(plan, viewport) {
    Object.assign(this, { plan, viewport });
  }

  /** Radius of a robot. */
  get robot() {
    const { scale } = this.viewport;
    const { roadmap, robots } = this.plan;
    const apart = Math.sqrt((roadmap.width * roadmap.height) / robots.length) * scale; // on average
    const cap = Math.max(SMALLEST_CAP.many, Math.min(SMALLEST_CAP.few, apart * 0.1), scale * 0.95);
    const least = Math.min(apart * 0.16, READABLE_RADIUS, cap);
    return Math.min(Math.max(scale * 0.31, least, 1.8), LARGEST_RADIUS[roadmap.hasCells ? "grid" : "network"]);
  }

  /** Half the side of a home. */
  get home() {
    const inCell = this.plan.roadmap.rows ? this.viewport.scale * 0.345 : 0;
    return Math.max(inCell, this.robot + 1.5);
  }

  /** Half the width of a stop's diamond. */
  get stop() {
    return Math.max(Math.min(this.robot * 0.75, 17), 3);
  }

  /** Width of a lane of a roadmap that is driven both ways. */
  get lane() {
    const { scale } = this.viewport;
    return Math.min(Math.max(scale * 0.42, 7), Math.max(scale * 0.8, 1.5), 18);
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
