/** The columns of the table of robots: what a cell says, and what it means when it is written. */

import { figure, said } from "../../../viz/page/assets/language/language.js";
import { numberOf, placeOfText, textOfPlace } from "../draw/places.js";
import { ATTRIBUTES } from "./attributes.js";
import { stopsOf, textOfStops, withKey, withStops } from "./fleet.js";
/** @import { DocumentFault } from "../api_types.js" */
/** @import { Column, Numeral, RobotData, Stop } from "../types.js" */

/**
 * A number that somebody has typed: with a comma too; as text where it is none, so that the library says why.
 * @param {string} text
 * @returns {Numeral | undefined}
 */
export function written(text) {
  const plain = text.trim().replace(",", ".");
  if (!plain) return undefined;
  return plain.includes("/") || Number.isNaN(Number(plain)) ? plain : Number(plain);
}

/**
 * Stops as `textOfStops` writes them: "N6 (3); N8".
 * @param {string} text
 * @returns {Stop[]}
 */
function stopsOfText(text) {
  return text
    .split(";")
    .map((part) => part.trim())
    .filter(Boolean)
    .map((part) => {
      const found = /^(.*?)\s*\(([^()]*)\)$/.exec(part);
      const at = placeOfText(found ? found[1] : part);
      return found ? { at, work: written(found[2]) } : { at };
    });
}

/**
 * The work at all stops; empty where they differ.
 * @param {RobotData} robot
 * @returns {string}
 */
function textOfWork(robot) {
  const works = new Set(stopsOf(robot).map(({ work }) => work ?? ""));
  return works.size === 1 ? figure(String([...works][0])) : "";
}

/**
 * The column of an attribute of the library's table.
 * @param {string} name
 * @returns {Column}
 */
function attribute(name) {
  const key = /** @type {keyof typeof ATTRIBUTES} */ (name);
  const { isText, title, hint, usual } = ATTRIBUTES[key];
  /** @param {RobotData} robot */
  const text = (robot) => {
    const value = String(robot[key] ?? "");
    return isText ? value : figure(value);
  };
  return {
    key,
    words: () => [said([title, {}]), said([hint, {}]), usual],
    text,
    value: isText ? undefined : (robot) => numberOf(robot[key], -1),
    set: (robot, given) => withKey(robot, key, isText ? given.trim() || undefined : written(given)),
  };
}

/** @type {Column[]} */
export const COLUMNS = [
  {
    key: "name",
    words: ({ columns }) => columns.name,
    text: ({ name }) => name ?? "",
    set: (robot, text) => ({ ...robot, name: text.trim() }),
  },
  {
    key: "home",
    words: ({ columns }) => columns.home,
    text: ({ home }) => textOfPlace(home),
    set: (robot, text) => withKey(robot, "home", placeOfText(text)),
  },
  {
    key: "stops",
    words: ({ columns }) => columns.stops,
    text: (robot) =>
      new Set(stopsOf(robot).map(({ work }) => work)).size > 1
        ? textOfStops(robot)
        : stopsOf(robot)
            .map(({ at }) => textOfPlace(at))
            .join("; "),
    set: (robot, text) => {
      const usual = stopsOf(robot)[0]?.work;
      return withStops(
        robot,
        stopsOfText(text).map((stop) =>
          "work" in stop || usual === undefined ? stop : { ...stop, work: usual },
        ),
      );
    },
  },
  {
    key: "work",
    words: ({ columns }) => columns.work,
    text: textOfWork,
    value: (robot) => numberOf(written(textOfWork(robot)), -1),
    set: (robot, text) =>
      withStops(
        robot,
        stopsOf(robot).map(({ at }) =>
          written(text) === undefined ? { at } : { at, work: written(text) },
        ),
      ),
  },
  ...Object.keys(ATTRIBUTES).map(attribute),
];

/**
 * The unit of the numbers in a column; empty for text, and where the document has none.
 * @param {Pick<Column, "key">} column
 * @param {{length?: string, time?: string}} units
 * @returns {string}
 */
export function unitOf({ key }, { length, time }) {
  if (key === "work" || key === "turn") return time ?? "";
  if (key === "radius") return length ?? "";
  if (key === "speed") return length && time ? `${length}/${time}` : "";
  return key === "turn_rate" && time ? `°/${time}` : "";
}

/**
 * The column of a fault of a robot: "target" is of the stops.
 * @param {Pick<DocumentFault, "path">} fault
 * @returns {string}
 */
export function columnOf({ path }) {
  const key = String(path[2] ?? "name");
  return { target: "stops", size: "radius" }[key] ?? key;
}
