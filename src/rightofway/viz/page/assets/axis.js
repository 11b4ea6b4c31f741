import { line, shortened } from "./shapes.js";

/** @import { Plan } from "./plan.js" */
/** @import { Theme } from "./theme.js" */
/** @import { Words } from "./words.js" */

export const AXIS_HEIGHT = 20;
const LABEL_GAP = 72; // pixels between two labelled moments, at least

/** Where a diagram is painted, and where a tick is on it. Slider and diagrams share its ends. */
export class Area {
  /**
   * @param {Element} top whose style says how far from its sides
   * @param {number} width
   * @param {number} height
   * @param {number} end
   * @param {number} [above]
   * @param {number} [below]
   */
  constructor(top, width, height, end, above = 0, below = AXIS_HEIGHT) {
    const style = getComputedStyle(top);
    this.left = Number.parseFloat(style.getPropertyValue("--gutter"));
    this.right = width - Number.parseFloat(style.getPropertyValue("--pad"));
    this.top = 8 + above;
    this.bottom = height - below;
    this.end = end;
  }

  get height() {
    return this.bottom - this.top;
  }

  /** @param {number} tick */
  x(tick) {
    return (
      this.left + ((tick === Infinity ? this.end : tick) / this.end) * (this.right - this.left)
    );
  }

  /** @param {number} x */
  tick(x) {
    return ((x - this.left) / (this.right - this.left)) * this.end;
  }
}

/** Times between labels, from ten seconds on. */
const ROUND_SECONDS = [10, 20, 30, 60, 120, 300, 600, 1200, 1800, 3600, 7200, 18000, 36000, 86400];

/**
 * Ticks between two labels: a round time where that is a whole number of ticks.
 *
 * @param {Area} area
 * @param {Plan} plan
 */
function labelStep(area, plan) {
  const least = (LABEL_GAP / (area.right - area.left)) * area.end;
  const perUnit = plan.tick.denominator / plan.tick.numerator;
  const round = [];
  for (let power = -3; power < 15; power++)
    for (const digit of [1, 2, 5]) round.push(digit * 10 ** power);
  /** @param {number} ticks */
  const whole = (ticks) => Math.abs(ticks - Math.round(ticks)) < 1e-6 && ticks >= least;
  const { seconds } = plan.quantities;
  const inUnit = seconds ? Number(seconds[0]) / Number(seconds[1]) : 1;
  const times = seconds
    ? [...round.filter((time) => time < 10), ...ROUND_SECONDS].map((time) => time / inUnit)
    : round;
  return Math.max(times.map((units) => units * perUnit).find(whole) ?? round.find(whole) ?? 1, 1);
}

/**
 * Moments along the bottom, with hairlines up through the diagram; without labels, these alone.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {Area} area
 * @param {Plan} plan
 * @param {Theme} theme
 * @param {Words} words
 * @param {boolean} [hasLabels]
 */
export function paintAxis(context, area, plan, theme, words, hasLabels = true) {
  const step = Math.round(labelStep(area, plan));
  const perTick = (area.right - area.left) / area.end;
  context.strokeStyle = theme.line;
  context.lineWidth = 1;
  context.beginPath();
  for (let tick = 0; tick <= area.end; tick += step) {
    line(context, area.x(tick), area.top, area.x(tick), area.bottom);
  }
  if (perTick >= 5) {
    for (let tick = 0; tick <= area.end; tick++) {
      line(context, area.x(tick), area.bottom, area.x(tick), area.bottom + 4);
    }
  }
  line(context, area.left, area.bottom, area.right, area.bottom);
  context.stroke();
  if (!hasLabels) return;
  context.font = theme.font(11.5);
  context.fillStyle = theme.muted;
  context.textBaseline = "top";
  context.textAlign = "center";
  for (let tick = 0; tick <= area.end; tick += step) {
    context.fillText(words.time(tick), area.x(tick), area.bottom + 6);
  }
}

/**
 * Names along the left, as many as have room.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {Area} area
 * @param {Theme} theme
 * @param {string[]} names
 * @param {number} rowHeight
 * @param {(row: number) => number} middle
 */
export function paintRowNames(context, area, theme, names, rowHeight, middle) {
  const every = Math.max(Math.ceil(13 / rowHeight), 1);
  context.font = theme.font(Math.min(Math.max(rowHeight * 0.72, 10.5), 12.5));
  context.fillStyle = theme.muted;
  context.textAlign = "right";
  context.textBaseline = "middle";
  for (let row = 0; row < names.length; row += every) {
    context.fillText(
      shortened(context, names[row], area.left - 34),
      area.left - 12,
      middle(row) + 0.5,
    );
  }
}
