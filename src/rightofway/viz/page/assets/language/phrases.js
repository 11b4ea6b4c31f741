import { said, templateOf } from "./language.js";
import { namesIn } from "./templates.js";

/** @import { PhraseData, PhraseEntry } from "../payload.d.ts" */

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
    return said(this.#phrase(index));
  }

  /**
   * @param {number} index
   * @returns {PhraseData}
   */
  #phrase(index) {
    const entry = this.entries[index];
    if (typeof entry === "string") return entry;
    const [kind, ...values] = entry;
    const name = String(this.entries[kind]);
    const names = name === "figure" ? [name] : namesIn(templateOf(name));
    return [name, Object.fromEntries(names.map((each, i) => [each, this.#phrase(values[i])]))];
  }
}
