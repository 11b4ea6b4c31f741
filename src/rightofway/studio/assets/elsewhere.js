/** What to do when another page has changed the same draft: nothing that was drawn is lost. */

import { html } from "./vendor/htm-preact.js";
import { words } from "./words.js";
/** @import { Props } from "./types.js" */

/** @param {Props} props */
export function Elsewhere({ studio }) {
  const { store, shelf } = studio;
  return html`
    <div class="notices" role="alert"><p class="notice">
      <span>${words.changedElsewhere}</span>
      <button type="button" onClick=${() => shelf.openDraft(store.elsewhere)}>${words.loadOther}</button>
      <button type="button" onClick=${() => store.keepCopy()}>${words.keepCopy}</button>
    </p></div>`;
}
