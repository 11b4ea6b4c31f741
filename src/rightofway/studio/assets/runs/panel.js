/** The plan: settings, how it came about, the runs, why robots wait, what if, what else there is. */

import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { Ask } from "./ask.js";
import { Change } from "./change.js";
import { Comparison } from "./comparison.js";
import { Curve, quantitiesOf } from "./curve.js";
import { Exports } from "./exports.js";
import { PlanFaults } from "./faults.js";
import { Jobs } from "./jobs.js";
import { RunList } from "./list.js";
import { Settings } from "./settings.js";
import { Report, Studies } from "./studies.js";
import { Waits } from "./waits.js";
/** @import { Props } from "../types.js" */

/** @param {Props} props */
export function PlanPanel({ studio }) {
  const { runs, stage, store } = studio;
  const { running, run } = runs;
  const current = running ?? run;
  const isChosen = stage.isPlan && Boolean(stage.choice.robot);
  const change = !runs.compared && html`<${Change} studio=${studio} />`;
  const questions = html`
      ${runs.losses && html`<${Waits} studio=${studio} />`}
      ${runs.payload && html`<${Ask} studio=${studio}>${isChosen && change}<//>`}`;
  return html`
    <div class="scroll">
      <${Settings} studio=${studio} />
      <${PlanFaults} studio=${studio} />
      ${current && html`<${Curve} key=${current.number} run=${current} others=${running ? [] : runs.besides(current)} quantities=${quantitiesOf(current, studio)} />`}
      ${run && !runs.isOf(store.document) && html`<p class="aside">${words.changedSince} <button type="button" class="framed" onClick=${() => studio.takeBack()}>${words.takeBack}</button></p>`}
      ${!isChosen && change}
      ${runs.payload && html`<${Exports} studio=${studio} />`}
      ${isChosen && questions}
      <${Jobs} studio=${studio} />
      <${RunList} studio=${studio} />
      <${Comparison} studio=${studio} />
      <${Report} studio=${studio} />
      ${!isChosen && questions}
      <${Studies} studio=${studio} />
    </div>`;
}
