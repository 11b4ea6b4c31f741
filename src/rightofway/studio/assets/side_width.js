/** The edge between map and side panel: dragged, or moved by keys; the browser remembers the width. */

import { html, useEffect, useRef, useState } from "./vendor/htm-preact.js";
import { words } from "./words.js";
/** @import { PageEvent } from "./vendor/htm-preact.js" */

const WIDTH = "side-width"; // the key of the width that was chosen [pixels]
const STEP = 24; // of a press of a key [pixels]
const LEAST = 300; // of the panel [pixels]; studio.css has the same limits
const MOST = 0.65; // of the window

/** The widest that the panel may be in this window [pixels]. */
const most = () => Math.max(Math.floor(innerWidth * MOST), LEAST);

/**
 * Have the panel as wide as was chosen; without a width, as wide as style.css has it.
 * @param {number | null} width
 * @returns {void}
 */
function apply(width) {
  const { style } = document.body;
  if (width === null) style.removeProperty("--side");
  else style.setProperty("--side", `${width}px`);
}

/** The width that was chosen last in this browser; null for none. */
const remembered = () => Number(localStorage.getItem(WIDTH)) || null;

export function SideEdge() {
  const edge = useRef(null);
  const [, refresh] = useState({});
  const [dragged, setDragged] = useState(false);
  const side = () => /** @type {HTMLElement} */ (edge.current.parentElement);
  useEffect(() => {
    apply(remembered());
    const seen = new ResizeObserver(() => refresh({}));
    seen.observe(side());
    return () => seen.disconnect();
  }, []);
  const now = Math.round(edge.current ? side().offsetWidth : 0);
  /**
   * @param {number | null} width
   * @returns {void}
   */
  const choose = (width) => {
    const kept = width === null ? null : Math.round(Math.min(Math.max(width, LEAST), most()));
    if (kept === null) localStorage.removeItem(WIDTH);
    else localStorage.setItem(WIDTH, String(kept));
    apply(kept);
  };
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const key = (event) => {
    /** @type {Record<string, number>} */
    const widths = {
      ArrowLeft: now + STEP,
      ArrowRight: now - STEP,
      Home: LEAST,
      End: most(),
    };
    const width = event.key === "Enter" ? null : widths[event.key];
    if (width === undefined) return;
    event.preventDefault(); // the arrows do not move time, too
    choose(width);
  };
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const press = (event) => {
    if (event.button) return;
    event.preventDefault();
    edge.current.focus();
    edge.current.setPointerCapture(event.pointerId);
    setDragged(true);
  };
  return html`<div class="side-edge" ref=${edge} role="separator" tabindex="0" aria-orientation="vertical"
    aria-label=${words.sideWidth} title=${words.sideWidthHint} aria-controls="panel"
    aria-valuemin=${LEAST} aria-valuemax=${most()} aria-valuenow=${now}
    onKeyDown=${key} onDblClick=${() => choose(null)} onPointerDown=${press}
    onPointerMove=${({ clientX }) => dragged && choose(side().getBoundingClientRect().right - clientX)}
    onLostPointerCapture=${() => setDragged(false)}></div>`;
}
