/** The texts of the studio in the language that was chosen; what the viewer says, too, is the viewer's. */

import { later } from "./given.js";
import * as viewer from "../../viz/page/assets/language/language.js";

/**
 * Terms that the viewer has, too: they are written once.
 * @param {typeof viewer.texts} texts
 */
function shared({ markup, ...texts }) {
  const { planner, robot, copied, severities, noFindings, faults } = texts;
  const { map, time, language, keys, close, zoomIn, zoomOut, fit, shift } = markup;
  return {
    ...{ map, time, language, keys, close, zoomIn, zoomOut, fit, shift },
    ...{ planner, robot, copied, severities },
    faultCount: faults,
    nothingFound: noFindings,
  };
}

/** @type {ReturnType<typeof shared> & typeof viewer.studioTexts} */
export let words = later();

/**
 * Speak a language, and remember it.
 * @param {string} code
 * @returns {void}
 */
export function setLanguage(code) {
  viewer.setLanguage(code);
  words = { ...shared(viewer.texts), ...viewer.studioTexts };
  localStorage.setItem("language", viewer.language);
}

viewer.learn(await (await fetch("/texts.json")).json());
setLanguage(localStorage.getItem("language") ?? navigator.language.slice(0, 2));
