/** What a plan costs beside another one: both sums, who gains and who loses. */

import { html } from "../vendor/htm-preact.js";
import { Quantities } from "../viewer/quantities.js";
import { several } from "../viewer/words.js";
import { words } from "../words.js";

/** Robots whose completion time differs: name and difference [time unit], the largest gain first. */
export function differences({ robots }) {
  return robots
    .map(({ name, completion: [before, after] }) => ({
      name,
      by: before === null || after === null ? NaN : after - before,
    }))
    .filter(({ by }) => Math.abs(by) > 1e-9)
    .sort((one, other) => one.by - other.by);
}

export function Change({ studio }) {
  const { runs, stage } = studio;
  const { comparison } = runs;
  if (!comparison) return null;
  const [before, after] = comparison.plans.map(({ text }) => text.flowtime);
  const found = differences(comparison);
  const { units } = stage.plan.quantities;
  const { duration } = {
    duration: (time) => new Quantities(units, [1, 1]).duration(Math.abs(time)),
  };
  const names = (those) =>
    several(those.map(({ name, by }) => `${name} (${duration(Number(by.toFixed(6)))})`));
  const [gain, lose] = [found.filter(({ by }) => by < 0), found.filter(({ by }) => by > 0)];
  return html`<p class="change" role="status">${words.flowtime} <b>${after}</b>${before === after ? ` ${words.asBefore}` : `, ${words.wasBefore(before)}`}
    ${gain.length > 0 && html`<span class="gain"> ${words.gains(names(gain))}</span>`}
    ${lose.length > 0 && html`<span class="lose"> ${words.losesTime(names(lose))}</span>`}</p>`;
}
