/** What a fleet that repeats its trips achieves, what sets its pace, and sliders for what would change that. */

import { html, useEffect, useRef, useState } from "../vendor/htm-preact.js";
import { post } from "../api.js";
import { changeRobots, robotsOf, stopsOf, withStops, writtenIn } from "../robots/fleet.js";
import { figure, said as phraseText } from "../../../viz/page/assets/language/language.js";
import { decimal, fraction, Quantities } from "../../../viz/page/assets/language/quantities.js";
import { several } from "../../../viz/page/assets/language/words.js";
import { words } from "../words.js";
import { Circle } from "./circle.js";
import { withHeadway } from "./rules.js";
import {
  compared,
  minus,
  number,
  over,
  ParameterCurve,
  plus,
  times,
  written,
} from "./parameter_curve.js";
import { later, present } from "../given.js";
/** @import { LapGroup, LapsAnswer, LapsReport, UnitNames } from "../api_types.js" */
/** @import { Studio } from "../studio.js" */
/** @import { Fraction } from "../../../viz/page/assets/language/quantities.js" */
/** @import { Moved, OtherOrder, Props, RobotData } from "../types.js" */

/** @type {Record<string, Fraction>} */
const SECONDS = { ms: [1n, 1000n], s: [1n, 1n], min: [60n, 1n], h: [3600n, 1n] };
/** @type {Fraction} */
const HOUR = [3600n, 1n];
const MOST_ROBOTS = 4; // of the critical circle that have sliders without being chosen
const MOST_ROWS = 8; // robots in the table at first
const PAUSE = 350; // between two steps of a key after which a value counts as given [ms]

/**
 * @param {LapGroup[]} groups
 * @returns {LapGroup | null}
 */
function largest(groups) {
  const most = Math.max(...groups.map(({ robots }) => robots.length));
  return groups.find(({ robots }) => robots.length === most) ?? null;
}

/** Times and speeds in the units of the scenario; the report has exact times, not ticks. */
class Said {
  /** @param {UnitNames} units */
  constructor(units) {
    this.units = units;
    this.quantities = new Quantities(units, [1, 1]);
  }
  /**
   * @param {Fraction} value
   * @returns {string}
   */
  time(value) {
    return this.quantities.duration(asText(value));
  }
  /**
   * Where there is little room: a bare number where no unit of time is known.
   * @param {Fraction} value
   * @returns {string}
   */
  short(value) {
    return this.quantities.short(asText(value));
  }
  /**
   * @param {Fraction} value
   * @returns {string}
   */
  speed(value) {
    return this.quantities.speed(asText(value));
  }
  /**
   * @param {{kind: string}} curve
   * @param {Fraction} value
   * @returns {string}
   */
  value({ kind }, value) {
    return kind === "speed" ? this.speed(value) : this.time(value);
  }
  /**
   * Laps in an hour, or in 3600 time units.
   * @param {number} laps
   * @param {Fraction} period
   * @returns {string}
   */
  throughput(laps, period) {
    const seconds = times(period, SECONDS[this.units.time ?? ""] ?? [1n, 1n]);
    return figure(decimal(over(times([BigInt(laps), 1n], HOUR), seconds), 1));
  }
}

/**
 * @param {Fraction} value
 * @returns {string}
 */
const asText = ([top, bottom]) => `${top}/${bottom}`;
/**
 * @param {LapGroup} group
 * @returns {number}
 */
const lapsIn = ({ laps_per_period: laps }) =>
  Object.values(laps).reduce((sum, count) => sum + count, 0);

/**
 * The group of the robot that is chosen, or the largest one that repeats; and the largest that does not.
 * @param {Props & {report: LapsReport}} props
 */
export function Laps({ studio, report }) {
  const { groups } = report;
  const chosen = studio.stage.isPlan ? studio.stage.choice.robot?.name : undefined;
  const own = groups.find(({ robots }) => chosen !== undefined && robots.includes(chosen));
  const group = own ?? largest(groups.filter(({ period }) => period !== null));
  const open = own?.period === null ? own : largest(groups.filter(({ period }) => period === null));
  const isAlone = groups.length === 1;
  return html`
    ${open && html`<p class="open-group">${words.openGroup({ names: several(open.robots), count: open.robots.length, why: phraseText(open.reason) })}</p>`}
    ${group && !isAlone && html`<p class="hint">${words.groupOf({ names: several(group.robots), count: groups.length })}</p>`}
    ${group && group.period !== null && html`<${Pace} key=${`${studio.runs.shown} ${group.robots[0]}`} studio=${studio} report=${report} group=${group} chosen=${chosen} />`}`;
}

/**
 * The period, now and with one value changed; the circle that sets it; and the sliders.
 * @param {Props & {report: LapsReport, group: LapGroup, chosen: string | undefined}} props
 */
function Pace({ studio, report, group, chosen }) {
  const [moved, setMoved] = useState(/** @type {Moved | null} */ (null));
  const [other, setOther] = useState(/** @type {OtherOrder | null} */ (null)); // laps in a new order
  const { runs } = studio;
  const said = new Said(report.units);
  const curves = useMade(group, () =>
    (group.curves?.curves ?? []).map((each) => new ParameterCurve(each)),
  );
  const at = fraction(present(group.period));
  const value = moved && moved.curve.at(moved.position);
  const period = moved && value ? moved.curve.period(value) : at;
  const piece = moved && value && moved.curve.pieceAt(value);
  const circle = piece ? present(group.curves).circuits[piece.circuit] : null;
  const pieces = circle?.pieces ?? group.bottleneck ?? [];
  useEffect(() => studio.stage.lightCircle(group.robots, circle?.visits ?? null), [circle]);
  useEffect(() => () => studio.stage.lightCircle(group.robots, null), []);
  const asked = useRef(0);
  /**
   * @param {ParameterCurve | null} curve
   * @param {number} position
   * @returns {void}
   */
  const move = (curve, position) => {
    asked.current++;
    setOther(null);
    setMoved(curve && position ? { curve, position } : null);
  };
  /**
   * Ask for laps in a new order, once the value has stayed for a moment.
   * @param {ParameterCurve} curve
   * @param {number} position
   * @returns {void}
   */
  const release = (curve, position) => {
    const turn = ++asked.current;
    if (!position) return;
    setTimeout(async () => {
      if (turn !== asked.current) return;
      const { kind, robot, stop } = curve;
      setOther({ isAsked: true });
      const found = await post(/** @type {const} */ (`/runs/${present(runs.shown)}/laps`), {
        kind,
        robot,
        stop,
        value: written(curve.at(position)),
      }).catch(({ message }) => ({ message }));
      if (turn === asked.current) setOther(answerOf(found, group));
    }, PAUSE);
  };
  const robots = [...new Set(pieces.map(({ robot }) => robot))];
  const shown = curves.filter(
    ({ robot }) => robot === null || robot === chosen || leaders(group).includes(robot),
  );
  const laps = lapsIn(group);
  const isLong = [laps, other?.laps ?? 0].some((count) => count > group.robots.length); // of several laps each
  const given =
    moved && value && `${nameOf(studio, moved.curve)} ${said.value(moved.curve, value)}`;
  const anew = newOrder(said, other, isLong);
  const about = anew && (other?.why || isLong) ? `${given}. ${anew}` : given;
  return html`
    <div class="pace">
      <p class="figure"><output>${said.short(period)}</output><span>${isLong ? words.periodOf({ laps, each: said.short(over(period, [BigInt(laps), 1n])) }) : words.period}</span></p>
      <${Table} said=${said} group=${group} at=${at} period=${moved && period} other=${other} />
      <p class="unseen" role="status">${moved ? `${words.sameOrder({ period: said.time(period), before: said.time(at) })} ${anew}` : ""}</p>
      <p class="hint">${moved ? about : words.moveSlider}</p>
      <div class="buttons">
        <button type="button" class="framed" disabled=${!moved} onClick=${() => move(null, 0)}>${words.resetValue}</button>
        <button type="button" class="framed" disabled=${!moved || !robotsOf(studio.store.document) || !runs.isOf(studio.store.document)} onClick=${() => moved && value && take(studio, moved.curve, value)}>${words.takeValue}</button>
      </div>
    </div>
    <h3>${robots.length ? words.setsThePace({ names: several(robots) }) : words.circleTooLong}</h3>
    <${Circle} studio=${studio} pieces=${pieces} short=${(/** @type {Fraction} */ time) => said.short(time)} isNow=${!moved} />
    <${Robots} said=${said} group=${group} studio=${studio} />
    <h3>${words.whatHelps}</h3>
    ${shown.map(
      (
        curve,
      ) => html`<${Slider} key=${curve.key} curve=${curve} said=${said} now=${at} studio=${studio}
        position=${moved?.curve === curve ? moved.position : 0} move=${move} release=${release} />`,
    )}
    <p class="hint">${[group.curves?.reason && phraseText(group.curves.reason), curves.length > shown.length && words.moreSliders, group.curves?.exact === false && words.rounded].filter(Boolean).join(" ")}</p>`;
}

/**
 * Laps of each robot, how much of its time it waits, and whom it waits for most.
 * @param {Props & {said: Said, group: LapGroup}} props
 */
function Robots({ said, group, studio }) {
  const [isWhole, setWhole] = useState(false);
  const shown = isWhole ? group.robots : group.robots.slice(0, MOST_ROWS);
  /**
   * @param {string} name
   * @returns {string}
   */
  const behind = (name) => {
    /** @type {Map<string, Fraction>} */
    const sums = new Map();
    for (const { waits, robots, for: time } of group.conflicts ?? []) {
      const other = robots.find((each) => each !== waits);
      if (other !== undefined && waits === name)
        sums.set(other, plus(sums.get(other) ?? [0n, 1n], fraction(time)));
    }
    const [most] = [...sums].sort(([, one], [, other]) => compared(other, one));
    return most ? words.behind({ name: most[0], time: said.short(most[1]) }) : "";
  };
  /**
   * @param {string} name
   * @returns {void}
   */
  const choose = (name) =>
    studio.stage.choice.chooseRobot(
      studio.stage.plan.planned.findIndex((one) => one.name === name),
    );
  return html`<h3>${words.lapsOfEach}</h3>
    <table class="lap-robots"><thead><tr><th scope="col">${words.robot}</th><th scope="col">${words.lapsCount}</th><th scope="col">${words.meanLap}</th><th scope="col">${words.waitsShare}</th></tr></thead>
    <tbody>${shown.map((name) => {
      const [mean, waits] = [group.mean_lap[name], group.waiting_share[name]];
      return html`<tr><th scope="row"><button type="button" class="watch" onClick=${() => choose(name)}>${name}</button></th>
        <td>${group.laps_per_period[name]}</td><td>${mean === null ? words.never : said.short(fraction(mean))}</td>
        <td>${waits === null ? "" : `${(100 * number(fraction(waits))).toFixed(0)} %`}<small>${behind(name)}</small></td></tr>`;
    })}</tbody></table>
    ${group.robots.length > shown.length && html`<button type="button" class="quiet" onClick=${() => setWhole(true)}>${words.moreRows({ count: group.robots.length - shown.length })}</button>`}`;
}

/**
 * The robots of the circle that have sliders.
 * @param {LapGroup} group
 * @returns {string[]}
 */
const leaders = ({ bottleneck }) =>
  [...new Set((bottleneck ?? []).map(({ robot }) => robot))].slice(0, MOST_ROBOTS);

/**
 * What laps in a new order achieve, of an answer.
 * @param {LapsAnswer | {message: string}} answer
 * @param {LapGroup} group
 * @returns {OtherOrder}
 */
function answerOf(answer, { robots }) {
  if ("message" in answer) return { why: answer.message };
  const found = present(answer.groups.find((each) => each.robots.includes(robots[0])));
  if (found.period === null) return { why: phraseText(found.reason) };
  return { period: fraction(found.period), laps: lapsIn(found) };
}

/**
 * In words, what a new order would reach.
 * @param {Said} said
 * @param {OtherOrder | null} other
 * @param {boolean} isLong
 * @returns {string}
 */
function newOrder(said, other, isLong) {
  if (!other || other.isAsked) return "";
  if (other.why) return words.noNewOrder({ why: other.why });
  const { period, laps } = other;
  if (!period || !laps) return "";
  if (!isLong) return words.newOrder({ period: said.time(period) });
  return words.newPattern({
    laps,
    period: said.short(period),
    each: said.short(over(period, [BigInt(laps), 1n])),
  });
}

/**
 * Period and laps: as they are, with the value in the same order, and with it in a new order.
 * @param {{said: Said, group: LapGroup, at: Fraction, period: Fraction | null, other: OtherOrder | null}} props
 */
function Table({ said, group, at, period, other }) {
  /**
   * @param {string} name
   * @param {Fraction | string} found
   * @param {number} laps
   */
  const row = (name, found, laps) => {
    const isKnown = typeof found !== "string";
    return html`<tr data-known=${String(isKnown)}><th scope="row">${name}</th>
      <td>${isKnown ? said.short(found) : found}</td><td>${isKnown ? said.throughput(laps, found) : ""}</td></tr>`;
  };
  const waits = other?.isAsked ? "…" : "–";
  return html`<table class="orders"><thead><tr><td></td><th scope="col">${words.period}</th><th scope="col">${words.throughput({ isTimed: Boolean(said.units.time) })}</th></tr></thead>
    <tbody>${row(words.orders.now, at, lapsIn(group))}${row(words.orders.same, period ?? "–", lapsIn(group))}${row(words.orders.anew, other?.period ?? waits, other?.laps ?? 0)}</tbody></table>`;
}

/**
 * Write a value into the scenario, and repeat the laps with it.
 * @param {Studio} studio
 * @param {ParameterCurve} curve
 * @param {Fraction} value
 * @returns {void}
 */
function take(studio, { kind, robot, stop }, value) {
  const { store, runs } = studio;
  const given = written(value);
  /**
   * @param {RobotData} one
   * @returns {RobotData}
   */
  const edit = (one) => {
    if (kind === "speed") return { ...one, speed: given };
    const stops = stopsOf(one).map((each, index) =>
      index === stop ? { ...each, work: given } : each,
    );
    return withStops(one, stops);
  };
  const request = runs.run?.request;
  store.change((document) => {
    if (kind === "headway") return withHeadway(document, given);
    const index = writtenIn(document).findIndex(({ name }) => name === robot);
    return changeRobots(document, [index], edit);
  });
  const { document, folder, name } = store;
  studio.study({ kind: "laps", document, folder, source: name, ...request }, document);
}

/**
 * A value that is made once for each of what it is made of.
 * @template T
 * @param {object} of
 * @param {() => T} make
 * @returns {T}
 */
function useMade(of, make) {
  const kept = useRef(/** @type {{of?: object, made: T}} */ ({ made: later() }));
  if (kept.current.of !== of) kept.current = { of, made: make() };
  return kept.current.made;
}

/**
 * One parameter: its value, the period for every value, and what the next change costs, in words.
 * @param {Props & {curve: ParameterCurve, said: Said, now: Fraction, position: number, move: (curve: ParameterCurve, position: number) => void, release: (curve: ParameterCurve, position: number) => void}} props
 */
function Slider({ curve, said, now, position, move, release, studio }) {
  const value = curve.at(position);
  const period = curve.period(value);
  const id = `curve-${curve.key.replaceAll(/\W/g, "-")}`;
  const colour = studio.stage.plan.robots?.find(({ name }) => name === curve.robot)?.colour;
  const name = nameOf(studio, curve);
  return html`
    <div class="parameter" data-curve=${curve.key}>
      <label for=${id}>${colour && html`<i class="dot" style=${`background: ${colour}`}></i>`}${name}</label>
      <output for=${id}>${said.value(curve, value)}</output>
      ${
        curve.isFixed
          ? html`<p class="hint">${words.noRoom}</p>`
          : html`<div class="track"><${Picture} curve=${curve} value=${value} now=${now} />
      <input type="range" id=${id} min=${curve.first} max=${curve.last} step="1" value=${position} style=${`--over: ${(100 * (position - curve.first)) / (curve.last - curve.first)}%`}
        aria-valuetext=${words.valueAndPeriod({ value: said.value(curve, value), period: said.time(period) })} aria-describedby=${`${id}-says`}
        onInput=${({ target }) => move(curve, Number(target.value))} onChange=${({ target }) => release(curve, Number(target.value))} /></div>
      <p class="hint" id=${`${id}-says`}>${effectOf(said, curve, value)}</p>`
      }
    </div>`;
}

/**
 * @param {Studio} studio
 * @param {ParameterCurve} curve
 * @returns {string}
 */
function nameOf(studio, { kind, robot, stop }) {
  if (kind === "headway") return words.parameters.headway;
  const name = robot ?? "";
  if (kind === "speed") return words.parameters.speed({ name });
  const plan = studio.stage.isPlan ? studio.stage.plan : null;
  const stage = plan?.robots.find((each) => each.name === robot)?.stages[stop ?? 0];
  return words.parameters.work({
    name,
    place: stage ? studio.stage.words.where(stage.vertex) : (stop ?? 0) + 1,
  });
}

/**
 * What a small change of a value does, and from where on that is otherwise.
 * @param {Said} said
 * @param {ParameterCurve} curve
 * @param {Fraction} value
 * @returns {string}
 */
function effectOf(said, curve, value) {
  const piece = curve.pieceAt(value);
  const index = curve.pieces.indexOf(piece);
  const next = curve.pieces[index + 1];
  const to = next && said.value(curve, piece.to);
  if (curve.kind === "speed") {
    const from = index ? said.value(curve, piece.from) : "";
    if (!piece.slope[0]) return words.fasterGainsNothing({ from });
    const faster = times(value, [11n, 10n]);
    const saved = minus(
      curve.period(value),
      curve.period(compared(faster, curve.most) > 0 ? curve.most : faster),
    );
    return words.fasterSaves({ saved: said.time(saved), flat: next && !next.slope[0] ? to : "" });
  }
  const unit = words.timeUnit({ unit: said.units.time ?? "" });
  /**
   * @param {Fraction} slope
   * @returns {string}
   */
  const costs = (slope) => said.time(slope);
  if (!piece.slope[0])
    return next ? words.freeUpTo({ to, unit, cost: costs(next.slope) }) : words.free;
  return words.eachCosts({ unit, cost: costs(piece.slope), to, then: next && costs(next.slope) });
}

const [WIDTH, HEIGHT, SAMPLES] = [200, 30, 60];

/**
 * The period over the values of a slider; where another circle takes over there is a line.
 * @param {{curve: ParameterCurve, value: Fraction, now: Fraction}} props
 */
function Picture({ curve, value, now }) {
  const [least, span] = [number(curve.least), number(minus(curve.most, curve.least))];
  /**
   * @param {Fraction} at
   * @returns {number}
   */
  const x = (at) => ((number(at) - least) / span) * WIDTH;
  const periods = [curve.least, curve.most].map((at) => number(curve.period(at)));
  const [low, high] = [Math.min(...periods), Math.min(Math.max(...periods), 2 * number(now))];
  /**
   * @param {Fraction} period
   * @returns {number}
   */
  const y = (period) => 2 + (HEIGHT - 4) * (1 - (number(period) - low) / (high - low || 1));
  const inner = Array.from({ length: SAMPLES + 1 }, (_, k) =>
    plus(curve.least, times(minus(curve.most, curve.least), [BigInt(k), BigInt(SAMPLES)])),
  );
  const bends = curve.pieces.slice(1).map(({ from }) => from);
  const points = [...inner, ...bends]
    .sort(compared)
    .filter((at) => number(curve.period(at)) <= high)
    .map((at) => `${x(at).toFixed(2)} ${y(curve.period(at)).toFixed(2)}`);
  return html`<svg viewBox="0 0 ${WIDTH} ${HEIGHT}" preserveAspectRatio="none" aria-hidden="true">
    ${bends.map((at) => html`<path class="bend" d="M${x(at).toFixed(2)} 0V${HEIGHT}" />`)}
    <path class="origin" d="M${x(curve.value).toFixed(2)} 0V${HEIGHT}" />
    <path class="curve-line" d=${`M${points.join("L")}`} />
    <path class="at" d="M${x(value).toFixed(2)} ${y(curve.period(value)).toFixed(2)}h0" /></svg>`;
}
