/** A line below the map: what the tool does next; and how the plan has changed by the last change. */

import { html } from "./vendor/htm-preact.js";
import { Change } from "./runs/change.js";
import { words } from "./words.js";

export function Status({ studio }) {
  const { editor, store, complaints } = studio;
  const name = [...editor.tools].find(([, tool]) => tool === editor.tool)[0];
  const hint = editor.isOn ? editor.message || words.tools[name][1] : words.watching;
  return html`
    <div class="status">
      ${
        complaints.length
          ? html`<span class="wrong" role="alert">${complaints.map(({ named, place, message }) => html`${named || place ? html`<b>${named || place}</b>: ` : ""}${message} `)}</span>`
          : html`<span role="status">${editor.isOn && html`<b>${words.tools[name][0]}</b> `}${hint}</span>`
      }
      ${studio.isLive && studio.tab !== "plan" && html`<${Change} studio=${studio} />`}
      ${store.faults.length > 0 && html`<button type="button" class="link wrong" onClick=${() => studio.showFaults()}>${words.faultCount(store.faults.length)}</button>`}
    </div>`;
}
