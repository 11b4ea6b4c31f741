/** What somebody has changed between two documents, in words: a line for each robot, place and part. */

import { COLUMNS } from "../robots/columns.js";
import { robotsOf } from "../robots/fleet.js";
import { words } from "../words.js";
import { textOfClosure } from "./closures.js";

export function editsBetween(before, after) {
  return [
    ...editsOfRobots(before, after),
    ...editsOfClosures(before, after),
    ...others(before, after),
  ];
}

function* editsOfRobots(before, after) {
  if (before.robots === after.robots) return;
  const named = (document) => new Map((robotsOf(document) ?? []).map((one) => [one.name, one]));
  const [old, now] = [named(before), named(after)];
  for (const [name, robot] of now) {
    if (!old.has(name)) yield words.edits.added(name);
    else if (old.get(name) !== robot) {
      const edits = COLUMNS.flatMap((column) => editOf(column, old.get(name), robot));
      if (edits.length) yield `${name}: ${edits.join(", ")}`;
    }
  }
  for (const name of old.keys()) if (!now.has(name)) yield words.edits.removed(name);
}

/** "speed 1 → 1/2", or nothing. */
function editOf({ key, text }, before, after) {
  const [label, , usual = ""] = words.columns[key];
  const [was, is] = [before, after].map((robot) => text(robot) || usual);
  return was === is ? [] : [`${label} ${was} → ${is}`];
}

function* editsOfClosures(before, after) {
  const texts = ({ closures = [] }) => closures.map(textOfClosure);
  const [old, now] = [texts(before), texts(after)];
  for (const text of now) if (!old.includes(text)) yield words.edits.closed(text);
  for (const text of old) if (!now.includes(text)) yield words.edits.opened(text);
}

function* others(before, after) {
  for (const key of ["map", "rules"])
    if (JSON.stringify(before[key]) !== JSON.stringify(after[key])) yield words.edits[key];
}
