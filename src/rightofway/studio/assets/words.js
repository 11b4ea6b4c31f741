/**
 * The texts of the studio in the language that was chosen; what the viewer says, too, is the viewer's.
 *
 * A language is a file in `words/` with the same keys, and a line here, beside the viewer's own.
 */

import { later } from "./given.js";
import * as viewer from "../../viz/page/assets/language/language.js";
import { GERMAN } from "./words/de.js";
import { ENGLISH } from "./words/en.js";

/** @type {Record<string, Partial<typeof ENGLISH>>} */
const TEXTS = { en: ENGLISH, de: GERMAN };

/** @type {[string, string][]} */
export const LANGUAGES = Object.entries(viewer.LANGUAGES).map(([code, { name }]) => [code, name]);

/**
 * Terms that the viewer has, too: they are written once.
 * @param {typeof viewer.texts} texts
 */
function shared({ markup, ...texts }) {
  const { planner, robot, copied, severities, noFindings, faults } = texts;
  const { map, time, language, keys, close, zoomIn, zoomOut, fit } = markup;
  return {
    ...{ map, time, language, keys, close, zoomIn, zoomOut, fit },
    ...{ planner, robot, copied, severities },
    faultCount: faults,
    nothingFound: noFindings,
  };
}

/** The language of the page: the one that was chosen, or the browser's, or English. */
export let language = "en";
/** @type {ReturnType<typeof shared> & typeof ENGLISH} */
export let words = later();

/**
 * @param {string} code
 * @returns {void}
 */
export function setLanguage(code) {
  viewer.setLanguage(code);
  language = viewer.language;
  words = { ...shared(viewer.texts), ...viewer.completed(TEXTS[language] ?? {}, ENGLISH) };
  localStorage.setItem("language", language);
}

setLanguage(localStorage.getItem("language") ?? navigator.language.slice(0, 2));
