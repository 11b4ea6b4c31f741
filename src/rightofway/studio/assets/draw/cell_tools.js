/** Tools for walls: brush, box, line, door, eraser. They collect cells while they are drawn. */

import { words } from "../words.js";
import { cellsOfBox, cellsOfLine } from "./ground.js";
import { lengthText } from "./readout.js";
import { guidesOfCell, paintGuides } from "./snapping.js";

/** A tool that collects cells from press to release, and then changes them. */
class CellTool {
  isDrawn = true; // from a place to another one, with the keyboard too
  start = null;
  end = null; // the cell that was reached last
  over = null; // the cell below the pointer

  constructor(editor) {
    this.editor = editor;
    this.cells = new Map();
  }

  get isBusy() {
    return this.start !== null;
  }

  press(point) {
    const cell = this.editor.ground.cellAt(point.x, point.y);
    this.cells = new Map();
    this.start = this.end = cell;
    this.#reach(cell);
  }

  drag(point) {
    if (this.start) {
      const cell = this.aimed(this.editor.ground.cellAt(point.x, point.y), point);
      if (cell[0] !== this.end[0] || cell[1] !== this.end[1]) this.#reach(cell);
    }
    this.hover(point);
  }

  /** The cell that is meant by the one below the pointer. */
  aimed(cell) {
    return cell;
  }

  hover(point) {
    this.over = this.editor.ground?.cellAt(point.x, point.y) ?? null;
  }

  leave() {
    this.over = null;
  }

  #reach(cell) {
    const from = this.end;
    this.end = cell;
    if (this.isWhole) return; // its cells are those between both ends
    if (!this.keeps) this.cells.clear();
    this.#add(this.collect(from, cell));
  }

  #add(cells) {
    const { ground } = this.editor;
    for (const each of cells) if (ground.holds(each)) this.cells.set(each.join(), each);
  }

  release() {
    if (!this.start) return;
    const { editor } = this;
    const path = this.#path();
    if (this.isWhole) this.#add(cellsOfBox(this.start, this.end));
    const cells = [...this.cells.values()];
    this.cancel();
    const before = editor.document;
    editor.store.change((document) => this.apply(editor.ground, document, cells));
    if (editor.document !== before) editor.done = (context) => this.#fill(context, path, 1);
  }

  cancel() {
    this.start = this.end = null;
    this.cells = new Map();
  }

  paint(context, theme, scale) {
    const { editor, over } = this;
    if (this.start) {
      this.#fill(context, this.#path(), 0.75);
      paintGuides(context, editor, guidesOfCell(editor, this.end), scale);
    } else if (over && editor.ground?.holds(over)) {
      context.strokeStyle = theme.muted;
      context.lineWidth = 1.5 / scale;
      context.strokeRect(...editor.ground.boxOf(over));
      if (!this.keeps) paintGuides(context, editor, guidesOfCell(editor, over), scale);
    }
  }

  #path() {
    const { ground, stage } = this.editor;
    const path = new Path2D();
    const more = 0.5 / stage.view.viewport.scale; // no hairline between two cells
    const boxes = this.isWhole
      ? [this.#corners(ground)]
      : [...this.cells.values()].map((cell) => [cell, cell]);
    for (const [from, to] of boxes) {
      const [left, top, width, height] = ground.boxOf(from, to);
      path.rect(left, top, width + more, height + more);
    }
    return path;
  }

  /** The upper left and the lower right cell of what was dragged over, inside of the map. */
  #corners({ columns, rows }) {
    const [one, other] = [this.start, this.end];
    const inside = (value, count) => Math.min(Math.max(value, 0), count - 1);
    return [Math.min, Math.max].map((best) => [
      inside(best(one[0], other[0]), columns),
      inside(best(one[1], other[1]), rows),
    ]);
  }

  #fill(context, path, opacity) {
    const { theme } = this.editor.stage;
    context.globalAlpha = opacity;
    context.fillStyle = this.frees ? theme.floor : theme.wall;
    context.fill(path);
    context.globalAlpha = 1;
  }

  apply(ground, document, cells) {
    return this.frees ? ground.free(document, cells) : ground.block(document, cells);
  }

  /** How wide and high what is drawn is [length unit]. */
  get span() {
    const { start, end, editor } = this;
    const step = editor.ground.side * editor.roadmap.unit;
    return [0, 1].map((axis) => (Math.abs(end[axis] - start[axis]) + 1) * step);
  }
}

export class BrushTool extends CellTool {
  static called = "brush";
  keeps = true; // the cells that it was dragged over before

  collect(from, cell) {
    return cellsOfLine(from, cell);
  }
}

export class EraseTool extends BrushTool {
  static called = "erase";
  frees = true;

  /** Robots are no walls: who means to erase one is told how. */
  release() {
    const { editor, cells } = this;
    const { roadmap, document } = editor;
    super.release();
    if (editor.document !== document) return editor.say("");
    const isAt = (vertex) =>
      vertex >= 0 && cells.has(editor.ground.cellAt(roadmap.x[vertex], roadmap.y[vertex]).join());
    const isRobot = editor.hits.robots.some(({ home, stops }) => [home, ...stops].some(isAt));
    editor.say(isRobot ? words.robotsStay : "");
  }
}

export class BoxTool extends CellTool {
  static called = "box";
  isWhole = true; // all between both ends

  /** With Shift a square. */
  aimed(cell, { isMore }) {
    if (!isMore) return cell;
    const way = cell.map((each, axis) => each - this.start[axis]);
    const side = Math.max(...way.map(Math.abs));
    return this.start.map((each, axis) => each + (way[axis] < 0 ? -side : side));
  }

  get measure() {
    if (!this.start) return "";
    return this.span.map((length) => lengthText(this.editor, length)).join(" × ");
  }
}

export class LineTool extends CellTool {
  static called = "line";

  /** With Shift along a row or a column. */
  aimed(cell, { isMore }) {
    if (!isMore) return cell;
    const [right, down] = cell.map((each, axis) => Math.abs(each - this.start[axis]));
    return right < down ? [this.start[0], cell[1]] : [cell[0], this.start[1]];
  }

  collect(_, cell) {
    return cellsOfLine(this.start, cell);
  }

  get measure() {
    if (!this.start) return "";
    const { editor, span } = this;
    const step = editor.ground.side * editor.roadmap.unit;
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

  hover(point) {
    super.hover(point);
    if (this.over && !this.editor.ground.isBlocked(this.editor.document, this.over))
      this.over = null;
  }
}
