/** Which planner with which options, how long, and the buttons that begin and end a run. */

import { html } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import { words } from "../words.js";
import {
  figure,
  language,
  said as phraseText,
} from "../../../viz/page/assets/language/language.js";
/** @import { PlannerEntry, PlannerOption } from "../api_types.js" */
/** @import { Props, SearchForm } from "../types.js" */

/** @param {Props} props */
export function Settings({ studio }) {
  const { settings, runs, store } = studio;
  const { planners } = runs;
  const chosen = settings.planner || planners.default;
  const spec = planners.planners.find(({ name }) => name === chosen);
  /**
   * @param {Partial<SearchForm>} change
   * @returns {void}
   */
  const set = (change) => {
    Object.assign(settings, change);
    studio.tell("change");
  };
  return html`
    <form class="settings" onSubmit=${(event) => {
      event.preventDefault();
      studio.plan();
    }}>
      <details open=${!runs.payload && !runs.running}><summary>${words.planSummary({ planner: chosen, seconds: settings.time_limit })}</summary>
      <div class="fields">
        <label>${words.planner}<select id="planner" aria-describedby="planner-summary" value=${chosen} onChange=${({ target }) => set({ planner: target.value, options: {} })}>
          ${planners.planners.map(({ name, summary }) => html`<option value=${name} title=${phraseText(summary)} translate=${false}>${name}</option>`)}</select></label>
        <label>${words.limit}<input type="number" id="limit" required min="0.1" max=${studio.about.limits?.seconds} step="any" value=${settings.time_limit} onInput=${({ target }) => set({ time_limit: target.value })} /></label>
        <label>${words.seed}<input type="number" id="seed" required min="0" max="4294967295" step="1" value=${settings.seed} onInput=${({ target }) => set({ seed: target.value })} /></label>
      </div>
      <p id="planner-summary" class="hint">${spec && phraseText(spec.summary)}</p>
      ${spec && spec.options.length > 0 && html`<details><summary>${words.options}</summary><${Options} spec=${spec} given=${settings.options} set=${(/** @type {Record<string, string | number>} */ options) => set({ options })} /></details>`}
      </details>
      <label class="check"><input type="checkbox" checked=${studio.isLive} onChange=${({
        target,
      }) => {
        studio.isLive = target.checked;
        studio.tell("change");
      }} /> ${words.live}</label>
      <div class="buttons">
        <button type="submit" class="framed strong" disabled=${Boolean(runs.running) || !store.survey.ok}>${words.plan}</button>
        <button type="button" class="framed" disabled=${!runs.running} onClick=${() => studio.attempt(() => runs.stop())}>${words.stop}</button>
        <button type="button" class="framed" disabled=${!runs.running} onClick=${() => studio.attempt(() => runs.cancel())}>${words.cancel}</button>
      </div>
      ${!store.survey.ok && html`<p class="wrong" lang=${store.faults[0] ? "en" : language}>${store.faults[0] ? `${store.faults[0].named || store.faults[0].place}: ${store.faults[0].message}` : words.noRobots}</p>`}
    </form>`;
}

/**
 * The options of a planner as its registry describes them; a field that is left empty has the default.
 * @param {{spec: PlannerEntry, given: Record<string, string | number>, set: (options: Record<string, string | number>) => void}} props
 */
function Options({ spec, given, set }) {
  /**
   * @param {string} name
   * @param {string} value
   * @returns {void}
   */
  const write = (name, value) => {
    const { [name]: before, ...rest } = given;
    set(value === "" ? rest : { ...rest, [name]: value });
  };
  /** @param {PlannerOption} option */
  const field = ({ name, choices, whole, default: usual }) =>
    choices.length
      ? html`<select aria-describedby=${`option-${name}`} value=${given[name] ?? usual} onChange=${({ target }) => write(name, target.value)}>${choices.map((each) => html`<option value=${each} translate=${false}>${each}</option>`)}</select>`
      : html`<${Field} aria-describedby=${`option-${name}`} value=${given[name] ?? ""} placeholder=${figure(String(usual ?? ""))} inputmode=${whole ? "numeric" : "text"} onChange=${({ target }) => write(name, target.value.trim())} />`;
  return html`<div class="options">${spec.options.map(
    (option) => html`
    <label><span translate=${false}>${option.name}</span>${field(option)}</label><p id=${`option-${option.name}`} class="hint">${phraseText(option.summary)}</p>`,
  )}</div>`;
}
