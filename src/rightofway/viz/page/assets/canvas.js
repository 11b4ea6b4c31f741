/** Finer than this, sharpness costs more than it shows. */
const MAX_PIXEL_RATIO = 2;

/** Make a canvas as fine as the screen; returns its size in CSS pixels and whether that changed. */
export function fitCanvas(canvas) {
  const ratio = Math.min(devicePixelRatio || 1, MAX_PIXEL_RATIO);
  const [width, height] = [canvas.clientWidth, canvas.clientHeight];
  const [wide, high] = [Math.round(width * ratio), Math.round(height * ratio)];
  const changed = canvas.width !== wide || canvas.height !== high;
  if (changed) Object.assign(canvas, { width: wide, height: high });
  return { width, height, ratio, changed };
}

/** A picture of what rarely changes, kept off the screen and painted again only when it does. */
export class Layer {
  constructor(paint) {
    this.canvas = document.createElement("canvas");
    this.context = this.canvas.getContext("2d");
    this.paint = paint;
    this.paintings = 0;
    this.stale = true;
  }

  /** Copy the picture onto another canvas of the given size. */
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

  #repaint(wide, high, ratio, width, height) {
    this.context.setTransform(1, 0, 0, 1, 0, 0);
    this.context.clearRect(0, 0, wide, high);
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.paint(this.context, width, height);
    this.stale = false;
    this.paintings++;
  }
}
