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
   * @param {Fleet} fleet
   * @param {() => T} make
   */
  constructor(fleet, make) {
    this.fleet = fleet;
    this.make = make;
  }

  /** @returns {T} */
  get value() {
    if (this.#robots !== this.fleet.robots) {
      this.#robots = this.fleet.robots;
      this.#made = this.make();
    }
    return /** @type {T} */ (this.#made);
  }
}
