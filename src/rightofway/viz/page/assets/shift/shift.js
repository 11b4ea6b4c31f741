import { lastAtMost } from "../common/arrays.js";

/** @import { JobData, ShiftData } from "../payload.d.ts" */

/** @typedef {"open" | "underWay" | "done"} JobState */

/** What a shift has beside the plan of all that robots have done. */
export class Shift {
  /**
   * @param {ShiftData} raw
   * @param {JobData[]} jobs in the order in which they became known
   */
  constructor(raw, jobs) {
    this.raw = raw;
    this.jobs = jobs;
    this.known = Float64Array.from(raw.known);
    this.begins = Float64Array.from(jobs, findFirstBegin);
    this.ends = Float64Array.from(jobs, ({ times }) => times?.[1] ?? Infinity);
  }

  /**
   * How many jobs are known at a tick.
   *
   * @param {number} tick
   */
  countKnown(tick) {
    if (!this.known.length || this.known[0] > tick) return 0;
    return lastAtMost(this.known, tick) + 1;
  }

  /**
   * @param {number} job
   * @param {number} tick
   * @returns {JobState}
   */
  stateOf(job, tick) {
    if (this.ends[job] <= tick) return "done";
    return this.begins[job] <= tick ? "underWay" : "open";
  }
}

/**
 * When the first work for a job began.
 *
 * @param {JobData} job
 */
function findFirstBegin({ stops }) {
  const begins = stops.flatMap(([, , begin]) => (begin < 0 ? [] : [begin]));
  return begins.length ? Math.min(...begins) : Infinity;
}
