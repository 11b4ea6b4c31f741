/** The way that the chosen robot had in the plan that is compared: a dashed line above the map. */

import { toDrawing } from "../draw/places.js";
import { Plan } from "../../../viz/page/assets/plan/plan.js";
import { present } from "../given.js";
/** @import { Robot } from "../../../viz/page/assets/plan/robot.js" */
/** @import { Stage } from "../stage.js" */
/** @import { Point, SitePayload } from "../types.js" */
/** @import { RunStore } from "./run_store.js" */

const [DASH, GAP, WIDTH, FAINT] = [5, 5, 2, 0.6]; // [pixels], and how opaque

export class FormerRoute {
  /** @type {SitePayload | null} */
  #payload = null;
  /** @type {Plan | null} */
  #plan = null; // made from the payload when it is first asked for

  /**
   * @param {RunStore} runs
   * @param {Stage} stage
   */
  constructor(runs, stage) {
    this.runs = runs;
    this.stage = stage;
    stage.on("overlay", () => this.#paint());
    runs.on("runs", () => stage.ask());
  }

  /**
   * The robot as it was, with the map of then; null where nothing else is compared.
   * @returns {Robot | null}
   */
  get #robot() {
    const { former, comparison } = this.runs;
    const name = this.stage.isPlan && this.stage.choice.robot?.name;
    if (!name || !former || comparison?.runs[0] !== former.number) return null;
    if (this.#payload !== former.payload) {
      this.#payload = former.payload;
      this.#plan = new Plan(former.payload);
    }
    return this.#plan?.robots.find((robot) => robot.name === name) ?? null;
  }

  /** The parts of the former way that the robot does not drive now, in units of the drawing. */
  get ways() {
    const robot = this.#robot;
    if (!robot) return [];
    const { roadmap: old } = present(this.#plan);
    const { roadmap } = this.stage.plan;
    const before = waysOf(robot, (vertex) =>
      toDrawing(roadmap, ...old.toSite(old.x[vertex], old.y[vertex])),
    );
    const now = waysOf(present(this.stage.choice.robot), (vertex) => [
      roadmap.x[vertex],
      roadmap.y[vertex],
    ]);
    return [...before].filter(([key]) => !now.has(key)).map(([, way]) => way);
  }

  #paint() {
    const { ways } = this;
    if (!ways.length) return;
    const { context, theme, view } = this.stage;
    const { scale } = view.viewport;
    context.save();
    context.strokeStyle = theme.ink;
    context.globalAlpha = FAINT;
    context.lineWidth = WIDTH / scale;
    context.setLineDash([DASH / scale, GAP / scale]);
    context.beginPath();
    /** @type {number[]} */
    let end = [];
    for (const [tail, head] of ways) {
      if (String(tail) !== String(end)) context.moveTo(...tail);
      context.lineTo(...head);
      end = head;
    }
    context.stroke();
    context.restore();
  }
}

/**
 * The straight ways between the places of a robot, each once, by their ends.
 * @param {Robot} robot
 * @param {(vertex: number) => Point} at
 * @returns {Map<string, [Point, Point]>}
 */
function waysOf({ vertices }, at) {
  const points = Array.from(vertices, at);
  /**
   * @param {Point} point
   * @returns {string}
   */
  const key = (point) => point.map((coordinate) => coordinate.toFixed(4)).join();
  /** @type {[Point, Point][]} */
  const ways = points.slice(1).map((head, i) => [points[i], head]);
  /** @type {Map<string, [Point, Point]>} */
  const found = new Map();
  for (const way of ways) {
    const ends = way.map(key).sort().join(" ");
    if (!found.has(ends)) found.set(ends, way);
  }
  return found;
}
