/** What a plan can be had as, and the command line that gives the same. */

import { html, useState } from "../vendor/htm-preact.js";
import { address } from "../api.js";
import { words } from "../words.js";

export function Exports({ studio }) {
  const { runs, store } = studio;
  const { shown, run, command, choices } = runs;
  const [copied, setCopied] = useState("");
  const copy = () =>
    studio.attempt(async () => {
      await navigator.clipboard.writeText(command);
      setCopied(command);
    });
  if (!run?.has_plan) return null;
  return html`
    <section aria-labelledby="export-title"><h2 id="export-title">${words.exportTitle}</h2>
      <div class="buttons">
        <a class="framed" href=${address(`/runs/${shown}/page`)} target="_blank" rel="noopener">${words.page}</a>
        ${Object.entries(words.forms).map(([form, name]) => html`<a class="framed" href=${studio.exportAddress(form)} download>${name}</a>`)}
      </div>
      <details><summary>${words.otherPrograms}</summary><ul class="formats">${Object.entries(
        choices.formats,
      ).map(
        ([form, summary]) => html`
        <li><a href=${studio.exportAddress(form)} download>${form}</a> <small lang="en">${summary}</small></li>`,
      )}</ul></details>
      ${
        command &&
        html`
        <div class="command"><code tabindex="0" aria-label=${words.command}>${command}</code>
          <button type="button" class="framed" aria-label=${words.copyCommand} onClick=${copy}><span role="status">${copied === command ? words.copied : words.copy}</span></button></div>
        ${run.source && !(store.isSaved && runs.isOf(store.document)) && html`<p class="hint">${words.saveFirst}</p>`}`
      }
    </section>`;
}
