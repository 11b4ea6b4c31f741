/** Both movement groups of a decision: the paper's List 1 and List 2, and the sums that it compares. */

import { html, useState } from "../vendor/htm-preact.js";
import { get } from "../api.js";
import { said } from "../../../viz/page/assets/language/language.js";
import { present } from "../given.js";
import { words } from "../words.js";
/** @import { GroupRow, MovementGroups } from "../api_types.js" */
/** @import { Props } from "../types.js" */

/** @type {Record<string, string>} */
const SIGNS = { collision: "*", swap: "!", near: "~", wait: "=" };

/**
 * They are computed when they are asked for: the planner runs again.
 * @param {Props & {index: number}} props
 */
export function Groups({ studio, index }) {
  const [found, setFound] = useState(/** @type {MovementGroups | null} */ (null));
  const path = /** @type {const} */ (`/runs/${present(studio.runs.shown)}/decisions/${index + 1}`);
  /** @param {{target: {open?: boolean}}} event */
  const ask = ({ target }) =>
    target.open && !found && studio.attempt(async () => setFound(await get(path)));
  return html`<details class="groups" onToggle=${ask}>
    <summary>${words.groups}</summary>
    ${found && html`<${Lists} ...${found} />`}</details>`;
}

/** @param {MovementGroups} props */
function Lists({ heading, times, rows, sums }) {
  const marks = Object.keys(SIGNS).filter((mark) =>
    rows.some((row) => row.marks.some((each) => each === mark)),
  );
  return html`
    ${sums.map((sum) => html`<p>${said(sum)}</p>`)}
    <div class="sheet" tabindex="0" role="region" aria-label=${words.groups}><table>
      <thead><tr><th scope="col">${words.groupHeading({ heading })}</th>
        ${times.map((time) => html`<th scope="col">${time}</th>`)}</tr></thead>
      <tbody>${rows.map(
        (row) => html`<tr><th scope="row">${row.robot} ${words.groupRows[row.kind]}</th>
          ${row.places.map((place, at) => cell(place, row.marks[at]))}</tr>`,
      )}</tbody></table></div>
    <p><small>${marks.map((mark) => `${SIGNS[mark]} ${words.groupMarks[mark]}`).join(" · ")}</small></p>`;
}

/**
 * A place, with the sign of what happens there.
 * @param {string} place
 * @param {GroupRow["marks"][number]} mark
 */
const cell = (place, mark) =>
  html`<td class=${mark ?? ""} title=${mark ? words.groupMarks[mark] : ""}>${place}${mark ? SIGNS[mark] : ""}</td>`;
