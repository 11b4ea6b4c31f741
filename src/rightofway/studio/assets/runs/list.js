/** All runs: shown, compared, named, forgotten. */

import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { isOver } from "./run_store.js";

export function RunList({ studio }) {
  const { runs } = studio;
  const title = (run) => run.name || run.source || words.runKinds[run.kind] || run.kind;
  const rename = (run) => {
    const name = window.prompt(words.runName, title(run));
    if (name !== null) studio.attempt(() => runs.rename(run.number, name.trim()));
  };
  const show = (number) => studio.attempt(async () => {
    await runs.show(number);
    studio.showTab("plan");
  });
  if (!runs.runs.length) return null;
  return html`
    <section aria-labelledby="runs-title"><h2 id="runs-title">${words.runs}</h2>
      <ul class="runs">${runs.runs.map((run) => html`
        <li key=${run.number} class=${run.number === runs.shown ? "chosen" : ""}>
          <button type="button" class="show" disabled=${!run.has_plan} aria-pressed=${String(run.number === runs.shown)} onClick=${() => show(run.number)}>
            <b>${run.number}</b> <span class="name">${title(run)}</span> <small>${run.request?.planner ?? ""} ${words.states[run.state]}</small>
            ${run.figures && html`<span class="cost">${run.figures.text.flowtime}</span>`}</button>
          ${run.has_plan && run.number !== runs.shown && runs.shown && html`<button type="button" class="quiet" aria-pressed=${String(runs.beside === run.number)}
            onClick=${() => studio.attempt(() => runs.compare(runs.beside === run.number ? null : run.number))}>${words.compare}</button>`}
          <button type="button" class="quiet" aria-label=${`${words.rename}: ${run.number}`} title=${words.rename} onClick=${() => rename(run)}>✎</button>
          ${isOver(run) && html`<button type="button" class="quiet" aria-label=${`${words.remove}: ${run.number}`} title=${words.remove} onClick=${() => studio.attempt(() => runs.forget(run.number))}>✕</button>`}
          ${run.error && html`<p class="wrong">${run.error.message}</p>`}
        </li>`)}
      </ul>
    </section>`;
}
