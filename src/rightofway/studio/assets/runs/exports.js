/** What the plan that is shown can be had as, and the command line that gives the same. */

import { html, useState } from "../vendor/htm-preact.js";
import { said as phraseText } from "../../../viz/page/assets/language/language.js";
import { words } from "../words.js";
import { titleOf } from "./list.js";
/** @import { Props } from "../types.js" */

/** @param {Props} props */
export function Exports({ studio }) {
  const { runs } = studio;
  const { run, command, choices } = runs;
  const [copied, setCopied] = useState("");
  const copy = () =>
    studio.attempt(async () => {
      await navigator.clipboard.writeText(command);
      setCopied(command);
    });
  if (!run?.has_plan) return null;
  /** @param {[string, string]} each */
  const link = ([form, name]) => html`<a
    class="framed"
    href=${studio.exportAddress(form)}
    title=${words.formHints[form]}
    download
    >${name}</a
  >`;
  return html` <section class="exports" aria-labelledby="export-title">
    <h2 id="export-title">${words.exportTitle({ title: `${run.number} ${titleOf(run)}` })}</h2>
    <div class="buttons">${Object.entries(words.forms).map(link)}</div>
    <details>
      <summary>${words.exportMore}</summary>
      ${command && html`<${Command} studio=${studio} copied=${copied} copy=${copy} />`}
      <h3>${words.otherPrograms}</h3>
      <ul class="formats">
        ${Object.entries(choices.formats).map(([form, summary]) => html`<li><a href=${studio.exportAddress(form)} translate=${false} download>${form}</a> <small>${phraseText(summary)}</small></li>`)}
      </ul>
    </details>
  </section>`;
}

/**
 * The command line; it reads the file as it is saved.
 * @param {Props & {copied: string, copy: () => void}} props
 */
function Command({ studio: { runs, store }, copied, copy }) {
  const { command, run } = runs;
  const isDrawn = run?.source && !(store.isSaved && runs.isOf(store.document));
  return html` <div class="command">
      <code tabindex="0" aria-label=${words.command}>${command}</code>
      <button type="button" class="framed" aria-label=${words.copyCommand} onClick=${copy}>
        <span role="status">${copied === command ? words.copied : words.copy}</span>
      </button>
    </div>
    ${isDrawn && html`<p class="hint">${words.saveFirst}</p>`}`;
}
