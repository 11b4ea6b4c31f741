/** A field of text that keeps what is typed until it is done, however often the page is written anew. */

import { html, useState } from "./vendor/htm-preact.js";
/** @import { Handler } from "./types.js" */

/**
 * As an `input` with `onChange`; Escape gives up what is typed, and so does another `value`.
 * @param {{value: string, onChange?: Handler, onBlur?: Handler, onKeyDown?: Handler, onInput?: Handler}} props
 */
export function Field({ value, onChange, onBlur, onKeyDown, onInput, ...rest }) {
  const [typed, setTyped] = useState(/** @type {{text: string, over: unknown} | null} */ (null)); // text, and the value that it was typed over
  const shown = typed?.over === value ? typed.text : value;
  /**
   * @param {Handler | undefined} action
   * @returns {Handler}
   */
  const give = (action) => (event) => {
    action?.(event);
    setTyped(null);
  };
  return html`<input ...${rest} value=${shown}
    onInput=${(event) => {
      setTyped({ text: event.target.value, over: value });
      onInput?.(event);
    }}
    onChange=${give(onChange)} onBlur=${give(onBlur)}
    onKeyDown=${(event) => {
      if (event.key === "Escape") {
        setTyped(null);
        event.target.value = value; // at once, so that who hears the key finds it restored
      }
      onKeyDown?.(event);
    }} />`;
}
