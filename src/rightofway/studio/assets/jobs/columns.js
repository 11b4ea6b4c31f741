/** The columns of the table of jobs: the keys of a job, as in files and workbooks. */

import { figure } from "../../../viz/page/assets/language/language.js";
import { post } from "../api.js";
import { numberOf, placeOfText, textOfPlace } from "../draw/places.js";
import { written } from "../robots/columns.js";
import { withKey } from "../robots/fleet.js";
import { addJobs } from "./jobs.js";
/** @import { DocumentFault } from "../api_types.js" */
/** @import { Column, JobData, JobStop, RowData, SheetTable } from "../types.js" */

/**
 * What a key of a job holds, as a cell says it and reads it.
 * @type {Record<string, { text: (value: any) => string, read: (text: string) => any, isNumber?: boolean }>}
 */
const KINDS = {
  place: { text: textOfPlace, read: placeOfText },
  number: {
    text: (value) => (value === undefined ? "" : figure(String(value))),
    read: written,
    isNumber: true,
  },
  text: { text: (value) => value ?? "", read: (text) => text.trim() || undefined },
  names: { text: (value) => (value ?? []).join(", "), read: namesOf },
  stops: { text: textOfJobStops, read: jobStopsOf },
};

/**
 * Names with commas between; undefined for none.
 * @param {string} text
 * @returns {string[] | undefined}
 */
function namesOf(text) {
  const names = text.split(",").map((name) => name.trim());
  return names.some(Boolean) ? names.filter(Boolean) : undefined;
}

/**
 * Stops as one cell of a table: "N3 (4) +2; N51 -1", with work time and load.
 * @param {JobStop[] | undefined} stops
 * @returns {string}
 */
function textOfJobStops(stops = []) {
  return stops
    .map(({ at, work, load }) => {
      const parts = [textOfPlace(at)];
      if (work !== undefined) parts.push(`(${figure(String(work))})`);
      if (load) parts.push(`${Number(load) > 0 ? "+" : ""}${load}`);
      return parts.join(" ");
    })
    .join("; ");
}

/**
 * Stops as `textOfJobStops` writes them; undefined for none.
 * @param {string} text
 * @returns {JobStop[] | undefined}
 */
function jobStopsOf(text) {
  const parts = text.split(";").map((part) => part.trim());
  const stops = parts.filter(Boolean).map((part) => {
    const [, place = part, work, load] =
      /^(.*?)\s*(?:\(([^()]*)\))?\s*([+-]\d+)?$/.exec(part) ?? [];
    /** @type {JobStop} */
    const stop = { at: placeOfText(place) };
    if (work !== undefined) stop.work = written(work);
    if (load !== undefined) stop.load = Number(load);
    return stop;
  });
  return stops.length ? stops : undefined;
}

/** @type {[keyof JobData, keyof typeof KINDS][]} */
const KEYS = [
  ["pickup", "place"],
  ["dropoff", "place"],
  ["at", "place"],
  ["stops", "stops"],
  ["load", "number"],
  ["work", "number"],
  ["pickup_work", "number"],
  ["dropoff_work", "number"],
  ["earliest", "number"],
  ["latest", "number"],
  ["due", "number"],
  ["weight", "number"],
  ["types", "names"],
  ["robot", "text"],
  ["after", "names"],
];

/** @type {Column[]} */
export const JOB_COLUMNS = [
  {
    key: "name",
    words: ({ jobColumns }) => jobColumns.name,
    text: ({ name }) => name ?? "",
    set: (job, text) => ({ ...job, name: text.trim() }),
  },
  ...KEYS.map(([key, kind]) => {
    const { text, read, isNumber } = KINDS[kind];
    /** @type {Column} */
    const column = {
      key,
      words: ({ jobColumns }) => jobColumns[key],
      text: (job) => text(/** @type {JobData} */ (job)[key]),
      value: isNumber ? (job) => numberOf(/** @type {any} */ (job)[key], -1) : undefined,
      set: (job, given) =>
        withKey(/** @type {JobData} */ (job), key, keepOthers(job, key, read(given))),
    };
    return column;
  }),
];

/**
 * Stops that were written anew keep the times and actions that a cell does not show.
 * @param {RowData} job
 * @param {string} key
 * @param {any} value
 */
function keepOthers(job, key, value) {
  if (key !== "stops" || !value) return value;
  const { stops = [] } = /** @type {JobData} */ (job);
  return /** @type {JobStop[]} */ (value).map((stop, i) => {
    const { earliest, latest, actions } = stops[i] ?? {};
    return {
      ...stop,
      ...(earliest === undefined ? {} : { earliest }),
      ...(latest === undefined ? {} : { latest }),
      ...(actions === undefined ? {} : { actions }),
    };
  });
}

const TIMES = ["work", "pickup_work", "dropoff_work", "earliest", "latest", "due"];

/** @type {SheetTable} */
export const JOB_TABLE = {
  list: "jobs",
  kind: "job",
  columns: JOB_COLUMNS,
  columnOf: ({ path }) => String(path[2] ?? "name"),
  unitOf: ({ key }, { time }) => (TIMES.includes(key) ? (time ?? "") : ""),
  newRow: ({ newJob }) => newJob,
  read: async (text) => {
    const { jobs } = await post("/rows", { text });
    return (document) => addJobs(document, jobs);
  },
};
