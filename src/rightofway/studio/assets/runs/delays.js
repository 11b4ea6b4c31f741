/** What becomes of a plan with delays: how late over all runs, any of them to replay, who suffers, where. */

import { html, useEffect, useState } from "../vendor/htm-preact.js";
import { fraction, Quantities } from "../../../viz/page/assets/language/quantities.js";
import { words } from "../words.js";
/** @import { Plan } from "../../../viz/page/assets/plan/plan.js" */
/** @import { Robot } from "../../../viz/page/assets/plan/robot.js" */
/** @import { DelaysReport, SpreadData } from "../api_types.js" */
/** @import { Props } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */

const MOST = 6; // robots, and places in a run, that are listed
const LEAST = 0.05; // share of a lateness from which on the robot behind it is named
const [WIDTH, HEIGHT] = [300, 84];

/** @param {Props & {report: DelaysReport}} props */
export function Delays({ studio, report }) {
  const { runs } = studio;
  const { rank, run, flowtime } = report.ranks;
  const begin = Math.max(run.indexOf(report.played), 0);
  const [at, setAt] = useState(begin); // index into the ranks
  const quantities = new Quantities(report.units, fraction(report.tick));
  /**
   * @param {number} value
   * @returns {string}
   */
  const ticks = (value) => quantities.duration(value.toFixed(1));
  /**
   * @param {number} value
   * @returns {string}
   */
  const short = (value) => quantities.short(value.toFixed(1));
  const middle = run.length > 1 ? (run.length - 1) >> 1 : 0;
  /**
   * @param {number} index
   * @returns {void}
   */
  const play = (index) => {
    setAt(index);
    studio.attempt(() => runs.replay(run[index]));
  };
  /**
   * @param {number} index
   * @returns {string}
   */
  const says = (index) => {
    const found = flowtime[index];
    const share = Math.floor((100 * rank[index]) / report.runs);
    return found === null
      ? words.runNeverEnds({ run: run[index] })
      : words.runSays({ run: run[index], flowtime: ticks(found), share });
  };
  const choice = (/** @type {string} */ name, /** @type {number} */ index) =>
    html`<button type="button" class="framed" aria-pressed=${String(at === index)} onClick=${() => play(index)}>${name}</button>`;
  const { median, p90, max } = report.lateness.flowtime;
  const never = report.runs - (report.spread?.counts.reduce((sum, count) => sum + count, 0) ?? 0);
  return html`
    ${
      report.spread &&
      html`<p class="late">${words.lateInSum({ median: late(ticks, median), most: late(short, p90), worst: late(short, max) })}</p>
      <${Spread} spread=${report.spread} ticks=${ticks} short=${short} flowtime=${flowtime} at=${at} play=${play} />`
    }
    ${never > 0 && html`<p class="wrong">${words.runsNeverEnd({ count: never, all: report.runs })}</p>`}
    <label class="ranks" for="rank"><span>${words.runByRank}</span>
      <input type="range" id="rank" min="0" max=${run.length - 1} step="1" value=${at} aria-valuetext=${says(at)} style=${`--over: ${run.length > 1 ? (100 * at) / (run.length - 1) : 0}%`}
        onInput=${({ target }) => setAt(Number(target.value))} onChange=${({ target }) => play(Number(target.value))} /></label>
    <p role="status">${says(at)}</p>
    <div class="buttons">
      ${choice(words.best, 0)}${choice(words.typical, middle)}${choice(words.worst, run.length - 1)}
    </div>
    <p class="hint">${words.byClock({ share: (100 * report.by_clock.share_of_runs).toFixed(0), collisions: report.collisions })}</p>
    <${HeldUp} studio=${studio} />
    <${Sufferers} studio=${studio} report=${report} ticks=${ticks} short=${short} />`;
}

/**
 * A lateness, or that there is none.
 * @param {(value: number) => string} said
 * @param {number} value
 * @returns {string}
 */
const late = (said, value) => (value > 0 ? said(value) : words.inTime);

/**
 * How many runs have which flowtime; the plan's own is a line, the run that plays is marked; a press plays a run.
 * @param {{spread: SpreadData, ticks: (value: number) => string, short: (value: number) => string, flowtime: (number | null)[], at: number, play: (index: number) => void}} props
 */
function Spread({ spread: { counts, planned, from, to }, ticks, short, flowtime, at, play }) {
  const most = Math.max(...counts);
  const span = Math.max(to - from, 1); // a plan that is further away than that stands at the border
  const [first, last] = [
    Math.max(Math.min(from, planned), from - span),
    Math.min(Math.max(to, planned, from + 1), to + span),
  ];
  /**
   * @param {number} value
   * @returns {number}
   */
  const x = (value) => 4 + ((WIDTH - 8) * (value - first)) / (last - first);
  const width = Math.max((x(to) - x(from)) / counts.length, 2);
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const press = ({ clientX, currentTarget }) => {
    const { left, width: wide } = currentTarget.getBoundingClientRect();
    const wanted = (clientX - left) / wide;
    /**
     * @param {number | null} found
     * @returns {number}
     */
    const far = (found) => (found === null ? Infinity : Math.abs(x(found) / WIDTH - wanted));
    play(
      flowtime.reduce(
        (/** @type {number} */ near, found, index) =>
          far(found) < far(flowtime[near]) ? index : near,
        0,
      ),
    );
  };
  const chosen = flowtime[at];
  const isInside = from <= planned && planned <= to;
  const ends = [Math.min(from, planned), ...(isInside ? [planned] : []), Math.max(to, planned)];
  return html`
    <figure class="spread"><svg viewBox="0 0 ${WIDTH} ${HEIGHT}" role="img" preserveAspectRatio="none" onClick=${press} aria-label=${words.spread({ from: ticks(from), to: ticks(to), planned: ticks(planned) })}>
      ${counts.map((count, i) => {
        const height = count ? Math.max(((HEIGHT - 6) * count) / most, 1.5) : 0;
        const isChosen =
          chosen !== null &&
          i ===
            Math.min(
              Math.floor(((chosen - from) / (to - from || 1)) * counts.length),
              counts.length - 1,
            );
        return html`<rect class=${isChosen ? "chosen" : ""} x=${x(from) + i * width} y=${HEIGHT - height} width=${width * 0.88} height=${height} />`;
      })}
      <path class=${planned < first || planned > last ? "far" : ""} d="M${x(Math.min(Math.max(planned, first), last))} 0V${HEIGHT}" /></svg>
      <figcaption>${ends.map((end) => (end === planned ? html`<span class="planned">${words.plannedSum({ time: short(end) })}</span>` : html`<span>${short(end)}</span>`))}</figcaption></figure>`;
}

/**
 * Where robots were held up in the run that plays, beyond the plan; each is a press away.
 * @param {Props} props
 */
function HeldUp({ studio }) {
  const { stage } = studio;
  const { plan } = stage;
  const found = stage.isPlan ? heldUp(plan).slice(0, MOST) : [];
  useEffect(() => {
    if (!stage.isPlan) return undefined;
    const { choice } = stage;
    choice.light(found.map(({ loss }) => loss.vertex));
    return () => choice.light([]);
  }, [plan]);
  /**
   * @param {{robot: Robot, loss: Robot["losses"][number]}} each
   * @returns {void}
   */
  const watch = ({ robot, loss }) => {
    stage.clock.pause();
    stage.clock.seek(loss.tick);
    stage.choice.chooseRobot(robot.index);
  };
  return html`
    <h3>${words.heldUp}</h3>
    ${
      found.length
        ? html`<ul class="held-up">${found.map(
            (each) => html`<li><button type="button" class="watch" onClick=${() => watch(each)}>
          <i class="dot" style=${`background: ${each.robot.colour}`}></i><span><b>${each.robot.name}</b> ${stage.plan.phrases.said(each.loss.text)}</span></button></li>`,
          )}</ul>`
        : html`<p class="hint">${words.nobodyHeldUp}</p>`
    }`;
}

/**
 * The waits of the run that plays that the plan did not have, the longest first.
 * @param {Plan} plan
 * @returns {{robot: Robot, loss: Robot["losses"][number], by: number}[]}
 */
function heldUp(plan) {
  return (plan.happened ?? [])
    .flatMap((robot) => robot.losses.map((loss) => ({ robot, loss, by: robot.unplanned(loss) })))
    .filter(({ by }) => by > 0)
    .sort((one, other) => other.by - one.by);
}

/**
 * The robots that are latest on average, and how much of that is waiting for others.
 * @param {Props & {report: DelaysReport, ticks: (value: number) => string, short: (value: number) => string}} props
 */
function Sufferers({ studio, report, ticks, short }) {
  const [isWhole, setWhole] = useState(false);
  const { stage } = studio;
  const latest = report.lateness.robots
    .map((robot, index) => ({ ...robot, index }))
    .filter(({ mean }) => mean > 0)
    .sort((one, other) => other.mean - one.mean);
  const robots = isWhole ? latest : latest.slice(0, MOST);
  if (!robots.length) return null;
  const most = robots[0].mean;
  return html`
    <h3>${words.suffersMost}</h3>
    <ul class="sufferers">${robots.map(({ name, index, mean, own, p95, waiting }) => {
      const [behind] = Object.entries(waiting).sort(([, one], [, other]) => other - one);
      const itself = Math.min(Math.max(own, 0), mean);
      return html`<li><button type="button" class="watch" onClick=${() => stage.choice.chooseRobot(index)}>
        <i class="dot" style=${`background: ${stage.plan?.robots?.[index]?.colour}`}></i><b>${name}</b><span class="bar" aria-hidden="true"><i style=${`width: ${(100 * itself) / most}%`}></i><i class="others" style=${`width: ${(100 * (mean - itself)) / most}%`}></i></span>
        <span>${words.laterBy({ time: ticks(mean) })}</span>
        <small>${words.suffers({ p95: short(p95), own: short(itself), behind: behind && behind[1] >= LEAST * mean ? behind[0] : "", waits: behind ? short(behind[1]) : "" })}</small></button></li>`;
    })}</ul>
    ${latest.length > robots.length && html`<button type="button" class="quiet" onClick=${() => setWhole(true)}>${words.moreRows({ count: latest.length - robots.length })}</button>`}`;
}
