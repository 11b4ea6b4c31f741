/** Tools for walls: brush, box, line, door, eraser. They collect cells while they are drawn. */

import { cellsOfBox, cellsOfLine } from "./ground.js";

/** A tool that collects cells from press to release, and then changes them. */
class CellTool {
  isDrawn = true; // from a place to another one, with the keyboard too

  constructor(editor) {
    this.editor = editor;
    this.cells = [];
    this.start = null;
    this.over = null; // the cell below the pointer
  }

  get isBusy() {
    return this.start !== null;
  }

  press(point) {
    const cell = this.editor.ground.cellAt(point.x, point.y);
    this.start = cell;
    this.cells = this.collect(cell, []);
  }

  drag(point) {
    if (this.start)
      this.cells = this.collect(this.editor.ground.cellAt(point.x, point.y), this.cells);
    this.hover(point);
  }

  hover(point) {
    this.over = this.editor.ground?.cellAt(point.x, point.y) ?? null;
  }

  release() {
    if (!this.start) return;
    const { cells, editor } = this;
    const boxes = this.#boxes();
    this.start = null;
    this.cells = [];
    const before = editor.document;
    editor.store.change((document) => this.apply(editor.ground, document, cells));
    if (editor.document !== before)
      editor.done = (context, scale) => this.#fill(context, boxes, scale, 1);
  }

  cancel() {
    this.start = null;
    this.cells = [];
  }

  paint(context, theme, scale) {
    if (this.start) this.#fill(context, this.#boxes(), scale, 0.75);
    else if (this.over && this.editor.ground?.holds(this.over)) {
      context.strokeStyle = theme.muted;
      context.lineWidth = 1.5 / scale;
      context.strokeRect(...this.editor.ground.boxOf(this.over));
    }
  }

  #boxes() {
    const { ground } = this.editor;
    return this.cells.filter((cell) => ground.holds(cell)).map((cell) => ground.boxOf(cell));
  }

  #fill(context, boxes, scale, opacity) {
    const { theme } = this.editor.stage;
    context.globalAlpha = opacity;
    context.fillStyle = this.frees ? theme.floor : theme.wall;
    for (const [left, top, width, height] of boxes)
      context.fillRect(left, top, width + 0.5 / scale, height + 0.5 / scale);
    context.globalAlpha = 1;
  }

  apply(ground, document, cells) {
    return this.frees ? ground.free(document, cells) : ground.block(document, cells);
  }
}

export class BrushTool extends CellTool {
  static called = "brush";
  last = null;

  collect(cell, cells) {
    const from = cells.length ? this.last : cell;
    this.last = cell;
    return [...cells, ...cellsOfLine(from, cell)];
  }
}

export class EraseTool extends BrushTool {
  static called = "erase";
  frees = true;
}

export class BoxTool extends CellTool {
  static called = "box";

  collect(cell) {
    return cellsOfBox(this.start, cell);
  }
}

export class LineTool extends CellTool {
  static called = "line";

  collect(cell) {
    return cellsOfLine(this.start, cell);
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
