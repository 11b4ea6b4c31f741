/** A line that comes and goes: what was done, and a press that takes it back. */

import { html, useEffect } from "./vendor/htm-preact.js";
import { Observable } from "../../viz/page/assets/observable.js";
import { words } from "./words.js";

const SHOWN = 8000; // how long a notice stays [ms]

/** Event: `notice` when one comes or goes. */
export class Notices extends Observable {
  current = null; // { text, label, action }

  say(text, label = "", action = null) {
    this.current = { text, label, action };
    this.tell("notice");
  }

  end() {
    if (!this.current) return;
    this.current = null;
    this.tell("notice");
  }

  /** Say what an edit has deleted, with an undo; whoever erases sees it on the map. */
  watch(store, isErasing) {
    store.on("edit", () => {
      const [was, is] = [countsOf(store.before), countsOf(store.document)];
      const gone = Object.keys(is).filter((kind) => is[kind] < was[kind]);
      if (!gone.length || isErasing()) return this.end();
      const parts = gone.map((kind) => words.counted[kind](was[kind] - is[kind]));
      this.say(words.deleted(parts.join(", ")), words.undo, () => store.undo());
    });
    for (const event of ["undo", "open"]) store.on(event, () => this.end());
  }
}

/** How many things of each kind a document has. */
function countsOf(document) {
  const { map = {}, robots } = document ?? {};
  return {
    robots: Array.isArray(robots) ? robots.length : 0,
    obstacles: map.floor?.obstacles?.length ?? 0,
    vertices: Object.keys(map.roadmap?.vertices ?? {}).length,
    lanes: map.roadmap?.edges?.length ?? 0,
  };
}

export function Notice({ notices }) {
  const { current } = notices;
  useEffect(() => {
    const timer = current && setTimeout(() => notices.end(), SHOWN);
    return () => clearTimeout(timer);
  }, [current]);
  const act = () => {
    const { action } = current;
    notices.end();
    action();
  };
  return html`
    <div class="notices" role="status">${
      current &&
      html`<p class="notice"><span>${current.text}</span>
        ${current.action && html`<button type="button" onClick=${act}>${current.label}</button>`}
        <button type="button" class="quiet" aria-label=${words.close} onClick=${() => notices.end()}>✕</button></p>`
    }</div>`;
}
