/** The head of the page: the file, back and forth, save, language, plan. */

import { html } from "./vendor/htm-preact.js";
import { Icon } from "./icons.js";
import { LANGUAGES, language, words } from "./words.js";

export function Header({ studio }) {
  const { isStarting } = studio;
  return html` <header class="summary bar-of-studio">
    <h1><b>rightofway</b> <span>studio</span></h1>
    ${!isStarting && html`<${File} studio=${studio} />`}
    <div class="actions last">
      <select
        class="language"
        aria-label=${words.language}
        value=${language}
        onChange=${(event) => studio.speak(event.target.value)}
      >
        ${LANGUAGES.map(([code, name]) => html`<option value=${code}>${name}</option>`)}
      </select>
      ${
        !isStarting &&
        html`<button
            type="button"
            aria-label=${words.keys}
            title=${`${words.keys} (?)`}
            onClick=${() => studio.help(true)}
          >
            <${Icon} name="help" />
          </button>
          <${PlanButton} studio=${studio} />`
      }
    </div>
  </header>`;
}

function File({ studio }) {
  const { store } = studio;
  const press = (name, text, key, isOff, action) =>
    html`<button
      type="button"
      aria-label=${text}
      title=${`${text} (${key})`}
      disabled=${isOff}
      onClick=${action}
    >
      <${Icon} name=${name} />
    </button>`;
  return html` <div class="actions file">
      <button
        type="button"
        class="with-icon"
        title=${words.toFiles}
        onClick=${() => studio.toStart()}
      >
        <${Icon} name="files" />${words.files}
      </button>
      <input
        class="file-name"
        aria-label=${words.fileName}
        title=${words.fileName}
        placeholder=${words.unnamed}
        value=${store.path}
        spellcheck="false"
        size=${Math.min(Math.max((store.path || words.unnamed).length + 1, 10), 32)}
        onChange=${(event) => store.rename(event.target.value.trim())}
      />
      <span
        class="state"
        role="status"
        title=${store.isSaved ? "" : words.draftHint}
        >${store.isSaved ? words.saved : words.keptAsDraft}</span
      >
      <button
        type="button"
        class="framed"
        title=${`${words.save} (Ctrl+S)`}
        onClick=${() => studio.shelf.save()}
      >
        ${words.save}
      </button>
    </div>
    <div class="actions">
      ${press("undo", words.undo, "Ctrl+Z", !store.canUndo, () => store.undo())}
      ${press("redo", words.redo, "Ctrl+Shift+Z", !store.canRedo, () => store.redo())}
    </div>`;
}

/** The button says why it cannot plan yet, and leads to where that is mended. */
export function PlanButton({ studio, text = words.plan }) {
  const reason = studio.notReady;
  return html`<button
    type="button"
    class="framed strong"
    aria-disabled=${String(Boolean(reason))}
    title=${reason || "Ctrl+Enter"}
    onClick=${() => studio.plan()}
  >
    ${text}
  </button>`;
}
