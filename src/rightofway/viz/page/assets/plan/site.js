import { Phrases } from "../language/phrases.js";
import { Quantities } from "../language/quantities.js";
import { Roadmap } from "./roadmap.js";
import { Robot } from "./robot.js";

/** @import { ClosureData, DecisionData, FaultData, ForcedLossData, JobData, LevelData, Payload, TourData } from "../payload.d.ts" */
/** @import { Shift } from "../shift/shift.js" */
/** @import { FloorRobot } from "./floor.js" */
/** @import { Driven } from "../live/driven.js" */
/** @import { Steady } from "./steady.js" */

/** @typedef {Omit<ClosureData, "until"> & { until: number }} Closure That lasts for ever until infinity. */

/** What a map shows of a scenario without a plan: the roadmap, and the robots at their homes. */
export class Site {
  /** @param {Omit<LevelData, "name" | "sentences" | "findings"> | Payload} raw */
  constructor(raw) {
    this.tick = { numerator: raw.tick[0], denominator: raw.tick[1] };
    this.quantities = new Quantities(raw.units, raw.tick);
    this.title = raw.title ?? "";
    this.roadmap = new Roadmap(raw.map, raw.units.length);
    this.phrases = new Phrases([]);
    /** @type {Map<number, number>} */
    this.places = new Map(); // cells that are called after robots: the index of the text of each
    this.planned = raw.robots.map((robot, index) => new Robot(robot, index));
    /** @type {Robot[]} */
    this.robots = this.planned;
    this.clearance = raw.clearance ?? 0; // [length unit]
    this.largestRadius = this.planned.reduce((most, { radius }) => Math.max(most, radius), 0);
    /** @type {Closure[]} */
    this.closures = (raw.closures ?? []).map((closure) => ({
      ...closure,
      until: closure.until ?? Infinity,
    }));
    /** @type {FaultData[]} */
    this.faults = [];
    /** @type {DecisionData[]} */
    this.decisions = [];
    /** @type {ForcedLossData[]} */
    this.forcedLosses = [];
    /** @type {JobData[]} */
    this.jobs = [];
    /** @type {TourData[]} */
    this.tours = []; // of the robots, where there are jobs
    /** @type {Shift | null} */
    this.shift = null;
    /** @type {FloorRobot[] | null} */
    this.happened = null;
    /** @type {Driven | null} */
    this.driven = null;
    /** @type {Steady | null} */
    this.steady = null;
    this.end = 0;
    this.headway = 0;
    this.booksAhead = false;
  }

  /** Whether there is more to see of bookings than places that one robot each stays at. */
  get hasSpace() {
    return this.largestRadius > 0 || this.roadmap.zones.length > 0;
  }

  /** Whether nothing moves. */
  get isStill() {
    return this.end === 0;
  }

  /**
   * The distance that two robots need [length unit]; 0 for two points.
   *
   * @param {Robot} one
   * @param {Robot} other
   */
  room(one, other) {
    const radii = one.radius + other.radius;
    return radii && radii + this.clearance;
  }

  /** The places that robots go to, homes apart, each with its robots; in a shift these are all places. */
  get stops() {
    return (this.#stops ??= this.#findStops());
  }

  /** @type {Map<number, Robot[]> | null} */
  #stops = null;

  #findStops() {
    /** @type {Map<number, Robot[]>} */
    const stops = new Map();
    if (this.shift) return stops;
    for (const robot of this.planned) {
      for (const vertex of new Set(robot.stages.map((stage) => stage.vertex))) {
        if (vertex === robot.home) continue;
        stops.set(vertex, [...(stops.get(vertex) ?? []), robot]);
      }
    }
    return stops;
  }

  /** Whether all trips lead home again. */
  get endsAtHome() {
    return this.planned.every(({ stages, home }) => stages.at(-1)?.vertex === home);
  }
}
