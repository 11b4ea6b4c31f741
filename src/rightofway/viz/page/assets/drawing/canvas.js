/** @typedef {{ width: number, height: number, ratio: number }} CanvasSize In CSS pixels, and how many finer ones each has. */

/** Finer than this, sharpness costs more than it shows. */
const MAX_PIXEL_RATIO = 2;

/**
 * Make a canvas as fine as the screen; returns its size in CSS pixels and whether that changed.
 *
 * @param {HTMLCanvasElement} canvas
 */
export function fitCanvas(canvas) {
  const ratio = Math.min(devicePixelRatio || 1, MAX_PIXEL_RATIO);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
  const changed = canvas.width !== wide || canvas.height !== high;
  if (changed) Object.assign(canvas, { width: wide, height: high });
  return { width, height, ratio, changed };
}

/**
 * The context that paints on a canvas.
 *
 * @param {HTMLCanvasElement} canvas
 */
export function contextOf(canvas) {
  const context = canvas.getContext("2d");
  if (!context) throw new Error("canvas: this browser paints no 2D pictures (use another one)");
  return context;
}

/** A picture of what rarely changes, kept off the screen and painted again only when it does. */
export class Layer {
  /** @param {(context: CanvasRenderingContext2D, width: number, height: number) => void} paint */
  constructor(paint) {
    this.canvas = document.createElement("canvas");
    this.context = contextOf(this.canvas);
    this.paint = paint;
    this.stale = true;
  }

  /**
   * Copy the picture onto another canvas of the given size.
   *
   * @param {CanvasRenderingContext2D} context
   * @param {CanvasSize} options
   */
  drawOn(context, { width, height, ratio }) {
    const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== wide || this.canvas.height !== high) {
      Object.assign(this.canvas, { width: wide, height: high });
      this.stale = true;
    }
    if (this.stale) this.#repaint(wide, high, ratio, width, height);
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.drawImage(this.canvas, 0, 0);
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  /**
   * @param {number} wide
   * @param {number} high
   * @param {number} ratio
   * @param {number} width
   * @param {number} height
   */
  #repaint(wide, high, ratio, width, height) {
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, wide, high);
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.paint(this.context, width, height);
    this.stale = false;
  }
}
