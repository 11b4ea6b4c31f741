import { onTheFloor } from "./floor.js";
import { Phrases } from "../language/phrases.js";
import { giveLosses } from "./robot.js";
import { Site } from "./site.js";
import { Steady } from "./steady.js";

/** @import { ComparisonData, Payload } from "../payload.d.ts" */
/** @import { Driven } from "../live/driven.js" */
/** @import { Robot } from "./robot.js" */

/** All that the page knows of a plan, as payload.py wrote it. */
export class Plan extends Site {
  /** @param {Payload} raw */
  constructor(raw) {
    super(raw);
    this.phrases = new Phrases(raw.phrases);
    this.places = new Map(raw.places);
    this.end = Math.max(raw.end, raw.floor?.end ?? 0);
    this.headway = raw.headway;
    this.booksAhead = raw.booksAhead;
    this.line = raw.line.map(([vertex, at]) => ({ vertex, at })); // of a small fleet: its places in one line
    giveLosses(this.planned, raw.losses);
    this.happened = raw.floor ? onTheFloor(raw, raw.floor, this.planned) : null;
    this.feed = raw.driven ?? null;
    this.robots = this.happened ?? this.planned; // a view may show those planned instead: see Choice
    this.steady = raw.steady && raw.laps ? new Steady(raw.steady, raw.laps, this.planned) : null;
    this.faults = raw.faults.listed;
    this.faultCount = raw.faults.count;
    this.faultKinds = raw.faults.kinds; // how many of each kind
    this.noPlan = raw.noPlan ?? false; // all robots stay at home, and the faults say why
    /** @type {Plan[]} */
    this.others = (raw.others ?? []).map((other) => new Plan({ map: raw.map, ...other })); // to compare with
    this.comparison = raw.comparison ?? null;
    if (this.comparison) this.#shareEnd();
    this.planner = raw.planner;
    this.decisions = raw.decisions;
    this.forcedLosses = raw.forcedLosses ?? []; // of an optimal plan
    if (raw.work) ({ jobs: this.jobs, tours: this.tours } = raw.work);
    this.reroutes = raw.reroutes;
    this.metrics = raw.metrics;
  }

  /**
   * Show a fleet that is driven beside what was planned.
   *
   * @param {Driven} driven
   */
  beDriven(driven) {
    if (this.feed) driven.take(this.feed.frame);
    this.driven = driven;
    this.robots = this.happened = driven.robots;
  }

  /** All plans that are compared end together, each in its own ticks. */
  #shareEnd() {
    const { scales } = /** @type {ComparisonData} */ (this.comparison);
    const plans = [this, ...this.others];
    const last = Math.max(...plans.map(({ end }, i) => end * scales[i]));
    plans.forEach((plan, i) => (plan.end = last / scales[i]));
  }

  /**
   * When a visit begins to book its vertex, and when it stops.
   *
   * @param {Robot} robot
   * @param {number} visit
   */
  booking(robot, visit) {
    const approach = this.booksAhead && visit > 0 ? robot.drive[visit] : 0;
    return [robot.enter[visit] - approach, robot.leave(visit) + this.headway];
  }
}
