/** All runs: shown, compared, named, forgotten. */

import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { canBeShown, isOver } from "./run_store.js";
import { Term } from "./term.js";

const MOST = 30; // that are listed at once; the others on request

export const titleOf = (run) => run.name || run.source || words.runKinds[run.kind] || run.kind;

export function RunList({ studio }) {
  const { runs } = studio;
  const [listed, setListed] = useState(MOST);
  if (!runs.runs.length) return null;
  return html`
    <section aria-labelledby="runs-title"><h2 id="runs-title">${words.runs}</h2>
      <table class="runs">
        <thead><tr><th scope="col"><span class="unseen">${words.show}</span></th><th scope="col">${words.name}</th><th scope="col"><${Term} of="flowtime" /></th>
          <th scope="col"><${Term} of="gap" /></th><th scope="col">${words.took}</th><th scope="col"><span class="unseen">${words.compare}, ${words.remove}</span></th></tr></thead>
        <tbody>${runs.runs.slice(0, listed).map((run) => html`<${Row} key=${run.number} studio=${studio} run=${run} />`)}</tbody>
      </table>
      ${runs.runs.length > listed && html`<button type="button" class="framed" onClick=${() => setListed(listed + MOST)}>${words.moreRows(runs.runs.length - listed)}</button>`}
    </section>`;
}

function Row({ studio, run }) {
  const { runs } = studio;
  const { number, figures } = run;
  const isShown = number === runs.shown;
  const named = (action) => `${action}: ${number} ${titleOf(run)}`;
  const method =
    run.request?.planner ??
    run.request?.rule ??
    (run.kind === "plan" ? runs.planners.default : words.runKinds[run.kind]);
  const took =
    run.started && run.ended && run.ended > run.started
      ? `${(run.ended - run.started).toFixed(1)} s`
      : "";
  return html`
    <tr class=${isShown ? "chosen" : ""} data-run=${number} data-state=${run.state}>
      <td><button type="button" class="show" disabled=${!canBeShown(run)} aria-pressed=${String(isShown)} aria-label=${named(words.show)} title=${words.show} onClick=${() => studio.showRun(number)}>${number}</button></td>
      <td class="title"><input value=${run.name} placeholder=${titleOf(run)} maxlength="200" spellcheck="false" aria-label=${`${words.runName} ${number}`}
          onChange=${({ target }) => studio.attempt(() => runs.rename(number, target.value.trim()))} />
        <small>${[method, words.states[run.state]].filter(Boolean).join(", ")}</small></td>
      <td>${figures?.text.flowtime}</td><td class="short">${figures?.text.gap}</td><td class="short">${took}</td>
      <td class="do">
        ${
          run.has_plan &&
          runs.run?.has_plan &&
          !isShown &&
          html`<button type="button" class="quiet" aria-pressed=${String(runs.beside === number)} aria-label=${named(words.compare)} title=${words.compare}
          onClick=${() => studio.attempt(() => runs.compare(runs.beside === number ? null : number))}>⇄</button>`
        }
        ${isOver(run) && html`<button type="button" class="quiet" aria-label=${named(words.remove)} title=${words.remove} onClick=${() => studio.attempt(() => runs.forget(number))}>✕</button>`}</td>
    </tr>
    ${run.error && html`<tr class="why"><td></td><td colspan="5"><${Failure} studio=${studio} error=${run.error} /></td></tr>`}`;
}

/** Why a run failed, as the library says it; each proven reason lights its places on the map. */
function Failure({ studio, error }) {
  const reasons = error.reasons?.filter(({ vertices }) => vertices.length) ?? [];
  if (!reasons.length) return html`<p class="wrong" lang="en">${error.message}</p>`;
  return html`${reasons.map(({ reason, vertices }) => html`<button type="button" class="watch wrong" lang="en" onClick=${() => studio.light(vertices)}>${reason}</button>`)}`;
}
