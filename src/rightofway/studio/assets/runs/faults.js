/** What is wrong with the plan that is shown, before all else: how many faults, and each with its place and time. */

import { html } from "../vendor/htm-preact.js";
import { texts } from "../../../viz/page/assets/language/language.js";
import { words } from "../words.js";
/** @import { Plan } from "../../../viz/page/assets/plan/plan.js" */
/** @import { RunData } from "../api_types.js" */
/** @import { Props } from "../types.js" */

const MOST = 5; // that are listed at once; the others on request

/**
 * How many faults the plan of a run has; 0 where none is known.
 * @param {Pick<RunData, "figures"> | undefined} run
 * @returns {number}
 */
export const faultsOf = (run) => run?.figures?.faults ?? 0;

/**
 * "2 faults: do not run this plan", as the exported page has it.
 * @param {number} count
 * @returns {string}
 */
export const doNotRun = (count) => texts.doNotRun({ count });

/**
 * The same in few words: "2 faults".
 * @param {number} count
 * @returns {string}
 */
export const inShort = (count) => texts.faults({ count });

/** @param {Props} props */
export function PlanFaults({ studio }) {
  const { stage } = studio;
  if (!stage.isPlan || !stage.plan.faultCount) return null;
  const { faults, faultCount } = stage.plan;
  return html`
    <section class="plan-faults" role="alert" aria-labelledby="plan-faults-title">
      <h2 id="plan-faults-title" class="wrong">${doNotRun(faultCount)}</h2>
      <ol>${faults.slice(0, MOST).map((fault, index) => html`<li><${Press} studio=${studio} fault=${fault} index=${index} /></li>`)}</ol>
      ${
        faults.length > MOST &&
        html`<details><summary>${words.moreFaults({ count: faultCount - MOST })}</summary>
        <ol start=${MOST + 1}>${faults.slice(MOST).map((fault, index) => html`<li><${Press} studio=${studio} fault=${fault} index=${MOST + index} /></li>`)}</ol></details>`
      }
    </section>`;
}

/**
 * A fault in a sentence; a press shows its place at its time.
 * @param {Props & {fault: Plan["faults"][number], index: number}} props
 */
function Press({ studio, fault, index }) {
  const { plan, words: said, clock, choice } = studio.stage;
  const look = () => {
    clock.pause();
    clock.seek(fault.tick);
    choice.chooseFault(index);
  };
  const when = plan.noPlan ? "" : `, ${texts.at({ moment: said.moment(fault.tick) })}`;
  const isChosen = choice.fault === plan.faults[index];
  return html`<button type="button" class="watch wrong" aria-pressed=${String(isChosen)} onClick=${look}>
    ${plan.phrases.said(fault.reason)}${when}</button>`;
}
