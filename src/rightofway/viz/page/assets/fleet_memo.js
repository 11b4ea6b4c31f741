/** What was made of the robots shown; made again when other robots are shown. */
export class FleetMemo {
  #robots = null;
  #made;

  constructor(plan, make) {
    Object.assign(this, { plan, make });
  }

  get value() {
    if (this.#robots !== this.plan.robots) {
      this.#robots = this.plan.robots;
      this.#made = this.make();
    }
    return this.#made;
  }
}
