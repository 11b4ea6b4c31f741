import { Area } from "../timetable/axis.js";
import { texts } from "../language/language.js";
import { CHARGE, DONE, DRIVE, TURN, WAIT, WORK } from "../plan/phases.js";
import { fleetBattery } from "./fleet_battery.js";
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
const LEAST_DROP = 18; // pixels from the top of a lane to its name, below the value at the top
const SAMPLES = 400; // of the batteries of the fleet

/**
 * A shift over time: marks of rounds, jobs done, service times, batteries, and what robots do. Of a
 * chosen robot: its battery, and what it does.
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
    this.battery = plan.tours.some(({ charges }) => charges?.length)
      ? fleetBattery(plan.tours, plan.end, SAMPLES)
      : null;
  }

  get title() {
    const { robot } = this.choice;
    if (robot) return texts.shift.chartOf({ name: robot.name });
    return this.battery ? texts.shift.chartWithBattery : texts.shift.chart;
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
    const paints = [
      /** @param {Area} lane */ (lane) => this.#jobs(context, lane),
      ...(charges?.length
        ? []
        : [/** @param {Area} lane */ (lane) => this.#service(context, lane)]),
      ...this.#batteries(context, robot, charges),
    ];
    const share = paints.length > 2 ? 0.2 : 0.27;
    paints.forEach((paint, i) => {
      const begin = top + i * share * height;
      paint(this.#lane(area, begin, begin + share * height - GAP));
    });
    const below = this.#lane(area, top + paints.length * share * height, area.bottom);
    if (robot) this.#robot(context, below, robot);
    else {
      this.#label(context, below, texts.shift.lanes.robots, String(this.plan.robots.length));
      this.census.paint(context, below, false);
    }
  }

  /**
   * The lane of the battery of a chosen robot, or of the fleet, if there is one.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Robot | null} robot
   * @param {[number, number][] | null | undefined} charges
   * @returns {((lane: Area) => void)[]}
   */
  #batteries(context, robot, charges) {
    if (charges?.length) return [(lane) => this.#battery(context, lane, charges)];
    const { battery } = this;
    return battery && !robot ? [(lane) => this.#fleetBattery(context, lane, battery)] : [];
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
    context.fillText(name, 28, Math.max((top + bottom) / 2, top + LEAST_DROP), left - 36);
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
    this.#curve(context, lane, charges);
  }

  /**
   * The mean state of charge, and dashed the lowest one.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} lane
   * @param {ReturnType<typeof fleetBattery>} battery
   */
  #fleetBattery(context, lane, { mean, lowest }) {
    this.#label(context, lane, texts.shift.lanes.battery, this.words.percent(1));
    for (const { shares, dash } of [
      { shares: mean, dash: [] },
      { shares: lowest, dash: [4, 3] },
    ]) {
      context.setLineDash(dash);
      this.#curve(
        context,
        lane,
        Array.from(shares, (share, i) => [(i / SAMPLES) * lane.end, share]),
      );
    }
    context.setLineDash([]);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} lane
   * @param {[number, number][]} points ticks with shares
   */
  #curve(context, lane, points) {
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 1.5;
    context.beginPath();
    for (const [tick, share] of points)
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
