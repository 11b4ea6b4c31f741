/** What can be done at a place of the map: by the second button, a long press or the menu key. */

import { html, useEffect, useRef } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { ClosureFields, closableAt, textOfClosure } from "./closures.js";
import { freeVertexName, isNetwork, splitLane } from "./network.js";
import { present } from "../given.js";
/** @import { Props } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */

const MARGIN = 8; // pixels from the border of the page

/** @type {Record<string, number>} */
const STEPS = { ArrowDown: 1, ArrowUp: -1 };

/**
 * What can be reached with arrow keys.
 * @param {HTMLElement} menu
 * @returns {HTMLElement[]}
 */
const focusable = (menu) => [...menu.querySelectorAll(/** @type {"button"} */ ("input, button"))];

/** @param {Props} props */
export function ContextMenu({ studio }) {
  const { editor, clipboard, store } = studio;
  const { selection, hits, stage } = editor;
  const menu = present(editor.menu);
  const list = useRef(null);
  useEffect(() => {
    const { current } = list;
    const { width, height } = current.getBoundingClientRect();
    current.style.left = `${Math.max(Math.min(menu.x, innerWidth - width - MARGIN), MARGIN)}px`;
    current.style.top = `${Math.max(Math.min(menu.y, innerHeight - height - MARGIN), MARGIN)}px`;
    focusable(current)[0].focus();
    /**
     * @param {PointerEvent} event
     * @returns {unknown}
     */
    const leave = (event) =>
      current.contains(/** @type {Node} */ (event.target)) || editor.closeMenu();
    document.addEventListener("pointerdown", leave, true);
    return () => document.removeEventListener("pointerdown", leave, true);
  }, [menu]);
  /**
   * @param {string} text
   * @param {() => unknown} action
   * @param {string} [key]
   */
  const item = (text, action, key = "") =>
    html`<button type="button" role="menuitem" onClick=${() => {
      editor.closeMenu();
      action();
    }}><span>${text}</span> <kbd hidden=${!key}>${key}</kbd></button>`;
  const place = closableAt(editor, menu.point);
  const scale = stage.view.viewport.scale;
  const lane = isNetwork(store.document) ? hits.laneAt(menu.point, scale) : null;
  const vertex = editor.vertexAt(menu.point);
  const isLane = Boolean(place?.edge && lane);
  const split = () => {
    const name = freeVertexName(store.document);
    const { index, share } = present(lane);
    store.change((document) => splitLane(document, index, share, name));
    editor.select([{ kind: "vertex", id: name }]);
  };
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const keys = (event) => {
    const step = STEPS[event.key];
    if (event.key === "Escape") editor.closeMenu();
    else if (step) {
      const items = focusable(list.current);
      items[(items.indexOf(event.target) + step + items.length) % items.length].focus();
    } else return;
    event.preventDefault();
    event.stopPropagation();
  };
  const title = place ? textOfClosure(place) : words.map;
  const select = editor.tools.get("select");
  return html`
    <div class="menu" role="menu" aria-label=${title} ref=${list} onKeyDown=${keys}>
      <p class="hint">${title}</p>
      ${place && html`<${ClosureFields} studio=${studio} place=${place} />`}
      ${isLane && item(words.splitLane, split)}
      ${vertex >= 0 && Array.isArray(store.document.robots) && item(words.robotFromHere, () => editor.startRobot(vertex))}
      ${
        selection.size > 0 &&
        html`<hr />${item(words.copy, () => clipboard.copy(), `${words.control}+C`)}
        ${item(words.cut, () => clipboard.cut(), `${words.control}+X`)}
        ${item(words.duplicate, () => select.duplicate(), `${words.control}+D`)}`
      }
      ${item(words.paste, () => clipboard.paste(menu.point), `${words.control}+V`)}
      ${
        selection.size > 0 &&
        html`${item(words.turn, () => select.turn("turn"))}
        ${item(words.remove, () => editor.remove(), words.deleteKey)}`
      }
    </div>`;
}
