/** A plan that simulated robots drive by right of way, and its live page. */

import { html, useEffect, useState } from "../vendor/htm-preact.js";
import { get, post } from "../api.js";
import { connection } from "../connection.js";
import { words } from "../words.js";
import { language } from "../../../viz/page/assets/language/language.js";
import { Causes, notation } from "./causes.js";
import { showModal } from "./comparison.js";
/** @import { Refusal } from "../api.js" */
/** @import { DriveData } from "../api_types.js" */
/** @import { Cause, Props } from "../types.js" */

const EVERY = 1000; // so often it is asked whether robots still drive [ms]

/**
 * A drive of which the studio has nothing to say: it ended with the studio that it was of.
 * @param {DriveData} drive
 * @param {Refusal} refusal
 * @returns {DriveData}
 */
const without = (drive, { status }) => (status === 404 ? { ...drive, state: "failed" } : drive);

/** @param {Props} props */
export function Drives({ studio }) {
  const { runs, stage } = studio;
  const { run } = runs;
  const [causes, setCauses] = useState(/** @type {Cause[]} */ ([]));
  const [pace, setPace] = useState(1);
  const [drive, setDrive] = useState(/** @type {DriveData | null} */ (null));
  const [isOpen, setOpen] = useState(false);
  const isDriving = drive?.state === "driving";
  useEffect(() => {
    if (!isDriving) return undefined;
    const look = async () => {
      if (connection.isLost) return;
      setDrive(await get(`/drives/${drive.number}`).catch((refusal) => without(drive, refusal)));
    };
    const timer = setInterval(look, EVERY);
    return () => clearInterval(timer);
  }, [drive?.number, isDriving]);
  if (!run?.has_plan) return null;
  const names = stage.isPlan ? stage.plan.planned.map(({ name }) => name) : [];
  const begin = () =>
    studio.attempt(async () => {
      const request = {
        delays: causes.map(notation),
        seed: Number(studio.settings.seed),
        time_scale: Number(pace),
      };
      setDrive(await post(`/runs/${run.number}/drives`, request));
      setOpen(true);
    });
  const stop = () =>
    drive && studio.attempt(async () => setDrive(await post(`/drives/${drive.number}/stop`)));
  return html`<details class="drives"><summary>${words.driveTitle}</summary>
    <${Causes} least=${0} causes=${causes} robots=${names} unit=${stage.isPlan ? stage.plan.quantities.units.time : ""} set=${setCauses} />
    <form class="fields" onSubmit=${(event) => {
      event.preventDefault();
      begin();
    }}>
      <label title=${words.paceHint}>${words.pace}<input type="number" id="pace" required min="0.1" max="1000" step="any" value=${pace} onInput=${({ target }) => setPace(Number(target.value))} /></label>
      <button type="submit" class="framed" disabled=${isDriving}>${words.drive}</button>
    </form>
    ${
      drive &&
      html`<p class="drive" role="status">${isDriving && connection.isLost ? words.stateUnknown : words.driveStates[drive.state]({ run: drive.run })}</p>
      ${drive.error && html`<p class="trouble" lang="en">${drive.error.message}</p>`}
      <div class="buttons">
        <button type="button" class="framed" onClick=${() => setOpen(true)}>${words.watchDrive}</button>
        ${isDriving && html`<button type="button" class="framed" onClick=${stop}>${words.stopDrive}</button>`}
      </div>`
    }
    ${
      drive &&
      isOpen &&
      html`<dialog class="beside" aria-label=${words.watchDrive} onClose=${() => setOpen(false)} ref=${showModal}>
      <form method="dialog">${isDriving && html`<button type="button" class="framed" onClick=${stop}>${words.stopDrive}</button>`} <button class="framed">${words.close}</button></form>
      <iframe title=${words.watchDrive} src=${`${drive.page}?lang=${language}`}></iframe>
    </dialog>`
    }
  </details>`;
}
