/** What is new in each run beside the one before it, in words. */

import { get } from "../api.js";
import { changeInWords } from "../../../viz/page/assets/compared_table.js";
import { words } from "../words.js";

export class RunNotes {
  #of = new Map(); // by the number of the run

  constructor(runs) {
    this.runs = runs;
  }

  /** What is said of a run. */
  on({ number }) {
    return this.#of.get(number) ?? [];
  }

  /** Find out in what runs differ from those before them. */
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

/** In what a run differs from the one before it, in words; "as good as 3" where nothing does. */
function between(before, run, edits) {
  const settings = ["seed", "time_limit"]
    .filter((key) => before.request[key] !== undefined && run.request[key] !== undefined)
    .filter((key) => before.request[key] !== run.request[key])
    .map((key) => words.settingChanged[key](before.request[key], run.request[key]));
  const found = [...edits, ...settings];
  const isSame = ["flowtime", "makespan"].every(
    (key) => before.figures?.[key] === run.figures?.[key],
  );
  return isSame && !edits.length ? [...found, words.asGoodAs(before.number)] : found;
}
