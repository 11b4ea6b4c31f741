import { element } from "../common/dom.js";
import { figure, language } from "./language.js";

/** @import { PhraseData, PhraseEntry } from "../payload.d.ts" */

/**
 * For each language, its own of each English template; those that the page has learnt.
 *
 * @type {Record<string, Record<string, string>>}
 */
const LIBRARIES = {};

/**
 * Learn templates of other languages: a page of a file brings those that it says, the studio all.
 *
 * @param {Record<string, Record<string, string>>} translations
 */
export function learn(translations) {
  for (const [code, table] of Object.entries(translations))
    LIBRARIES[code] = { ...LIBRARIES[code], ...table };
}

/**
 * A phrase of the library, as `phrases.py` hands it over: template and values, or plain English.
 *
 * @param {PhraseData} phrase
 * @returns {string}
 */
export function said(phrase) {
  if (typeof phrase === "string") return phrase;
  const [english, values] = phrase;
  const given = Object.entries(values).map(([name, value]) => [name, said(value)]);
  return filled(english, Object.fromEntries(given));
}

const VALUE = /\{(\w+)\}/g; // a place for a value in a template

/**
 * The template of this language with its values in their places.
 *
 * @param {string} english
 * @param {Record<string, string>} values
 * @returns {string}
 */
function filled(english, values) {
  const own = LIBRARIES[language]?.[english] ?? english;
  return own.replace(VALUE, (/** @type {string} */ whole, /** @type {string} */ name) =>
    name === "figure" ? figure(values[name]) : (values[name] ?? whole),
  );
}

/**
 * A phrase as an element, marked with its language so that it is read out rightly.
 *
 * @param {PhraseData} phrase
 */
export function spoken(phrase) {
  return phrase ? element("span", { lang: languageOf(phrase) }, said(phrase)) : "";
}

/** The phrases of a plan, as `PhraseBook` of phrases.py hands them over: each text once, by index. */
export class Phrases {
  /** @param {readonly PhraseEntry[]} entries */
  constructor(entries) {
    this.entries = entries;
  }

  /**
   * @param {number} index
   * @returns {string}
   */
  said(index) {
    const entry = this.entries[index];
    if (typeof entry === "string") return entry;
    const english = this.#template(entry);
    const names = new Set(Array.from(english.matchAll(VALUE), ([, name]) => name));
    const values = Array.from(names, (name, i) => [name, this.said(entry[i + 1])]);
    return filled(english, Object.fromEntries(values));
  }

  /**
   * The language in which a text is said: English where it has no translation.
   *
   * @param {number} index
   */
  languageOf(index) {
    const entry = this.entries[index];
    return languageOf(typeof entry === "string" ? entry : [this.#template(entry), {}]);
  }

  /** @param {readonly number[]} entry */
  #template([template]) {
    return String(this.entries[template]);
  }
}

/**
 * The language in which a phrase of the library is said: English where it has no translation.
 *
 * @param {PhraseData} phrase
 */
export function languageOf(phrase) {
  return typeof phrase !== "string" && LIBRARIES[language]?.[phrase[0]] ? language : "en";
}
