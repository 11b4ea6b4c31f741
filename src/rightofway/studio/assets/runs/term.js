/** What a plan costs, in plain words; the field's own term and its meaning are in the tooltip. */

import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";

/** @param {{of: "flowtime" | "makespan" | "bound" | "gap"}} props */
export const Term = ({ of }) => html`<span title=${words.terms[of]}>${words[of]}</span>`;
