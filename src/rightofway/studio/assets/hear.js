/** The stream of events of all runs, and the runs as these events describe them. */

/** @import { Events, RunData } from "./api_types.js" */
/** @import { EventPair, Tell } from "./types.js" */

/** @type {(keyof Events)[]} */
const EVENTS = ["runs", "run", "progress", "plan", "deleted"];

/**
 * Hear of all runs: first the list of them, then what happens; `refused` is called where there is no
 * stream, `lost` where it has ended. The browser opens one that is lost again.
 * @param {Tell} tell
 * @param {() => void} lost
 * @param {() => void} [refused]
 * @returns {EventSource}
 */
export function hear(tell, lost, refused = () => {}) {
  const stream = new EventSource("/api/v1/events");
  for (const name of EVENTS)
    stream.addEventListener(name, ({ data }) =>
      tell(.../** @type {EventPair} */ ([name, JSON.parse(data)])),
    );
  stream.onerror = () => {
    lost();
    if (stream.readyState === EventSource.CLOSED) refused();
  };
  return stream;
}

/** The runs as the events so far describe them, by number; null before the first list. */
export class KnownRuns {
  /** @type {Map<number, RunData> | null} */
  byNumber = null;

  /**
   * Take in an event.
   * @param {EventPair} event
   * @returns {void}
   */
  take(...[name, data]) {
    if (name === "runs") this.byNumber = new Map(data.runs.map((run) => [run.number, run]));
    else if (name === "run") this.byNumber?.set(data.number, data);
    else if (name === "deleted") this.byNumber?.delete(data.number);
    const run = name === "plan" ? this.byNumber?.get(data.number) : undefined;
    if (run && name === "plan") Object.assign(run, { figures: data.figures, has_plan: true });
  }
}
