/** Planning: how, how far it is, what came of it, why robots wait, what else there is. */

import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { Change } from "./change.js";
import { Curve } from "./curve.js";
import { Exports } from "./exports.js";
import { RunList } from "./list.js";
import { Settings } from "./settings.js";
import { Waits } from "./waits.js";

export function PlanPanel({ studio }) {
  const { runs, store } = studio;
  const { running, run } = runs;
  const current = running ?? run;
  return html`
    <div class="scroll">
      <${Settings} studio=${studio} />
      ${current && html`<${Curve} run=${current} />`}
      ${run && !runs.isOf(store.document) && html`<p class="note">${words.changedSince}</p>`}
      <${Change} studio=${studio} />
      ${runs.losses && html`<${Waits} studio=${studio} />`}
      ${runs.payload && html`<${Exports} studio=${studio} />`}
      <${RunList} studio=${studio} />
    </div>`;
}
