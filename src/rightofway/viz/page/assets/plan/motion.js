import { lastAtMost } from "../common/arrays.js";
import { DRIVE } from "./phases.js";
import { pointAlong } from "./roadmap.js";

/** @import { Robot } from "./robot.js" */
/** @import { Roadmap } from "./roadmap.js" */

/** @typedef {{ robots: readonly Robot[], roadmap: Roadmap }} Fleet The robots that are shown, which may change. */

/** Where all robots are and what they do, at one instant. */
export class Motion {
  /** @param {Fleet} fleet */
  constructor(fleet) {
    const count = fleet.robots.length;
    this.fleet = fleet;
    this.x = new Float64Array(count);
    this.y = new Float64Array(count);
    this.activity = new Uint8Array(count);
    this.share = new Float32Array(count); // of the activity that is over, 0 to 1
    this.phase = new Int32Array(count);
    this.ticks = new Float64Array(count); // the moment of each robot
    this.counts = new Int32Array(8); // robots by activity
    this.moveTo(0);
  }

  /** @type {readonly Robot[] | null} */
  #robots = null;

  /**
   * Go to a tick; `tickOf` may give robots ticks of their own.
   *
   * @param {number} tick
   * @param {((robot: number) => number) | null} [tickOf]
   */
  moveTo(tick, tickOf = null) {
    if (this.#robots !== this.fleet.robots) this.phase.fill(0);
    const { robots } = this.fleet;
    this.#robots = robots;
    this.counts.fill(0);
    for (const robot of robots) this.#move(robot, tickOf ? tickOf(robot.index) : tick);
  }

  /**
   * While time runs on, a robot's next phase is this one or the next; else search.
   *
   * @param {Robot} robot
   * @param {number} tick
   */
  #find(robot, tick) {
    const { begin } = robot.phases;
    const last = begin.length - 1;
    let phase = this.phase[robot.index];
    if (tick < begin[phase]) phase = lastAtMost(begin, tick);
    for (let step = 0; phase < last && begin[phase + 1] <= tick; step++) {
      if (step > 3) return lastAtMost(begin, tick);
      phase++;
    }
    return phase;
  }

  /**
   * @param {Robot} robot
   * @param {number} tick
   */
  #move(robot, tick) {
    const i = robot.index;
    this.ticks[i] = tick;
    const phase = (this.phase[i] = this.#find(robot, tick));
    const activity = (this.activity[i] = robot.phases.activity[phase]);
    this.counts[activity]++;
    const begin = robot.phases.begin[phase];
    const end = robot.phases.end(phase);
    const share = end === Infinity ? 1 : (tick - begin) / (end - begin);
    this.share[i] = Math.max(share, 0);
    const { x, y } = this.fleet.roadmap;
    const visit = robot.phases.visit[phase];
    const here = robot.vertices[visit];
    this.x[i] = x[here];
    this.y[i] = y[here];
    if (activity !== DRIVE) return;
    const there = robot.vertices[visit + 1];
    const curve = this.fleet.roadmap.curve(here, there);
    if (curve) {
      [this.x[i], this.y[i]] = pointAlong(curve, share);
      return;
    }
    this.x[i] += (x[there] - x[here]) * share;
    this.y[i] += (y[there] - y[here]) * share;
  }
}
