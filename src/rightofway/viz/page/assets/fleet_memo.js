/** @import { Fleet } from "./motion.js" */
/** @import { Robot } from "./robot.js" */

/**
 * What was made of the robots shown; made again when other robots are shown.
 *
 * @template T
 */
export class FleetMemo {
  /** @type {readonly Robot[] | null} */
  #robots = null;
  /** @type {T | undefined} */
  #made;

  /**
   * @param {Fleet} plan
   * @param {() => T} make
   */
  constructor(plan, make) {
    this.plan = plan;
    this.make = make;
  }

  /** @returns {T} */
  get value() {
    if (this.#robots !== this.plan.robots) {
      this.#robots = this.plan.robots;
      this.#made = this.make();
    }
    return /** @type {T} */ (this.#made);
  }
}
