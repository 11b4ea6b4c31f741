import { lastOf } from "../common/arrays.js";
import { FleetMemo } from "./fleet_memo.js";
import { blend } from "../drawing/theme.js";

/** @import { Fleet } from "./motion.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Robot } from "./robot.js" */

/** How much each vertex is used, and by whom when. */
export class Use {
  #held;
  #byVertex;

  /** @param {Fleet} fleet the robots that are shown */
  constructor(fleet) {
    this.fleet = fleet;
    this.#held = new FleetMemo(fleet, () => this.#sum());
    this.#byVertex = new FleetMemo(fleet, () => this.#sort());
  }

  /** How long each vertex is held, without resting at the end [ticks]. */
  get held() {
    return this.#held.value.held;
  }

  /** How long that one is held that is held longest. */
  get most() {
    return this.#held.value.most;
  }

  /**
   * The colour of a vertex on the heat map: the scale is linear from nothing to `most`.
   *
   * @param {number} vertex
   * @param {Theme} options
   */
  heat(vertex, { heatLow, heatHigh }) {
    return this.held[vertex] ? blend(heatLow, heatHigh, this.held[vertex] / this.most) : null;
  }

  /**
   * The visits at a vertex, as pairs of robot and visit.
   *
   * @param {number} vertex
   */
  visitsAt(vertex) {
    const { first, robots, visits } = this.#byVertex.value;
    /** @type {[Robot, number][]} */
    const pairs = [];
    for (let i = first[vertex]; i < first[vertex + 1]; i++)
      pairs.push([this.fleet.robots[robots[i]], visits[i]]);
    return pairs;
  }

  #sum() {
    const held = new Float64Array(this.fleet.roadmap.size);
    for (const robot of this.fleet.robots) {
      for (let visit = 0; visit + 1 < robot.vertices.length; visit++) {
        held[robot.vertices[visit]] += robot.leave(visit) - robot.enter[visit];
      }
    }
    return { held, most: held.reduce((most, ticks) => Math.max(most, ticks), 1) };
  }

  /** All visits in the order of their vertices, in flat arrays. */
  #sort() {
    const first = new Int32Array(this.fleet.roadmap.size + 1);
    for (const robot of this.fleet.robots) for (const vertex of robot.vertices) first[vertex + 1]++;
    for (let vertex = 0; vertex < this.fleet.roadmap.size; vertex++)
      first[vertex + 1] += first[vertex];
    const next = first.slice();
    const [robots, visits] = [new Int32Array(lastOf(first)), new Int32Array(lastOf(first))];
    for (const robot of this.fleet.robots) {
      robot.vertices.forEach((vertex, visit) => {
        robots[next[vertex]] = robot.index;
        visits[next[vertex]++] = visit;
      });
    }
    return { first, robots, visits };
  }
}
