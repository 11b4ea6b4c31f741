/** Walls on cells and floors: what is blocked, as edits of a document. */

import { numberOf, rounded, toDrawing } from "./places.js";

const STANDARD_STEP = 0.25; // length units; where a floor has no cells of one size

/** Cells of a map that can be blocked and freed, or null where a map has none that are in the document. */
export function groundOf(document, roadmap) {
  const { grid, floor } = document.map;
  if (grid) return new GridGround(roadmap);
  return floor ? new FloorGround(document.map, roadmap) : null;
}

/** The rows of a grid as a list, however they are written. */
const rowsOf = (grid) => (Array.isArray(grid) ? grid : grid.replace(/\n$/, "").split("\n"));

/** A grid: a cell is blocked or free. */
class GridGround {
  constructor(roadmap) {
    this.columns = roadmap.width;
    this.rows = roadmap.height;
    this.side = 1;
  }

  /** The cell at a point of the drawing, inside or not. */
  cellAt(x, y) {
    return [Math.round(x), Math.round(y)];
  }

  holds([column, row]) {
    return column >= 0 && row >= 0 && column < this.columns && row < this.rows;
  }

  /** Cells as a rectangle of the drawing: left, top, width, height. */
  boxOf([left, top], [right, bottom] = [left, top]) {
    return [left - 0.5, top - 0.5, right - left + 1, bottom - top + 1];
  }

  block(document, cells) {
    return this.#set(document, cells, "@");
  }

  free(document, cells) {
    return this.#set(document, cells, ".");
  }

  isBlocked(document, cell) {
    return this.blockedOf(document, [cell]).length > 0;
  }

  /** Those of some cells that are blocked. */
  blockedOf({ map }, cells) {
    const rows = rowsOf(map.grid);
    return cells.filter(([column, row]) => !".GS".includes(rows[row]?.[column] ?? "@"));
  }

  #set(document, cells, character) {
    const rows = rowsOf(document.map.grid).map((row) => [...row]);
    let changes = 0;
    for (const cell of cells.filter((each) => this.holds(each))) {
      const isBlocked = !".GS".includes(rows[cell[1]][cell[0]]);
      if (isBlocked === (character === "@")) continue;
      rows[cell[1]][cell[0]] = character;
      changes++;
    }
    return changes
      ? { ...document, map: { ...document.map, grid: rows.map((row) => row.join("")) } }
      : document;
  }
}

/** A floor: what is blocked is a list of rectangles in lengths, which keep to steps of one cell. */
class FloorGround {
  constructor({ floor, smallest }, roadmap) {
    this.roadmap = roadmap;
    this.step = roadmap.rows ? roadmap.unit : numberOf(smallest, STANDARD_STEP);
    this.side = this.step / roadmap.unit;
    const [width, height] = floor.size.map((length) => numberOf(length));
    [this.columns, this.rows] = [
      Math.ceil(width / this.step - 1e-9),
      Math.ceil(height / this.step - 1e-9),
    ];
    this.size = [width, height];
    this.corner = roadmap.rows ? [-0.5, -0.5] : toDrawing(roadmap, ...this.#leftTop());
  }

  /** The corner of an adaptive floor that is drawn at the left above, on the site. */
  #leftTop() {
    const { roadmap } = this;
    const reach = (vertex, sign) => (sign * roadmap.sides[vertex]) / 2;
    const [left, top] = Array.from(roadmap.x.keys()).reduce(
      ([x, y], vertex) => [
        Math.min(x, roadmap.x[vertex] - reach(vertex, 1)),
        Math.min(y, roadmap.y[vertex] - reach(vertex, 1)),
      ],
      [Infinity, Infinity],
    );
    return roadmap.toSite(left, top);
  }

  cellAt(x, y) {
    return [
      Math.floor((x - this.corner[0]) / this.side),
      Math.floor((y - this.corner[1]) / this.side),
    ];
  }

  holds([column, row]) {
    return column >= 0 && row >= 0 && column < this.columns && row < this.rows;
  }

  boxOf([left, top], [right, bottom] = [left, top]) {
    const { corner, side } = this;
    return [
      corner[0] + left * side,
      corner[1] + top * side,
      (right - left + 1) * side,
      (bottom - top + 1) * side,
    ];
  }

  block(document, cells) {
    const rects = blocksOf(cells.filter((cell) => this.holds(cell))).map(([from, to]) => ({
      rect: this.#rectOf(from, to),
    }));
    const known = document.map.floor.obstacles ?? [];
    const there = known.map(({ rect }) => rect.map((length) => numberOf(length)));
    const news = rects.filter(({ rect }) => !there.some((other) => covers(other, rect)));
    return news.length ? withObstacles(document, [...known, ...news]) : document;
  }

  free(document, cells) {
    const known = document.map.floor.obstacles ?? [];
    const holes = blocksOf(cells).map(([from, to]) => this.#rectOf(from, to));
    const left = known.flatMap((each) => without(each, holes));
    const isSame = left.length === known.length && left.every((each, i) => each === known[i]);
    return isSame ? document : withObstacles(document, left);
  }

  isBlocked(document, cell) {
    const [x, y, width, height] = this.#rectOf(cell, cell);
    return (document.map.floor.obstacles ?? []).some(({ rect }) =>
      covers(
        rect.map((length) => numberOf(length)),
        [x + width / 4, y + height / 4, width / 2, height / 2],
      ),
    );
  }

  /** Cells as a rectangle of the site: the least x and y, width, height. */
  #rectOf(from, to) {
    const [left, top, width, height] = this.boxOf(from, to);
    const [one, other] = [
      this.roadmap.toSite(left, top),
      this.roadmap.toSite(left + width, top + height),
    ];
    const [x, y] = [Math.min(one[0], other[0]), Math.min(one[1], other[1])];
    return [x, y, Math.abs(one[0] - other[0]), Math.abs(one[1] - other[1])].map(rounded);
  }
}

export const withObstacles = (document, obstacles) => ({
  ...document,
  map: { ...document.map, floor: { ...document.map.floor, obstacles } },
});

/** Whether a rectangle holds another one. */
function covers([left, top, wide, high], [x, y, width, height]) {
  return (
    x >= left - 1e-9 &&
    y >= top - 1e-9 &&
    x + width <= left + wide + 1e-9 &&
    y + height <= top + high + 1e-9
  );
}

/** What is left of an obstacle round some holes: itself, or pieces of it. */
function without(obstacle, holes) {
  const whole = obstacle.rect.map((length) => numberOf(length));
  let pieces = [whole];
  for (const hole of holes) pieces = pieces.flatMap((piece) => piecesRound(piece, hole));
  return pieces.length === 1 && pieces[0] === whole
    ? [obstacle]
    : pieces.map((rect) => ({ ...obstacle, rect: rect.map(rounded) }));
}

/** A rectangle without a hole: itself, or up to four pieces. */
function piecesRound(rect, [x, y, width, height]) {
  const [left, top, wide, high] = rect;
  const [right, bottom] = [left + wide, top + high];
  if (
    x >= right - 1e-9 ||
    y >= bottom - 1e-9 ||
    x + width <= left + 1e-9 ||
    y + height <= top + 1e-9
  )
    return [rect];
  const [from, to] = [Math.max(top, y), Math.min(bottom, y + height)];
  return [
    [left, top, wide, y - top],
    [left, y + height, wide, bottom - y - height],
    [left, from, x - left, to - from],
    [x + width, from, right - x - width, to - from],
  ].filter(([, , w, h]) => w > 1e-9 && h > 1e-9);
}

/** Cells as few blocks: runs in a row, joined with equal runs in the row below. */
function blocksOf(cells) {
  const ordered = [...new Map(cells.map((cell) => [cell.join(), cell])).values()].sort(
    ([a, b], [c, d]) => b - d || a - c,
  );
  const runs = [];
  for (const [column, row] of ordered) {
    const last = runs.at(-1);
    if (last && last[1][1] === row && last[1][0] === column - 1) last[1] = [column, row];
    else
      runs.push([
        [column, row],
        [column, row],
      ]);
  }
  const blocks = [];
  const latest = new Map(); // of each run of columns
  for (const [from, to] of runs) {
    const columns = `${from[0]} ${to[0]}`;
    const above = latest.get(columns);
    if (above?.[1][1] === from[1] - 1) above[1] = to;
    else {
      latest.set(columns, [from, to]);
      blocks.push(latest.get(columns));
    }
  }
  return blocks;
}

/** The cells of a straight line between two, as a grid has them (Bresenham). */
export function cellsOfLine([column, row], [toColumn, toRow]) {
  const [wide, high] = [Math.abs(toColumn - column), Math.abs(toRow - row)];
  const [right, down] = [Math.sign(toColumn - column), Math.sign(toRow - row)];
  const cells = [[column, row]];
  for (let rest = wide - high; column !== toColumn || row !== toRow;) {
    const twice = 2 * rest;
    if (twice > -high) [rest, column] = [rest - high, column + right];
    if (twice < wide) [rest, row] = [rest + wide, row + down];
    cells.push([column, row]);
  }
  return cells;
}

/** A cell of what is selected: its column and row. */
export const cellOf = (id) => id.split(",").map(Number);

export function cellsOfBox([left, top], [right, bottom]) {
  const cells = [];
  for (let row = Math.min(top, bottom); row <= Math.max(top, bottom); row++) {
    for (let column = Math.min(left, right); column <= Math.max(left, right); column++)
      cells.push([column, row]);
  }
  return cells;
}
