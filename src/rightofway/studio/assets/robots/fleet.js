/** The robots of a document, as edits of it. */

import { textOfPlace } from "../draw/places.js";

/** The robots that are written in the document; null where they are in another file. */
export const robotsOf = ({ robots }) => (Array.isArray(robots) ? robots : null);

const withRobots = (document, robots) => ({ ...document, robots });

/** A name that no robot has: R1, R2, ... */
export function freeName(robots, prefix = "R") {
  const taken = new Set(robots.map(({ name }) => name));
  let number = robots.length + 1;
  while (taken.has(`${prefix}${number}`)) number++;
  return `${prefix}${number}`;
}

/** The stops of a robot: `{ at, work }`, however they are written. */
export function stopsOf({ target, work, stops }) {
  if (stops) return stops;
  return target === undefined ? [] : [work === undefined ? { at: target } : { at: target, work }];
}

/** A robot with other stops; one is written as target and work. */
export function withStops(robot, stops) {
  const { target, work, stops: before, ...rest } = robot;
  if (!stops.length) return rest;
  if (stops.length > 1) return { ...rest, stops };
  const [{ at, work: only }] = stops;
  return only === undefined ? { ...rest, target: at } : { ...rest, target: at, work: only };
}

/** A robot with one of its stops at another place. */
export const withStopAt = (robot, number, at) =>
  withStops(
    robot,
    stopsOf(robot).map((stop, i) => (i === number ? { ...stop, at } : stop)),
  );

/** Add robots; each gets a name if it has none. */
export function addRobots(document, news) {
  const robots = [...robotsOf(document)];
  for (const robot of news) robots.push({ name: freeName(robots), ...robot });
  return withRobots(document, robots);
}

/** Change some robots by a function of robot and index. */
export function changeRobots(document, indices, change) {
  const chosen = new Set(indices);
  return withRobots(
    document,
    robotsOf(document).map((robot, index) => (chosen.has(index) ? change(robot, index) : robot)),
  );
}

export function removeRobots(document, indices) {
  const chosen = new Set(indices);
  return withRobots(
    document,
    robotsOf(document).filter((_, index) => !chosen.has(index)),
  );
}

/** Set a key of a robot; undefined takes it away. */
export function withKey(robot, key, value) {
  const { [key]: before, ...rest } = robot;
  return value === undefined ? rest : { ...robot, [key]: value };
}

/** Put robots into the order of what a function says of them. */
export function sortRobots(document, valueOf, isDown) {
  const order = robotsOf(document).map((robot, index) => [valueOf(robot), index, robot]);
  order.sort(([a, i], [b, j]) => (isDown ? -1 : 1) * compared(a, b) || i - j);
  return withRobots(
    document,
    order.map(([, , robot]) => robot),
  );
}

function compared(one, other) {
  if (typeof one === "number" && typeof other === "number") return one - other;
  return String(one).localeCompare(String(other), undefined, { numeric: true });
}

/** Robots as text for a spreadsheet; `columns` have `key` and `text`. */
export const tableText = (robots, columns) =>
  robots.map((robot) => columns.map(({ text }) => text(robot)).join("\t")).join("\n");

/** Stops as one cell of a table: "N6 (3); N8". */
export const textOfStops = (robot) =>
  stopsOf(robot)
    .map(({ at, work }) => (work === undefined ? textOfPlace(at) : `${textOfPlace(at)} (${work})`))
    .join("; ");
