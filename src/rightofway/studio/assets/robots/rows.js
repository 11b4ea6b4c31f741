/** Lists of a document whose items are rows of a table, robots or jobs: edits of them. */

import { present } from "../given.js";
/** @import { Column, ListName, RowData, ScenarioDocument } from "../types.js" */

/**
 * The items that are written in a document; null where there are none, or they are in another file.
 * @param {Partial<ScenarioDocument>} document
 * @param {ListName} list
 * @returns {RowData[] | null}
 */
export const rowsOf = (document, list) => {
  const { [list]: rows } = document;
  return Array.isArray(rows) ? rows : null;
};

/**
 * The items of a document that has them.
 * @param {Partial<ScenarioDocument>} document
 * @param {ListName} list
 * @returns {RowData[]}
 */
export const rowsIn = (document, list) => present(rowsOf(document, list));

/** The first letter of the names of new items. */
const PREFIXES = { robots: "R", jobs: "J" };

/**
 * A name that no item has: R1, R2, ...
 * @param {RowData[]} rows
 * @param {ListName} list
 * @returns {string}
 */
export function freeName(rows, list) {
  const taken = new Set(rows.map(({ name }) => name));
  let number = rows.length + 1;
  while (taken.has(`${PREFIXES[list]}${number}`)) number++;
  return `${PREFIXES[list]}${number}`;
}

/**
 * Add items; each gets a name if it has none.
 * @param {ScenarioDocument} document
 * @param {ListName} list
 * @param {RowData[]} news
 * @returns {ScenarioDocument}
 */
export function addRows(document, list, news) {
  const rows = [...rowsIn(document, list)];
  for (const row of news) rows.push({ name: freeName(rows, list), ...row });
  return { ...document, [list]: rows };
}

/**
 * Change some items by a function of item and index.
 * @param {ScenarioDocument} document
 * @param {ListName} list
 * @param {number[]} indices
 * @param {(row: RowData, index: number) => RowData} change
 * @returns {ScenarioDocument}
 */
export function changeRows(document, list, indices, change) {
  const chosen = new Set(indices);
  const rows = rowsIn(document, list).map((row, index) =>
    chosen.has(index) ? change(row, index) : row,
  );
  return { ...document, [list]: rows };
}

/**
 * @param {ScenarioDocument} document
 * @param {ListName} list
 * @param {number[]} indices
 * @returns {ScenarioDocument}
 */
export function removeRows(document, list, indices) {
  const chosen = new Set(indices);
  return { ...document, [list]: rowsIn(document, list).filter((_, index) => !chosen.has(index)) };
}

/**
 * Put items into the order of what a function says of them.
 * @param {ScenarioDocument} document
 * @param {ListName} list
 * @param {(row: RowData) => string | number} valueOf
 * @param {boolean} isDown
 * @returns {ScenarioDocument}
 */
export function sortRows(document, list, valueOf, isDown) {
  /** @type {[string | number, number, RowData][]} */
  const order = rowsIn(document, list).map((row, index) => [valueOf(row), index, row]);
  order.sort(([a, i], [b, j]) => (isDown ? -1 : 1) * compared(a, b) || i - j);
  return { ...document, [list]: order.map(([, , row]) => row) };
}

/**
 * @param {string | number} one
 * @param {string | number} other
 * @returns {number}
 */
function compared(one, other) {
  if (typeof one === "number" && typeof other === "number") return one - other;
  return String(one).localeCompare(String(other), undefined, { numeric: true });
}

/**
 * Items as text for a spreadsheet; `columns` have `text`.
 * @param {RowData[]} rows
 * @param {Pick<Column, "text">[]} columns
 * @returns {string}
 */
export const tableText = (rows, columns) =>
  rows.map((row) => columns.map(({ text }) => text(row)).join("\t")).join("\n");
