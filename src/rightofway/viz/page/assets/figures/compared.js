import { matches } from "../lists/find.js";
import { Observable } from "../common/observable.js";
import { Quantities } from "../language/quantities.js";

/** @import { ComparedPlan, ComparedRobot, ComparisonData } from "../payload.d.ts" */

/** @typedef {ComparedPlan & { title: string }} ComparedFigures */

/**
 * What plans cost and when their robots are done, as metrics.comparison wrote it, against the base: one of
 * the plans. Event: `base` when another plan is that.
 */
export class Compared extends Observable {
  /**
   * @param {ComparisonData} options
   * @param {string[]} titles
   */
  constructor({ plans, robots, best, units, tick }, titles) {
    super();
    this.plans = plans.map((plan, place) => ({
      ...plan,
      title: titles[place],
    }));
    this.robots = robots; // { name, completion: [ticks or null in each plan] }
    /** @param {number[]} places */
    const sound = (places) => places.filter((place) => !this.plans[place].faults);
    this.best = {
      flowtime: sound(best.flowtime),
      makespan: sound(best.makespan),
      gap: sound(best.gap),
      seconds: sound(best.seconds),
    }; // places of the plans with the best figure, by its name; a plan with faults is not good
    this.quantities = new Quantities(units, tick);
    this.base = 0;
  }

  /** @param {number} place */
  setBase(place) {
    this.base = place;
    this.tell("base");
  }

  /** The places of the plans that are compared with the base. */
  get others() {
    return this.plans.map((_, place) => place).filter((place) => place !== this.base);
  }

  /**
   * How much later a robot is done in a plan than in the base [ticks]; NaN if it is not in both.
   *
   * @param {ComparedRobot} options
   * @param {number} place
   */
  change({ completion }, place) {
    const [before, after] = [completion[this.base], completion[place]];
    return before === null || after === null ? NaN : after - before;
  }

  /**
   * The largest change of a robot in any plan, or in one.
   *
   * @param {ComparedRobot} robot
   * @param {number[]} [places]
   */
  largest(robot, places = this.others) {
    return Math.max(...places.map((place) => Math.abs(this.change(robot, place)) || 0));
  }

  /**
   * The robots that a search finds: the largest change first, or by name for `place` -1.
   *
   * @param {string} [search]
   * @param {number | null} [place]
   */
  sorted(search = "", place = null) {
    const found = this.robots.filter(({ name }) => matches(name, search));
    if (place === -1)
      return found.sort((one, other) =>
        one.name.localeCompare(other.name, undefined, { numeric: true }),
      );
    const places = place === null || place === this.base ? this.others : [place];
    const weight = new Map(found.map((robot) => [robot, this.largest(robot, places)]));
    return found.sort((one, other) => (weight.get(other) ?? 0) - (weight.get(one) ?? 0));
  }

  /**
   * How many robots gain by a plan, and how many lose.
   *
   * @param {number} place
   */
  counts(place) {
    const changes = this.robots.map((robot) => this.change(robot, place));
    return [changes.filter((by) => by < 0).length, changes.filter((by) => by > 0).length];
  }

  /**
   * A time where there is little room.
   *
   * @param {number} ticks
   */
  time(ticks) {
    return this.quantities.short(ticks);
  }

  /**
   * A change with its sign: "−2 s".
   *
   * @param {number} ticks
   */
  signed(ticks) {
    if (!ticks) return ticks === 0 ? "=" : "–";
    return `${ticks < 0 ? "−" : "+"}${this.time(Math.abs(ticks))}`;
  }
}
