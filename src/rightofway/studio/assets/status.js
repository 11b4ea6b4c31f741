/** A line below the map: the one thing to do next; and how the plan has changed by the last change. */

import { html } from "./vendor/htm-preact.js";
import { connection } from "./connection.js";
import { nameOf } from "./fault_place.js";
import { robotsOf } from "./robots/fleet.js";
import { Change } from "./runs/change.js";
import { doNotRun } from "./runs/faults.js";
import { said } from "../../viz/page/assets/language/language.js";
import { words } from "./words.js";
import { present } from "./given.js";
/** @import { Editor } from "./draw/editor.js" */
/** @import { Props } from "./types.js" */

/** @param {Props} props */
export function Status({ studio }) {
  const { editor, store, shelf, complaints } = studio;
  return html`
    <div class="status">
      ${
        complaints.length
          ? html`<span class="wrong" role="alert">${complaints.map((fault) => html`${nameOf(fault) && html`<b>${nameOf(fault)}</b>: `}<span lang="en">${fault.message}</span> `)}${shelf.waiting && words.pictureMissing}</span>`
          : html`<span role="status">${editor.isOn ? html`<${ToolHint} editor=${editor} />` : html`<${PlanHint} studio=${studio} />`}</span>`
      }
      ${studio.isLive && studio.tab !== "plan" && html`<${Change} studio=${studio} />`}
      ${store.faults.length > 0 && html`<button type="button" class="link wrong" onClick=${() => studio.showFaults()}>${words.faultCount({ count: store.faults.length })}</button>`}
    </div>`;
}

/** @param {{editor: Editor}} props */
function ToolHint({ editor }) {
  const [name] = present([...editor.tools].find(([, tool]) => tool === editor.tool));
  return html`<b>${words.tools[name][0]}</b> ${editor.message || words.tools[name][1]}`;
}

/**
 * The longest wait of the plan, one press away from its reason.
 * @param {Props} props
 */
function PlanHint({ studio }) {
  const { runs, stage, store } = studio;
  const { running, losses } = runs;
  if (stage.isPicking) return words.pressToClose;
  if (running) return connection.isLost ? words.stateUnknown : words.planning;
  if (stage.isPlan && stage.plan.faultCount)
    return html`<b class="wrong">${doNotRun(stage.plan.faultCount)}</b>`;
  const { robot } = stage.choice ?? {};
  if (robot && robotsOf(store.document)) return words.dragPlaces({ name: robot.name });
  if (robot || !losses) return words.watching;
  const waits = losses.filter((loss) => loss.for);
  if (!waits.length) return losses.length ? words.watching : words.noWaitNext;
  const longest = waits.reduce((one, other) => (other.ticks > one.ticks ? other : one));
  return html`${said(longest.phrase)} <button type="button" class="link" onClick=${() => studio.watchLoss(longest)}>${words.seeWhy}</button>`;
}
