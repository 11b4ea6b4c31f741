/** Tools for walls: brush, box, line, door, eraser. They collect cells while they are drawn. */

import { words } from "../words.js";
import { cellsOfBox, cellsOfLine } from "./ground.js";
import { AXES } from "./places.js";
import { lengthText } from "./readout.js";
import { guidesOfCell, paintGuides } from "./snapping.js";
import { present } from "../given.js";
/** @import { Theme } from "../../../viz/page/assets/drawing/theme.js" */
/** @import { Cell, DrawingPoint, Ground, ScenarioDocument } from "../types.js" */
/** @import { Editor } from "./editor.js" */

/** A tool that collects cells from press to release, and then changes them. */
class CellTool {
  isDrawn = true; // from a place to another one, with the keyboard too
  isWhole = false; // whether all cells between both ends are meant
  keeps = false; // whether the cells are kept that it was dragged over before
  frees = false;
  /** @type {Cell | null} */
  start = null;
  /** @type {Cell | null} */
  end = null; // the cell that was reached last
  /** @type {Cell | null} */
  over = null; // the cell below the pointer

  /** @param {Editor} editor */
  constructor(editor) {
    this.editor = editor;
    /** @type {Map<string, Cell>} */
    this.cells = new Map();
  }

  /** The ground that is drawn on: without one, such a tool is not taken. */
  get ground() {
    return present(this.editor.ground);
  }

  get isBusy() {
    return this.start !== null;
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  press(point) {
    const cell = this.ground.cellAt(point.x, point.y);
    this.cells = new Map();
    this.start = this.end = cell;
    this.#reach(cell);
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  drag(point) {
    if (this.start) {
      const cell = this.aimed(this.ground.cellAt(point.x, point.y), point);
      const [column, row] = present(this.end);
      if (cell[0] !== column || cell[1] !== row) this.#reach(cell);
    }
    this.hover(point);
  }

  /**
   * The cell that is meant by the one below the pointer.
   * @type {(cell: Cell, point: DrawingPoint) => Cell}
   */
  aimed(cell) {
    return cell;
  }

  /**
   * The cells that a drag from one cell to another one adds.
   * @param {Cell} _from
   * @param {Cell} cell
   * @returns {Cell[]}
   */
  collect(_from, cell) {
    return [cell];
  }

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  hover(point) {
    this.over = this.editor.ground?.cellAt(point.x, point.y) ?? null;
  }

  leave() {
    this.over = null;
  }

  /**
   * @param {Cell} cell
   * @returns {void}
   */
  #reach(cell) {
    const from = present(this.end);
    this.end = cell;
    if (this.isWhole) return; // its cells are those between both ends
    if (!this.keeps) this.cells.clear();
    this.#add(this.collect(from, cell));
  }

  /**
   * @param {Cell[]} cells
   * @returns {void}
   */
  #add(cells) {
    const { ground } = this;
    for (const each of cells) if (ground.holds(each)) this.cells.set(each.join(), each);
  }

  release() {
    if (!this.start) return;
    const { editor, ground } = this;
    const path = this.#path();
    if (this.isWhole) this.#add(cellsOfBox(this.start, present(this.end)));
    const cells = [...this.cells.values()];
    this.cancel();
    const before = editor.document;
    editor.store.change((document) => this.apply(ground, document, cells));
    if (editor.document !== before) editor.done = (context) => this.#fill(context, path, 1);
  }

  cancel() {
    this.start = this.end = null;
    this.cells = new Map();
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Theme} theme
   * @param {number} scale
   * @returns {void}
   */
  paint(context, theme, scale) {
    const { editor, over } = this;
    if (this.start) {
      this.#fill(context, this.#path(), 0.75);
      paintGuides(context, editor, guidesOfCell(editor, present(this.end)), scale);
    } else if (over && editor.ground?.holds(over)) {
      context.strokeStyle = theme.muted;
      context.lineWidth = 1.5 / scale;
      context.strokeRect(...editor.ground.boxOf(over));
      if (!this.keeps) paintGuides(context, editor, guidesOfCell(editor, over), scale);
    }
  }

  #path() {
    const { ground } = this;
    const { stage } = this.editor;
    const path = new Path2D();
    const more = 0.5 / stage.view.viewport.scale; // no hairline between two cells
    const boxes = this.isWhole
      ? [this.#corners(ground)]
      : Array.from(this.cells.values(), (cell) => [cell, cell]);
    for (const [from, to] of boxes) {
      const [left, top, width, height] = ground.boxOf(from, to);
      path.rect(left, top, width + more, height + more);
    }
    return path;
  }

  /**
   * The upper left and the lower right cell of what was dragged over, inside of the map.
   * @param {Ground} ground
   * @returns {Cell[]}
   */
  #corners({ columns, rows }) {
    const [one, other] = [present(this.start), present(this.end)];
    /**
     * @param {number} value
     * @param {number} count
     * @returns {number}
     */
    const inside = (value, count) => Math.min(Math.max(value, 0), count - 1);
    return [Math.min, Math.max].map((best) => [
      inside(best(one[0], other[0]), columns),
      inside(best(one[1], other[1]), rows),
    ]);
  }

  /**
   * @param {CanvasRenderingContext2D} context
   * @param {Path2D} path
   * @param {number} opacity
   * @returns {void}
   */
  #fill(context, path, opacity) {
    const { theme } = this.editor.stage;
    context.globalAlpha = opacity;
    context.fillStyle = this.frees ? theme.floor : theme.wall;
    context.fill(path);
    context.globalAlpha = 1;
  }

  /**
   * @param {Ground} ground
   * @param {ScenarioDocument} document
   * @param {Cell[]} cells
   * @returns {ScenarioDocument}
   */
  apply(ground, document, cells) {
    return this.frees ? ground.free(document, cells) : ground.block(document, cells);
  }

  /** How wide and high what is drawn is [length unit]. */
  get span() {
    const [start, end] = [present(this.start), present(this.end)];
    const step = this.ground.side * this.editor.roadmap.unit;
    return AXES.map((axis) => (Math.abs(end[axis] - start[axis]) + 1) * step);
  }
}

export class BrushTool extends CellTool {
  static called = "brush";
  keeps = true; // the cells that it was dragged over before

  /**
   * @param {Cell} from
   * @param {Cell} cell
   * @returns {Cell[]}
   */
  collect(from, cell) {
    return cellsOfLine(from, cell);
  }
}

export class EraseTool extends BrushTool {
  static called = "erase";
  frees = true;

  /** Robots are no walls: who means to erase one is told how. */
  release() {
    const { editor, cells, ground } = this;
    const { roadmap, document } = editor;
    super.release();
    if (editor.document !== document) return editor.say("");
    /**
     * @param {number} vertex
     * @returns {boolean}
     */
    const isAt = (vertex) =>
      vertex >= 0 && cells.has(ground.cellAt(roadmap.x[vertex], roadmap.y[vertex]).join());
    const isRobot = editor.hits.robots.some(({ home, stops }) => [home, ...stops].some(isAt));
    editor.say(isRobot ? words.robotsStay : "");
  }
}

export class BoxTool extends CellTool {
  static called = "box";
  isWhole = true; // all between both ends

  /**
   * With Shift a square.
   * @param {Cell} cell
   * @param {DrawingPoint} point
   * @returns {Cell}
   */
  aimed(cell, { isMore }) {
    if (!isMore) return cell;
    const start = present(this.start);
    const way = cell.map((each, axis) => each - start[axis]);
    const side = Math.max(...way.map(Math.abs));
    return start.map((each, axis) => each + (way[axis] < 0 ? -side : side));
  }

  get measure() {
    if (!this.start) return "";
    return this.span.map((length) => lengthText(this.editor, length)).join(" × ");
  }
}

export class LineTool extends CellTool {
  static called = "line";

  /**
   * With Shift along a row or a column.
   * @param {Cell} cell
   * @param {DrawingPoint} point
   * @returns {Cell}
   */
  aimed(cell, { isMore }) {
    if (!isMore) return cell;
    const [column, row] = present(this.start);
    const isUpright = Math.abs(cell[0] - column) < Math.abs(cell[1] - row);
    return isUpright ? [column, cell[1]] : [cell[0], row];
  }

  /**
   * @param {Cell} _
   * @param {Cell} cell
   * @returns {Cell[]}
   */
  collect(_, cell) {
    return cellsOfLine(present(this.start), cell);
  }

  get measure() {
    if (!this.start) return "";
    const { editor, span } = this;
    const step = this.ground.side * editor.roadmap.unit;
    const [width, height] = span.map((length) => lengthText(editor, length));
    if (span[1] <= step * 1.001) return width;
    if (span[0] <= step * 1.001) return height;
    return `${lengthText(editor, Math.hypot(...span))}  (${width}, ${height})`;
  }
}

/** A gap in a wall: one cell with a press, more with a drag along the wall. */
export class DoorTool extends LineTool {
  static called = "door";
  frees = true;

  /**
   * @param {DrawingPoint} point
   * @returns {void}
   */
  hover(point) {
    super.hover(point);
    if (this.over && !this.ground.isBlocked(this.editor.document, this.over)) this.over = null;
  }
}
