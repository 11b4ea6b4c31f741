/** Numbers at the pointer and rulers along the map, in the length unit of the scenario. */

import { figure } from "../../../viz/page/assets/language/language.js";
import { rounded } from "./places.js";
/** @import { Stage } from "../stage.js" */
/** @import { Point } from "../types.js" */
/** @import { Editor } from "./editor.js" */

export const RULER = 18; // pixels that a ruler is wide
const GAP = 64; // pixels between two numbers of a ruler, at least
const LARGE = 2000; // pixels of a map from which on its texts are larger

/**
 * A length as people read it.
 * @param {Editor} editor
 * @param {number} length
 * @returns {string}
 */
export const lengthText = ({ stage }, length) =>
  stage.plan.quantities.length(rounded(Number(length.toFixed(3))));

/**
 * How far something went: along both axes, and straight.
 * @param {Editor} editor
 * @param {Point} way
 * @returns {string}
 */
export function wayText(editor, [right, up]) {
  const straight = Math.hypot(right, up);
  const [x, y, way] = [right, up, straight].map((length) => lengthText(editor, length));
  return Math.abs(right) < 1e-9 || Math.abs(up) < 1e-9 ? way : `${way}  (${x}, ${y})`;
}

/**
 * A text in a pill, right below a point of the screen [pixels], inside of the map.
 * @param {CanvasRenderingContext2D} context
 * @param {Editor} editor
 * @param {string} text
 * @param {{x: number, y: number}} at
 * @returns {void}
 */
export function paintReadout(context, { stage }, text, { x, y }) {
  const { canvas, ratio } = screenOf(context, stage);
  const { theme } = stage;
  const size = sizeOf(canvas);
  context.save();
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.font = theme.font(size, 600);
  const width = context.measureText(text).width + 16;
  const height = size + 12;
  const left = Math.min(x + 16, canvas.clientWidth - width - 4);
  const top = y + 18 + height > canvas.clientHeight ? y - 12 - height : y + 18;
  context.fillStyle = theme.ink;
  context.beginPath();
  context.roundRect(left, top, width, height, 6);
  context.fill();
  context.fillStyle = theme.paper;
  context.textBaseline = "middle";
  context.textAlign = "left";
  context.fillText(text, left + 8, top + height / 2 + 0.5);
  context.restore();
}

/**
 * @param {{clientWidth: number}} canvas
 * @returns {number}
 */
const sizeOf = ({ clientWidth }) => (clientWidth > LARGE ? 18 : 13);

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Stage} stage
 * @returns {{canvas: HTMLCanvasElement, ratio: number}}
 */
function screenOf(context, { view }) {
  const { canvas } = view.viewport;
  return { canvas, ratio: context.canvas.width / canvas.clientWidth };
}

/**
 * Rulers along the upper and the left border, with marks where the pointer is.
 * @param {CanvasRenderingContext2D} context
 * @param {Editor} editor
 * @param {{x: number, y: number} | undefined} pointer
 * @returns {void}
 */
export function paintRulers(context, { stage }, pointer) {
  const { roadmap, viewport } = stage.view;
  if (roadmap.frame.yaw) return; // its axes are not the screen's
  const { canvas, ratio } = screenOf(context, stage);
  const { theme } = stage;
  const { clientWidth: width, clientHeight: height } = canvas;
  const size = sizeOf(canvas) - 3;
  const band = Math.max(RULER, size + 8);
  context.save();
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.globalAlpha = 0.92;
  context.fillStyle = theme.panel;
  context.fillRect(0, 0, width, band);
  context.fillRect(0, 0, band, height);
  context.globalAlpha = 1;
  context.strokeStyle = theme.line;
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(band, band + 0.5);
  context.lineTo(width, band + 0.5);
  context.moveTo(band + 0.5, band);
  context.lineTo(band + 0.5, height);
  context.stroke();
  context.fillStyle = theme.muted;
  context.strokeStyle = theme.muted;
  context.font = theme.font(size);
  context.beginPath();
  const perPixel = roadmap.unit / viewport.scale;
  const step = roundLength(GAP * perPixel);
  context.textBaseline = "middle";
  context.textAlign = "left";
  const [fromX, fromY] = roadmap.toSite(viewport.toX(band), viewport.toY(band));
  const [toX, toY] = roadmap.toSite(viewport.toX(width), viewport.toY(height));
  for (const [value, isWhole] of ticks(fromX, toX, step)) {
    const at = band + (value - fromX) / perPixel;
    context.moveTo(at, isWhole ? band - 7 : band - 4);
    context.lineTo(at, band);
    if (isWhole) context.fillText(shortNumber(value, step), at + 3, band / 2);
  }
  const sign = toY > fromY ? 1 : -1;
  for (const [value, isWhole] of ticks(Math.min(fromY, toY), Math.max(fromY, toY), step)) {
    const at = band + (sign * (value - fromY)) / perPixel;
    context.moveTo(isWhole ? band - 7 : band - 4, at);
    context.lineTo(band, at);
    if (!isWhole) continue;
    context.save();
    context.translate(band / 2, at - 3);
    context.rotate(-Math.PI / 2);
    context.fillText(shortNumber(value, step), 0, 0);
    context.restore();
  }
  context.stroke();
  if (pointer) {
    context.fillStyle = theme.held;
    context.fillRect(pointer.x - 0.75, 0, 1.5, band);
    context.fillRect(0, pointer.y - 0.75, band, 1.5);
  }
  context.fillStyle = theme.panel;
  context.fillRect(0, 0, band, band);
  context.restore();
}

/**
 * The least of 1, 2, 5, 10, ... that is not below a length.
 * @param {number} least
 * @returns {number}
 */
function roundLength(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return ([1, 2, 5].find((digit) => digit * power >= least * (1 - 1e-9)) ?? 10) * power;
}

/**
 * Values between two, five in a step, and whether each is a whole step.
 * @param {number} from
 * @param {number} to
 * @param {number} step
 * @returns {Generator<[number, boolean]>}
 */
function* ticks(from, to, step) {
  const small = step / 5;
  for (let i = Math.ceil(from / small - 1e-9); i * small <= to; i++) yield [i * small, i % 5 === 0];
}

/**
 * @param {number} value
 * @param {number} step
 * @returns {string}
 */
function shortNumber(value, step) {
  const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  return figure(value.toFixed(digits).replace(/^-(0(\.0+)?)$/, "$1"));
}
