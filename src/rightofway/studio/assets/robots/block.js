/** A block of cells of the table of robots: copied, pasted, cleared, filled, as edits of the document. */

import { COLUMNS } from "./columns.js";
import { addRobots, changeRobots, writtenIn } from "./fleet.js";
/** @import { Block, Column, RobotData, ScenarioDocument, SheetCell } from "../types.js" */

/**
 * The rows and columns from one cell to another: `{ row, column }`, the ends included.
 * @param {SheetCell} from
 * @param {SheetCell} to
 * @returns {Block}
 */
export function blockOf(from, to) {
  /**
   * @param {number} one
   * @param {number} other
   * @returns {[number, number]}
   */
  const span = (one, other) => [Math.min(one, other), Math.max(one, other)];
  const [top, bottom] = span(from.row, to.row);
  const [left, right] = span(from.column, to.column);
  return { top, bottom, left, right };
}

/**
 * @param {Block | null} block
 * @param {number} row
 * @param {number} column
 * @returns {boolean | null}
 */
export const holds = (block, row, column) =>
  block && row >= block.top && row <= block.bottom && column >= block.left && column <= block.right;

/**
 * @param {Block} block
 * @returns {boolean}
 */
export const isSingle = ({ top, bottom, left, right }) => top === bottom && left === right;

/**
 * The text of a block for a spreadsheet.
 * @param {RobotData[]} robots
 * @param {Column[]} columns
 * @param {Block} block
 * @returns {string}
 */
export const blockText = (robots, columns, { top, bottom, left, right }) =>
  robots
    .slice(top, bottom + 1)
    .map((robot) =>
      columns
        .slice(left, right + 1)
        .map(({ text }) => text(robot))
        .join("\t"),
    )
    .join("\n");

/**
 * The rows that a text of a spreadsheet has.
 * @param {string} text
 * @returns {string[][]}
 */
export const rowsOfText = (text) =>
  text
    .replace(/\r?\n$/, "")
    .split(/\r?\n/)
    .map((line) => line.split("\t"));

/**
 * Write rows from a cell on; robots that are not there yet are added; headings are left out.
 * @param {ScenarioDocument} document
 * @param {Column[]} columns
 * @param {string[][]} rows
 * @param {SheetCell} at
 * @returns {ScenarioDocument}
 */
export function pasted(document, columns, rows, { row, column }) {
  const heads = rows[0].map((text) => text.trim().toLowerCase());
  const keys = heads.map((head) => (head === "target" ? "stops" : head));
  const known = keys.filter((key) => COLUMNS.some((each) => each.key === key));
  const isHead = known.length > rows[0].length / 2;
  /** @type {(Column | undefined)[]} */
  const written = isHead
    ? keys.map((key) => COLUMNS.find((each) => each.key === key))
    : columns.slice(column);
  const lines = isHead ? rows.slice(1) : rows;
  const missing = Math.max(row + lines.length - writtenIn(document).length, 0);
  const news = Array.from({ length: missing }, () => ({}));
  return changeRobots(
    addRobots(document, news),
    lines.map((_, line) => row + line),
    (robot, index) =>
      lines[index - row].reduce((done, text, at) => written[at]?.set(done, text) ?? done, robot),
  );
}

/**
 * Write one text into every cell of a block that may be without it.
 * @param {ScenarioDocument} document
 * @param {Column[]} columns
 * @param {Block} block
 * @returns {ScenarioDocument}
 */
export const cleared = (document, columns, block) =>
  filledWith(document, columns, block, (column, robot) =>
    ["name", "home"].includes(column.key) ? column.text(robot) : "",
  );

/**
 * Write the first row of a block into its other rows; names stay, for no two robots share one.
 * @param {ScenarioDocument} document
 * @param {Column[]} columns
 * @param {Block} block
 * @returns {ScenarioDocument}
 */
export function filled(document, columns, block) {
  const first = writtenIn(document)[block.top];
  return filledWith(document, columns, block, (column, robot) =>
    column.key === "name" ? column.text(robot) : column.text(first),
  );
}

/**
 * @param {ScenarioDocument} document
 * @param {Column[]} columns
 * @param {Block} block
 * @param {(column: Column, robot: RobotData) => string} textFor
 * @returns {ScenarioDocument}
 */
function filledWith(document, columns, { top, bottom, left, right }, textFor) {
  const last = Math.min(bottom, writtenIn(document).length - 1);
  const rows = Array.from({ length: last - top + 1 }, (_, line) => top + line);
  return changeRobots(document, rows, (robot) =>
    columns.slice(left, right + 1).reduce((done, column) => {
      const text = textFor(column, robot);
      return column.text(done) === text ? done : column.set(done, text);
    }, robot),
  );
}
