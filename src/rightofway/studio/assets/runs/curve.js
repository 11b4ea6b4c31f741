/** How the flowtime of a run came down over time, above the lower bound. */

import { html } from "../vendor/htm-preact.js";
import { words } from "../words.js";

const [WIDTH, HEIGHT] = [300, 90];

export function Curve({ run }) {
  const { points, figures } = run;
  if (!figures) return null;
  const bound = figures.lower_bound;
  const most = Math.max(...points.map(([, flowtime]) => flowtime), bound + 1);
  const last = Math.max(points.at(-1)?.[0] ?? 0, 0.001);
  const x = (seconds) => (seconds / last) * WIDTH;
  const y = (flowtime) => HEIGHT - ((flowtime - bound) / (most - bound)) * (HEIGHT - 8) - 2;
  const steps = points.map(([seconds, flowtime], i) =>
    i ? `H${x(seconds).toFixed(1)}V${y(flowtime).toFixed(1)}` : `M${x(seconds).toFixed(1)} ${y(flowtime).toFixed(1)}`);
  return html`
    <figure class="curve">
      ${points.length > 1 && html`<svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label=${words.curve} preserveAspectRatio="none">
        <path class="bound" d="M0 ${HEIGHT - 2}H${WIDTH}" /><path d=${steps.join("")} />
      </svg>`}
      <figcaption>${words.flowtime} <b>${figures.text.flowtime}</b>, ${words.bound} ${figures.text.lower_bound}</figcaption>
    </figure>`;
}
