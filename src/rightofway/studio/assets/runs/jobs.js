/** The jobs of the plan that is shown: those that nobody does with their reasons, then by their begin. */

import { texts } from "../../../viz/page/assets/language/language.js";
import { linesOf } from "../../../viz/page/assets/jobs/job_list.js";
import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
/** @import { Props } from "../types.js" */

const MOST = 12; // that are listed at once; the others on request

/** @param {Props} props */
export function Jobs({ studio }) {
  const { stage } = studio;
  const [most, setMost] = useState(MOST);
  if (!stage.isPlan || !stage.plan.jobs.length) return null;
  const { plan, clock, choice } = stage;
  const lines = linesOf(plan, clock, choice, stage.words);
  const done = plan.jobs.filter(({ times }) => times).length;
  return html`<section class="jobs-of-plan" aria-labelledby="jobs-title">
    <h2 id="jobs-title">${words.tabs.jobs} <small>${texts.lateOf({ count: done, all: lines.length })}</small></h2>
    <ul>${lines.slice(0, most).map(
      ({ head, detail, isAlarm, isChosen, choose }) => html`<li>
        <button type="button" aria-pressed=${String(isChosen())} onClick=${choose}>
          <b class=${isAlarm ? "wrong" : ""}>${head}</b> <span>${detail}</span></button></li>`,
    )}</ul>
    ${lines.length > most && html`<button type="button" class="framed" onClick=${() => setMost(most + MOST)}>${words.moreRows({ count: lines.length - most })}</button>`}
  </section>`;
}
