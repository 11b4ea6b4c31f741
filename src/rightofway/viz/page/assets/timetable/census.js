import { FleetMemo } from "../plan/fleet_memo.js";
import { texts } from "../language/language.js";
import { BROKEN, CHARGE, DONE, DRIVE, HELD, TURN, WAIT, WORK } from "../plan/phases.js";

/** @import { Area } from "./axis.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Robot } from "../plan/robot.js" */
/** @import { Theme } from "../drawing/theme.js" */

const MOST_SAMPLES = 1200;
const STACK = [WORK, CHARGE, TURN, DRIVE, WAIT, HELD, BROKEN]; // from the bottom up; robots that are done are the empty space above

/** What a large fleet does: how many robots work, turn, drive and wait, over time. */
export class Census {
  #counts;
  #beside;

  /**
   * @param {Plan} plan
   * @param {Theme} theme
   * @param {Choice} choice
   */
  constructor(plan, theme, choice) {
    this.plan = plan;
    this.theme = theme;
    this.choice = choice;
    this.#counts = new FleetMemo(choice, () => this.#count(choice.robots));
    this.#beside = new FleetMemo(choice, () => this.#out(this.#count(choice.beside ?? [])));
    this.samples = Math.min(plan.end, MOST_SAMPLES);
  }

  get title() {
    const what = texts.census({ count: this.plan.robots.length });
    return this.choice.beside ? texts.censusBeside({ title: what }) : what;
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {boolean} [hasLegend]
   */
  paint(context, area, hasLegend = true) {
    const counts = this.#counts.value;
    const below = new Float64Array(this.samples);
    const { work, turn, drive, wait, held, broken, paper } = this.theme;
    /** @type {Record<number, string>} */
    const colours = {
      [WORK]: work,
      [CHARGE]: `color-mix(in srgb, ${work} 40%, ${paper})`,
      [TURN]: turn,
      [DRIVE]: drive,
      [WAIT]: wait,
      [HELD]: held,
      [BROKEN]: broken,
    };
    for (const activity of this.#stack) {
      context.fillStyle = colours[activity];
      this.#band(context, area, below, counts[activity]);
    }
    if (this.choice.beside) this.#outline(context, area, this.#beside.value);
    if (hasLegend) this.#legend(context, area, colours);
  }

  get #stack() {
    return STACK.filter(
      (activity) => activity < DONE || this.#counts.value[activity].some(Boolean),
    );
  }

  /**
   * How many robots are not done yet, in each sample.
   *
   * @param {Int32Array[]} counts
   */
  #out(counts) {
    return counts[DONE].map((done) => this.plan.robots.length - done);
  }

  /**
   * A line at the height of these numbers of robots.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {Int32Array} robots
   */
  #outline(context, area, robots) {
    /** @param {number} sample */
    const x = (sample) => area.x((sample / this.samples) * area.end);
    /** @param {number} count */
    const y = (count) => area.bottom - (count / this.plan.robots.length) * area.height;
    context.strokeStyle = this.theme.ink;
    context.lineWidth = 1.25;
    context.beginPath();
    for (let i = 0; i < this.samples; i++) {
      context.lineTo(x(i), y(robots[i]));
      context.lineTo(x(i + 1), y(robots[i]));
    }
    context.stroke();
  }

  /**
   * Robots by activity, in the middle of each sample.
   *
   * @param {readonly Robot[]} robots
   */
  #count(robots) {
    const counts = texts.activities.map(() => new Int32Array(this.samples + 1));
    /** @param {number} tick */
    const sample = (tick) =>
      Math.min(Math.max(Math.ceil((tick / this.plan.end) * this.samples - 0.5), 0), this.samples);
    for (const { phases } of robots) {
      for (let i = 0; i < phases.begin.length; i++) {
        counts[phases.activity[i]][sample(phases.begin[i])]++;
        counts[phases.activity[i]][sample(phases.end(i))]--;
      }
    }
    for (const row of counts) for (let i = 1; i < row.length; i++) row[i] += row[i - 1];
    return counts;
  }

  /**
   * Paint one activity on top of what lies below, and add it to that.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {Float64Array} below
   * @param {Int32Array} counts
   */
  #band(context, area, below, counts) {
    /** @param {number} sample */
    const x = (sample) => area.x((sample / this.samples) * area.end);
    /** @param {number} robots */
    const y = (robots) => area.bottom - (robots / this.plan.robots.length) * area.height;
    context.beginPath();
    for (let i = 0; i < this.samples; i++) {
      const top = y(below[i] + counts[i]);
      if (i === 0) context.moveTo(x(i), top);
      else context.lineTo(x(i), top);
      context.lineTo(x(i + 1), top);
    }
    for (let i = this.samples - 1; i >= 0; i--) {
      context.lineTo(x(i + 1), y(below[i]));
      context.lineTo(x(i), y(below[i]));
      below[i] += counts[i];
    }
    context.closePath();
    context.fill();
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {Record<number, string>} colours
   */
  #legend(context, area, colours) {
    context.font = this.theme.font(12.5);
    context.textAlign = "left";
    context.textBaseline = "middle";
    context.fillStyle = this.theme.muted;
    context.fillText(texts.robots({ count: this.plan.robots.length }), 28, area.top + 4);
    this.#stack.forEach((activity, place) => {
      const y = area.bottom - 12 - place * 22;
      context.fillStyle = colours[activity];
      context.fillRect(28, y - 5, 10, 10);
      context.fillStyle = this.theme.muted;
      context.fillText(texts.activities[activity], 46, y + 0.5);
    });
  }
}
