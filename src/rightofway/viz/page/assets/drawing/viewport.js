import { all, isEmbedded } from "../common/dom.js";
import { Observable } from "../common/observable.js";

/** @import { Roadmap } from "../plan/roadmap.js" */

const LARGEST_CELL = 400; // pixels
const LARGEST_FITTED = { cell: 190, edge: 320 }; // pixels; an edge that is as long as a unit
const LEGEND_HEIGHT = 34; // pixels below the map: scale bar, legends

/**
 * Which part of the map is shown, and how large. Dragging pans, wheel and two fingers zoom.
 * Events: `view` when it changes, `click` and `hover` with `pointer` in map units.
 */
export class Viewport extends Observable {
  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Roadmap} roadmap
   * @param {number} [reach]
   */
  constructor(canvas, roadmap, reach = 0) {
    super();
    this.canvas = canvas;
    this.roadmap = roadmap;
    this.reach = reach; // how far robots reach beyond the vertices they stand on [units]
    this.scale = 1; // pixels in a unit
    this.left = 0; // pixels from the canvas to the map's origin
    this.top = 0;
    this.fitted = true;
    this.border = 0; // pixels round the map that something else lies on
    this.pointer = { x: NaN, y: NaN };
    this.#touches = new Map();
    this.#listen();
  }

  /** @type {Map<number, { x: number, y: number }>} */
  #touches;
  #dragged = 0;

  /** @param {number} pixels */
  toX(pixels) {
    return (pixels - this.left) / this.scale;
  }

  /** @param {number} pixels */
  toY(pixels) {
    return (pixels - this.top) / this.scale;
  }

  /** Show the whole map: the cells of a grid to their borders, a roadmap with room for its marks. */
  fit() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const { rows, width: columns, height: lines } = this.roadmap;
    const beyond = 2 * Math.max(this.reach, rows ? 0.5 : 0);
    const [across, down] = [columns - 1 + beyond, lines - 1 + beyond];
    const margin = (rows ? 16 : 26) + this.border;
    const [title] = this.canvas.parentElement
      ? all(".map-title", HTMLElement, this.canvas.parentElement)
      : [];
    const above = Math.max(
      1.25 * margin,
      title?.textContent ? title.offsetTop + title.offsetHeight + 4 : 0,
    );
    const room = { width: width - 2 * margin, height: height - above - LEGEND_HEIGHT };
    const fitting = Math.min(
      room.width / Math.max(across, 1e-9),
      room.height / Math.max(down, 1e-9),
    );
    this.scale = Math.max(Math.min(fitting, LARGEST_FITTED[rows ? "cell" : "edge"]), 0.1);
    this.left = (width - (columns - 1) * this.scale) / 2;
    this.top = above + (room.height - (lines - 1) * this.scale) / 2;
    this.#changed(true);
  }

  /** The canvas has another size: keep the whole map in view, or what was in the middle. */
  resized() {
    if (this.fitted) this.fit();
    else this.#changed(false);
  }

  /**
   * Zoom by a factor round a point of the canvas, or its middle.
   *
   * @param {number} factor
   * @param {number} [x]
   * @param {number} [y]
   */
  zoom(factor, x = this.canvas.clientWidth / 2, y = this.canvas.clientHeight / 2) {
    const scale = Math.min(Math.max(this.scale * factor, 0.5), LARGEST_CELL);
    this.left = x - ((x - this.left) * scale) / this.scale;
    this.top = y - ((y - this.top) * scale) / this.scale;
    this.scale = scale;
    this.#changed(false);
  }

  /**
   * @param {number} right
   * @param {number} down
   */
  pan(right, down) {
    this.left += right;
    this.top += down;
    this.#changed(false);
  }

  /**
   * Bring a point into the middle unless it is in sight.
   *
   * @param {number} x
   * @param {number} y
   */
  show(x, y) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const [right, down] = [this.left + x * this.scale, this.top + y * this.scale];
    if (right < 0 || right > width || down < 0 || down > height)
      this.pan(width / 2 - right, height / 2 - down);
  }

  /**
   * Bring several points into sight: as they are if they all are, else their middle, smaller if need be.
   *
   * @param {[number, number][]} points
   */
  showAll(points) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    const [xs, ys] = [points.map(([x]) => x), points.map(([, y]) => y)];
    const [left, top, right, bottom] = [
      Math.min(...xs),
      Math.min(...ys),
      Math.max(...xs),
      Math.max(...ys),
    ];
    const isInSight =
      left >= this.toX(20) &&
      right <= this.toX(width - 20) &&
      top >= this.toY(20) &&
      bottom <= this.toY(height - 20);
    if (isInSight) return;
    const fitting = Math.min(
      (width - 80) / Math.max(right - left, 1e-9),
      (height - 80) / Math.max(bottom - top, 1e-9),
    );
    this.scale = Math.min(this.scale, fitting);
    this.left = width / 2 - ((left + right) / 2) * this.scale;
    this.top = height / 2 - ((top + bottom) / 2) * this.scale;
    this.#changed(false);
  }

  /** @param {boolean} fitted */
  #changed(fitted) {
    this.fitted = fitted;
    this.canvas.classList.toggle("zoomed", !fitted);
    this.tell("view");
  }

  #listen() {
    const { canvas } = this;
    canvas.addEventListener("wheel", (event) => this.#wheel(event), { passive: false });
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointercancel", (event) => this.#touches.delete(event.pointerId));
    canvas.addEventListener("mousedown", (event) => event.preventDefault()); // or arrow keys would pan from now on
    canvas.addEventListener("keydown", (event) => this.#key(event));
    canvas.addEventListener("pointerleave", () => this.#point(NaN, NaN));
  }

  /**
   * Inside another page the wheel scrolls that page, unless Ctrl is held.
   *
   * @param {WheelEvent} event
   */
  #wheel(event) {
    if (isEmbedded(this.canvas) && !event.ctrlKey) return;
    event.preventDefault();
    const pace = event.deltaMode ? 0.05 : event.ctrlKey ? 0.01 : 0.0016; // by lines, by two fingers, by pixels
    this.zoom(Math.exp(-event.deltaY * pace), event.offsetX, event.offsetY);
  }

  /**
   * Arrow keys pan while the map has the focus.
   *
   * @param {KeyboardEvent} event
   */
  #key(event) {
    /** @type {Record<string, [number, number]>} */
    const steps = {
      ArrowLeft: [60, 0],
      ArrowRight: [-60, 0],
      ArrowUp: [0, 60],
      ArrowDown: [0, -60],
    };
    const step = steps[event.key];
    if (!step || event.shiftKey) return;
    event.preventDefault();
    event.stopPropagation();
    this.pan(...step);
  }

  /** @param {PointerEvent} event */
  #down(event) {
    this.canvas.setPointerCapture(event.pointerId);
    this.#touches.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    if (this.#touches.size === 1) this.#dragged = 0;
    this.#point(event.offsetX, event.offsetY); // a finger that presses has not moved there
  }

  /** @param {PointerEvent} event */
  #move(event) {
    const touch = this.#touches.get(event.pointerId);
    this.#point(event.offsetX, event.offsetY);
    if (!touch) return;
    const before = this.#span();
    const [right, down] = [event.offsetX - touch.x, event.offsetY - touch.y];
    Object.assign(touch, { x: event.offsetX, y: event.offsetY });
    this.#dragged += Math.abs(right) + Math.abs(down);
    if (this.#dragged < 4) return;
    this.canvas.classList.add("panning");
    const share = 1 / this.#touches.size;
    this.pan(right * share, down * share);
    const after = this.#span();
    if (before.length && after.length) this.zoom(after.length / before.length, after.x, after.y);
  }

  /** @param {PointerEvent} event */
  #up(event) {
    this.#touches.delete(event.pointerId);
    this.canvas.classList.remove("panning");
    if (this.#dragged < 4) this.tell("click");
  }

  /** Middle and distance of two fingers; no length with one. */
  #span() {
    const [one, two] = this.#touches.values();
    if (!two) return { length: 0 };
    return {
      length: Math.hypot(one.x - two.x, one.y - two.y),
      x: (one.x + two.x) / 2,
      y: (one.y + two.y) / 2,
    };
  }

  /**
   * @param {number} x
   * @param {number} y
   */
  #point(x, y) {
    this.pointer = { x: this.toX(x), y: this.toY(y) };
    this.tell("hover");
  }
}
