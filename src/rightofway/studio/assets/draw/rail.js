/** The tools, in a column beside the map. */

import { html } from "../vendor/htm-preact.js";
import { Icon } from "../icons.js";
import { TOOL_KEYS } from "../keys.js";
import { words } from "../words.js";
/** @import { Props } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */

/** @type {Record<string, number>} */
const STEPS = { ArrowDown: 1, ArrowUp: -1 };

/** @param {Props} props */
export function Rail({ studio }) {
  const { editor, stage, store } = studio;
  const fitting = store.site ? editor.fitting : [];
  /**
   * @param {string} name
   * @returns {void}
   */
  const take = (name) => {
    if (!editor.isOn) studio.showTab(name === "robot" ? "robots" : name === "job" ? "jobs" : "map");
    editor.take(name);
  };
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const move = (event) => {
    const step = STEPS[event.key];
    if (!step) return;
    event.preventDefault();
    const buttons = [...event.currentTarget.querySelectorAll("button")];
    const at = buttons.findIndex((each) => each === document.activeElement);
    buttons[(at + step + buttons.length) % buttons.length].focus();
  };
  /**
   * @param {string} name
   * @param {string} text
   * @param {string} key
   * @param {() => void} action
   */
  const press = (name, text, key, action) =>
    html`<button type="button" aria-label=${text} title=${`${text} (${key})`} onClick=${action}><${Icon} name=${name} /></button>`;
  return html`
    <div class="rail" role="toolbar" aria-label=${words.toolbar} aria-orientation="vertical" onKeyDown=${move}>
      ${fitting.map((name) => {
        const [text, hint] = words.tools[name];
        const isTaken = editor.isOn && editor.tool === editor.tools.get(name);
        return html`<button type="button" data-tool=${name} aria-label=${text} aria-pressed=${String(isTaken)} title=${`${text} (${TOOL_KEYS[name].toUpperCase()}): ${hint}`}
          onClick=${() => take(name)}><${Icon} name=${name} /><small aria-hidden="true">${words.toolNames[name] ?? text}</small></button>`;
      })}
      <span class="gap"></span>
      ${press("in", words.zoomIn, "+", () => stage.view.viewport.zoom(1.5))}
      ${press("out", words.zoomOut, "−", () => stage.view.viewport.zoom(1 / 1.5))}
      ${press("fit", words.fit, "0", () => stage.view.viewport.fit())}
    </div>`;
}
