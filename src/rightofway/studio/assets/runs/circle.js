/** A critical circle: what each robot on it does until the next one can go on, with its share of the period. */

import { html, useState } from "../vendor/htm-preact.js";
import { said } from "../../../viz/page/assets/language/language.js";
import { fraction } from "../../../viz/page/assets/language/quantities.js";
import { words } from "../words.js";
import { number } from "./parameter_curve.js";
/** @import { Robot } from "../../../viz/page/assets/plan/robot.js" */
/** @import { CirclePiece } from "../api_types.js" */
/** @import { Fraction } from "../../../viz/page/assets/language/quantities.js" */
/** @import { Props } from "../types.js" */

const MOST = 10; // steps that are listed at first

/** @param {Props & {pieces: CirclePiece[], short: (value: Fraction) => string, isNow: boolean}} props */
export function Circle({ studio, pieces, short, isNow }) {
  const [isWhole, setWhole] = useState(false);
  const { stage } = studio;
  /**
   * @param {string} name
   * @returns {Robot | undefined}
   */
  const robotOf = (name) => stage.plan?.robots?.find((robot) => robot.name === name);
  const steps = pieces.map((piece) => ({ ...piece, time: fraction(piece.for) }));
  const shown = isWhole ? steps : steps.slice(0, MOST);
  return html`
    ${
      isNow &&
      html`<div class="circle-bar" aria-hidden="true">${steps.map(
        ({ robot, kind, time }) =>
          html`<i class=${kind.replaceAll(" ", "-")} style=${`flex-grow: ${number(time)}; background: ${robotOf(robot)?.colour}`}></i>`,
      )}</div>`
    }
    <ol class="circle">${shown.map(
      (
        piece,
      ) => html`<li><button type="button" class="watch" onClick=${() => studio.light(piece.vertices)}>
        <i class="dot" style=${`background: ${robotOf(piece.robot)?.colour}`}></i>
        <span>${said(piece.text)}</span>
        ${isNow && piece.time[0] > 0n && html`<small>${short(piece.time)}</small>`}</button></li>`,
    )}</ol>
    ${steps.length > shown.length && html`<button type="button" class="quiet" onClick=${() => setWhole(true)}>${words.moreSteps({ count: steps.length - shown.length })}</button>`}`;
}
