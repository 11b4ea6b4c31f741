/** A line that comes and goes: what was done, and a press that takes it back. */

import { html, useEffect } from "./vendor/htm-preact.js";
import { Observable } from "../../viz/page/assets/common/observable.js";
import { words } from "./words.js";
/** @import { ScenarioStore } from "./document.js" */
/** @import { ScenarioDocument } from "./types.js" */

const SHOWN = 8000; // how long a notice stays [ms]

/** @typedef {"robots" | "obstacles" | "vertices" | "lanes"} Counted */

/** @type {Counted[]} */
const COUNTED = ["robots", "obstacles", "vertices", "lanes"];

/** Event: `notice` when one comes or goes. */
export class Notices extends Observable {
  /** @type {{text: string, label: string, action: (() => void) | null} | null} */
  current = null; // { text, label, action }

  /**
   * @param {string} text
   * @param {string} [label]
   * @param {(() => void) | null} [action]
   * @returns {void}
   */
  say(text, label = "", action = null) {
    this.current = { text, label, action };
    this.tell("notice");
  }

  end() {
    if (!this.current) return;
    this.current = null;
    this.tell("notice");
  }

  /**
   * Say what an edit has deleted, with an undo; whoever erases sees it on the map.
   * @param {ScenarioStore} store
   * @param {() => boolean | undefined} isErasing
   * @returns {void}
   */
  watch(store, isErasing) {
    store.on("edit", () => {
      const [was, is] = [countsOf(store.before), countsOf(store.document)];
      const gone = COUNTED.filter((kind) => is[kind] < was[kind]);
      if (!gone.length || isErasing()) return this.end();
      const parts = gone.map((kind) => words.counted[kind]({ count: was[kind] - is[kind] }));
      this.say(words.deleted({ what: parts.join(", ") }), words.undo, () => store.undo());
    });
    for (const event of ["undo", "open"]) store.on(event, () => this.end());
  }
}

/**
 * How many things of each kind a document has.
 * @param {ScenarioDocument | null} document
 * @returns {Record<Counted, number>}
 */
function countsOf(document) {
  const { map, robots } = document ?? {};
  return {
    robots: Array.isArray(robots) ? robots.length : 0,
    obstacles: map?.floor?.obstacles?.length ?? 0,
    vertices: Object.keys(map?.roadmap?.vertices ?? {}).length,
    lanes: map?.roadmap?.edges?.length ?? 0,
  };
}

/** @param {{notices: Notices}} props */
export function Notice({ notices }) {
  const { current } = notices;
  useEffect(() => {
    const timer = current ? setTimeout(() => notices.end(), SHOWN) : undefined;
    return () => clearTimeout(timer);
  }, [current]);
  const act = () => {
    notices.end();
    current?.action?.();
  };
  return html`
    <div class="notices" role="status">${
      current &&
      html`<p class="notice"><span>${current.text}</span>
        ${current.action && html`<button type="button" onClick=${act}>${current.label}</button>`}
        <button type="button" class="quiet" aria-label=${words.close} onClick=${() => notices.end()}>✕</button></p>`
    }</div>`;
}
