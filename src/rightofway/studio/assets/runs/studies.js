/** What else a plan can be asked: how it repeats in laps, and what becomes of it with delays. */

import { html, useEffect, useRef, useState } from "../vendor/htm-preact.js";
import { said as phraseText } from "../../../viz/page/assets/language/language.js";
import { words } from "../words.js";
import { causeOf, Causes, notation } from "./causes.js";
import { Delays } from "./delays.js";
import { Drives } from "./drives.js";
import { Laps } from "./laps.js";
import { present } from "../given.js";
/** @import { NewLaps, NewSimulation } from "../api_types.js" */
/** @import { Cause, Props, ScenarioDocument } from "../types.js" */

let isWanted = false; // whether the next report is to be brought into sight: somebody has asked for it

/** @param {Props} props */
export function Studies({ studio }) {
  const { runs, store, stage } = studio;
  const { run, choices } = runs;
  const [rule, setRule] = useState("first-come");
  const [chosen, setCauses] = useState(/** @type {Cause[] | null} */ (null)); // causes of delay; null while nobody has changed any
  const [count, setCount] = useState(1000);
  const { seed, time_limit } = studio.settings;
  const names = stage.isPlan ? stage.plan.planned.map(({ name }) => name) : [];
  const causes = chosen ?? [causeOf("exponential", names)];
  /**
   * @param {NewLaps | NewSimulation} request
   * @param {ScenarioDocument} [document]
   * @returns {Promise<void>}
   */
  const study = (request, document) => {
    isWanted = true;
    return studio.study(request, document);
  };
  const simulate = () =>
    run &&
    study({
      kind: "simulate",
      based_on: present(run.kind === "simulate" ? run.based_on : run.number),
      seed: Number(seed),
      runs: Number(count),
      delays: causes.map(notation),
    });
  return html`
    <section aria-labelledby="studies-title"><h2 id="studies-title">${words.studies}</h2>
      <details class="laps"><summary>${words.lapsTitle}</summary>
        <form class="fields" onSubmit=${(event) => {
          event.preventDefault();
          const { document, folder, name } = store;
          study(
            {
              kind: "laps",
              document,
              folder,
              source: name,
              rule,
              seed: Number(seed),
              time_limit: Number(time_limit),
            },
            document,
          );
        }}>
          <label>${words.rule}<select id="rule" aria-describedby="rule-summary" value=${rule} onChange=${({ target }) => setRule(target.value)}>${Object.keys(choices.rules).map((name) => html`<option value=${name}>${words.rules[name] ?? name}</option>`)}</select></label>
          <button type="submit" class="framed" disabled=${Boolean(runs.running) || !store.survey.ok}>${words.runLaps}</button>
        </form><p id="rule-summary" class="hint">${choices.rules[rule] && phraseText(choices.rules[rule])}</p></details>
      ${
        run?.has_plan &&
        html`<details class="delays"><summary>${words.delaysTitle}</summary>
        <${Causes} causes=${causes} robots=${names} unit=${stage.isPlan ? stage.plan.quantities.units.time : ""} set=${setCauses} />
        <form class="fields" onSubmit=${(event) => {
          event.preventDefault();
          simulate();
        }}>
          <label>${words.runCount}<input type="number" id="run-count" required min="1" max="100000" step="1" value=${count} onInput=${({ target }) => setCount(Number(target.value))} /></label>
          <button type="submit" class="framed" disabled=${Boolean(runs.running)}>${words.simulate}</button>
        </form></details>`
      }
      <${Drives} studio=${studio} />
    </section>`;
}

/**
 * What came of laps or of delays.
 * @param {Props} props
 */
export function Report({ studio }) {
  const { report, run } = studio.runs;
  const section = useRef(null);
  useEffect(() => {
    if (!isWanted || !section.current) return;
    isWanted = false;
    section.current.scrollIntoView({ block: "start" });
  }, [report]);
  if (!report || !("groups" in report || "ranks" in report)) return null;
  return html`
    <section class="study" aria-labelledby="report-title" ref=${section}><h2 id="report-title">${"groups" in report ? words.lapsResult : words.delaysResult}</h2>
      ${"groups" in report && html`<${Laps} studio=${studio} report=${report} />`}
      ${"ranks" in report && html`<${Delays} key=${run?.number} studio=${studio} report=${report} />`}
    </section>`;
}
