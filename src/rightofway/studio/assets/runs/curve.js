/** How the flowtime of runs came down over time, towards the lower bound; while one runs, as it comes. */

import { html, useEffect, useState } from "../vendor/htm-preact.js";
import { connection } from "../connection.js";
import { figure, said as phraseText } from "../../../viz/page/assets/language/language.js";
import { Quantities } from "../../../viz/page/assets/language/quantities.js";
import { words } from "../words.js";
import { secondsOf } from "./list.js";
import { faultsOf } from "./faults.js";
import { isOver, stateOf } from "./run_store.js";
import { Term } from "./term.js";
/** @import { Studio } from "../studio.js" */
/** @import { Axes, LiveRun } from "../types.js" */

const [WIDTH, HEIGHT] = [300, 90]; // of the drawing, which is stretched to the room that there is
const ROOM = 1.12; // how much higher than the first plan the axis ends
const PERIOD = 200; // between two looks at the time while a run goes on [ms]
const DASHES = ["", "6 3", "2 3", "8 3 2 3"]; // of runs that are compared, again from the fifth on

/**
 * The curve of a run, or of several that are compared; `quantities` write the flowtimes of the run.
 * @param {{run: LiveRun, others?: LiveRun[], quantities?: Quantities | null}} props
 */
export function Curve({ run, others = [], quantities = null }) {
  const seconds = useSeconds(run);
  const drawn = [run, ...others.map((each) => inTicksOf(run, each))].filter(
    ({ points }) => points.length,
  );
  const { figures } = run;
  const bound = (figures?.lower_bound ?? run.bound) || undefined; // 0 says nothing
  const limit = run.request?.time_limit ?? 1;
  const isLive = !isOver(run);
  const last = Math.max(
    ...drawn.map((each) => endOf(each, seconds, run)),
    isLive ? seconds : 0,
    0.01,
  );
  const flowtimes = drawn.flatMap(({ points }) => points.map(([, flowtime]) => flowtime));
  const floor = Math.min(bound ?? Infinity, ...flowtimes);
  const most = floor + Math.max(Math.max(...flowtimes) - floor, floor * 0.01, 1) * ROOM;
  /** @type {Axes} */
  const place = {
    x: (at) => (at / last) * WIDTH,
    y: (flowtime) => HEIGHT - 2 - ((flowtime - floor) / (most - floor)) * (HEIGHT - 4),
  };
  const time = quantities && ((/** @type {number} */ ticks) => quantities.short(ticks));
  const isDrawn = drawn.length > 0 && (isLive || flowtimes.length > 1 || others.length > 0);
  /**
   * @param {number} i
   * @param {string} d
   */
  const line = (i, d) => html`<path class=${i ? "reached beside" : "reached"}
    stroke-dasharray=${DASHES[i % DASHES.length]} d=${d} />`;
  /**
   * @param {LiveRun} each
   * @param {number} i
   */
  const legend = (each, i) => html`<li>
    <svg viewBox="0 0 24 8" aria-hidden="true">${line(i, "M0 4H24")}</svg>${each.number}</li>`;
  const level = bound !== undefined && drawn.length > 0 && place.y(bound).toFixed(1);
  const plot = html`
    <div class="plot" role="img" aria-label=${inWords(drawn, bound, time)}>
      <svg viewBox="0 0 ${WIDTH} ${HEIGHT}" preserveAspectRatio="none" aria-hidden="true">
        ${level && html`<path class="bound" d="M0 ${level}H${WIDTH}" />`}
        ${drawn.map((each, i) => line(i, steps(each.points, place, endOf(each, seconds, run))))}
      </svg>
      ${
        drawn.length > 0 &&
        time &&
        html`<${Labels} most=${Math.max(...flowtimes)} floor=${floor} bound=${bound}
          place=${place} time=${time} last=${last} />`
      }
      ${others.length > 0 && html`<ul class="legend">${drawn.map(legend)}</ul>`}
    </div>`;
  return html`
    <figure class="curve" data-state=${run.state}>
      ${(isDrawn || isLive) && plot}
      ${
        isLive &&
        html`<progress aria-label=${words.timeUsed} max=${limit}
          value=${Math.min(seconds, limit)}></progress>`
      }
      <${Caption} run=${run} isFaulty=${faultsOf(run) > 0} bound=${bound} seconds=${seconds} />
    </figure>`;
}

/**
 * What has been reached, in figures; those of a plan with faults are worth nothing.
 * @param {{run: LiveRun, isFaulty: boolean, bound: number | undefined, seconds: number}} props
 */
function Caption({ run: { state, figures, status, round }, isFaulty, bound, seconds }) {
  const isLive = !isOver({ state });
  const said = !isFaulty && figures?.tick && new Quantities(figures.units, figures.tick);
  return html`<figcaption>
    ${isLive && html`<span role="status">${stateOf({ state })}</span> `}
    ${state === "running" && !connection.isLost && `${figure(seconds.toFixed(1))} s `}
    ${said && html`<${Term} of="flowtime" /> <b>${said.duration(figures.flowtime)}</b>, `}
    ${said && figures.lower_bound > 0 && html`<${Term} of="bound" /> ${said.duration(figures.lower_bound)}`}
    ${said && bound && figures.flowtime > bound && ` (+${phraseText(figures.text.gap)})`}
    ${isLive && round && html` <span class="hint">${phraseText(round)}</span>`}
    ${!isLive && status && html` <span class="hint">${phraseText(status)}</span>`}
  </figcaption>`;
}

/**
 * Another run with flowtimes in the ticks of a run.
 * @param {LiveRun} run
 * @param {LiveRun} other
 * @returns {LiveRun}
 */
function inTicksOf({ figures }, other) {
  const [top, bottom] = figures?.tick ?? [1, 1];
  const [otherTop, otherBottom] = other.figures?.tick ?? [1, 1];
  const scale = (otherTop * bottom) / (otherBottom * top);
  return { ...other, points: other.points.map(([at, flowtime]) => [at, flowtime * scale]) };
}

/**
 * What the axes mean: the first flowtime and the bound at the left, seconds below.
 * @param {{most: number, floor: number, bound: number | undefined, place: Axes, time: (ticks: number) => string, last: number}} props
 */
function Labels({ most, floor, bound, place, time, last }) {
  const isApart = place.y(floor) - place.y(most) > 20;
  /**
   * @param {number} flowtime
   * @returns {{top: string}}
   */
  const at = (flowtime) => ({ top: `${(100 * place.y(flowtime)) / HEIGHT}%` });
  const lowest = floor === bound ? `${time(floor)} (${words.bound})` : time(floor);
  return html`
    <span class="label" style=${at(most)}>${time(most)}</span>
    ${isApart && html`<span class="label" style=${at(floor)} title=${words.bound}>${lowest}</span>`}
    <span class="seconds first">0</span>
    <span class="seconds last">${figure(String(Number(last.toPrecision(2))))} s</span>`;
}

/**
 * The same for who does not see it.
 * @param {LiveRun[]} drawn
 * @param {number | undefined} bound
 * @param {((ticks: number) => string) | null} time
 * @returns {string}
 */
function inWords(drawn, bound, time) {
  if (!drawn.length || !time) return words.curve;
  const parts = drawn.map(({ number, points }) => {
    const [[start, first], [end, best]] = [points[0], points[points.length - 1]];
    return words.curveOf({
      number,
      first: time(first),
      start: figure(start.toFixed(1)),
      best: time(best),
      end: figure(end.toFixed(1)),
    });
  });
  return [words.curve, ...parts, bound === undefined ? "" : `${words.bound} ${time(bound)}`]
    .filter(Boolean)
    .join(". ");
}

/**
 * When a run ended, or how long it has been going on [s].
 * @param {LiveRun} run
 * @param {number} seconds
 * @param {LiveRun} current
 * @returns {number}
 */
function endOf(run, seconds, current) {
  const last = run.points.at(-1)?.[0] ?? 0;
  return Math.max(last, run === current ? seconds : secondsOf(run) || 0);
}

/**
 * How long a run has been going on, or has taken [s].
 * @param {LiveRun} run
 * @returns {number}
 */
function useSeconds(run) {
  const [, look] = useState(0);
  const isRunning = run.state === "running" && !connection.isLost;
  useEffect(() => {
    if (!isRunning) return undefined;
    const timer = setInterval(() => look((count) => count + 1), PERIOD);
    return () => clearInterval(timer);
  }, [isRunning]);
  return isRunning ? (performance.now() - (run.since ?? 0)) / 1000 : secondsOf(run) || 0;
}

/**
 * A line that goes down in steps, up to its end.
 * @param {[number, number][]} points
 * @param {Axes} place
 * @param {number} end
 * @returns {string}
 */
function steps(points, { x, y }, end) {
  const corners = points.map(
    ([at, flowtime], i) =>
      `${i ? `H${x(at).toFixed(1)}V` : `M${x(at).toFixed(1)} `}${y(flowtime).toFixed(1)}`,
  );
  return `${corners.join("")}H${x(end).toFixed(1)}`;
}

/**
 * How flowtimes of a run are written: as those of the plan that is shown, or of the map that is drawn.
 * @param {LiveRun} run
 * @param {Studio} studio
 * @returns {Quantities | null}
 */
export function quantitiesOf(run, { store, stage }) {
  if (run.figures?.tick) return new Quantities(run.figures.units, run.figures.tick);
  return (
    (stage.isPlan ? stage.plan.quantities : null) ??
    (store.site && new Quantities(store.site.units, store.site.tick))
  );
}
