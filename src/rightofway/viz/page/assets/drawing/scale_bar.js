import { texts } from "../language/language.js";
import { haloed } from "./shapes.js";

/** @import { Site } from "../plan/site.js" */
/** @import { Theme } from "./theme.js" */
/** @import { Viewport } from "./viewport.js" */

export const LONGEST_BAR = 130; // pixels
const LIMIT_NOTED = 480; // pixels; a narrower map has no room for the usual speed limit

/**
 * The longest round length that the longest bar has room for [length unit].
 *
 * @param {number} perPixel
 */
export function roundLength(perPixel) {
  const most = LONGEST_BAR * perPixel;
  const power = 10 ** Math.floor(Math.log10(most));
  return ([5, 2].find((digit) => digit * power <= most) ?? 1) * power;
}

/**
 * How long a length is on the map, at its lower right corner, and the speed limit where no sign says another.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {number} width
 * @param {number} height
 * @param {Site} plan
 * @param {Viewport} options
 * @param {Theme} theme
 */
export function paintScaleBar(context, width, height, plan, { scale }, theme) {
  const length = roundLength(plan.roadmap.unit / scale);
  const wide = (length / plan.roadmap.unit) * scale;
  const [right, bottom] = [width - 18, height - 10];
  const trace = () => {
    context.beginPath();
    context.moveTo(right - wide, bottom - 5);
    context.lineTo(right - wide, bottom);
    context.lineTo(right, bottom);
    context.lineTo(right, bottom - 5);
    context.stroke();
  };
  context.lineJoin = "miter";
  context.strokeStyle = theme.paper;
  context.lineWidth = 4;
  trace();
  context.strokeStyle = theme.muted;
  context.lineWidth = 1.5;
  trace();
  context.font = theme.font(12 * theme.zoom);
  context.textAlign = "right";
  context.textBaseline = "bottom";
  haloed(
    context,
    plan.quantities.length(Number(length.toPrecision(1))),
    right,
    bottom - 6,
    theme.ink,
    theme.paper,
    3,
  );
  const { usualLimit } = plan.roadmap;
  if (!usualLimit || width < LIMIT_NOTED) return;
  haloed(
    context,
    texts.usualLimit({ speed: plan.quantities.speed(usualLimit) }),
    right - wide - 20,
    bottom + 2,
    theme.muted,
    theme.paper,
    3,
  );
}
