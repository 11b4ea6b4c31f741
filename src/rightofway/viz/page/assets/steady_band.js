import { texts } from "./language.js";
import { line } from "./shapes.js";

const BAND_HEIGHT = 17;
export const NARROWEST_PERIOD = 5; // pixels; narrower ones are not drawn one by one

/** Above the diagram: the transient, and each period of the group that is looked at. */
export class SteadyBand {
  constructor(plan, clock, choice, theme, words) {
    Object.assign(this, { plan, clock, choice, theme, words });
  }

  /** Pixels it needs above the diagram. */
  get height() {
    return this.plan.steady ? BAND_HEIGHT + 7 : 0;
  }

  get group() {
    return this.plan.steady.group(this.choice.robot);
  }

  /** Paint what lies behind the diagram. */
  paint(context, area) {
    if (!this.plan.steady) return;
    const { start, period, until, borders } = this.group;
    const top = area.top - BAND_HEIGHT - 4;
    const apart = area.x(start + period) - area.x(start);
    context.fillStyle = this.theme.ink;
    context.globalAlpha = 0.05;
    context.fillRect(area.x(start), area.top, area.x(until) - area.x(start), area.height);
    context.globalAlpha = 1;
    this.#part(context, area, top, 0, start, [texts.transient], 0);
    if (apart < NARROWEST_PERIOD)
      this.#part(context, area, top, start, until, [this.#everyTime()], 0.12);
    else borders.forEach((tick, index) => this.#period(context, area, top, tick, index));
  }

  #everyTime() {
    return texts.every(this.words.time(this.group.period));
  }

  #period(context, area, top, tick, index) {
    const { period, until } = this.group;
    const end = Math.min(tick + period, until);
    const looped = this.clock.loop?.from === tick;
    const every = 10 ** Math.max(Math.ceil(Math.log10(26 / (area.x(period) - area.x(0)))), 0);
    const number = (index + 1) % every === 0 ? String(index + 1) : "";
    const labels = index ? [number] : texts.period(this.words.time(period));
    this.#part(context, area, top, tick, end, labels, looped ? 0.3 : index % 2 ? 0.07 : 0.13);
    context.strokeStyle = this.theme.muted;
    context.lineWidth = 1;
    context.setLineDash([2, 3]);
    context.beginPath();
    line(context, area.x(tick), top, area.x(tick), area.bottom);
    context.stroke();
    context.setLineDash([]);
  }

  /** A stretch of time with the longest of its labels that has room. */
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
