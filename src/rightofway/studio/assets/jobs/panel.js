/** The jobs beside the map: the table, how jobs are drawn, batteries. */

import { liesAt } from "../fault_place.js";
import { PlanButton } from "../header.js";
import { robotsOf } from "../robots/fleet.js";
import { tableText } from "../robots/rows.js";
import { Sheet } from "../robots/sheet.js";
import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { Batteries } from "./batteries.js";
import { JOB_COLUMNS, JOB_TABLE } from "./columns.js";
import { jobsOf, withJobs } from "./jobs.js";
/** @import { Column, Props } from "../types.js" */

const USUAL = ["name", "pickup", "dropoff", "due"]; // columns of every table

/** @param {Props} props */
export function JobPanel({ studio }) {
  const { store, editor } = studio;
  const { document } = store;
  const jobs = jobsOf(document);
  const [asked, setAsked] = useState(/** @type {string[]} */ ([])); // columns that were asked for
  if ((document.jobs && !jobs) || !robotsOf(document))
    return html`<div class="scroll"><div class="aside"><p>${words.jobsElsewhere}</p><button type="button" class="framed" disabled=${!store.survey.ok} onClick=${() => studio.shelf.inline()}>${words.writeHere}</button></div></div>`;
  if (!jobs)
    return html`<div class="scroll"><div class="aside"><p>${words.noJobsYet}</p><button type="button" class="framed strong" onClick=${() => store.change(withJobs)}>${words.beginJobs}</button></div></div>`;
  /**
   * @param {Column} column
   * @returns {boolean}
   */
  const isShown = (column) =>
    USUAL.includes(column.key) ||
    asked.includes(column.key) ||
    jobs.some((job) => column.text(job));
  const columns = JOB_COLUMNS.filter(isShown);
  const others = JOB_COLUMNS.filter((column) => !isShown(column));
  const faults = store.faults.filter((fault) => liesAt(fault, "jobs"));
  const isDrawing = editor.tool === editor.tools.get("job");
  return html`
    <div class="scroll">
      <div class="buttons">
        <button type="button" class="framed" aria-pressed=${String(isDrawing)} onClick=${() => editor.take(isDrawing ? "select" : "job")}>${words.drawJob}</button>
      </div>
      ${faults.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}
      ${!jobs.length && html`<p class="hint">${words.noJobs}</p>`}
      <${Sheet} studio=${studio} table=${JOB_TABLE} columns=${columns} wanted="" />
      <div class="buttons under">
        ${others.map((column) => html`<button type="button" class="quiet" title=${column.words(words)[1]} onClick=${() => setAsked([...asked, column.key])}>+ ${column.words(words)[0]}</button>`)}
        <button type="button" class="quiet" disabled=${!jobs.length} onClick=${() => navigator.clipboard.writeText(tableText(jobs, JOB_COLUMNS))}>${words.copyTable}</button>
      </div>
      <p class="hint small">${words.pasteJobs({ example: "name, pickup, dropoff, due, …" })}</p>
      <${Batteries} studio=${studio} />
    </div>
    ${jobs.length > 0 && html`<div class="next"><${PlanButton} studio=${studio} text=${words.nextPlan} /></div>`}`;
}
