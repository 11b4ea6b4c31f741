/** The robots of a document, as edits of it. */

import { figure } from "../../../viz/page/assets/language/language.js";
import { textOfPlace } from "../draw/places.js";
import { present } from "../given.js";
/** @import { Column, Place, RobotData, ScenarioDocument, Stop } from "../types.js" */

/**
 * The robots that are written in the document; null where they are in another file.
 * @param {Pick<ScenarioDocument, "robots">} document
 * @returns {RobotData[] | null}
 */
export const robotsOf = ({ robots }) => (Array.isArray(robots) ? robots : null);

/**
 * The robots of a document that has them.
 * @param {Pick<ScenarioDocument, "robots">} document
 * @returns {RobotData[]}
 */
export const writtenIn = (document) => present(robotsOf(document));

/**
 * @param {ScenarioDocument} document
 * @param {RobotData[]} robots
 * @returns {ScenarioDocument}
 */
const withRobots = (document, robots) => ({ ...document, robots });

/**
 * A name that no robot has: R1, R2, ...
 * @param {RobotData[]} robots
 * @param {string} [prefix]
 * @returns {string}
 */
export function freeName(robots, prefix = "R") {
  const taken = new Set(robots.map(({ name }) => name));
  let number = robots.length + 1;
  while (taken.has(`${prefix}${number}`)) number++;
  return `${prefix}${number}`;
}

/**
 * The stops of a robot: `{ at, work }`, however they are written.
 * @param {RobotData} robot
 * @returns {Stop[]}
 */
export function stopsOf({ target, work, stops }) {
  if (stops) return stops;
  return target === undefined ? [] : [work === undefined ? { at: target } : { at: target, work }];
}

/**
 * A robot with other stops; one is written as target and work.
 * @param {RobotData} robot
 * @param {Stop[]} stops
 * @returns {RobotData}
 */
export function withStops(robot, stops) {
  const { target, work, stops: before, ...rest } = robot;
  if (!stops.length) return rest;
  if (stops.length > 1) return { ...rest, stops };
  const [{ at, work: only }] = stops;
  return only === undefined ? { ...rest, target: at } : { ...rest, target: at, work: only };
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
 * @returns {ScenarioDocument}
 */
export function addRobots(document, news) {
  const robots = [...writtenIn(document)];
  for (const robot of news) robots.push({ name: freeName(robots), ...robot });
  return withRobots(document, robots);
}

/**
 * Change some robots by a function of robot and index.
 * @param {ScenarioDocument} document
 * @param {number[]} indices
 * @param {(robot: RobotData, index: number) => RobotData} change
 * @returns {ScenarioDocument}
 */
export function changeRobots(document, indices, change) {
  const chosen = new Set(indices);
  return withRobots(
    document,
    writtenIn(document).map((robot, index) => (chosen.has(index) ? change(robot, index) : robot)),
  );
}

/**
 * @param {ScenarioDocument} document
 * @param {number[]} indices
 * @returns {ScenarioDocument}
 */
export function removeRobots(document, indices) {
  const chosen = new Set(indices);
  return withRobots(
    document,
    writtenIn(document).filter((_, index) => !chosen.has(index)),
  );
}

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
 * Put robots into the order of what a function says of them.
 * @param {ScenarioDocument} document
 * @param {(robot: RobotData) => string | number} valueOf
 * @param {boolean} isDown
 * @returns {ScenarioDocument}
 */
export function sortRobots(document, valueOf, isDown) {
  /** @type {[string | number, number, RobotData][]} */
  const order = writtenIn(document).map((robot, index) => [valueOf(robot), index, robot]);
  order.sort(([a, i], [b, j]) => (isDown ? -1 : 1) * compared(a, b) || i - j);
  return withRobots(
    document,
    order.map(([, , robot]) => robot),
  );
}

/**
 * @param {string | number} one
 * @param {string | number} other
 * @returns {number}
 */
function compared(one, other) {
  if (typeof one === "number" && typeof other === "number") return one - other;
  return String(one).localeCompare(String(other), undefined, { numeric: true });
}

/**
 * Robots as text for a spreadsheet; `columns` have `key` and `text`.
 * @param {RobotData[]} robots
 * @param {Pick<Column, "text">[]} columns
 * @returns {string}
 */
export const tableText = (robots, columns) =>
  robots.map((robot) => columns.map(({ text }) => text(robot)).join("\t")).join("\n");

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
