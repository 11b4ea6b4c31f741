/** The robots of a document, as edits of it. */

import { figure } from "../../../viz/page/assets/language/language.js";
import { textOfPlace } from "../draw/places.js";
import { addRows, changeRows, removeRows, rowsIn, rowsOf } from "./rows.js";
/** @import { Place, RobotData, ScenarioDocument, Stop } from "../types.js" */

/**
 * The robots that are written in the document; null where they are in another file.
 * @param {Pick<ScenarioDocument, "robots">} document
 * @returns {RobotData[] | null}
 */
export const robotsOf = (document) => rowsOf(document, "robots");

/**
 * The robots of a document that has them.
 * @param {Pick<ScenarioDocument, "robots">} document
 * @returns {RobotData[]}
 */
export const writtenIn = (document) => rowsIn(document, "robots");

/**
 * The stops of a robot: `{ at, work, actions }`, however they are written.
 * @param {RobotData} robot
 * @returns {Stop[]}
 */
export function stopsOf({ target, work, actions, stops }) {
  if (stops) return stops;
  return target === undefined ? [] : [withoutMissing({ at: target, work, actions })];
}

/**
 * A stop without the keys that have no value.
 * @param {Stop} stop
 * @returns {Stop}
 */
const withoutMissing = (stop) =>
  Object.fromEntries(Object.entries(stop).filter(([, value]) => value !== undefined));

/**
 * A robot with other stops; one is written as target and work.
 * @param {RobotData} robot
 * @param {Stop[]} stops
 * @returns {RobotData}
 */
export function withStops(robot, stops) {
  const { target, work, actions, stops: before, ...rest } = robot;
  if (!stops.length) return rest;
  if (stops.length > 1) return { ...rest, stops };
  const [{ at, ...own }] = stops;
  return { ...rest, target: at, ...withoutMissing(own) };
}

/**
 * A robot with one of its stops at another place.
 * @param {RobotData} robot
 * @param {number} number
 * @param {Place} at
 * @returns {RobotData}
 */
export const withStopAt = (robot, number, at) =>
  withStops(
    robot,
    stopsOf(robot).map((stop, i) => (i === number ? { ...stop, at } : stop)),
  );

/**
 * Add robots; each gets a name if it has none.
 * @param {ScenarioDocument} document
 * @param {RobotData[]} news
 */
export const addRobots = (document, news) => addRows(document, "robots", news);

/**
 * Change some robots by a function of robot and index.
 * @param {ScenarioDocument} document
 * @param {number[]} indices
 * @param {(robot: RobotData, index: number) => RobotData} change
 */
export const changeRobots = (document, indices, change) =>
  changeRows(document, "robots", indices, change);

/**
 * @param {ScenarioDocument} document
 * @param {number[]} indices
 */
export const removeRobots = (document, indices) => removeRows(document, "robots", indices);

/**
 * Set a key of a robot; undefined takes it away.
 * @template {object} T
 * @param {T} robot
 * @param {keyof T} key
 * @param {T[keyof T] | undefined} value
 * @returns {T}
 */
export function withKey(robot, key, value) {
  const { [key]: before, ...rest } = robot;
  return value === undefined ? /** @type {T} */ (rest) : { ...robot, [key]: value };
}

/**
 * Stops as one cell of a table: "N6 (3); N8".
 * @param {RobotData} robot
 * @returns {string}
 */
export const textOfStops = (robot) =>
  stopsOf(robot)
    .map(({ at, work }) =>
      work === undefined ? textOfPlace(at) : `${textOfPlace(at)} (${figure(String(work))})`,
    )
    .join("; ");
