import { Area } from "../timetable/axis.js";
import { texts } from "../language/language.js";
import { CHARGE, DONE, DRIVE, TURN, WAIT, WORK } from "../plan/phases.js";
import { line } from "../drawing/shapes.js";

/** @import { Census } from "../timetable/census.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { ShiftData } from "../payload.d.ts" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Words } from "../language/words.js" */

const ROUNDS_HEIGHT = 9; // pixels, of the marks of rounds at the top
const GAP = 10; // pixels between two lanes

/**
 * A shift over time: marks of rounds, jobs done, service times, and what robots do. Of a chosen robot:
 * its battery, and what it does.
 */
export class ShiftChart {
  /**
   * @param {Plan} plan
   * @param {ShiftData} shift
   * @param {Theme} theme
   * @param {Choice} choice
   * @param {Words} words
   * @param {Census} census
   */
  constructor(plan, shift, theme, choice, words, census) {
    this.plan = plan;
    this.shift = shift;
    this.theme = theme;
    this.choice = choice;
    this.words = words;
    this.census = census;
  }

  get title() {
    const { robot } = this.choice;
    return robot ? texts.shift.chartOf({ name: robot.name }) : texts.shift.chart;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   */
  paint(context, area) {
    const { robot } = this.choice;
    const top = area.top + ROUNDS_HEIGHT + GAP / 2;
    const height = area.bottom - top;
    this.#rounds(context, area);
    const charges = robot && this.plan.tours[robot.index].charges;
    const second = top + height * 0.28 + GAP;
    const third = top + height * 0.54 + GAP;
    this.#jobs(context, this.#lane(area, top, second - GAP));
    const middle = this.#lane(area, second, third - GAP);
    if (charges?.length) this.#battery(context, middle, charges);
    else this.#service(context, middle);
    const below = this.#lane(area, third, area.bottom);
    if (robot) this.#robot(context, below, robot);
    else {
      this.#label(context, below, texts.shift.lanes.robots, String(this.plan.robots.length));
      this.census.paint(context, below, false);
    }
  }

  /**
   * A part of an area with the same time axis.
   *
   * @param {Area} area
   * @param {number} top
   * @param {number} bottom
   */
  #lane(area, top, bottom) {
    const lane = new Area(this.theme.root.top, 0, 0, area.end);
    return Object.assign(lane, { left: area.left, right: area.right, top, bottom });
  }

  /**
   * The name of a lane, and the value at its top.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} lane
   * @param {string} name
   * @param {string} most
   */
  #label(context, { left, top, bottom, right }, name, most) {
    context.font = this.theme.font(12.5);
    context.fillStyle = this.theme.muted;
    context.textBaseline = "middle";
    context.textAlign = "left";
    context.fillText(name, 28, (top + bottom) / 2, left - 36);
    context.font = this.theme.font(11);
    context.textAlign = "right";
    if (most) context.fillText(most, left - 6, top + 5, left - 34);
    context.strokeStyle = this.theme.line;
    context.lineWidth = 1;
    context.beginPath();
    line(context, left, bottom, right, bottom);
    context.stroke();
  }

  /**
   * A mark from the begin of each round to its takeover; after a red one the old plan stood.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   */
  #rounds(context, area) {
    const { rounds } = this.shift;
    const crowd = (2 * rounds.length) / (area.right - area.left);
    context.globalAlpha = Math.min(Math.max(1 / Math.max(crowd, 1), 0.25), 0.7);
    context.fillStyle = this.theme.muted;
    for (const [begin, takeover, , , stands] of rounds)
      if (!stands) this.#mark(context, area, begin, takeover, 0.6);
    context.globalAlpha = 1;
    context.fillStyle = this.theme.held;
    for (const [begin, takeover, , , stands] of rounds)
      if (stands) this.#mark(context, area, begin, takeover, 1);
    context.font = this.theme.font(11);
    context.textBaseline = "middle";
    context.textAlign = "left";
    context.fillStyle = this.theme.muted;
    context.fillText(texts.shift.lanes.rounds, 28, area.top + 3, area.left - 36);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {number} begin
   * @param {number} end
   * @param {number} share of the height
   */
  #mark(context, area, begin, end, share) {
    const left = area.x(begin);
    const height = ROUNDS_HEIGHT * share;
    const width = Math.max(area.x(end) - left, 1);
    context.fillRect(left, area.top + ROUNDS_HEIGHT - height, width, height);
  }

  /**
   * Jobs done in each part of the shift; the late ones at the bottom of each bar.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} lane
   */
  #jobs(context, lane) {
    const { slices } = this.shift;
    const most = Math.max(1, ...slices.map(([, done]) => done));
    this.#label(context, lane, texts.shift.lanes.jobs, String(most));
    let begin = 0;
    for (const [end, done, late] of slices) {
      const left = lane.x(begin) + 0.5;
      const width = Math.max(lane.x(end) - left - 0.5, 1);
      for (const { count, colour } of [
        { count: done, colour: this.theme.work },
        { count: late, colour: this.theme.held },
      ]) {
        const height = (count / most) * lane.height;
        context.fillStyle = colour;
        context.fillRect(left, lane.bottom - height, width, height);
      }
      begin = end;
    }
  }

  /**
   * The median of service times in each part of the shift, and dashed their 95th percentile.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} lane
   */
  #service(context, lane) {
    const { slices } = this.shift;
    const most = Math.max(1, ...slices.map(([, , , , p95]) => p95 ?? 0));
    this.#label(context, lane, texts.shift.lanes.service, this.words.time(Math.round(most)));
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 1.5;
    for (const { column, dash } of [
      { column: 3, dash: [] },
      { column: 4, dash: [4, 3] },
    ]) {
      context.setLineDash(dash);
      context.beginPath();
      let begin = 0;
      for (const slice of slices) {
        const value = slice[column];
        if (value !== null) {
          const y = lane.bottom - (value / most) * lane.height;
          context.lineTo(lane.x((begin + slice[0]) / 2), y);
        }
        begin = slice[0];
      }
      context.stroke();
    }
    context.setLineDash([]);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} lane
   * @param {[number, number][]} charges
   */
  #battery(context, lane, charges) {
    this.#label(context, lane, texts.shift.lanes.battery, this.words.percent(1));
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 1.5;
    context.beginPath();
    for (const [tick, share] of charges)
      context.lineTo(lane.x(tick), lane.bottom - share * lane.height);
    context.stroke();
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} lane
   * @param {Robot} robot
   */
  #robot(context, lane, { name, phases }) {
    this.#label(context, lane, name, "");
    const { drive, wait, work, turn, paper } = this.theme;
    const charge = `color-mix(in srgb, ${work} 40%, ${paper})`;
    /** @type {Record<number, string>} */
    const colours = { [DRIVE]: drive, [WAIT]: wait, [WORK]: work, [TURN]: turn, [CHARGE]: charge };
    /** @type {Record<number, number>} */
    const heights = { [DRIVE]: 0.4, [WAIT]: 0.7, [WORK]: 1, [TURN]: 0.4 };
    for (let i = 0; i < phases.begin.length; i++) {
      const activity = phases.activity[i];
      if (activity === DONE) continue;
      const left = lane.x(phases.begin[i]);
      const width = Math.max(lane.x(Math.min(phases.end(i), lane.end)) - left, 0.5);
      const height = lane.height * (heights[activity] ?? 1);
      context.fillStyle = colours[activity] ?? wait;
      context.fillRect(left, lane.bottom - height, width, height);
    }
  }
}
