import { Quantities } from "./quantities.js";
import { Roadmap } from "./roadmap.js";
import { Robot } from "./robot.js";

/** What a map shows of a scenario without a plan: the roadmap, and the robots at their homes. */
export class Site {
  constructor(raw) {
    this.tick = { numerator: raw.tick[0], denominator: raw.tick[1] };
    this.quantities = new Quantities(raw.units, raw.tick);
    this.title = raw.title;
    this.roadmap = new Roadmap(raw.map, raw.units.length);
    this.planned = raw.robots.map((robot, index) => new Robot(robot, index));
    this.robots = this.planned; // those that are shown
    this.clearance = raw.clearance ?? 0; // [length unit]
    this.largestRadius = this.planned.reduce((most, { radius }) => Math.max(most, radius), 0);
    this.closures = (raw.closures ?? []).map((closure) => ({
      ...closure,
      until: closure.until ?? Infinity,
    }));
    this.faults = [];
    this.decisions = [];
    this.happened = null;
    this.steady = null;
    this.end = 0;
  }

  /** Whether nothing moves. */
  get isStill() {
    return this.end === 0;
  }

  /** The distance that two robots need [length unit]; 0 for two points. */
  room(one, other) {
    const radii = one.radius + other.radius;
    return radii && radii + this.clearance;
  }

  /** The places that robots go to, homes apart, each with its robots. */
  get stops() {
    return (this.#stops ??= this.#findStops());
  }

  #stops = null;

  #findStops() {
    const stops = new Map();
    for (const robot of this.planned) {
      for (const vertex of new Set(robot.stages.map((stage) => stage.vertex))) {
        if (vertex === robot.home) continue;
        if (!stops.has(vertex)) stops.set(vertex, []);
        stops.get(vertex).push(robot);
      }
    }
    return stops;
  }

  /** Whether all trips lead home again. */
  get endsAtHome() {
    return this.planned.every(({ stages, home }) => stages.at(-1).vertex === home);
  }
}
