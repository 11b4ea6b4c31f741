/** Drawing on the map: the tool in hand, pointer and keys, what is selected. Every change goes through the store. */

import { figure, texts } from "../../../viz/page/assets/language/language.js";
import { Observable } from "../../../viz/page/assets/common/observable.js";
import { JobTool } from "../jobs/tool.js";
import { RobotTool } from "../robots/tool.js";
import { PickTool } from "./backdrop.js";
import { groundOf } from "./ground.js";
import { Hits } from "./hits.js";
import { MeasureTool } from "./measure_tool.js";
import { LaneTool, MarkTool, VertexTool } from "./network_tools.js";
import { isNetwork } from "./network.js";
import { paintFaults, paintJobs, paintSelection } from "./overlay.js";
import { paintReadout, paintRulers } from "./readout.js";
import { Selection } from "./selection.js";
import { SelectTool } from "./select_tool.js";
import { BoxTool, BrushTool, DoorTool, EraseTool, LineTool } from "./cell_tools.js";
import { present } from "../given.js";
/** @import { ScenarioStore } from "../document.js" */
/** @import { Stage } from "../stage.js" */
/** @import { DrawingPoint, Item, Point, PointedAt, Span, Tool, ToolMap } from "../types.js" */

const LONG_PRESS = 550; // milliseconds that a finger rests for a menu
const WAVERING = 10; // pixels that a resting finger may move
/** @type {Record<string, Point>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** Events: `editor` when tool, selection or what is drawn at the moment changes. */
export class Editor extends Observable {
  /**
   * @param {ScenarioStore} store
   * @param {Stage} stage
   */
  constructor(store, stage) {
    super();
    this.store = store;
    this.stage = stage;
    this.selection = new Selection();
    /** @type {DrawingPoint | null} */
    this.cursor = null; // of the keyboard, in units of the drawing
    /** @type {PointedAt | null} */
    this.over = null; // where the pointer is over the map, in units of the drawing
    /** @type {{x: number, y: number, point: DrawingPoint} | null} */
    this.menu = null; // what can be done at a place of the page, and of the drawing
    /** @type {((context: CanvasRenderingContext2D, scale: number) => void) | null} */
    this.done = null; // paints what was drawn until the library has looked at it
    this.isOn = true;
    this.message = "";
    const tools = [
      SelectTool,
      BrushTool,
      BoxTool,
      LineTool,
      DoorTool,
      EraseTool,
      VertexTool,
      LaneTool,
      MarkTool,
      RobotTool,
      JobTool,
      MeasureTool,
      PickTool,
    ];
    /** @type {Map<string, Tool>} */
    const made = new Map();
    for (const Made of tools) made.set(Made.called, new Made(this));
    this.tools = /** @type {ToolMap} */ (made);
    /** @type {Tool} */
    this.tool = this.tools.get("select");
    store.on("survey", () => (this.done = null));
    store.on("document", () => this.#forget());
    stage.on("overlay", () => this.#paint());
    this.#listen(stage.holder);
  }

  /** @type {Hits | null} */
  #hits = null;
  /** @type {Map<number, PointerEvent>} */
  #touches = new Map();
  /** @type {number | null} */
  #held = null; // the pointer that the tool follows
  #panning = false;
  /** @type {ReturnType<typeof setTimeout> | undefined} */
  #resting = undefined; // the timer of a finger that rests

  /** Whether there is a map that can be drawn on. */
  get isReady() {
    return this.isOn && Boolean(this.store.site && this.stage.view);
  }

  get document() {
    return this.store.document;
  }

  get roadmap() {
    return this.stage.plan.roadmap;
  }

  /** What can be blocked and freed, or null. */
  get ground() {
    return groundOf(this.document, this.roadmap);
  }

  /** The tools that fit the map: names, in order. */
  get fitting() {
    const { document } = this;
    const cells =
      document.map.grid || document.map.floor ? ["line", "brush", "box", "door", "erase"] : [];
    const lanes = isNetwork(document) ? ["vertex", "lane", "mark"] : [];
    return ["select", ...cells, ...lanes, "robot", "job", "measure"];
  }

  /**
   * What is where, in the document as it is drawn.
   * @returns {Hits}
   */
  get hits() {
    if (this.#hits?.document !== this.document || this.#hits.roadmap !== this.roadmap)
      this.#hits = new Hits(this.document, this.roadmap);
    return this.#hits;
  }

  /**
   * @param {string} name
   * @returns {void}
   */
  take(name) {
    if (!this.fitting.includes(name)) return;
    this.tool.cancel();
    this.tool.leave?.();
    this.tool = this.tools.get(name);
    this.say("");
  }

  /**
   * Say what happens next, or what was done.
   * @param {string} message
   * @returns {void}
   */
  say(message) {
    this.message = message;
    this.changed();
  }

  changed() {
    this.stage.ask();
    this.tell("editor");
  }

  /**
   * The vertex at a point of the drawing, near enough to be meant, or -1.
   * @param {{x: number, y: number}} point
   * @returns {number}
   */
  vertexAt({ x, y }) {
    return this.hits.vertexAt(x, y, this.stage.view.viewport.scale);
  }

  /**
   * @param {Item[]} items
   * @returns {void}
   */
  select(items) {
    this.selection.set(items);
    const [robot] = this.selection.of("robot");
    if (this.isReady)
      this.stage.choice.chooseRobot(
        present(this.store.site).robots.findIndex(({ index }) => index === robot),
      );
    this.changed();
  }

  remove() {
    this.tools.get("select").remove();
  }

  /** A document that was undone may lack what was selected. */
  #forget() {
    const { robots, jobs } = this.document;
    const counts = { robot: robots, job: jobs };
    this.selection.set(
      this.selection.items.filter(({ kind, id }) => {
        if (kind !== "robot" && kind !== "job") return true;
        const { [kind]: list } = counts;
        return id < (Array.isArray(list) ? list.length : 0);
      }),
    );
    this.changed();
  }

  /**
   * @param {HTMLElement} holder
   * @returns {void}
   */
  #listen(holder) {
    /**
     * @template {keyof HTMLElementEventMap} Name
     * @param {Name} name
     * @param {(event: HTMLElementEventMap[Name]) => unknown} action
     * @returns {void}
     */
    const on = (name, action) =>
      holder.addEventListener(name, (event) => this.isReady && action(event), true);
    on("pointerdown", (event) => this.#down(event));
    on("pointermove", (event) => this.#move(event));
    on("pointerup", (event) => this.#up(event));
    on("pointercancel", (event) => this.#drop(event));
    on("keydown", (event) => this.#key(event));
    on("contextmenu", (event) => this.#ask(/** @type {PointerEvent} */ (event)));
    on("pointerleave", (event) => event.target === holder && this.#leave());
    on("keyup", (event) => event.key === "Tab" && this.#showFocus(true));
    document.addEventListener(
      "keyup",
      (event) => event.code === "Space" && (this.#panning = false),
    );
  }

  /** Nothing is pointed at any more. */
  #leave() {
    this.over = null;
    this.tool.leave?.();
    this.stage.ask();
  }

  /**
   * A frame round the map tells who works with keys that it has the focus.
   * @param {boolean} isShown
   * @returns {void}
   */
  #showFocus(isShown) {
    this.stage.holder.classList.toggle("by-keys", isShown);
  }

  /**
   * Where an event is on the map: Shift for more of it, Ctrl for just there, Alt for a copy.
   * @param {PointerEvent} event
   * @returns {PointedAt}
   */
  #point(event) {
    const { left, top } = this.stage.holder.getBoundingClientRect();
    const { viewport } = this.stage.view;
    const screen = { x: event.clientX - left, y: event.clientY - top };
    this.over = { x: viewport.toX(screen.x), y: viewport.toY(screen.y), screen };
    return {
      ...this.over,
      isMore: event.shiftKey,
      isFree: event.ctrlKey || event.metaKey,
      isCopy: event.altKey,
      isTouch: event.pointerType === "touch",
    };
  }

  /**
   * The menu of a place, by the second button.
   * @param {PointerEvent} event
   * @returns {void}
   */
  #ask(event) {
    event.preventDefault();
    if (event.pointerType !== "touch" && !this.tool.isBusy)
      this.openMenu(event, this.#point(event));
  }

  /**
   * @param {{clientX: number, clientY: number}} at
   * @param {DrawingPoint} point
   * @returns {void}
   */
  openMenu({ clientX, clientY }, point) {
    const hit = this.hits.at(point, this.stage.view.viewport.scale);
    if (!hit) this.select([]);
    else if (!this.selection.has(hit)) this.select([hit]);
    this.menu = { x: clientX, y: clientY, point };
    this.changed();
  }

  /**
   * Begin a robot whose home is a vertex.
   * @param {number} vertex
   * @returns {void}
   */
  startRobot(vertex) {
    const { roadmap } = this;
    this.take("robot");
    this.tool.release({ x: roadmap.x[vertex], y: roadmap.y[vertex] });
    this.changed();
  }

  closeMenu() {
    this.menu = null;
    this.changed();
    this.stage.canvas.focus({ preventScroll: true });
  }

  /**
   * @param {PointerEvent} event
   * @returns {void}
   */
  #rest(event) {
    clearTimeout(this.#resting);
    if (event.pointerType !== "touch") return;
    const point = this.#point(event);
    this.#resting = setTimeout(() => {
      this.#abandon();
      this.openMenu(event, point);
    }, LONG_PRESS);
    this.#rested = { x: event.clientX, y: event.clientY };
  }

  #rested = { x: 0, y: 0 };

  /**
   * The first button and the first finger draw; the others, and two fingers, move the map.
   * @param {PointerEvent} event
   * @returns {void}
   */
  #down(event) {
    if (event.button !== 0 || this.#panning) return;
    event.stopPropagation();
    event.preventDefault();
    this.stage.canvas.focus({ preventScroll: true });
    this.#touches.set(event.pointerId, event);
    this.stage.holder.setPointerCapture(event.pointerId);
    if (this.#touches.size > 1) return this.#abandon();
    this.#held = event.pointerId;
    this.cursor = null;
    this.#showFocus(false);
    this.#rest(event);
    this.tool.press(this.#point(event));
    this.changed();
  }

  /**
   * @param {PointerEvent} event
   * @returns {void}
   */
  #move(event) {
    if (!this.#touches.has(event.pointerId)) {
      if (!event.buttons) this.#hover(event);
      return;
    }
    event.stopPropagation();
    const before = this.#span();
    this.#touches.set(event.pointerId, event);
    if (this.#touches.size > 1) return this.#pinch(before, this.#span());
    if (event.pointerId !== this.#held) return;
    const { x, y } = this.#rested;
    if (Math.hypot(event.clientX - x, event.clientY - y) > WAVERING) clearTimeout(this.#resting);
    this.tool.drag(this.#point(event));
    this.stage.ask();
  }

  /**
   * @param {PointerEvent} event
   * @returns {void}
   */
  #hover(event) {
    this.tool.hover(this.#point(event));
    this.stage.ask();
  }

  /**
   * @param {PointerEvent} event
   * @returns {void}
   */
  #up(event) {
    if (!this.#touches.delete(event.pointerId)) return;
    event.stopPropagation();
    clearTimeout(this.#resting);
    if (event.pointerId !== this.#held) return;
    this.#held = null;
    this.tool.release(this.#point(event));
    if (event.pointerType === "touch") this.over = null;
    this.changed();
  }

  /**
   * @param {PointerEvent} event
   * @returns {void}
   */
  #drop(event) {
    this.#touches.delete(event.pointerId);
    this.#abandon();
  }

  #abandon() {
    clearTimeout(this.#resting);
    this.#held = null;
    this.tool.cancel();
    this.changed();
  }

  /** @returns {Span | null} */
  #span() {
    const [one, two] = this.#touches.values();
    if (!two) return null;
    const { left, top } = this.stage.holder.getBoundingClientRect();
    return {
      x: (one.clientX + two.clientX) / 2 - left,
      y: (one.clientY + two.clientY) / 2 - top,
      length: Math.hypot(one.clientX - two.clientX, one.clientY - two.clientY),
    };
  }

  /**
   * @param {Span | null} before
   * @param {Span | null} after
   * @returns {void}
   */
  #pinch(before, after) {
    if (!before || !after) return;
    const { viewport } = this.stage.view;
    viewport.pan(after.x - before.x, after.y - before.y);
    viewport.zoom(after.length / before.length, after.x, after.y);
  }

  /**
   * Arrow keys move a cursor; Enter does there what the pointer does, press and release in turn.
   * @param {KeyboardEvent} event
   * @returns {void}
   */
  #key(event) {
    const arrow = ARROWS[event.key];
    if (event.ctrlKey || event.metaKey || (event.altKey && !arrow)) return;
    const isNudge = arrow && this.selection.size && (!this.cursor || event.altKey);
    if (isNudge) this.tools.get("select").nudge(arrow, event.shiftKey);
    else if (arrow) this.#moveCursor(arrow, event.shiftKey);
    else if (event.key === "ContextMenu" || (event.key === "F10" && event.shiftKey))
      this.#askAtCursor();
    else if (event.key === "Enter" && this.cursor) this.#pressAtCursor();
    else if (event.key === "Delete" || event.key === "Backspace") this.remove();
    else if (event.key === "Escape") this.escape();
    else if (event.code === "Space") this.#panning = true;
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Give up what has begun; else select nothing; else take the tool that selects. */
  escape() {
    if (this.tool.isBusy) this.tool.cancel();
    else if (this.selection.size) this.select([]);
    else if (this.cursor) {
      this.cursor = null;
      this.#leave();
    } else this.take("select");
    this.say("");
  }

  /**
   * @param {Point} way
   * @param {boolean} isFar
   * @returns {void}
   */
  #moveCursor([right, down], isFar) {
    const { roadmap, stage } = this;
    this.#showFocus(true);
    const side = this.ground?.side ?? 1;
    const step = isFar ? 5 * side : side;
    if (this.cursor)
      this.cursor = { x: this.cursor.x + right * step, y: this.cursor.y + down * step };
    else this.cursor = roadmap.size ? { x: roadmap.x[0], y: roadmap.y[0] } : { x: 0, y: 0 };
    stage.view.viewport.show(this.cursor.x, this.cursor.y);
    if (this.tool.isBusy) this.tool.drag(this.cursor);
    else this.tool.hover(this.cursor);
    const vertex = this.vertexAt(this.cursor);
    this.say(
      vertex < 0
        ? this.#pointText(this.cursor)
        : [roadmap.label(vertex), roadmap.uses(vertex), ...this.hits.namesAt(vertex)]
            .filter(Boolean)
            .join(", "),
    );
  }

  /**
   * A point of the drawing in the frame of the site.
   *
   * @param {DrawingPoint} point
   */
  #pointText({ x: right, y: up }) {
    const { roadmap } = this.stage.plan;
    const [x, y] = roadmap.toSite(right, up);
    return texts.pair({ x: figure(x.toFixed(2)), y: figure(y.toFixed(2)) });
  }

  /** The menu of the cursor's place, or of what is selected. */
  #askAtCursor() {
    const [item] = this.selection.items;
    const vertex = item ? this.hits.vertexOf(item) : -1;
    const { roadmap, stage } = this;
    const point =
      this.cursor ?? (vertex >= 0 ? { x: roadmap.x[vertex], y: roadmap.y[vertex] } : this.over);
    if (!point) return;
    const { left, top } = stage.holder.getBoundingClientRect();
    const { viewport } = stage.view;
    this.openMenu(
      {
        clientX: left + viewport.left + point.x * viewport.scale,
        clientY: top + viewport.top + point.y * viewport.scale,
      },
      point,
    );
  }

  #pressAtCursor() {
    const cursor = present(this.cursor);
    if (this.tool.isBusy || !this.tool.isDrawn) {
      if (!this.tool.isBusy) this.tool.press(cursor);
      this.tool.release(cursor);
    } else this.tool.press(cursor);
    this.changed();
  }

  #paint() {
    if (!this.isReady) return;
    const { context, theme, view } = this.stage;
    const { scale } = view.viewport;
    paintJobs(context, this, scale);
    paintFaults(context, this, scale);
    this.done?.(context, scale);
    paintSelection(context, this, scale);
    this.tool.paint(context, theme, scale);
    const { over } = this;
    paintRulers(context, this, over?.screen);
    const { measure } = this.tool;
    if (measure && over) paintReadout(context, this, measure, over.screen);
    const readout = (over && measure) || "";
    const { dataset } = this.stage.holder;
    if ((dataset.readout ?? "") !== readout) dataset.readout = readout; // for whom does not see it
    if (!this.cursor) return;
    const side = this.ground?.side ?? 24 / scale;
    context.strokeStyle = theme.ink;
    context.lineWidth = 2 / scale;
    context.strokeRect(this.cursor.x - side / 2, this.cursor.y - side / 2, side, side);
  }
}
