/** Two plans side by side: what each costs, and which robots are earlier or later in the one that is shown. */

import { html, useState } from "../vendor/htm-preact.js";
import { address } from "../api.js";
import { Quantities } from "../viewer/quantities.js";
import { words } from "../words.js";
import { differences } from "./change.js";
import { titleOf } from "./list.js";
import { Term } from "./term.js";

const MOST = 20;

export function Comparison({ studio }) {
  const { runs, stage } = studio;
  const { comparison } = runs;
  const [isOpen, setOpen] = useState(false);
  if (!comparison || !stage.isPlan) return null;
  const both = comparison.runs.map((number) => runs.find(number)).filter(Boolean);
  if (both.length < 2) return null;
  const [before, after] = comparison.plans;
  const quantities = new Quantities(stage.plan.quantities.units, [1, 1]);
  const duration = (time) => quantities.duration(Number(time.toFixed(6)));
  const signed = (by) => (by ? `${by < 0 ? "−" : "+"}${duration(Math.abs(by))}` : "=");
  const way = (by) => (by < 0 ? "gain" : by > 0 ? "lose" : "");
  const rows = differences(comparison);
  const times = new Map(comparison.robots.map(({ name, completion }) => [name, completion]));
  const look = (name) =>
    stage.choice.chooseRobot(stage.plan.robots.findIndex((robot) => robot.name === name));
  return html`
    <section class="comparison" aria-labelledby="comparison-title"><h2 id="comparison-title">${words.comparison}</h2>
      <table>
        <thead><tr><td></td>${both.map((run) => html`<th scope="col">${run.number} ${titleOf(run)}</th>`)}</tr></thead>
        <tbody>
          ${["flowtime", "makespan"].map(
            (key) => html`<tr><th scope="row"><${Term} of=${key} /></th>
            <td>${before.text[key]}</td><td class=${way(after.time[key] - before.time[key])}>${after.text[key]}</td></tr>`,
          )}
          <tr><th scope="row"><${Term} of="bound" /></th><td>${before.text.lower_bound}</td><td>${after.text.lower_bound}</td></tr>
          <tr><th scope="row"><${Term} of="gap" /></th><td>${before.text.gap}</td><td>${after.text.gap}</td></tr>
        </tbody>
      </table>
      ${
        rows.length > 0 &&
        html`<table>
        <thead><tr><th scope="col">${words.robot}</th>${both.map(({ number }) => html`<th scope="col">${number}</th>`)}<th scope="col">${words.difference}</th></tr></thead>
        <tbody>${rows.slice(0, MOST).map(
          ({
            name,
            by,
          }) => html`<tr><th scope="row"><button type="button" class="link" onClick=${() => look(name)}>${name}</button></th>
          ${times.get(name).map((time) => html`<td>${time === null ? "–" : duration(time)}</td>`)}<td class=${way(by)}>${Number.isNaN(by) ? "" : signed(by)}</td></tr>`,
        )}</tbody>
      </table>`
      }
      ${rows.length > MOST && html`<p class="hint">${words.moreRobots(rows.length - MOST)}</p>`}
      <div class="buttons"><button type="button" class="framed" onClick=${() => setOpen(true)}>${words.sideBySide}</button>
        <button type="button" class="framed" onClick=${() => studio.attempt(() => runs.compare(null))}>${words.endComparison}</button></div>
      ${isOpen && html`<${SideBySide} number=${comparison.runs[0]} other=${comparison.runs[1]} close=${() => setOpen(false)} />`}
    </section>`;
}

/** The viewer's own page of two plans, over all else. */
function SideBySide({ number, other, close }) {
  return html`
    <dialog class="beside" aria-label=${words.sideBySide} onClose=${close} ref=${(dialog) => dialog && !dialog.open && dialog.showModal()}>
      <form method="dialog"><button class="framed">${words.close}</button></form>
      <iframe title=${words.sideBySide} src=${address(`/runs/${number}/page?other=${other}`)}></iframe>
    </dialog>`;
}
