/** Plans beside each other, by the viewer's own table and list: figures, who gains, who loses. */

import { html, useEffect, useRef, useState } from "../vendor/htm-preact.js";
import { address } from "../api.js";
import { Compared } from "../../../viz/page/assets/figures/compared.js";
import { ComparedRobots } from "../../../viz/page/assets/figures/compared_robots.js";
import { ComparedTable } from "../../../viz/page/assets/figures/compared_table.js";
import { words } from "../words.js";
import { language } from "../../../viz/page/assets/language/language.js";
/** @import { Robot } from "../../../viz/page/assets/plan/robot.js" */
/** @import { Studio } from "../studio.js" */
/** @import { Props } from "../types.js" */

/** @param {Props} props */
export function Comparison({ studio }) {
  const { runs } = studio;
  const found = runs.compared ?? runs.comparison;
  const [isOpen, setOpen] = useState(false);
  const [figures, robots] = [useRef(null), useRef(null)];
  useEffect(() => {
    if (!found) return;
    const compared = new Compared(found.comparison, found.titles);
    new ComparedTable(compared, figures.current);
    new ComparedRobots(compared, robots.current, {
      choose: (name) => look(studio, name),
      colourOf: (name) => robotNamed(studio, name)?.colour ?? "transparent",
    });
  }, [found]);
  if (!found) return null;
  const [first, ...others] = found.runs;
  const beside = others.map((number) => `other=${number}`).join("&");
  /**
   * @param {string} kind
   * @returns {string}
   */
  const page = (kind) => address(`/runs/${first}/${kind}?${beside}`);
  const rows = found.robots.length;
  const counts = { "--plans": found.runs.length, "--rows": rows };
  return html`
    <section class="comparison" style=${counts} aria-labelledby="comparison-title">
      <h2 id="comparison-title">${words.comparison}</h2>
      <div class="compared-wide" ref=${figures}></div>
      <div class="buttons"><button type="button" class="framed strong" onClick=${() => setOpen(true)}>${words.sideBySide}</button>
        <a class="framed" href=${page("export/html")} download>${words.forms.html}</a>
        <button type="button" class="framed" onClick=${() => studio.attempt(() => runs.endComparison())}>${words.endComparison}</button></div>
      <div class="compared-wide robots-compared" ref=${robots}></div>
      ${isOpen && html`<${SideBySide} page=${page("page")} close=${() => setOpen(false)} />`}
    </section>`;
}

/**
 * @param {Studio} studio
 * @param {string} name
 * @returns {Robot | undefined}
 */
const robotNamed = ({ stage }, name) => stage.plan?.robots.find((robot) => robot.name === name);

/**
 * @param {Studio} studio
 * @param {string} name
 * @returns {void}
 */
function look(studio, name) {
  const robot = robotNamed(studio, name);
  if (robot && studio.stage.isPlan) studio.stage.choice.chooseRobot(robot.index);
}

/**
 * @param {HTMLDialogElement | null} dialog
 * @returns {void}
 */
export function showModal(dialog) {
  if (dialog && !dialog.open) dialog.showModal();
}

/**
 * The viewer's own page of the plans, over all else.
 * @param {{page: string, close: () => void}} props
 */
function SideBySide({ page, close }) {
  return html`
    <dialog class="beside" aria-label=${words.sideBySide} onClose=${close} ref=${showModal}>
      <form method="dialog"><button class="framed">${words.close}</button></form>
      <iframe title=${words.sideBySide} src=${`${page}&lang=${language}`}></iframe>
    </dialog>`;
}
