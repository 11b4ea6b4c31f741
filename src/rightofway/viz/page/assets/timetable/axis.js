import { fraction, product } from "../language/quantities.js";
import { line, shortened } from "../drawing/shapes.js";

/** @import { Fraction } from "../language/quantities.js" */
/** @import { Plan } from "../plan/plan.js" */
/** @import { Theme } from "../drawing/theme.js" */
/** @import { Words } from "../language/words.js" */

export const AXIS_HEIGHT = 20;
const LABEL_GAP = 72; // pixels between two labelled moments, at least
const MARK_GAP = 5; // pixels between two ticks that have marks, at least

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

/** Round numbers: the digits 1, 2 and 5 with zeros. */
const ROUND = Array.from({ length: 18 }, (_, k) => k - 3).flatMap((power) =>
  [1, 2, 5].map((digit) => Number(`${digit}e${power}`)),
);

/** @param {Fraction} options */
const isWhole = ([top, bottom]) => top % bottom === 0n;

/**
 * Ticks between two labels: a round time, which is a whole number of ticks where these have marks.
 *
 * @param {number} least
 * @param {Pick<Plan, "tick" | "quantities">} plan
 * @param {boolean} hasMarks
 * @returns {Fraction}
 */
export function labelStep(least, { tick, quantities }, hasMarks) {
  const [top, bottom] = quantities.seconds ?? [1n, 1n];
  /** @type {Fraction} */
  const perTime = [BigInt(tick.denominator) * bottom, BigInt(tick.numerator) * top];
  const times = quantities.seconds
    ? [...ROUND.filter((time) => time < 10), ...ROUND_SECONDS]
    : ROUND;
  /** @param {Fraction} ticks */
  const fits = (ticks) =>
    Number(ticks[0]) / Number(ticks[1]) >= least && (!hasMarks || isWhole(ticks));
  return (
    times.map((time) => product(fraction(time), perTime)).find(fits) ??
    ROUND.map(fraction).find((ticks) => fits(ticks) && isWhole(ticks)) ?? [1n, 1n]
  );
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
  const perTick = (area.right - area.left) / area.end;
  const hasMarks = perTick >= MARK_GAP;
  const [top, bottom] = labelStep(LABEL_GAP / perTick, plan, hasMarks);
  const step = Number(top) / Number(bottom);
  const moments = Array.from({ length: Math.floor(area.end / step) + 1 }, (_, k) => ({
    tick: k * step,
    exact: `${BigInt(k) * top}/${bottom}`,
  }));
  context.strokeStyle = theme.line;
  context.lineWidth = 1;
  context.beginPath();
  for (const { tick } of moments) line(context, area.x(tick), area.top, area.x(tick), area.bottom);
  if (hasMarks) {
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
  for (const { tick, exact } of moments) {
    const label = words.time(exact);
    // The last label may use 12 pixels next to the diagram.
    const last = area.right + 12 - context.measureText(label).width / 2;
    context.fillText(label, Math.min(area.x(tick), last), area.bottom + 6);
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
