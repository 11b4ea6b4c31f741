/** Which planner with which options, how long, and the buttons that begin and end a run. */

import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";

export function Settings({ studio }) {
  const { settings, runs, store } = studio;
  const { planners } = runs;
  const chosen = settings.planner || planners.default;
  const spec = planners.planners.find(({ name }) => name === chosen);
  const set = (change) => {
    Object.assign(settings, change);
    studio.tell("change");
  };
  const option = (name, value) => {
    const { [name]: before, ...rest } = settings.options;
    set({ options: value === "" ? rest : { ...rest, [name]: value } });
  };
  return html`
    <form class="settings" onSubmit=${(event) => {
      event.preventDefault();
      studio.plan();
    }}>
      <details open=${!runs.payload}><summary>${words.planSummary(chosen, settings.time_limit)}</summary>
      <div class="fields">
        <label>${words.planner}<select value=${chosen} title=${spec?.summary} onChange=${({ target }) => set({ planner: target.value, options: {} })}>
          ${planners.planners.map(({ name, summary }) => html`<option value=${name} title=${summary}>${name}</option>`)}</select></label>
        <label>${words.limit}<input type="number" id="limit" required min="0.1" max="3600" step="any" value=${settings.time_limit} onInput=${({ target }) => set({ time_limit: target.value })} /></label>
        <label>${words.seed}<input type="number" required min="0" max="4294967295" step="1" value=${settings.seed} onInput=${({ target }) => set({ seed: target.value })} /></label>
      </div>
      ${spec?.options.length > 0 && html`<details><summary>${words.options}</summary><div class="fields">${spec.options.map(({ name, summary, choices, ...rest }) => html`
        <label title=${summary}>${name}${choices.length ? html`<select value=${settings.options[name] ?? rest.default} onChange=${({ target }) => option(name, target.value)}>${choices.map((each) => html`<option>${each}</option>`)}</select>`
          : html`<input value=${settings.options[name] ?? ""} placeholder=${String(rest.default ?? "")} inputmode=${rest.least === null ? "text" : "numeric"} onChange=${({ target }) => option(name, target.value)} />`}</label>`)}</div></details>`}
      </details>
      <label class="check"><input type="checkbox" checked=${studio.isLive} onChange=${({ target }) => {
        studio.isLive = target.checked;
        studio.tell("change");
      }} /> ${words.live}</label>
      <div class="buttons">
        <button type="submit" class="framed strong" disabled=${Boolean(runs.running) || !store.survey.ok}>${words.plan}</button>
        ${runs.running && html`<button type="button" class="framed" onClick=${() => studio.attempt(() => runs.stop())}>${words.stop}</button>`}
      </div>
      ${!store.survey.ok && html`<p class="wrong">${store.faults[0] ? `${store.faults[0].named || store.faults[0].place}: ${store.faults[0].message}` : words.noRobots}</p>`}
    </form>`;
}
