/** How the flowtime of a run came down over time, above the lower bound; while it runs, as it comes. */

import { html, useEffect, useState } from "../vendor/htm-preact.js";
import { words } from "../words.js";
import { isOver } from "./run_store.js";
import { Term } from "./term.js";

const [WIDTH, HEIGHT] = [300, 90];
const PERIOD = 200; // between two looks at the time while a run goes on [ms]

export function Curve({ run }) {
  const seconds = useSeconds(run);
  const { points, figures } = run;
  const bound = figures?.lower_bound ?? run.bound;
  const limit = run.request?.time_limit ?? 1;
  return html`
    <figure class="curve" data-state=${run.state}>
      ${
        (points.length > 0 || !isOver(run)) &&
        html`<svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" aria-label=${words.curve} preserveAspectRatio="none">
        ${bound !== undefined && html`<path class="bound" d="M0 ${HEIGHT - 2}H${WIDTH}" />`}
        ${bound !== undefined && points.length > 0 && html`<path class="reached" d=${steps(points, bound, seconds)} />`}
      </svg>
      <progress aria-label=${words.timeUsed} max=${limit} value=${isOver(run) ? limit : Math.min(seconds, limit)}></progress>`
      }
      <figcaption>
        ${!isOver(run) && html`<span role="status">${words.states[run.state]}</span>${run.state === "running" && ` ${seconds.toFixed(1)} s`} `}
        ${figures && html`<${Term} of="flowtime" /> <b>${figures.text.flowtime}</b>, <${Term} of="bound" /> ${figures.text.lower_bound}${figures.flowtime > bound && ` (+${figures.text.gap})`}`}
        ${isOver(run) && run.status && html` <span class="hint" lang="en">${run.status}</span>`}
      </figcaption>
    </figure>`;
}

/** How long a run has been going on, or has taken [s]. */
function useSeconds(run) {
  const [, look] = useState(0);
  const isRunning = run.state === "running";
  useEffect(() => {
    if (!isRunning) return undefined;
    const timer = setInterval(() => look((count) => count + 1), PERIOD);
    return () => clearInterval(timer);
  }, [isRunning]);
  if (isRunning) return (performance.now() - run.since) / 1000;
  return run.started && run.ended ? run.ended - run.started : 0;
}

/** A line that goes down in steps, up to now. */
function steps(points, bound, seconds) {
  const most = Math.max(...points.map(([, flowtime]) => flowtime), bound + 1);
  const last = Math.max(points.at(-1)[0], seconds, 0.001);
  const x = (at) => ((at / last) * WIDTH).toFixed(1);
  const y = (flowtime) =>
    (HEIGHT - ((flowtime - bound) / (most - bound)) * (HEIGHT - 8) - 2).toFixed(1);
  const corners = points.map(
    ([at, flowtime], i) => `${i ? `H${x(at)}V` : `M${x(at)} `}${y(flowtime)}`,
  );
  return `${corners.join("")}H${x(last)}`;
}
