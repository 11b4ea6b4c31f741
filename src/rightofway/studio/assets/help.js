/** All keys, in a dialog. */

import { html, useEffect, useRef } from "./vendor/htm-preact.js";
import { TOOL_KEYS } from "./keys.js";
import { words } from "./words.js";

export function Help({ studio }) {
  const dialog = useRef(null);
  useEffect(() => dialog.current.showModal(), []);
  const rows = [
    ...Object.entries(TOOL_KEYS).map(([tool, key]) => [key.toUpperCase(), words.tools[tool][0]]),
    ...words.keyList,
  ];
  return html`
    <dialog class="keys" ref=${dialog} aria-labelledby="keys-title" onClose=${() => studio.help(false)}>
      <header><h2 id="keys-title">${words.keys}</h2><button type="button" class="quiet" aria-label=${words.close} onClick=${() => dialog.current.close()}>✕</button></header>
      <dl>${rows.map(([key, text]) => html`<div><dt><kbd>${key}</kbd></dt><dd>${text}</dd></div>`)}</dl>
    </dialog>`;
}
