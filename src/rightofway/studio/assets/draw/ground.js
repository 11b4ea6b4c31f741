/** Walls on cells and floors: what is blocked, as edits of a document. */

import { numberOf, rounded, toDrawing } from "./places.js";
import { present } from "../given.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { Cell, MapData, ObstacleData, Point, Rect, ScenarioDocument } from "../types.js" */

const STANDARD_STEP = 0.25; // length units; where a floor has no cells of one size

/**
 * Cells of a map that can be blocked and freed, or null where a map has none that are in the document.
 * @param {ScenarioDocument} document
 * @param {Roadmap} roadmap
 * @returns {GridGround | FloorGround | null}
 */
export function groundOf(document, roadmap) {
  const { grid, floor } = document.map;
  if (grid) return new GridGround(roadmap);
  return floor ? new FloorGround(document.map, roadmap) : null;
}

/**
 * The rows of a grid as a list, however they are written.
 * @param {string | string[]} grid
 * @returns {string[]}
 */
const rowsOf = (grid) => (Array.isArray(grid) ? grid : grid.replace(/\n$/, "").split("\n"));

/** A grid: a cell is blocked or free. */
export class GridGround {
  /** @param {Roadmap} roadmap */
  constructor(roadmap) {
    this.columns = roadmap.width;
    this.rows = roadmap.height;
    this.side = 1;
  }

  /**
   * The cell at a point of the drawing, inside or not.
   * @param {number} x
   * @param {number} y
   * @returns {Cell}
   */
  cellAt(x, y) {
    return [Math.round(x), Math.round(y)];
  }

  /**
   * @param {Cell} cell
   * @returns {boolean}
   */
  holds([column, row]) {
    return column >= 0 && row >= 0 && column < this.columns && row < this.rows;
  }

  /**
   * Cells as a rectangle of the drawing: left, top, width, height.
   * @param {Cell} from
   * @param {Cell} [to]
   * @returns {Rect}
   */
  boxOf([left, top], [right, bottom] = [left, top]) {
    return [left - 0.5, top - 0.5, right - left + 1, bottom - top + 1];
  }

  /**
   * @param {ScenarioDocument} document
   * @param {Cell[]} cells
   * @returns {ScenarioDocument}
   */
  block(document, cells) {
    return this.#set(document, cells, "@");
  }

  /**
   * @param {ScenarioDocument} document
   * @param {Cell[]} cells
   * @returns {ScenarioDocument}
   */
  free(document, cells) {
    return this.#set(document, cells, ".");
  }

  /**
   * @param {ScenarioDocument} document
   * @param {Cell} cell
   * @returns {boolean}
   */
  isBlocked(document, cell) {
    return this.blockedOf(document, [cell]).length > 0;
  }

  /**
   * Those of some cells that are blocked.
   * @param {ScenarioDocument} document
   * @param {Cell[]} cells
   * @returns {Cell[]}
   */
  blockedOf({ map }, cells) {
    const rows = rowsOf(map.grid ?? []);
    return cells.filter(([column, row]) => !".GS".includes(rows[row]?.[column] ?? "@"));
  }

  /**
   * @param {ScenarioDocument} document
   * @param {Cell[]} cells
   * @param {string} character
   * @returns {ScenarioDocument}
   */
  #set(document, cells, character) {
    const rows = rowsOf(document.map.grid ?? []).map((row) => [...row]);
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
  /**
   * @param {MapData} map
   * @param {Roadmap} roadmap
   */
  constructor({ floor, smallest }, roadmap) {
    this.roadmap = roadmap;
    this.step = roadmap.rows ? roadmap.unit : numberOf(smallest, STANDARD_STEP);
    this.side = this.step / roadmap.unit;
    const [width, height] = present(floor).size.map((length) => numberOf(length));
    this.columns = Math.ceil(width / this.step - 1e-9);
    this.rows = Math.ceil(height / this.step - 1e-9);
    this.size = [width, height];
    this.corner = roadmap.rows ? [-0.5, -0.5] : toDrawing(roadmap, ...this.#leftTop());
  }

  /**
   * The corner of an adaptive floor that is drawn at the left above, on the site.
   * @returns {Point}
   */
  #leftTop() {
    const { roadmap } = this;
    const sides = present(roadmap.sides);
    /**
     * @param {number} vertex
     * @param {number} sign
     * @returns {number}
     */
    const reach = (vertex, sign) => (sign * sides[vertex]) / 2;
    const [left, top] = Array.from(roadmap.x.keys()).reduce(
      ([x, y], vertex) => [
        Math.min(x, roadmap.x[vertex] - reach(vertex, 1)),
        Math.min(y, roadmap.y[vertex] - reach(vertex, 1)),
      ],
      [Infinity, Infinity],
    );
    return roadmap.toSite(left, top);
  }

  /**
   * @param {number} x
   * @param {number} y
   * @returns {Cell}
   */
  cellAt(x, y) {
    return [
      Math.floor((x - this.corner[0]) / this.side),
      Math.floor((y - this.corner[1]) / this.side),
    ];
  }

  /**
   * @param {Cell} cell
   * @returns {boolean}
   */
  holds([column, row]) {
    return column >= 0 && row >= 0 && column < this.columns && row < this.rows;
  }

  /**
   * @param {Cell} from
   * @param {Cell} [to]
   * @returns {Rect}
   */
  boxOf([left, top], [right, bottom] = [left, top]) {
    const { corner, side } = this;
    return [
      corner[0] + left * side,
      corner[1] + top * side,
      (right - left + 1) * side,
      (bottom - top + 1) * side,
    ];
  }

  /**
   * @param {ScenarioDocument} document
   * @param {Cell[]} cells
   * @returns {ScenarioDocument}
   */
  block(document, cells) {
    const rects = blocksOf(cells.filter((cell) => this.holds(cell))).map(([from, to]) => ({
      rect: this.#rectOf(from, to),
    }));
    const known = obstaclesOf(document);
    const there = known.map(({ rect }) => rect.map((length) => numberOf(length)));
    const news = rects.filter(({ rect }) => !there.some((other) => covers(other, rect)));
    return news.length ? withObstacles(document, [...known, ...news]) : document;
  }

  /**
   * @param {ScenarioDocument} document
   * @param {Cell[]} cells
   * @returns {ScenarioDocument}
   */
  free(document, cells) {
    const known = obstaclesOf(document);
    const holes = blocksOf(cells).map(([from, to]) => this.#rectOf(from, to));
    const left = known.flatMap((each) => without(each, holes));
    const isSame = left.length === known.length && left.every((each, i) => each === known[i]);
    return isSame ? document : withObstacles(document, left);
  }

  /**
   * @param {ScenarioDocument} document
   * @param {Cell} cell
   * @returns {boolean}
   */
  isBlocked(document, cell) {
    const [x, y, width, height] = this.#rectOf(cell, cell);
    return obstaclesOf(document).some(({ rect }) =>
      covers(
        rect.map((length) => numberOf(length)),
        [x + width / 4, y + height / 4, width / 2, height / 2],
      ),
    );
  }

  /**
   * Cells as a rectangle of the site: the least x and y, width, height.
   * @param {Cell} from
   * @param {Cell} to
   * @returns {Rect}
   */
  #rectOf(from, to) {
    const [left, top, width, height] = this.boxOf(from, to);
    const [one, other] = [
      this.roadmap.toSite(left, top),
      this.roadmap.toSite(left + width, top + height),
    ];
    const [x, y] = [Math.min(one[0], other[0]), Math.min(one[1], other[1])];
    const [wide, high] = [Math.abs(one[0] - other[0]), Math.abs(one[1] - other[1])];
    return [rounded(x), rounded(y), rounded(wide), rounded(high)];
  }
}

/**
 * The obstacles of a floor.
 * @param {ScenarioDocument} document
 * @returns {ObstacleData[]}
 */
export const obstaclesOf = ({ map }) => map.floor?.obstacles ?? [];

/**
 * @param {ScenarioDocument} document
 * @param {ObstacleData[]} obstacles
 * @returns {ScenarioDocument}
 */
export const withObstacles = (document, obstacles) => ({
  ...document,
  map: { ...document.map, floor: { ...present(document.map.floor), obstacles } },
});

/**
 * Whether a rectangle holds another one.
 * @param {Rect} outer
 * @param {Rect} inner
 * @returns {boolean}
 */
function covers([left, top, wide, high], [x, y, width, height]) {
  return (
    x >= left - 1e-9 &&
    y >= top - 1e-9 &&
    x + width <= left + wide + 1e-9 &&
    y + height <= top + high + 1e-9
  );
}

/**
 * What is left of an obstacle round some holes: itself, or pieces of it.
 * @param {ObstacleData} obstacle
 * @param {Rect[]} holes
 * @returns {ObstacleData[]}
 */
function without(obstacle, holes) {
  const whole = obstacle.rect.map((length) => numberOf(length));
  let pieces = [whole];
  for (const hole of holes) pieces = pieces.flatMap((piece) => piecesRound(piece, hole));
  return pieces.length === 1 && pieces[0] === whole
    ? [obstacle]
    : pieces.map((rect) => ({ ...obstacle, rect: rect.map(rounded) }));
}

/**
 * A rectangle without a hole: itself, or up to four pieces.
 * @param {Rect} rect
 * @param {Rect} hole
 * @returns {Rect[]}
 */
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
  /** @type {Rect[]} */
  const pieces = [
    [left, top, wide, y - top],
    [left, y + height, wide, bottom - y - height],
    [left, from, x - left, to - from],
    [x + width, from, right - x - width, to - from],
  ];
  return pieces.filter(([, , w, h]) => w > 1e-9 && h > 1e-9);
}

/**
 * Cells as few blocks: runs in a row, joined with equal runs in the row below.
 * @param {Cell[]} cells
 * @returns {[Cell, Cell][]}
 */
function blocksOf(cells) {
  const ordered = [...new Map(cells.map((cell) => [cell.join(), cell])).values()].sort(
    ([a, b], [c, d]) => b - d || a - c,
  );
  /** @type {[Cell, Cell][]} */
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
  /** @type {[Cell, Cell][]} */
  const blocks = [];
  /** @type {Map<string, [Cell, Cell]>} */
  const latest = new Map(); // of each run of columns
  for (const [from, to] of runs) {
    const columns = `${from[0]} ${to[0]}`;
    const above = latest.get(columns);
    if (above?.[1][1] === from[1] - 1) above[1] = to;
    else {
      /** @type {[Cell, Cell]} */
      const block = [from, to];
      latest.set(columns, block);
      blocks.push(block);
    }
  }
  return blocks;
}

/**
 * The cells of a straight line between two, as a grid has them (Bresenham).
 * @param {Cell} from
 * @param {Cell} to
 * @returns {Cell[]}
 */
export function cellsOfLine([column, row], [toColumn, toRow]) {
  const [wide, high] = [Math.abs(toColumn - column), Math.abs(toRow - row)];
  const [right, down] = [Math.sign(toColumn - column), Math.sign(toRow - row)];
  /** @type {Cell[]} */
  const cells = [[column, row]];
  for (let rest = wide - high; column !== toColumn || row !== toRow;) {
    const twice = 2 * rest;
    if (twice > -high) [rest, column] = [rest - high, column + right];
    if (twice < wide) [rest, row] = [rest + wide, row + down];
    cells.push([column, row]);
  }
  return cells;
}

/**
 * A cell of what is selected: its column and row.
 * @param {string} id
 * @returns {Cell}
 */
export function cellOf(id) {
  const [column, row] = id.split(",").map(Number);
  return [column, row];
}

/**
 * @param {Cell} from
 * @param {Cell} to
 * @returns {Cell[]}
 */
export function cellsOfBox([left, top], [right, bottom]) {
  /** @type {Cell[]} */
  const cells = [];
  for (let row = Math.min(top, bottom); row <= Math.max(top, bottom); row++) {
    for (let column = Math.min(left, right); column <= Math.max(left, right); column++)
      cells.push([column, row]);
  }
  return cells;
}
