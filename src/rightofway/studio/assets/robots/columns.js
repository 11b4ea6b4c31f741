/** The columns of the table of robots: what a cell says, and what it means when it is written. */

import { figure, said } from "../../../viz/page/assets/language/language.js";
import { numberOf, placeOfText, textOfPlace } from "../draw/places.js";
import { ATTRIBUTES } from "./attributes.js";
import { stopsOf, textOfStops, withKey, withStops } from "./fleet.js";
/** @import { DocumentFault } from "../api_types.js" */
/** @import { Column, Numeral, Place, RobotData, SheetTable, StartData, Stop } from "../types.js" */

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
      const before = stopsOf(robot);
      const usual = before[0]?.work;
      return withStops(
        robot,
        stopsOfText(text).map((stop, i) => ({
          ...("work" in stop || usual === undefined ? {} : { work: usual }),
          ...stop,
          ...(before[i]?.actions === undefined ? {} : { actions: before[i].actions }),
        })),
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
        stopsOf(robot).map(({ work, ...stop }) =>
          written(text) === undefined ? stop : { ...stop, work: written(text) },
        ),
      ),
  },
  ...Object.keys(ATTRIBUTES).map(attribute),
  {
    key: "capacity",
    words: ({ columns }) => columns.capacity,
    text: ({ capacity }) => figure(String(capacity ?? "")),
    value: ({ capacity }) => numberOf(capacity, -1),
    set: (robot, text) => withKey(robot, "capacity", written(text)),
  },
  {
    key: "battery",
    words: ({ columns }) => columns.battery,
    text: ({ battery }) => battery ?? "",
    set: (robot, text) => withKey(robot, "battery", text.trim() || undefined),
  },
  {
    key: "charging",
    words: ({ columns }) => columns.charging,
    text: ({ charging }) => (charging ?? []).map(textOfPlace).join("; "),
    set: (robot, text) => {
      const places = placesOfText(text);
      return withKey(robot, "charging", places.length ? places : undefined);
    },
  },
  {
    key: "start",
    words: ({ columns }) => columns.start,
    text: ({ start }) => textOfPlace(start?.at),
    set: (robot, text) => withStart(robot, { at: placeOfText(text) }),
  },
  {
    key: "soc",
    words: ({ columns }) => columns.soc,
    text: ({ start }) => figure(String(start?.soc ?? "")),
    value: ({ start }) => numberOf(start?.soc, -1),
    set: (robot, text) => withStart(robot, { soc: written(text) }),
  },
];

/**
 * A robot with other parts of its start; without one where nothing of it is left.
 * @param {RobotData} robot
 * @param {Partial<StartData>} parts
 * @returns {RobotData}
 */
function withStart(robot, parts) {
  const given = Object.entries({ ...robot.start, ...parts }).filter(
    ([, value]) => value !== undefined,
  );
  return withKey(robot, "start", given.length ? Object.fromEntries(given) : undefined);
}

/**
 * Places with ; between.
 * @param {string} text
 * @returns {Place[]}
 */
export const placesOfText = (text) => text.split(";").flatMap((part) => placeOfText(part) ?? []);

/**
 * The unit of the numbers in a column; empty for text, and where the document has none.
 * @param {Pick<Column, "key">} column
 * @param {{length?: string, time?: string}} units
 * @returns {string}
 */
function unitOf({ key }, { length, time }) {
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
  const key = String((path[3] === "soc" ? path[3] : path[2]) ?? "name");
  return { target: "stops", size: "radius" }[key] ?? key;
}

/** @type {SheetTable} */
export const ROBOT_TABLE = {
  list: "robots",
  kind: "robot",
  columns: COLUMNS,
  columnOf,
  unitOf,
  newRow: ({ newRow }) => newRow,
};
