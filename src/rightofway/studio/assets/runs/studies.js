/** What else a plan can be asked: how it repeats in laps, and what becomes of it with delays. */

import { html, useEffect, useRef, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { causeOf, Causes, notation } from "./causes.js";
import { Delays } from "./delays.js";
import { Laps } from "./laps.js";

let isWanted = false; // whether the next report is to be brought into sight: somebody has asked for it

export function Studies({ studio }) {
  const { runs, store, stage } = studio;
  const { run, choices } = runs;
  const [rule, setRule] = useState("first-come");
  const [chosen, setCauses] = useState(null); // causes of delay; null while nobody has changed any
  const [count, setCount] = useState(1000);
  const { seed, time_limit } = studio.settings;
  const names = stage.isPlan ? stage.plan.planned.map(({ name }) => name) : [];
  const causes = chosen ?? [causeOf("exponential", names)];
  const study = (request, document) => {
    isWanted = true;
    return studio.study(request, document);
  };
  const simulate = () =>
    study({
      kind: "simulate",
      based_on: run.kind === "simulate" ? run.based_on : run.number,
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
        </form><p id="rule-summary" class="hint" lang="en">${choices.rules[rule]}</p></details>
      ${
        run?.has_plan &&
        html`<details class="delays"><summary>${words.delaysTitle}</summary>
        <${Causes} causes=${causes} robots=${names} unit=${stage.isPlan ? stage.plan.quantities.units.time : ""} set=${setCauses} />
        <form class="fields" onSubmit=${(event) => {
          event.preventDefault();
          simulate();
        }}>
          <label>${words.runCount}<input type="number" id="run-count" required min="1" max="100000" step="1" value=${count} onInput=${({ target }) => setCount(target.value)} /></label>
          <button type="submit" class="framed" disabled=${Boolean(runs.running)}>${words.simulate}</button>
        </form></details>`
      }
    </section>`;
}

/** What came of laps or of delays. */
export function Report({ studio }) {
  const { report, run } = studio.runs;
  const section = useRef(null);
  useEffect(() => {
    if (!isWanted || !section.current) return;
    isWanted = false;
    section.current.scrollIntoView({ block: "start" });
  }, [report]);
  if (!report?.text) return null;
  return html`
    <section class="study" aria-labelledby="report-title" ref=${section}><h2 id="report-title">${report.groups ? words.lapsResult : words.delaysResult}</h2>
      ${report.groups && html`<${Laps} studio=${studio} report=${report} />`}
      ${report.ranks && html`<${Delays} key=${run.number} studio=${studio} report=${report} />`}
    </section>`;
}
