/** The robots beside the map: the table, how robots are placed and dealt out, which columns are shown. */

import { liesAt } from "../fault_place.js";
import { PlanButton } from "../header.js";
import { html, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { COLUMNS, ROBOT_TABLE } from "./columns.js";
import { robotsOf } from "./fleet.js";
import { FewRobots, RandomFleet } from "./random.js";
import { tableText } from "./rows.js";
import { Sheet } from "./sheet.js";
/** @import { Column, Props } from "../types.js" */

const USUAL = ["name", "home", "stops", "work", "speed"]; // columns of every table
const OF_TRIPS = ["stops", "work", "laps"]; // of robots that do no jobs
const OF_JOBS = ["capacity", "battery", "charging", "start", "soc"]; // of robots that do
const MANY = 30; // robots from which on a name is looked for

/** @param {Props} props */
export function RobotPanel({ studio }) {
  const { store, editor } = studio;
  const robots = robotsOf(store.document);
  const [asked, setAsked] = useState(/** @type {string[]} */ ([])); // columns that were asked for
  const [wanted, setWanted] = useState("");
  if (!robots) {
    return html`<div class="scroll"><div class="aside"><p>${words.robotsElsewhere}</p><button type="button" class="framed" disabled=${!store.survey.ok} onClick=${() => studio.shelf.inline()}>${words.writeHere}</button></div></div>`;
  }
  /**
   * @param {Column} column
   * @returns {boolean}
   */
  const isShown = (column) =>
    USUAL.includes(column.key) ||
    asked.includes(column.key) ||
    robots.some((robot) => column.text(robot));
  const unfit = store.document.jobs ? OF_TRIPS : OF_JOBS;
  const fitting = COLUMNS.filter(
    (column) => !unfit.includes(column.key) || robots.some((robot) => column.text(robot)),
  );
  const columns = fitting.filter(isShown);
  const others = fitting.filter((column) => !isShown(column));
  const faults = store.faults.filter((fault) => liesAt(fault, "robots"));
  const isPlacing = editor.tool === editor.tools.get("robot");
  return html`
    <div class="scroll">
      <div class="buttons">
        <button type="button" class="framed" aria-pressed=${String(isPlacing)} onClick=${() => editor.take(isPlacing ? "select" : "robot")}>${words.placeRobot}</button>
        <${FewRobots} studio=${studio} />
        ${robots.length > MANY && html`<input type="search" class="find" placeholder=${words.findRobot} aria-label=${words.findRobot} value=${wanted} onInput=${({ target }) => setWanted(target.value)} />`}
      </div>
      ${faults.map(({ message }) => html`<p class="wrong" role="alert" lang="en">${message}</p>`)}
      ${!robots.length && html`<p class="hint">${words.noRobots}</p>`}
      <${Sheet} studio=${studio} table=${ROBOT_TABLE} columns=${columns} wanted=${wanted.trim().toLowerCase()} />
      <div class="buttons under">
        ${others.map((column) => html`<button type="button" class="quiet" title=${column.words(words)[1]} onClick=${() => setAsked([...asked, column.key])}>+ ${column.words(words)[0]}</button>`)}
        <button type="button" class="quiet" disabled=${!robots.length} onClick=${() => navigator.clipboard.writeText(tableText(robots, COLUMNS))}>${words.copyTable}</button>
      </div>
      <p class="hint small">${words.sheetHint}</p>
      <${RandomFleet} studio=${studio} />
    </div>
    ${robots.length > 0 && html`<div class="next"><${PlanButton} studio=${studio} text=${words.nextPlan} /></div>`}`;
}
