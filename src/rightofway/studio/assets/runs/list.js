/** The runs of a document: shown, named, sorted, selected to be compared, forgotten; others on request. */

import { html, useEffect, useState } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import {
  figure,
  language,
  said as phraseText,
} from "../../../viz/page/assets/language/language.js";
import { Quantities } from "../../../viz/page/assets/language/quantities.js";
import { words } from "../words.js";
import { doNotRun, faultsOf, inShort } from "./faults.js";
import { canBeShown, isOver, isWithoutPlan, stateOf } from "./run_store.js";
/** @import { ErrorData, PlanFigures, RunData } from "../api_types.js" */
/** @import { Studio } from "../studio.js" */
/** @import { LiveRun, Props } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */

const MOST = 12; // that are listed at once; the others on request

/**
 * What a run is called: its own name, its file, or what it is.
 * @param {Pick<RunData, "name" | "source" | "kind">} run
 * @returns {string}
 */
export const titleOf = (run) => run.name || fileOf(run) || words.runKinds[run.kind] || run.kind;

/**
 * The file that a run was made from; a draft has a name without an ending.
 * @param {Pick<RunData, "source">} run
 * @returns {string}
 */
const fileOf = ({ source }) => (/\.\w+$/.test(source) ? source : "");

/**
 * How long a run took [s], or NaN.
 * @param {Pick<RunData, "started" | "ended">} run
 * @returns {number}
 */
export const secondsOf = ({ started, ended }) =>
  started && ended && ended > started ? ended - started : NaN;

/** @type {Record<string, (run: LiveRun) => number>} */
const SORTS = {
  number: ({ number }) => -number,
  flowtime: (run) => {
    const { figures } = run;
    const [numerator, denominator] = figures?.tick ?? [1, 1];
    return figures && !faultsOf(run) ? (figures.flowtime * numerator) / denominator : Infinity;
  },
  took: (run) => secondsOf(run) || Infinity,
};

/** @param {Props} props */
export function RunList({ studio }) {
  const { runs, store } = studio;
  const [listed, setListed] = useState(MOST);
  const [sort, setSort] = useState("number");
  const [file, setFile] = useState(null); // null for this document, "*" for all
  const all = runs.listed(store, file);
  const empty = all.filter(
    (run) => isWithoutPlan(run) && !(run === all[0] && runs.hasJustFailed(run)),
  );
  const found = all
    .filter((run) => !empty.includes(run))
    .sort((a, b) => SORTS[sort](a) - SORTS[sort](b));
  const shown = found.slice(0, listed);
  const unit = unitOf(all);
  useEffect(() => {
    runs.notes.find(shown.map(({ number }) => number));
  }, [shown.map(({ number, state }) => `${number} ${state}`).join()]);
  if (!runs.runs.length) return null;
  /**
   * @param {string} key
   * @param {string} text
   * @param {string} [hint]
   */
  const head = (key, text, hint = "") => {
    const way = key === "number" ? "descending" : "ascending";
    return html`<th scope="col" class=${key} aria-sort=${sort === key ? way : undefined}>
      <button type="button" class="quiet" title=${hint} onClick=${() => setSort(key)}>
        ${text}</button></th>`;
  };
  /** @param {LiveRun} run */
  const row = (run) => html`<${Row} key=${run.number} studio=${studio} run=${run}
    order=${shown} isOwn=${file === null} hasUnit=${Boolean(unit)} />`;
  const left = found.length - listed;
  return html`
    <section class="run-list" aria-labelledby="runs-title">
      <header><h2 id="runs-title">${words.runs}</h2>
        <${Files} studio=${studio} file=${file} setFile=${setFile} /></header>
      <${Selection} studio=${studio} />
      <table class="runs" hidden=${!all.length}>
        <thead><tr><td></td>${head("number", words.number)}
          <th scope="col" class="title">${words.name}</th>
          ${head("flowtime", withUnit(words.flowtime, unit), words.terms.flowtime)}
          ${head("took", withUnit(words.took, "s"), words.tookHint)}<td></td></tr></thead>
        <tbody>${shown.map(row)}</tbody>
        ${empty.length > 0 && html`<${Empty} studio=${studio} runs=${empty} row=${row} />`}
      </table>
      ${!all.length && html`<p class="hint">${words.noRuns}</p>`}
      ${
        left > 0 &&
        html`<button type="button" class="framed" onClick=${() => setListed(listed + MOST)}>
          ${words.moreRows({ count: left })}</button>`
      }
    </section>`;
}

/**
 * The unit of time of all plans; empty where they have different ones, or none.
 * @param {LiveRun[]} runs
 * @returns {string}
 */
function unitOf(runs) {
  const known = runs.flatMap(({ figures }) => figures ?? []);
  const units = new Set(known.map(({ tick, units: { time } }) => (tick && time) || ""));
  return units.size === 1 ? [...units][0] : "";
}

/**
 * The head of a column of numbers.
 * @param {string} title
 * @param {string} unit
 * @returns {string}
 */
const withUnit = (title, unit) => (unit ? `${title} [${unit}]` : title);

/**
 * The runs that came to nothing: one line until somebody wants to see them.
 * @param {Props & {runs: LiveRun[], row: (run: LiveRun) => unknown}} props
 */
function Empty({ studio, runs, row }) {
  const [isOpen, setOpen] = useState(false);
  const numbers = runs.map(({ number }) => number);
  const about = words.withoutPlan({ count: runs.length });
  return html`<tbody class="empty">
    <tr class="fold"><td colspan="6"><div>
      <button type="button" class="quiet" aria-expanded=${String(isOpen)} onClick=${() => setOpen(!isOpen)}>
        <i aria-hidden="true">${isOpen ? "▼" : "▶"}</i>${about}</button>
      <button type="button" class="quiet" aria-label=${`${words.remove}: ${about}`}
        onClick=${() => forget(studio, numbers, about)}>${words.remove}</button>
    </div></td></tr>
    ${isOpen && runs.map(row)}</tbody>`;
}

/**
 * Whose runs are listed, where there are others than those of this document.
 * @param {Props & {file: string | null, setFile: (file: string | null) => void}} props
 */
function Files({ studio, file, setFile }) {
  const { runs, store } = studio;
  const [own, all] = [null, "*"].map((whose) => runs.plans(store, whose).length);
  if (own === all) return null;
  const others = [...new Set(runs.runs.map(fileOf))].filter(
    (each) => each && !store.names.has(each),
  );
  return html`<select aria-label=${words.whoseRuns} value=${file ?? ""}
      onChange=${({ target }) => setFile(target.value || null)}>
    <option value="">${words.ownRuns({ count: own })}</option>
    <option value="*">${words.allRuns({ count: all })}</option>
    ${others.map((each) => html`<option value=${each}>${each}</option>`)}</select>`;
}

/**
 * What can be done with the runs that are selected.
 * @param {Props} props
 */
function Selection({ studio }) {
  const { runs } = studio;
  const { selected } = runs;
  if (!selected.length) return null;
  const count = selected.length;
  const none = () => studio.attempt(() => runs.select([]));
  return html`<p class="selection">
    <span role="status">${count === 1 ? words.selectMore : words.plansSelected({ count })}</span>
    <button type="button" class="framed" onClick=${() => forget(studio, selected)}>
      ${words.remove}</button>
    <button type="button" class="framed" onClick=${none}>${words.selectNone}</button></p>`;
}

/**
 * Forget runs, with an undo while the notice stands.
 * @param {Studio} studio
 * @param {number[]} numbers
 * @param {string} [about]
 * @returns {void}
 */
function forget({ runs, notices }, numbers, about = "") {
  const text =
    numbers.length === 1
      ? words.runDeleted({ number: numbers[0] })
      : words.runsDeleted({ count: numbers.length });
  const undo = runs.forgetSoon(numbers);
  notices.say(about ? words.deleted({ what: about }) : text, words.undo, undo);
}

/**
 * A run; its flowtime is a number alone where the head of the list has the unit.
 * @param {Props & {run: LiveRun, order: LiveRun[], isOwn: boolean, hasUnit: boolean}} props
 */
function Row({ studio, run, order, isOwn, hasUnit }) {
  const { runs } = studio;
  const { number, figures } = run;
  const isShown = number === runs.shown;
  const isSelected = runs.selected.includes(number);
  /**
   * @param {string} action
   * @returns {string}
   */
  const named = (action) => `${action}: ${number} ${titleOf(run)}`;
  const method =
    run.request?.planner ??
    run.request?.rule ??
    (run.kind === "plan" ? runs.planners.default : words.runKinds[run.kind]);
  const took = secondsOf(run);
  const title = isOwn ? method : titleOf(run);
  const rest = [run.name || !isOwn ? method : "", stateOf(run), ...runs.notes.on(run)];
  const about = rest.filter(Boolean).join(" · ");
  const flowtime = figures?.tick
    ? new Quantities(figures.units, figures.tick)[hasUnit ? "cell" : "short"](figures.flowtime)
    : phraseText(figures?.text.flowtime ?? "");
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const select = (event) =>
    void studio.attempt(() => runs.toggle(number, event.shiftKey ? order : null));
  /**
   * @param {{target: HTMLInputElement}} event
   * @returns {void}
   */
  const rename = ({ target }) =>
    void studio.attempt(() => runs.rename(number, target.value.trim()));
  const remove = html`<button type="button" class="quiet" title=${words.remove}
    aria-label=${named(words.remove)} onClick=${() => forget(studio, [number])}>✕</button>`;
  /**
   * A press on any other part of the row plays the plan, as its number does.
   * @param {PageEvent} event
   * @returns {unknown}
   */
  const play = (event) =>
    canBeShown(run) && !event.target.closest("input, button") && studio.showRun(number);
  return html`
    <tr class=${isShown ? "chosen" : ""} data-run=${number} data-state=${run.state} onClick=${play}>
      <td><input type="checkbox" checked=${isSelected} disabled=${!run.has_plan}
        aria-label=${named(words.compare)} title=${words.compareHint} onClick=${select} /></td>
      <td><button type="button" class="show" disabled=${!canBeShown(run)} title=${words.show}
        aria-pressed=${String(isShown)} aria-label=${named(words.show)}
        onClick=${() => studio.showRun(number)}>${number}</button></td>
      <td class="title"><${Field} value=${run.name} placeholder=${title} maxlength="200"
        spellcheck="false" aria-label=${`${words.runName} ${number}`} onChange=${rename} />
        <small title=${about}>${about}</small></td>
      <td class="short">${
        faultsOf(run)
          ? html`<b class="wrong" title=${doNotRun(faultsOf(run))}>${inShort(faultsOf(run))}</b>`
          : html`${flowtime}${figures?.text.gap && html`<${Gap} figures=${figures} />`}`
      }</td>
      <td class="short">${took ? figure(took.toFixed(1)) : ""}</td>
      <td class="do">${isOver(run) && remove}</td>
    </tr>
    ${
      run.error &&
      html`<tr class="why"><td></td>
        <td colspan="5"><${Failure} studio=${studio} error=${run.error} /></td></tr>`
    }`;
}

/**
 * How far the flowtime is above the bound: a bar, full from twice the bound on, and a figure.
 * @param {{figures: PlanFigures}} props
 */
function Gap({ figures: { flowtime, lower_bound: bound, text } }) {
  const share = Math.min(flowtime / bound - 1, 1);
  return html`<small title=${`${words.gap} ${phraseText(text.gap)}`}>
    <span class="gap-bar" style=${{ "--gap": share }}></span>+${phraseText(text.gap)}</small>`;
}

/**
 * Why a run failed, as the library says it; each proven reason lights its places on the map.
 * @param {Props & {error: ErrorData}} props
 */
function Failure({ studio, error }) {
  const reasons = error.reasons?.filter(({ vertices }) => vertices.length) ?? [];
  if (!reasons.length)
    return html`<p class="wrong" lang=${error.phrase ? language : "en"}>${phraseText(error.phrase ?? error.message)}</p>`;
  return reasons.map(
    ({ phrase, vertices }) =>
      html`<button type="button" class="watch wrong" onClick=${() => studio.light(vertices)}>
        ${phraseText(phrase)}</button>`,
  );
}
