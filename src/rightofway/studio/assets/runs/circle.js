/** A critical circle: what each robot on it does until the next one can go on, with its share of the period. */

import { html, useState } from "../vendor/htm-preact.js";
import { lastOf } from "../../../viz/page/assets/arrays.js";
import { fraction } from "../../../viz/page/assets/quantities.js";
import { words } from "../words.js";
import { number, plus } from "./parameter_curve.js";
/** @import { Robot } from "../../../viz/page/assets/robot.js" */
/** @import { CirclePiece } from "../api_types.js" */
/** @import { Stage } from "../stage.js" */
/** @import { Props, Step } from "../types.js" */
/** @import { Said } from "./laps.js" */

const MOST = 10; // steps that are listed at first

/** @param {Props & {pieces: CirclePiece[], said: Said, isNow: boolean}} props */
export function Circle({ studio, pieces, said, isNow }) {
  const [isWhole, setWhole] = useState(false);
  const { stage } = studio;
  /**
   * @param {string} name
   * @returns {Robot | undefined}
   */
  const robotOf = (name) => stage.plan?.robots?.find((robot) => robot.name === name);
  /** @type {Step[]} */
  const steps = counted(pieces, (name) => {
    const robot = robotOf(name);
    return robot && stage.plan.roadmap.name(robot.home);
  });
  const shown = isWhole ? steps : steps.slice(0, MOST);
  return html`
    ${
      isNow &&
      html`<div class="circle-bar" aria-hidden="true">${steps.map(
        ({ robot, kind, time }) =>
          html`<i class=${kind.replaceAll(" ", "-")} style=${`flex-grow: ${number(time)}; background: ${robotOf(robot)?.colour}`}></i>`,
      )}</div>`
    }
    <ol class="circle">${shown.map(
      (
        piece,
        i,
      ) => html`<li><button type="button" class="watch" onClick=${() => studio.light(piece.vertices)}>
        <i class="dot" style=${`background: ${robotOf(piece.robot)?.colour}`}></i>
        <span>${sentence(piece, steps.at(i - 1), robotOf(piece.robot), stage)}</span>
        ${isNow && piece.time[0] > 0n && html`<small>${said.short(piece.time)}</small>`}</button></li>`,
    )}</ol>
    ${steps.length > shown.length && html`<button type="button" class="quiet" onClick=${() => setWhole(true)}>${words.moreSteps(steps.length - shown.length)}</button>`}`;
}

/**
 * The steps with their times; whole laps that a robot makes in between are one step.
 * @param {CirclePiece[]} pieces
 * @param {(name: string) => string | undefined} homeOf
 * @returns {Step[]}
 */
function counted(pieces, homeOf) {
  const steps = pieces.map((piece) => ({ ...piece, time: fraction(piece.for) }));
  /** @type {Step[]} */
  const found = [];
  for (let begin = 0; begin < steps.length;) {
    const { robot } = steps[begin];
    let end = begin;
    while (end < steps.length && steps[end].robot === robot) end++;
    const run = steps.slice(begin, end);
    /**
     * @param {Step} step
     * @returns {boolean}
     */
    const isHome = ({ kind, vertices }) => kind === "way" && vertices.at(-1) === homeOf(robot);
    const [first, last] = [run.findIndex(isHome) + 1, run.findLastIndex(isHome) + 1];
    if (first === last) found.push(...run);
    else {
      const between = run.slice(first, last);
      const laps = between.filter(isHome).length;
      const vertices = [...new Set(between.flatMap((step) => step.vertices))];
      const time = between.map((step) => step.time).reduce(plus);
      found.push(...run.slice(0, first), { kind: "laps", robot, vertices, laps, time });
      found.push(...run.slice(last));
    }
    begin = end;
  }
  return found;
}

/**
 * What one step is, in words.
 * @param {Step} step
 * @param {Step | undefined} before
 * @param {Robot | undefined} drawn
 * @param {Stage} stage
 * @returns {string}
 */
function sentence({ kind, robot, vertices, laps }, before, drawn, stage) {
  if (kind === "laps") return words.steps.laps(robot, laps ?? 0);
  const [from, to] = [vertices[0], lastOf(vertices)];
  const [first, last] = [from, to].map((name) => placeOn(stage, name));
  const home = drawn && stage.plan.roadmap.name(drawn.home);
  if (kind === "way") return words.steps.way(robot, first, last, to === home);
  if (kind === "work")
    return from === home ? words.steps.turn(robot, first) : words.steps.work(robot, first);
  return words.steps.right(robot, first, before?.robot);
}

/**
 * What the viewer calls a vertex; its name, where the map that is shown does not have it.
 * @param {Stage} stage
 * @param {string} name
 * @returns {string}
 */
function placeOn({ plan, words: said }, name) {
  const vertex = plan?.roadmap.vertexNamed(name) ?? -1;
  return vertex < 0 ? name : said.vertex(vertex);
}
