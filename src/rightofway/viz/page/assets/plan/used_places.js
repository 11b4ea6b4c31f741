/** @import { Site } from "./site.js" */
/** @import { Robot } from "./robot.js" */

/** @typedef {{ robots: number[], homeOf: Robot | null, isStop: boolean }} Mark A home, a stop, or another place with a use. */
/** @typedef {Map<number, Mark>} Marks By vertex. */

/**
 * The homes and stops, each with its robots, then stations, parking places and chargers.
 *
 * @param {Site} plan
 * @returns {Marks}
 */
export function usedPlaces(plan) {
  /** @type {Marks} */
  const places = new Map();
  /**
   * @param {number} vertex
   * @returns {Mark}
   */
  const at = (vertex) => {
    const known = places.get(vertex) ?? { robots: [], homeOf: null, isStop: false };
    places.set(vertex, known);
    return known;
  };
  for (const robot of plan.robots) {
    const stages = robot.idles ? [] : robot.stages; // a shift stops nearly everywhere
    for (const vertex of [robot.home, ...stages.map((stage) => stage.vertex)]) {
      const place = at(vertex);
      place.robots.push(robot.index);
      if (vertex === robot.home) place.homeOf = robot;
      else place.isStop = true;
    }
  }
  const { stations, parking, charging } = plan.roadmap;
  for (const vertex of [...stations.keys(), ...parking, ...charging]) at(vertex);
  return places;
}
