/** The jobs of a document, as edits of it. */

import { addRows, freeName, rowsOf } from "../robots/rows.js";
import { stopsOf, withStops, writtenIn } from "../robots/fleet.js";
/** @import { JobData, JobStop, Place, ScenarioDocument } from "../types.js" */

/**
 * The jobs that are written in the document; null where there are none, or they are in another file.
 * @param {ScenarioDocument} document
 * @returns {JobData[] | null}
 */
export const jobsOf = (document) => rowsOf(document, "jobs");

/**
 * A document whose robots do jobs: a trip becomes a job of its robot.
 * @param {ScenarioDocument} document
 * @returns {ScenarioDocument}
 */
export function withJobs(document) {
  if (document.jobs) return document;
  const robots = writtenIn(document);
  const trips = robots.filter((robot) => stopsOf(robot).length);
  /** @type {JobData[]} */
  const jobs = [];
  for (const robot of trips) {
    const stops = stopsOf(robot);
    const places = stops.length > 1 ? { stops } : stops[0];
    jobs.push({ name: freeName(jobs, "jobs"), ...places, robot: robot.name });
  }
  const free = robots.map((robot) => {
    const { laps, ...rest } = withStops(robot, []);
    return rest;
  });
  return { ...document, robots: free, jobs };
}

/**
 * Add jobs; each gets a name if it has none.
 * @param {ScenarioDocument} document
 * @param {JobData[]} news
 * @returns {ScenarioDocument}
 */
export const addJobs = (document, news) => addRows(withJobs(document), "jobs", news);

/**
 * The stops of a job, however they are written.
 * @param {JobData} job
 * @returns {JobStop[]}
 */
export function stopsOfJob({ at, work, pickup, dropoff, stops }) {
  if (stops) return stops;
  if (at !== undefined) return [{ at, work }];
  return [pickup, dropoff].filter((place) => place !== undefined).map((place) => ({ at: place }));
}

/**
 * A job between two places; at one place where they are the same.
 * @param {Place} from
 * @param {Place} to
 * @param {boolean} isOne
 * @returns {JobData}
 */
export const jobBetween = (from, to, isOne) =>
  isOne ? { at: from } : { pickup: from, dropoff: to };
