import { all, isEmbedded } from "../common/dom.js";
import { GERMAN } from "../texts/de.js";
import { ENGLISH } from "../texts/en.js";

/** @import { Texts } from "../texts/en.js" */

/**
 * Each language by its code: its own name, and its texts.
 *
 * @type {Record<string, { name: string, texts: Texts }>}
 */
export const LANGUAGES = {
  en: { name: "English", texts: ENGLISH },
  de: { name: "Deutsch", texts: GERMAN },
};

/** The language that is spoken, and its texts; all modules read them here at the time of writing. */
export let language = "en";
/** @type {Texts} */
export let texts = ENGLISH;

/**
 * Speak a language, English where it is not known; texts that it lacks are English.
 *
 * @param {string} code
 * @param {HTMLElement} [top] what is written in it
 */
export function setLanguage(code, top = document.documentElement) {
  language = Object.hasOwn(LANGUAGES, code) ? code : "en";
  texts = completed(LANGUAGES[language].texts, ENGLISH);
  top.lang = language;
}

/**
 * The language that the address asks for (`?lang=de`), or that of the browser.
 *
 * @param {boolean} [isPart] whether the address is that of another page
 */
export function askedLanguage(isPart = false) {
  const asked = new URLSearchParams(isPart ? "" : location.search).get("lang");
  return asked ?? navigator.language.slice(0, 2);
}

/**
 * Some of the texts of a table, and of the tables in it.
 *
 * @template T
 * @typedef {{ [K in keyof T]?: T[K] extends Record<string, unknown> ? Some<T[K]> : T[K] }} Some
 */

/**
 * Texts, with those of another language where there are none.
 *
 * @template {object} T
 * @param {Some<T>} own
 * @param {T} other
 * @returns {T}
 */
export function completed(own, other) {
  /** @type {Record<string, unknown>} */
  const known = { ...own };
  const both = Object.entries(other).map(([key, value]) => [
    key,
    typeof value === "object" && !Array.isArray(value)
      ? completed(known[key] ?? {}, value)
      : (known[key] ?? value),
  ]);
  return { ...own, ...Object.fromEntries(both) };
}

/**
 * Write the texts of the markup: `data-text` is what stands in an element, `data-label` its name for
 * screen readers, `data-title` and `data-hint` what it does, with the key that does it, too.
 *
 * @param {ParentNode} [within]
 */
export function writeMarkup(within = document) {
  /** @type {Record<string, string>} */
  const markup = texts.markup;
  /**
   * @param {string} kind
   * @param {(found: HTMLElement, text: string, key: string | undefined) => void} write
   */
  const each = (kind, write) => {
    for (const found of all(`[data-${kind}]`, HTMLElement, within))
      write(found, markup[found.dataset[kind] ?? ""], found.dataset.key);
  };
  each("text", (found, text) => (found.textContent = text));
  each("label", (found, text) => found.setAttribute("aria-label", text));
  each("title", (found, text, key) => (found.title = withKey(text, key)));
  each("hint", (found, text, key) => found.setAttribute("placeholder", withKey(text, key)));
}

/**
 * Numbers as the language writes them: "1.5 s" is "1,5 s" in German, "4.4%" is "4,4 %".
 *
 * @param {string} text with numbers as English has them
 */
export function figure(text) {
  return texts.point === "."
    ? text
    : text.replace(/(\d)\.(?=\d)/g, `$1${texts.point}`).replace(/(\d)%/g, "$1 %");
}

/**
 * "Zoom in (+)".
 *
 * @param {string} text
 * @param {string | undefined} key
 */
export function withKey(text, key) {
  return key ? `${text} (${key})` : text;
}

/**
 * Fill the choice of a language; another one opens the page anew, at the same moment.
 *
 * @param {HTMLSelectElement} select
 */
export function offerLanguages(select) {
  select.hidden = isEmbedded(select);
  for (const [code, { name }] of Object.entries(LANGUAGES)) {
    const option = new Option(code.toUpperCase(), code);
    option.title = name;
    select.append(option);
  }
  select.value = language;
  select.addEventListener("change", () => {
    const address = new URL(location.href);
    address.searchParams.set("lang", select.value);
    location.assign(address);
  });
}
