/** What a plan can be had as, and the command line that gives the same. */

import { html, useState } from "../vendor/htm-preact.js";
import { address, get } from "../api.js";
import { words } from "../words.js";

export function Exports({ studio }) {
  const { runs } = studio;
  const [command, setCommand] = useState({ of: 0, text: "" });
  const { shown } = runs;
  const show = () => studio.attempt(async () => setCommand({ of: shown, text: (await get(`/runs/${shown}/command`)).command }));
  return html`
    <section aria-labelledby="export-title"><h2 id="export-title">${words.exportTitle}</h2>
      <div class="buttons">
        <a class="framed" href=${address(`/runs/${shown}/page${runs.beside && runs.beside !== shown ? `?other=${runs.beside}` : ""}`)} target="_blank" rel="noopener">${words.page}</a>
        ${Object.entries(words.forms).map(([form, name]) => html`<a class="framed" href=${studio.exportAddress(form)} download>${name}</a>`)}
        <button type="button" class="framed" onClick=${show}>${words.command}</button>
      </div>
      ${command.of === shown && command.text && html`<pre class="command" tabindex="0">${command.text}</pre>`}
    </section>`;
}
