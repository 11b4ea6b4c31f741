import { all, isEmbedded } from "../common/dom.js";
import { chosen, filled, labelsOf } from "./templates.js";

/** @import { PhraseData } from "../payload.d.ts" */
/** @import { Template, Value, Values } from "./templates.js" */
/** @import { PageTexts, StudioTexts } from "./texts.d.ts" */

/** @typedef {{ name: string, facts: Record<string, Template>, page: object, studio?: object }} Texts A file of texts. */
/** @typedef {{ texts: Record<string, Texts> }} WithTexts The data of a page, with its texts by language. */

/**
 * Each language by its code: its own name, its templates of facts, and its labels.
 *
 * @type {Record<string, Texts>}
 */
export const LANGUAGES = {};

/** The language that is spoken, and its labels; all modules read them here at the time of writing. */
export let language = "en";
export let texts = /** @type {PageTexts} */ ({});
export let studioTexts = /** @type {StudioTexts} */ ({});

/** @type {Record<string, Template>} */
let templates = {};
let numbers = new Intl.NumberFormat("en");

/**
 * Learn what is said in each language: a page of a file brings what it says, the studio all.
 *
 * @param {Record<string, Texts>} known
 */
export function learn(known) {
  Object.assign(LANGUAGES, known);
}

/**
 * Speak a language, English where it is not known.
 *
 * @param {string} code
 * @param {HTMLElement} [top] what is written in it
 */
export function setLanguage(code, top = document.documentElement) {
  language = Object.hasOwn(LANGUAGES, code) ? code : "en";
  const { facts, page, studio = {} } = LANGUAGES[language];
  templates = facts;
  numbers = new Intl.NumberFormat(language, { useGrouping: false, maximumFractionDigits: 20 });
  texts = labelsOf(page, fill);
  studioTexts = labelsOf(studio, fill);
  top.lang = language;
}

/**
 * The template of a kind of fact in the language that is spoken; text that is no kind stays.
 *
 * @param {string} kind
 * @returns {Template}
 */
export function templateOf(kind) {
  return templates[kind] ?? kind;
}

/**
 * A template with its values in their places, in the language that is spoken.
 *
 * @param {Template} template
 * @param {Values} values
 * @returns {string}
 */
function fill(template, values) {
  return filled(chosen(template, values), (name, form) => written(values[name], form));
}

/**
 * A value as text. A form that begins with `n_` is the kind of a template of a number; the language
 * chooses it, for example by the case of a noun.
 *
 * @param {Value} value
 * @param {string} form
 * @returns {string}
 */
function written(value, form) {
  const isKind = form.startsWith("n_");
  if (Array.isArray(value)) return said(isKind ? [form, value[1]] : value);
  if (isKind) return fill(templates[form], { number: value });
  return typeof value === "number" ? numbers.format(value) : String(value ?? "");
}

/**
 * A phrase, as phrases.py hands it over: its kind and its values, or plain text.
 *
 * @param {PhraseData} phrase
 * @returns {string}
 */
export function said(phrase) {
  if (typeof phrase === "string") return phrase;
  const [kind, values] = phrase;
  return kind === "figure" ? figure(String(values.figure)) : fill(templateOf(kind), values);
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
 * Write the texts of the markup: `data-text` is what stands in an element, `data-label` its name for
 * screen readers, `data-title` and `data-hint` what it does, with the key that does it, too.
 *
 * @param {ParentNode} [within]
 */
export function writeMarkup(within = document) {
  /** @type {Record<string, string>} */
  const markup = { ...texts.markup, ...texts.driven?.markup }; // labels of a fleet that is driven
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
  if (language === "en") return text;
  const point = numbers.format(0.5)[1];
  return text.replace(/(\d)\.(?=\d)/g, `$1${point}`).replace(/(\d)%/g, "$1 %");
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
    option.translate = false;
    select.append(option);
  }
  select.value = language;
  select.addEventListener("change", () => {
    const address = new URL(location.href);
    address.searchParams.set("lang", select.value);
    location.assign(address);
  });
}
