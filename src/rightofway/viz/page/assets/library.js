import { language } from "./language.js";
import { GERMAN_OF } from "./texts/library_de.js";

/** @import { PhraseData } from "./payload.d.ts" */

/**
 * For each language, its own of each English template, or a function of the values.
 *
 * @type {Record<string, Record<string, string | ((values: Record<string, string>) => string)>>}
 */
const LIBRARIES = { de: GERMAN_OF };

/**
 * A phrase of the library, as `phrases.py` hands it over: template and values, or plain English.
 *
 * @param {PhraseData} phrase
 * @returns {string}
 */
export function said(phrase) {
  if (typeof phrase === "string") return phrase;
  const [english, values] = phrase;
  const own = LIBRARIES[language]?.[english] ?? english;
  const given = Object.fromEntries(
    Object.entries(values).map(([name, value]) => [name, said(value)]),
  );
  if (typeof own === "function") return own(given);
  return own.replace(
    /\{(\w+)\}/g,
    (/** @type {string} */ whole, /** @type {string} */ name) => given[name] ?? whole,
  );
}

/**
 * The language in which a phrase of the library is said: English where it has no translation.
 *
 * @param {PhraseData} phrase
 */
export function languageOf(phrase) {
  return typeof phrase !== "string" && LIBRARIES[language]?.[phrase[0]] ? language : "en";
}
