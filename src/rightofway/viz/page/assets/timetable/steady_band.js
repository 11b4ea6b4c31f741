import { texts } from "../language/language.js";
import { line } from "../drawing/shapes.js";

/** @import { Area } from "./axis.js" */
/** @import { Choice } from "../player/choice.js" */
/** @import { Moments } from "../player/clock.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Words } from "../language/words.js" */
/** @import { Group } from "../plan/steady.js" */

const BAND_HEIGHT = 17;
export const NARROWEST_PERIOD = 5; // pixels; narrower ones are not drawn one by one

/** Above the diagram: the transient, and each period of the group that is looked at. */
export class SteadyBand {
  /**
   * @param {Plan} plan
   * @param {Moments} clock
   * @param {Choice} choice
   * @param {Theme} theme
   * @param {Words} words
   */
  constructor(plan, clock, choice, theme, words) {
    this.plan = plan;
    this.clock = clock;
    this.choice = choice;
    this.theme = theme;
    this.words = words;
  }

  /** Pixels it needs above the diagram. */
  get height() {
    return this.plan.steady ? BAND_HEIGHT + 7 : 0;
  }

  get group() {
    return this.plan.steady?.group(this.choice.robot) ?? null;
  }

  /**
   * Paint what lies behind the diagram.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   */
  paint(context, area) {
    const { group } = this;
    if (!group) return;
    const { start, period, until, borders } = group;
    const top = area.top - BAND_HEIGHT - 4;
    const apart = area.x(start + period) - area.x(start);
    context.fillStyle = this.theme.ink;
    context.globalAlpha = 0.05;
    context.fillRect(area.x(start), area.top, area.x(until) - area.x(start), area.height);
    context.globalAlpha = 1;
    this.#part(context, area, top, 0, start, [texts.transient], 0);
    if (apart < NARROWEST_PERIOD)
      this.#part(
        context,
        area,
        top,
        start,
        until,
        [texts.every({ time: this.words.time(period) })],
        0.12,
      );
    else borders.forEach((tick, index) => this.#period(context, area, group, top, tick, index));
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {Group} group
   * @param {number} top
   * @param {number} tick
   * @param {number} index
   */
  #period(context, area, { period, until }, top, tick, index) {
    const end = Math.min(tick + period, until);
    const looped = this.clock.loop?.from === tick;
    const every = 10 ** Math.max(Math.ceil(Math.log10(26 / (area.x(period) - area.x(0)))), 0);
    const number = (index + 1) % every === 0 ? String(index + 1) : "";
    const labels = index ? [number] : texts.period({ time: this.words.time(period) });
    this.#part(context, area, top, tick, end, labels, looped ? 0.3 : index % 2 ? 0.07 : 0.13);
    context.strokeStyle = this.theme.muted;
    context.lineWidth = 1;
    context.setLineDash([2, 3]);
    context.beginPath();
    line(context, area.x(tick), top, area.x(tick), area.bottom);
    context.stroke();
    context.setLineDash([]);
  }

  /**
   * A stretch of time with the longest of its labels that has room.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {Area} area
   * @param {number} top
   * @param {number} from
   * @param {number} to
   * @param {string[]} labels
   * @param {number} strength
   */
  #part(context, area, top, from, to, labels, strength) {
    const [left, right] = [area.x(from), area.x(to)];
    if (right - left < 1) return;
    context.fillStyle = this.theme.ink;
    context.globalAlpha = strength;
    context.fillRect(left, top, right - left, BAND_HEIGHT);
    context.globalAlpha = 1;
    context.font = this.theme.font(11.5);
    context.fillStyle = strength ? this.theme.ink : this.theme.muted;
    context.textAlign = "center";
    context.textBaseline = "middle";
    if (/^\d+$/.test(labels[0])) {
      // as many of these are given as have room
      context.fillText(labels[0], (left + right) / 2, top + BAND_HEIGHT / 2 + 0.5);
      return;
    }
    const fits = labels.find((text) => context.measureText(text).width < right - left - 4);
    if (fits) context.fillText(fits, (left + right) / 2, top + BAND_HEIGHT / 2 + 0.5);
  }
}
