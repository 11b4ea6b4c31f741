/** What is new in each run beside the one before it, in words. */

import { get } from "../api.js";
import { changeInWords } from "../../../viz/page/assets/figures/compared_table.js";
import { words } from "../words.js";
/** @import { RunData } from "../api_types.js" */
/** @import { RunStore } from "./run_store.js" */

/** @type {["seed", "time_limit"]} */
const SETTINGS = ["seed", "time_limit"];
/** @type {["flowtime", "makespan"]} */
const FIGURES = ["flowtime", "makespan"];

export class RunNotes {
  /** @type {Map<number, string[]>} */
  #of = new Map(); // by the number of the run

  /** @param {RunStore} runs */
  constructor(runs) {
    this.runs = runs;
  }

  /**
   * What is said of a run.
   * @param {{number: number}} run
   * @returns {string[]}
   */
  on({ number }) {
    return this.#of.get(number) ?? [];
  }

  /**
   * Find out in what runs differ from those before them.
   * @param {number[]} numbers
   * @returns {Promise<void>}
   */
  async find(numbers) {
    const { runs } = this;
    for (const run of numbers.map((number) => runs.find(number))) {
      if (!run?.has_plan || !run.ended || this.#of.has(run.number)) continue;
      this.#of.set(run.number, []);
      try {
        const { before, changes } = await get(`/runs/${run.number}/changes`);
        const earlier = runs.find(before);
        if (earlier) this.#of.set(run.number, between(earlier, run, changes.map(changeInWords)));
        runs.tell("runs");
      } catch {
        // it is forgotten: there is nothing to say
      }
    }
  }
}

/**
 * In what a run differs from the one before it, in words; "as good as 3" where nothing does.
 * @param {RunData} before
 * @param {RunData} run
 * @param {string[]} edits
 * @returns {string[]}
 */
function between(before, run, edits) {
  const settings = SETTINGS.filter(
    (key) => before.request[key] !== undefined && run.request[key] !== undefined,
  )
    .filter((key) => before.request[key] !== run.request[key])
    .map((key) =>
      words.settingChanged[key]({
        before: before.request[key] ?? "",
        after: run.request[key] ?? "",
      }),
    );
  const found = [...edits, ...settings];
  const isSame = FIGURES.every((key) => before.figures?.[key] === run.figures?.[key]);
  return isSame && !edits.length ? [...found, words.asGoodAs({ number: before.number })] : found;
}
