import { language } from "./language.js";
import { GERMAN_OF } from "./texts/library_de.js";

/** For each language, its own of each English template, or a function of the values. */
const LIBRARIES = { de: GERMAN_OF };

/** A phrase of the library, as `phrases.py` hands it over: template and values, or plain English. */
export function said(phrase) {
  if (typeof phrase === "string") return phrase;
  const [english, values] = phrase;
  const own = LIBRARIES[language]?.[english] ?? english;
  const given = Object.fromEntries(
    Object.entries(values).map(([name, value]) => [name, said(value)]),
  );
  if (typeof own === "function") return own(given);
  return own.replace(/\{(\w+)\}/g, (all, name) => given[name] ?? all);
}

/** The language in which a phrase of the library is said: English where it has no translation. */
export function languageOf(phrase) {
  return typeof phrase !== "string" && LIBRARIES[language]?.[phrase[0]] ? language : "en";
}
