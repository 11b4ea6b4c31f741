/** Why robots wait: each wait in a sentence, the decisions behind it, and what if the other went first. */

import { html } from "../vendor/htm-preact.js";
import { said } from "../../../viz/page/assets/language/language.js";
import { words } from "../words.js";
import { Groups } from "./groups.js";
/** @import { Robot } from "../../../viz/page/assets/plan/robot.js" */
/** @import { LossData } from "../api_types.js" */
/** @import { Stage } from "../stage.js" */
/** @import { Props } from "../types.js" */

const MOST = 30;
const WITH_GROUPS = new Set(["paper", "two-level", "auto"]); // planners that decide by movement groups

/** @param {Props} props */
export function Waits({ studio }) {
  const { runs, stage } = studio;
  const chosen = stage.isPlan ? stage.choice.robot?.name : undefined;
  const found = (runs.losses ?? [])
    .filter(({ robot }) => chosen === undefined || robot === chosen)
    .toSorted((one, other) => one.tick - other.tick);
  const hasGroups = stage.isPlan && WITH_GROUPS.has(stage.plan.planner?.name ?? "");
  if (chosen !== undefined && !found.length) return null; // the card says that it loses no time
  return html`
    <section aria-labelledby="waits-title"><h2 id="waits-title">${chosen ? words.waitsOf({ name: chosen }) : words.waits}</h2>
      ${
        found.length
          ? html`<ol class="waits">${found.slice(0, MOST).map(
              (loss) => html`<li>
        <button type="button" class="watch" onClick=${() => studio.watchLoss(loss)}>${said(loss.phrase)}</button>
        ${loss.because.map(
          ({ phrase, index }) => html`<p><small>${said(phrase)}</small></p>
          ${hasGroups && html`<${Groups} key=${`${runs.shown} ${index}`} studio=${studio} index=${index} />`}`,
        )}
        ${loss.for && !isOnlyChoice(stage, loss) && html`<button type="button" class="framed" onClick=${() => studio.flip(loss)}>${words.letGoFirst({ name: loss.robot })}</button>`}
      </li>`,
            )}</ol>`
          : html`<p class="hint">${words.noWaits}</p>`
      }
      ${found.length > MOST && html`<p class="hint">${words.moreWaits({ count: found.length - MOST })}</p>`}
    </section>`;
}

/**
 * What the viewer knows of a loss that the server lists.
 * @param {Stage} stage
 * @param {Pick<LossData, "robot" | "tick" | "vertex">} loss
 * @returns {Robot["losses"][number] | undefined}
 */
export function lossOn({ plan }, { robot, tick, vertex }) {
  return plan.planned
    ?.find(({ name }) => name === robot)
    ?.losses.find((each) => each.tick === tick && plan.roadmap.name(each.vertex) === vertex);
}

/**
 * Whether the other robot could not have gone first: then that is not offered.
 * @param {Stage} stage
 * @param {LossData} loss
 * @returns {boolean}
 */
const isOnlyChoice = ({ plan }, { because, for: first }) =>
  because.some(({ index }) => {
    const { level, robots } = plan.decisions[index];
    return level === "only" && robots.some((robot) => plan.robots[robot].name === first);
  });
