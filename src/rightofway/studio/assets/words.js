/** The texts of the studio in the language that was chosen; what the library says stays as it says it.

A language is a file in `words/` with the same keys, and a line here. */

import { GERMAN } from "./words/de.js";
import { ENGLISH } from "./words/en.js";

const TEXTS = { en: ENGLISH, de: GERMAN };

export const LANGUAGES = [
  ["en", "English"],
  ["de", "Deutsch"],
];

/** The language of the page: the one that was chosen, or the browser's, or English. */
export let language = "en";
export let words = TEXTS.en;

export function setLanguage(code) {
  language = TEXTS[code] ? code : "en";
  words = TEXTS[language];
  document.documentElement.lang = language;
  localStorage.setItem("language", language);
}

setLanguage(localStorage.getItem("language") ?? navigator.language.slice(0, 2));
