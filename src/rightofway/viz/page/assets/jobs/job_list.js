import { texts } from "../language/language.js";
import { foundList } from "../player/markup.js";
import { TwoLineList, chooseAt } from "../lists/two_line_list.js";
import { upperFirst } from "../language/words.js";

/** @import { Root } from "../common/root.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { JobData } from "../payload.d.ts" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { TwoLines } from "../lists/two_line_list.js" */
/** @import { Words } from "../language/words.js" */

export const JOBS_TAB = `<button type="button" role="tab" id="tab-jobs" aria-controls="jobs" aria-selected="false" tabindex="-1"><span data-text="jobs"></span> <b></b></button>`;

export const JOBS_PANEL = `<div class="panel" id="jobs" role="tabpanel" aria-labelledby="tab-jobs" hidden>
  ${foundList({ item: "job", label: "jobs", hint: "findJob", find: "findJob" })}
</div>`;

/**
 * All jobs, those that nobody does first, then by their begin; choosing one goes there.
 *
 * @param {Plan} plan
 * @param {Pick<Clock, "pause" | "seek">} clock
 * @param {Choice} choice
 * @param {Words} words
 * @returns {TwoLines[]}
 */
export function linesOf(plan, clock, choice, words) {
  const order = [...plan.jobs.keys()].sort((a, b) => beginOf(plan, a) - beginOf(plan, b));
  return order.map((index) => {
    const job = plan.jobs[index];
    const choose = () => choice.chooseJob(index);
    return {
      head: headOf(words, job),
      detail: detailOf(plan, words, job),
      isAlarm: job.robot === undefined,
      isChosen: () => choice.jobIndex === index,
      choose: job.times ? () => chooseAt(clock, beginOf(plan, index), choose) : choose,
    };
  });
}

/**
 * The list of all jobs.
 *
 * @param {Root} root
 * @param {Plan} plan
 * @param {Clock} clock
 * @param {Choice} choice
 * @param {Words} words
 */
export function makeJobList(root, plan, clock, choice, words) {
  const items = linesOf(plan, clock, choice, words);
  return new TwoLineList(root, "job", choice, items, {
    none: items.length ? texts.jobs.noneFits : texts.jobs.none,
    isLong: false,
  });
}

/**
 * When a job begins; before all others where nobody does it.
 *
 * @param {Plan} plan
 * @param {number} index
 */
function beginOf(plan, index) {
  return plan.jobs[index].times?.[0] ?? -1;
}

/**
 * Its name, who does it, and how late.
 *
 * @param {Words} words
 * @param {JobData} job
 */
function headOf(words, { name, robot, times }) {
  if (robot === undefined) return texts.jobs.notServed({ name });
  const done = texts.jobs.doneBy({ name, robot: words.robot(robot) });
  return times?.[3] ? `${done}, ${texts.lateness.late({ time: words.time(times[3]) })}` : done;
}

/**
 * When it is done, or why it is not.
 *
 * @param {Plan} plan
 * @param {Words} words
 * @param {JobData} job
 */
function detailOf(plan, words, job) {
  if (!job.times) return job.reason === undefined ? "" : upperFirst(plan.phrases.said(job.reason));
  const [begin, end, service] = job.times;
  const when = texts.fromTo({ from: words.time(begin), to: words.time(end) });
  return `${when} · ${texts.jobs.inService({ time: words.time(service) })}`;
}
