import { readFileSync } from "node:fs";
import { learn, setLanguage } from "../../src/rightofway/viz/page/assets/language/language.js";

/** @import { Texts } from "../../src/rightofway/viz/page/assets/language/language.js" */

/** @param {string} code @returns {Texts} */
function textsOf(code) {
  const file = new URL(`../../src/rightofway/texts/${code}.json`, import.meta.url);
  return JSON.parse(readFileSync(file, "utf8"));
}

learn({ en: textsOf("en"), de: textsOf("de") });

/**
 * Speak a language where there is no page.
 *
 * @param {string} code
 */
export function speak(code) {
  setLanguage(code, /** @type {HTMLElement} */ ({}));
}

speak("en");
