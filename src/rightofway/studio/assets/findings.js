/** Faults and findings of the map that is drawn, in the library's words; each lights its places. */

import { html, useState } from "./vendor/htm-preact.js";
import { said } from "../../viz/page/assets/language/language.js";
import { nameOf } from "./fault_place.js";
import { words } from "./words.js";
/** @import { SiteFinding } from "./api_types.js" */
/** @import { Studio } from "./studio.js" */
/** @import { Props } from "./types.js" */

const FIRST = 3; // findings, the worst first; the others on request

/** @param {Props} props */
export function Findings({ studio }) {
  const { store } = studio;
  const [isWhole, setWhole] = useState(false);
  const { findings } = store.survey;
  const shown = isWhole ? findings : findings.slice(0, FIRST);
  /**
   * @param {SiteFinding} finding
   * @returns {void}
   */
  const light = ({ vertices }) => studio.light(vertices);
  return html`
    <section>
      <h2 id="faults-title">${words.findings}</h2>
      ${
        store.faults.length > 0 &&
        html`<div role="alert"><ul class="findings">${store.faults.map(
          (fault) => html`
        <li><button type="button" onClick=${() => studio.goTo(fault)}><${Sign} severity="error" /><span><b>${nameOf(fault)}</b> <span lang="en">${fault.message}</span></span></button></li>`,
        )}</ul></div>`
      }
      ${
        shown.length > 0 &&
        html`<ul class="findings" onMouseLeave=${() => studio.light([])}>${shown.map(
          (finding) => html`
        <li><button type="button" onMouseEnter=${() => light(finding)} onFocus=${() => light(finding)} onClick=${() => show(studio, finding)}>
          <${Sign} severity=${finding.severity} /><span><${Phrase} phrase=${finding.phrases.fact} /><br /><small><${Phrase} phrase=${finding.phrases.remedy} /></small></span></button></li>`,
        )}</ul>`
      }
      ${findings.length > shown.length && html`<button type="button" class="link" onClick=${() => setWhole(true)}>${words.moreFindings({ count: findings.length - shown.length })}</button>`}
      ${!store.faults.length && !findings.length && html`<p class="hint">${words.nothingFound}</p>`}
    </section>`;
}

/**
 * A phrase of the library, in the language of the page or marked as English.
 * @param {{phrase: Parameters<typeof said>[0]}} props
 */
const Phrase = ({ phrase }) => html`<span>${said(phrase)}</span>`;

/** @param {{severity: SiteFinding["severity"]}} props */
const Sign = ({ severity }) =>
  html`<span class=${`severity ${severity}`} role="img" aria-label=${words.severities[severity]}>${{ error: "✕", warning: "!", note: "i" }[severity]}</span>`;

/**
 * Light the places of a finding, and bring them into sight.
 * @param {Studio} studio
 * @param {SiteFinding} finding
 * @returns {void}
 */
function show(studio, { vertices: names }) {
  const { plan, view } = studio.stage;
  const { roadmap } = plan;
  const vertices = names.map((name) => roadmap.vertexNamed(name)).filter((vertex) => vertex >= 0);
  studio.light(names);
  if (vertices.length)
    view.viewport.showAll(vertices.map((vertex) => [roadmap.x[vertex], roadmap.y[vertex]]));
}

/**
 * What the reader notes, and how large the map is; open where a file of another program was read.
 * @param {Props} props
 */
export function AboutMap({ studio }) {
  const { notes, store } = studio;
  // The reader of the file and that of the draft note the same; a phrase is equal by its text.
  const noted = new Map([...notes, ...store.survey.notes].map((note) => [said(note), note]));
  const all = [...noted.values(), ...store.survey.phrases];
  if (!all.length) return null;
  return html`<details class="notes" open=${notes.length > 0}><summary>${words.notes}</summary><ul>${all.map((note) => html`<li><${Phrase} phrase=${note} /></li>`)}</ul></details>`;
}
