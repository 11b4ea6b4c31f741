/** What there is to press, in groups; it leaves the page usable. */

import { html, useEffect, useRef } from "./vendor/htm-preact.js";
import { TOOL_KEYS } from "./keys.js";
import { words } from "./words.js";
/** @import { Props } from "./types.js" */

/** @param {Props} props */
export function Help({ studio }) {
  const pane = useRef(null);
  useEffect(() => {
    pane.current.showPopover();
    pane.current.querySelector("button")?.focus();
  }, []);
  /**
   * @param {string} tool
   * @returns {string[]}
   */
  const toolRow = (tool) => [TOOL_KEYS[tool].toUpperCase(), words.tools[tool][0]];
  /** @type {Record<string, string[][]>} */
  const groups = studio.isStarting
    ? { all: words.keyList.all }
    : { tools: studio.editor.fitting.map(toolRow), ...words.keyList };
  return html`
    <div popover="auto" class="keys" role="dialog" ref=${pane} aria-labelledby="keys-title" onToggle=${({ newState }) => newState === "closed" && studio.help(false)}>
      <header><h2 id="keys-title">${words.keys}</h2><button type="button" class="quiet" aria-label=${words.close} onClick=${() => pane.current.hidePopover()}>✕</button></header>
      <div class="groups">${Object.entries(groups).map(
        ([group, rows]) => html`
        <section><h3>${words.keyGroups[group]}</h3><dl>${rows.map(([key, text]) => html`<div><dt><kbd>${key}</kbd></dt><dd>${text}</dd></div>`)}</dl></section>`,
      )}</div>
    </div>`;
}
