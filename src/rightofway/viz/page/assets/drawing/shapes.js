/** @import { Box } from "./label_board.js" */
/** @import { Theme } from "./theme.js" */

/**
 * @param {CanvasPath} context
 * @param {number} fromX
 * @param {number} fromY
 * @param {number} toX
 * @param {number} toY
 */
export function line(context, fromX, fromY, toX, toY) {
  context.moveTo(fromX, fromY);
  context.lineTo(toX, toY);
}

/**
 * A point in a path that is stroked with round caps.
 *
 * @param {CanvasPath} path
 * @param {number} x
 * @param {number} y
 */
export function dot(path, x, y) {
  line(path, x, y, x + 1e-4, y); // a line of no length need not be drawn
}

/**
 * An arrow head with its middle at a point, in the present stroke.
 *
 * @param {CanvasPath} context
 * @param {number} x
 * @param {number} y
 * @param {number} angle
 * @param {number} size
 */
export function chevron(context, x, y, angle, size) {
  const [along, across] = [Math.cos(angle) * size, Math.sin(angle) * size];
  context.moveTo(x - along * 0.5 - across, y - across * 0.5 + along);
  context.lineTo(x + along * 0.5, y + across * 0.5);
  context.lineTo(x - along * 0.5 + across, y - across * 0.5 - along);
}

/**
 * A text at the present alignment, set apart from what is behind it.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {number} x
 * @param {number} y
 * @param {string} ink
 * @param {string} halo
 * @param {number} width
 */
export function haloed(context, text, x, y, ink, halo, width) {
  context.strokeStyle = halo;
  context.lineWidth = width;
  context.lineJoin = "round";
  context.strokeText(text, x, y);
  context.fillStyle = ink;
  context.fillText(text, x, y);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 */
export function disc(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.fill();
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 */
export function ring(context, x, y, radius) {
  context.beginPath();
  context.arc(x, y, radius, 0, 2 * Math.PI);
  context.stroke();
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 * @param {number} from
 * @param {number} to
 */
export function arc(context, x, y, radius, from, to) {
  context.beginPath();
  context.arc(x, y, radius, from, to);
  context.stroke();
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 * @param {number} side
 */
export function field(context, x, y, side) {
  context.beginPath();
  context.roundRect(x - side / 2, y - side / 2, side, side, side * 0.16);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} y
 * @param {number} radius
 */
export function diamond(context, x, y, radius) {
  context.beginPath();
  context.moveTo(x, y - radius);
  context.lineTo(x + radius, y);
  context.lineTo(x, y + radius);
  context.lineTo(x - radius, y);
  context.closePath();
}

/**
 * A triangle that points down from the top edge.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {number} x
 * @param {number} size
 */
export function pointer(context, x, size) {
  context.beginPath();
  context.moveTo(x - size, 0);
  context.lineTo(x + size, 0);
  context.lineTo(x, size * 1.4);
  context.fill();
}

/**
 * A box with stripes in the present colour, and filled where it is too small for them.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {number} left
 * @param {number} top
 * @param {number} width
 * @param {number} height
 */
export function stripes(context, left, top, width, height) {
  if (height < 5) {
    context.fillRect(left, top, width, height);
    return;
  }
  context.save();
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
  context.strokeStyle = context.fillStyle;
  context.lineWidth = 2;
  context.beginPath();
  for (let x = left - height; x < left + width; x += 5)
    line(context, x, top + height, x + height, top);
  context.stroke();
  context.restore();
}

/**
 * A cross in the present colour at the left, and a line from there on.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {number} left
 * @param {number} middle
 * @param {number} width
 * @param {number} height
 */
export function crossedOut(context, left, middle, width, height) {
  const reach = Math.max(Math.min(height / 2, 6), 2);
  context.fillRect(left, middle - 0.75, width, 1.5);
  context.save();
  context.strokeStyle = context.fillStyle;
  context.lineWidth = Math.max(reach * 0.5, 1.5);
  context.beginPath();
  line(context, left - reach, middle - reach, left + reach, middle + reach);
  line(context, left - reach, middle + reach, left + reach, middle - reach);
  context.stroke();
  context.restore();
}

/**
 * A text cut to fit a width, with an ellipsis.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {number} width
 */
export function shortened(context, text, width) {
  if (context.measureText(text).width <= width) return text;
  const share = width / context.measureText(text).width;
  return `${text.slice(0, Math.max(Math.floor(text.length * share) - 1, 1))}…`;
}

/**
 * A text in a ring that fills a box, as the sign of a limit.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {string} text
 * @param {Box} box
 * @param {Theme} theme
 */
export function ringed(context, text, [left, top, right, bottom], theme) {
  const [x, y] = [(left + right) / 2, (top + bottom) / 2];
  context.fillStyle = theme.paper;
  disc(context, x, y, (right - left) / 2);
  context.strokeStyle = theme.held;
  context.lineWidth = 1.75;
  ring(context, x, y, (right - left) / 2 - 1);
  context.fillStyle = theme.ink;
  context.textAlign = "center";
  context.fillText(text, x, y + 0.5);
}
