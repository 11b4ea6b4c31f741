/** The head of the page: the file, back and forth, save, language. */

import { html } from "./vendor/htm-preact.js";
import { Icon } from "./icons.js";
import { LANGUAGES, language, words } from "./words.js";

export function Header({ studio }) {
  const { store, isStarting } = studio;
  return html`
    <header class="summary bar-of-studio">
      <h1><b>rightofway</b> <span>studio</span></h1>
      ${
        !isStarting &&
        html`
        <input class="file-name" aria-label=${words.fileName} placeholder=${words.unnamed} value=${store.path} spellcheck="false" size=${Math.max(store.path.length, 20)}
          onChange=${(event) => store.rename(event.target.value.trim())} />
        <span class="state" role="status">${store.isSaved ? words.saved : words.keptAsDraft}</span>
        <div class="actions">
          <button type="button" aria-label=${words.undo} title=${`${words.undo} (Ctrl+Z)`} disabled=${!store.canUndo} onClick=${() => store.undo()}><${Icon} name="undo" /></button>
          <button type="button" aria-label=${words.redo} title=${`${words.redo} (Ctrl+Shift+Z)`} disabled=${!store.canRedo} onClick=${() => store.redo()}><${Icon} name="redo" /></button>
          <button type="button" class="framed" title=${`${words.save} (Ctrl+S)`} onClick=${() => studio.save()}>${words.save}</button>
          <button type="button" class="framed" onClick=${() => studio.toStart()}>${words.files}</button>
        </div>`
      }
      <div class="actions last">
        <select aria-label=${words.language} value=${language} onChange=${(event) => studio.speak(event.target.value)}>${LANGUAGES.map(([code, name]) => html`<option value=${code}>${name}</option>`)}</select>
        ${
          !isStarting &&
          html`<button type="button" aria-label=${words.keys} title=${`${words.keys} (?)`} onClick=${() => studio.help(true)}><${Icon} name="help" /></button>
          <button type="button" class="framed strong" title="Ctrl+Enter" disabled=${!store.survey.ok} onClick=${() => studio.plan()}>${words.plan}</button>`
        }
      </div>
    </header>`;
}
