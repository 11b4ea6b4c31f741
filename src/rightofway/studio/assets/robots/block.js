/** A block of cells of a table of robots or jobs: copied, pasted, cleared, filled, as edits of the document. */

import { addRows, changeRows, rowsIn } from "./rows.js";
/** @import { Block, Column, RowData, ScenarioDocument, SheetCell, SheetTable } from "../types.js" */

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
 * @param {RowData[]} items
 * @param {Column[]} columns
 * @param {Block} block
 * @returns {string}
 */
export const blockText = (items, columns, { top, bottom, left, right }) =>
  items
    .slice(top, bottom + 1)
    .map((item) =>
      columns
        .slice(left, right + 1)
        .map(({ text }) => text(item))
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
 * The columns that the first of some rows names; null where that is no row of headings.
 * @param {SheetTable} table
 * @param {string[][]} rows
 * @returns {(Column | undefined)[] | null}
 */
export function headingsOf({ columns }, rows) {
  const heads = rows[0].map((text) => text.trim().toLowerCase());
  const found = heads.map((head) =>
    columns.find(({ key }) => key === (head === "target" ? "stops" : head)),
  );
  return found.filter(Boolean).length > heads.length / 2 ? found : null;
}

/**
 * Write rows from a cell on; items that are not there yet are added; headings are left out.
 * @param {ScenarioDocument} document
 * @param {SheetTable} table
 * @param {Column[]} columns
 * @param {string[][]} rows
 * @param {SheetCell} at
 * @returns {ScenarioDocument}
 */
export function pasted(document, table, columns, rows, { row, column }) {
  const { list } = table;
  const named = headingsOf(table, rows);
  const written = named ?? columns.slice(column);
  const lines = named ? rows.slice(1) : rows;
  const missing = Math.max(row + lines.length - rowsIn(document, list).length, 0);
  const news = Array.from({ length: missing }, () => ({}));
  return changeRows(
    addRows(document, list, news),
    list,
    lines.map((_, line) => row + line),
    (item, index) =>
      lines[index - row].reduce((done, text, at) => written[at]?.set(done, text) ?? done, item),
  );
}

/**
 * Write one text into every cell of a block that may be without it.
 * @param {ScenarioDocument} document
 * @param {SheetTable} table
 * @param {Column[]} columns
 * @param {Block} block
 * @returns {ScenarioDocument}
 */
export const cleared = (document, table, columns, block) =>
  filledWith(document, table, columns, block, (column, item) =>
    ["name", "home"].includes(column.key) ? column.text(item) : "",
  );

/**
 * Write the first row of a block into its other rows; names stay, for no two items share one.
 * @param {ScenarioDocument} document
 * @param {SheetTable} table
 * @param {Column[]} columns
 * @param {Block} block
 * @returns {ScenarioDocument}
 */
export function filled(document, table, columns, block) {
  const first = rowsIn(document, table.list)[block.top];
  return filledWith(document, table, columns, block, (column, item) =>
    column.key === "name" ? column.text(item) : column.text(first),
  );
}

/**
 * @param {ScenarioDocument} document
 * @param {SheetTable} table
 * @param {Column[]} columns
 * @param {Block} block
 * @param {(column: Column, item: RowData) => string} textFor
 * @returns {ScenarioDocument}
 */
function filledWith(document, { list }, columns, { top, bottom, left, right }, textFor) {
  const last = Math.min(bottom, rowsIn(document, list).length - 1);
  const rows = Array.from({ length: last - top + 1 }, (_, line) => top + line);
  return changeRows(document, list, rows, (item) =>
    columns.slice(left, right + 1).reduce((done, column) => {
      const text = textFor(column, item);
      return column.text(done) === text ? done : column.set(done, text);
    }, item),
  );
}
