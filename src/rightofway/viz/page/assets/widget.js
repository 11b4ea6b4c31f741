import { createPlayer } from "./player/player.js";
import { WORKING } from "./jobs/working.js";

/** @import { PlayerHandle } from "./player/player.js" */

/**
 * Put the page of a plan into an element of a notebook, in a tree of its own that no style of the notebook reaches.
 *
 * @param {{ model: { get(name: string): string }, el: HTMLElement }} widget
 */
function render({ model, el }) {
  const shadow = el.appendChild(document.createElement("div")).attachShadow({ mode: "open" });
  shadow.innerHTML = SHELL;
  const page = shadow.querySelector(".page");
  if (!(page instanceof HTMLElement)) throw new Error("widget: the markup has no page");
  /** @type {PlayerHandle | null} */
  let player = null;
  const frame = requestAnimationFrame(() => {
    player = createPlayer(page, JSON.parse(model.get("payload")), null, WORKING); // once it has a size
  });
  return () => {
    cancelAnimationFrame(frame);
    player?.destroy(); // when the cell is taken away
  };
}

export default { render };
