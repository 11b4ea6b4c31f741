/** A plan beside the one before it: what was changed, both sums, who gains and who loses. */

import { html, useEffect } from "../vendor/htm-preact.js";
import { Quantities } from "../../../viz/page/assets/language/quantities.js";
import { changeInWords } from "../../../viz/page/assets/figures/compared_table.js";
import { words } from "../words.js";
import { doNotRun, faultsOf } from "./faults.js";
import { Term } from "./term.js";
/** @import { RobotCompletions } from "../api_types.js" */
/** @import { Props } from "../types.js" */

/**
 * Robots whose completion time differs: name and difference [time unit], the largest gain first.
 * @param {{robots: RobotCompletions[]}} compared
 * @returns {{name: string, by: number}[]}
 */
function differences({ robots }) {
  return robots
    .map(({ name, completion: [before, after] }) => ({
      name,
      by: before === null || after === null ? NaN : after - before,
    }))
    .filter(({ by }) => Math.abs(by) > 1e-9)
    .sort((one, other) => one.by - other.by);
}

const MOST = 4; // robots that are named

/** @param {Props} props */
export function Change({ studio }) {
  const { runs, stage } = studio;
  const { comparison } = runs;
  useEffect(() => {
    if (!studio.seeksChange || comparison?.runs[1] !== runs.shown || !runs.losses) return;
    studio.seeksChange = false;
    studio.reveal(".change");
  }, [comparison, runs.losses]); // the waits stand above it
  if (!comparison || !stage.plan) return null;
  const [before, after] = comparison.plans.map(({ flowtime, units, tick }) =>
    new Quantities(units, tick).duration(flowtime),
  );
  const { changes } = comparison.comparison.plans[1];
  const { start, robots } = runs.run?.figures ?? {};
  const { waits, goes_first } = runs.run?.request ?? {};
  const found = differences(comparison);
  return html`
    <section class="change" role="status" aria-busy=${String(comparison.runs[1] !== runs.shown)}>
      ${runs.run?.kind === "flip" && html`<p class="edit">${words.goesBefore({ waits, goes_first })}</p>`}
      ${changes.map((change) => html`<p class="edit">${changeInWords(change)}</p>`)}
      ${faultsOf(runs.run) > 0 && html`<p class="wrong">${doNotRun(faultsOf(runs.run))}</p>`}
      <p><${Term} of="flowtime" /> <b>${after}</b>${before === after ? ` ${words.asBefore}` : `, ${words.wasBefore({ text: before })}`}</p>
      <${Robots} studio=${studio} className="gain" label=${words.gains} found=${found.filter(({ by }) => by < 0)} />
      <${Robots} studio=${studio} className="lose" label=${words.losesTime} found=${found.filter(({ by }) => by > 0).reverse()} />
      ${start && html`<p class="hint">${words.keptRoutes({ kept: start.routes, robots: robots ?? 0 })}</p>`}
      ${studio.former.ways.length > 0 && html`<p class="hint">${words.formerRoute}</p>`}
      ${runs.run?.request.start === comparison.runs[0] && html`<button type="button" class="framed" onClick=${() => studio.putBack(comparison.runs[0])}>${words.putBack}</button>`}
    </section>`;
}

/**
 * Robots that gain or lose, those with the largest difference first; a press shows one on the map.
 * @param {Props & {className: string, label: string, found: {name: string, by: number}[]}} props
 */
function Robots({ studio: { stage }, className, label, found }) {
  if (!found.length) return null;
  const quantities = new Quantities(stage.plan.quantities.units, [1, 1]);
  /**
   * @param {string} name
   * @returns {void}
   */
  const look = (name) =>
    stage.choice.chooseRobot(stage.plan.robots.findIndex((robot) => robot.name === name));
  /**
   * @param {number} by
   * @returns {string}
   */
  const time = (by) => quantities.duration(Number(Math.abs(by).toFixed(6)));
  /** @param {{name: string, by: number}} robot */
  const row = ({ name, by }) =>
    html`<button type="button" class="link" onClick=${() => look(name)}>${name}</button> ${time(by)}`;
  const rest = found.length - MOST;
  return html`<p class=${className}>${label} ${found.slice(0, MOST).map((robot, i) => [i ? ", " : "", row(robot)])}${rest > 0 && `, ${words.andMore({ count: rest })}`}</p>`;
}
