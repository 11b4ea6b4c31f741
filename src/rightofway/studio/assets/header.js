/** The head of the page: the file, back and forth, save, language, plan. */

import { html } from "./vendor/htm-preact.js";
import { connection } from "./connection.js";
import { Field } from "./field.js";
import { Icon } from "./icons.js";
import { present } from "./given.js";
import { words } from "./words.js";
import { LANGUAGES, language } from "../../viz/page/assets/language/language.js";
/** @import { ScenarioStore } from "./document.js" */
/** @import { Props } from "./types.js" */
/** @import { PageEvent } from "./vendor/htm-preact.js" */

const SAVED = /\.(ya?ml|json|xlsx)$/i; // endings of files that documents are saved in

/** @param {Props} props */
export function Header({ studio }) {
  const { isStarting } = studio;
  return html`
    <header class="summary bar-of-studio">
      <h1><b>rightofway</b> <span>studio</span></h1>
      ${!isStarting && html`<${File} studio=${studio} />`}
      <div class="actions last">
        <select class="language" aria-label=${words.language} value=${language} onChange=${({ target }) => studio.speak(target.value)}>${Object.entries(LANGUAGES).map(([code, { name }]) => html`<option value=${code} translate=${false}>${name}</option>`)}</select>
        <button type="button" aria-label=${words.keys} title=${`${words.keys} (?)`} onClick=${() => studio.help(true)}><${Icon} name="help" /></button>
        ${!isStarting && html`<${PlanButton} studio=${studio} />`}
      </div>
      <${Unsaved} studio=${studio} />
    </header>`;
}

/**
 * What keeps changes from being saved, as long as it does.
 * @param {Props} props
 */
function Unsaved({ studio }) {
  const unsaved = studio.isStarting ? null : studio.store.unsaved;
  if (!connection.isLost && !unsaved) return null;
  const reason = connection.isLost
    ? words.noConnection
    : html`<span lang="en">${present(unsaved).message}</span>`;
  const text = unsaved ? words.unsaved : words.noAnswer;
  return html`<p class="unsaved" role="alert"><b>${unsaved ? `${words.notSaved}. ` : ""}${reason}</b> ${text}</p>`;
}

/** @param {ScenarioStore} store */
const stateOf = ({ isSaved, unsaved }) =>
  isSaved ? words.saved : unsaved ? words.notSaved : words.keptAsDraft;

/** @param {Props} props */
function File({ studio }) {
  const { store, shelf } = studio;
  /**
   * @param {{target: HTMLInputElement}} event
   * @returns {void}
   */
  const rename = ({ target }) => {
    const name = target.value.trim();
    target.value = name && !SAVED.test(name) ? `${name}.yaml` : name;
    store.rename(target.value);
  };
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const enter = (event) => {
    if (event.key !== "Enter" || event.ctrlKey || event.metaKey) return;
    rename(event);
    shelf.save();
  };
  /**
   * @param {string} name
   * @param {string} text
   * @param {string} key
   * @param {boolean} isOff
   * @param {() => void} action
   */
  const press = (name, text, key, isOff, action) =>
    html`<button type="button" aria-label=${text} title=${`${text} (${key})`} disabled=${isOff} onClick=${action}><${Icon} name=${name} /></button>`;
  return html`
    <div class="actions file">
      <button type="button" class="with-icon" title=${words.toFiles} onClick=${() => studio.toStart()}><${Icon} name="files" /><span>${words.files}</span></button>
      <${Field} class="file-name" aria-label=${words.fileName} title=${store.path || words.fileName} placeholder=${words.unnamed} value=${store.path} spellcheck="false" onChange=${rename} onKeyDown=${enter} />
      <button type="button" class="framed" title=${`${words.save} (${words.control}+S)`} onClick=${() => shelf.save()}>${words.save}</button>
      <span class="state" role="status" title=${store.isSaved ? "" : words.draftHint}>${stateOf(store)}</span>
    </div>
    <div class="actions">
      ${press("undo", words.undo, `${words.control}+Z`, !store.canUndo, () => store.undo())}
      ${press("redo", words.redo, `${words.control}+${words.shift}+Z`, !store.canRedo, () => store.redo())}
    </div>`;
}

/**
 * The button says why it cannot plan yet, and leads to where that is mended.
 * @param {Props & {text?: string}} props
 */
export function PlanButton({ studio, text = words.plan }) {
  const reason = studio.notReady;
  return html`<button type="button" class="framed strong" aria-disabled=${String(Boolean(reason))} title=${reason || `${words.control}+Enter`} onClick=${() => studio.plan()}>${text}</button>`;
}
