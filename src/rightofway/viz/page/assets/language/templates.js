/** Templates: text with values in braces, as `texts/en.json` has them; the twin of languages.py. */

/** @import { PhraseData } from "../payload.d.ts" */

/** @typedef {string | Readonly<Record<string, string>>} Template Text, or one for each of some values. */
/** @typedef {PhraseData | number | boolean | undefined} Value A phrase, a number, or that by which a text is chosen. */
/** @typedef {Readonly<Record<string, Value>>} Values */
/** @typedef {(name: string, form: string) => string} Write Writes a value by its name, in the form of its template. */

const VALUE = /\{(\w+)(?::(\w+))?\}/g;

/**
 * The text of a template for the value that it names by `by`, which is the `number` of things else.
 *
 * @param {Template} template
 * @param {Values} values
 */
export function chosen(template, values) {
  if (typeof template === "string") return template;
  return template[String(values[template.by ?? "number"] ?? "")] ?? template.other;
}

/**
 * A text with its values in their places.
 *
 * @param {string} text
 * @param {Write} write
 */
export function filled(text, write) {
  return text.replace(
    VALUE,
    (_, /** @type {string} */ name, /** @type {string | undefined} */ form) =>
      write(name, form ?? ""),
  );
}

/**
 * The names of the values of a template, in the order in which `PhraseBook` hands them over.
 *
 * @param {Template} template
 */
export function namesIn(template) {
  const isTable = typeof template !== "string";
  const texts = isTable ? Object.values(template).join() : template;
  const names = Array.from(texts.matchAll(VALUE), ([, name]) => name);
  return [...new Set(isTable ? [template.by ?? "number", ...names] : names)].sort();
}

/**
 * Labels as modules read them: text, or a function of the values of a template.
 *
 * @param {any} node a tree of templates
 * @param {(template: Template, values: Values) => string} fill
 * @returns {any}
 */
export function labelsOf(node, fill) {
  if (isTemplate(node))
    return hasValues(node) ? (/** @type {Values} */ values) => fill(node, values) : node;
  if (Array.isArray(node))
    return node.some(hasValues)
      ? (/** @type {Values} */ values) => node.map((each) => fill(each, values))
      : node;
  return Object.fromEntries(Object.entries(node).map(([key, each]) => [key, labelsOf(each, fill)]));
}

/**
 * @param {unknown} node
 * @returns {node is Template}
 */
function isTemplate(node) {
  return typeof node === "string" || (!Array.isArray(node) && Object.hasOwn(Object(node), "other"));
}

/** @param {unknown} node */
function hasValues(node) {
  return isTemplate(node) && namesIn(node).length > 0;
}
