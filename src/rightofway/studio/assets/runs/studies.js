/** What else a plan can be asked: how it repeats in laps, and what becomes of it with delays. */

import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";

export function Studies({ studio }) {
  const { runs, store } = studio;
  const { run, choices } = runs;
  const [rule, setRule] = useState("first-come");
  const [delays, setDelays] = useState("");
  const [count, setCount] = useState(1000);
  const { seed, time_limit } = studio.settings;
  const given = delays.trim();
  const simulate = () =>
    studio.study({
      kind: "simulate",
      based_on: run.kind === "simulate" ? run.based_on : run.number,
      seed: Number(seed),
      runs: Number(count),
      delays: given ? [given] : [],
    });
  return html`
    <section aria-labelledby="studies-title"><h2 id="studies-title">${words.studies}</h2>
      <details class="laps"><summary>${words.lapsTitle}</summary>
        <form class="fields" onSubmit=${(event) => {
          event.preventDefault();
          const { document, folder, path } = store;
          studio.study(
            {
              kind: "laps",
              document,
              folder,
              source: path,
              rule,
              seed: Number(seed),
              time_limit: Number(time_limit),
            },
            document,
          );
        }}>
          <label>${words.rule}<select id="rule" aria-describedby="rule-summary" value=${rule} onChange=${({ target }) => setRule(target.value)}>${Object.keys(choices.rules).map((name) => html`<option>${name}</option>`)}</select></label>
          <button type="submit" class="framed" disabled=${Boolean(runs.running) || !store.survey.ok}>${words.runLaps}</button>
        </form><p id="rule-summary" class="hint">${choices.rules[rule]}</p></details>
      ${
        run?.has_plan &&
        html`<details class="delays"><summary>${words.delaysTitle}</summary>
        <form class="fields" onSubmit=${(event) => {
          event.preventDefault();
          simulate();
        }}>
          <label>${words.delays}<input id="delays" list="delay-examples" aria-describedby="delay-summary" spellcheck="false" value=${delays} placeholder=${choices.delays.default} onInput=${({ target }) => setDelays(target.value)} /></label>
          <label>${words.runCount}<input type="number" id="run-count" required min="1" max="100000" step="1" value=${count} onInput=${({ target }) => setCount(target.value)} /></label>
          <button type="submit" class="framed" disabled=${Boolean(runs.running)}>${words.simulate}</button>
          <datalist id="delay-examples">${Object.entries(choices.delays.examples).map(([example, means]) => html`<option value=${example}>${means}</option>`)}</datalist>
        </form><p id="delay-summary" class="hint">${choices.delays.examples[given || choices.delays.default]}</p></details>`
      }
    </section>`;
}

/** What the command says of laps or delays, and how flowtimes are spread over the runs. */
export function Report({ studio }) {
  const { report, run } = studio.runs;
  if (!report?.text) return null;
  const playWorst = () => {
    const { delays, runs, seed } = run.request;
    studio.study({
      kind: "simulate",
      based_on: run.based_on,
      delays,
      runs,
      seed,
      run: report.worst,
    });
  };
  return html`
    <section aria-labelledby="report-title"><h2 id="report-title">${words.report}</h2>
      ${report.spread && html`<${Spread} spread=${report.spread} />`}
      <pre class="report" tabindex="0" aria-labelledby="report-title">${report.text}</pre>
      ${report.worst !== undefined && report.worst !== report.played && html`<button type="button" class="framed" onClick=${playWorst}>${words.playWorst(report.worst)}</button>`}
    </section>`;
}

function Spread({ spread: { counts, planned, from, to, text } }) {
  const most = Math.max(...counts);
  const [first, last] = [Math.min(from, planned), Math.max(to, planned, from + 1)];
  const x = (ticks) => (100 * (ticks - first)) / (last - first);
  const width = Math.max((x(to) - x(from)) / counts.length, 0.5);
  return html`
    <figure class="spread"><svg viewBox="0 0 100 40" role="img" preserveAspectRatio="none" aria-label=${words.spread(text.from, text.to, text.planned)}>
      ${counts.map((count, i) => html`<rect x=${x(from) + i * width} y=${40 - (38 * count) / most} width=${width * 0.9} height=${(38 * count) / most} />`)}
      <path d="M${x(planned)} 0V40" /></svg>
      <figcaption>${words.spread(text.from, text.to, text.planned)}</figcaption></figure>`;
}
