/** Robots or jobs as a spreadsheet: typed, pasted, filled, sorted with the keyboard; faults stand at their cells and below. */

import { itemOf, nameOf } from "../fault_place.js";
import { html, useEffect, useRef, useState } from "../vendor/htm-preact.js";
import { Field } from "../field.js";
import { words } from "../words.js";
import {
  blockOf,
  blockText,
  cleared,
  filled,
  headingsOf,
  holds,
  isSingle,
  pasted,
  rowsOfText,
} from "./block.js";
import { freeName, removeRows, rowsIn, sortRows } from "./rows.js";
/** @import { DocumentFault } from "../api_types.js" */
/** @import { Block, Column, Edit, Props, RowData, SheetCell, SheetTable } from "../types.js" */
/** @import { PageEvent } from "../vendor/htm-preact.js" */

const MOST_ROWS = 100; // that are written at once; the others on request
const MOST_FAULTS = 5; // that are listed below the table

/**
 * The table; `columns` are those that are shown, `wanted` is what an item has to say somewhere.
 * @param {Props & {table: SheetTable, columns: Column[], wanted: string}} props
 */
export function Sheet({ studio, table, columns, wanted }) {
  const { store, editor } = studio;
  const { list, kind, columnOf, unitOf } = table;
  const items = rowsIn(store.document, list);
  const [sorted, setSorted] = useState({ key: "", isDown: false });
  const [most, setMost] = useState(MOST_ROWS);
  const [cells, setCells] = useState(/** @type {{from: SheetCell, to: SheetCell} | null} */ (null)); // the block
  const sheet = useRef(null);
  /** @type {import("../vendor/htm-preact.js").Ref<EventTarget | null>} */
  const edited = useRef(null); // the field whose text is edited; the text of a cell that is only selected is replaced by typing
  const block = cells && blockOf(cells.from, cells.to);
  useEffect(() => setCells(null), [columns.length]);

  /**
   * @param {RowData} item
   * @returns {boolean}
   */
  const isWanted = (item) =>
    !wanted || columns.some(({ text }) => text(item).toLowerCase().includes(wanted));
  const rows = items.map((item, row) => ({ item, row })).filter(({ item }) => isWanted(item));
  const colours = new Map(
    kind === "robot" ? store.site?.robots.map(({ index, colour }) => [index, colour]) : [],
  );
  const faults = faultsByRow(store.faults, list);

  /**
   * @param {Edit} edit
   * @returns {void}
   */
  const change = (edit) => store.change(edit);
  /**
   * @param {SheetCell} at
   * @param {string} text
   * @returns {void}
   */
  const write = (at, text) => {
    const item = items[at.row];
    if (item ? columns[at.column].text(item) === text : !text.trim()) return;
    change((document) => pasted(document, table, columns, [[text]], at));
  };
  /**
   * @param {Column} column
   * @returns {void}
   */
  const sort = (column) => {
    const isDown = sorted.key === column.key && !sorted.isDown;
    setSorted({ key: column.key, isDown });
    change((document) => sortRows(document, list, column.value ?? column.text, isDown));
  };
  /**
   * @param {SheetCell} at
   * @param {HTMLInputElement} field
   * @returns {void}
   */
  const enter = (at, field) => {
    edited.current = null;
    field.select();
    setCells({ from: at, to: at });
    if (items[at.row]) editor.select([{ kind, id: at.row }]);
  };
  /**
   * @param {HTMLInputElement} field
   * @returns {void}
   */
  const edit = (field) => {
    edited.current = field;
    field.setSelectionRange(field.value.length, field.value.length);
  };
  /**
   * A press selects a cell, whose text stays selected; in a cell that is edited it places the caret.
   * @param {PageEvent} event
   * @param {SheetCell} at
   * @returns {void}
   */
  const press = (event, at) => {
    const { target: field, shiftKey } = event;
    if (edited.current === field) return;
    event.preventDefault();
    if (shiftKey) extend(at);
    else if (document.activeElement === field) enter(at, field);
    else field.focus();
  };
  /**
   * @param {SheetCell} at
   * @returns {void}
   */
  const extend = (at) => {
    if (cells) setCells({ from: cells.from, to: at });
  };
  /**
   * @param {SheetCell} at
   * @param {HTMLElement} from
   * @returns {void}
   */
  const goTo = ({ row, column }, from) => {
    /** @type {HTMLElement | null} */
    const cell = sheet.current.querySelector(`[data-cell="${row} ${column}"]`);
    if (cell && cell !== from) cell.focus();
    else from.blur(); // what was written counts all the same
  };

  /**
   * @param {PageEvent} event
   * @param {SheetCell} at
   * @returns {void}
   */
  const paste = (event, at) => {
    const text = event.clipboardData?.getData("text") ?? "";
    const lines = rowsOfText(text);
    if (lines.length === 1 && lines[0].length === 1) return;
    event.preventDefault();
    if (table.read && headingsOf(table, lines)) {
      const { read } = table;
      studio.attempt(async () => store.change(await read(text)));
    } else change((document) => pasted(document, table, columns, lines, at));
  };
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const copy = (event) => {
    if (!block || isSingle(block)) return;
    event.preventDefault();
    event.clipboardData?.setData("text/plain", blockText(items, columns, block));
    if (event.type === "cut") change((document) => cleared(document, table, columns, block));
  };
  /**
   * @param {number} until
   * @returns {void}
   */
  const fill = (until) => {
    if (!block || !cells) return;
    const whole = { ...block, bottom: Math.max(until, block.bottom) };
    change((document) => filled(document, table, columns, whole));
    setCells({ from: cells.from, to: { row: whole.bottom, column: whole.right } });
  };
  /**
   * @param {PageEvent} event
   * @param {SheetCell} at
   * @returns {void}
   */
  const key = (event, at) => {
    const isMany = block && !isSingle(block);
    if ((event.ctrlKey || event.metaKey) && event.key === "Enter")
      return write(at, event.target.value); // the page plans it
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === "d")
      fill(isMany ? block.bottom : items.length - 1);
    else if (isMany && ["Delete", "Backspace"].includes(event.key))
      change((document) => cleared(document, table, columns, block));
    else if (event.key === "Escape") enter(at, event.target);
    else if (event.key === "F2" || (isPlainEnter(event) && edited.current !== event.target))
      edit(event.target);
    else if (cells && event.shiftKey && ARROWS[event.key] && stepFrom(event)) {
      const [down, right] = ARROWS[event.key];
      extend({
        row: clamped(cells.to.row + down, items.length - 1),
        column: clamped(cells.to.column + right, columns.length - 1),
      });
    } else {
      const next = stepFrom(event);
      if (!next) return;
      const place = rows.findIndex(({ row }) => row === at.row);
      const shown = [...rows.map(({ row }) => row), items.length];
      const row = shown[clamped((place < 0 ? rows.length : place) + next[0], rows.length)];
      goTo({ row, column: clamped(at.column + next[1], columns.length - 1) }, event.target);
    }
    event.preventDefault();
    event.stopPropagation();
  };

  /**
   * @param {RowData | null} item
   * @param {number} row
   * @param {Column} column
   * @param {number} at
   */
  const cell = (item, row, column, at) => {
    const place = { row, column: at };
    const fault = faults.get(row)?.find((each) => columnOf(each) === column.key);
    const [title, , usual = ""] = column.words(words);
    return html`<td key=${column.key} class=${`${column.key} ${holds(block, row, at) && !isSingle(/** @type {Block} */ (block)) ? "in" : ""}`}>
      <${Field} value=${item ? column.text(item) : ""} data-cell=${`${row} ${at}`} spellcheck="false"
        aria-label=${item ? `${title}, ${item.name}` : `${title}, ${table.newRow(words)}`} aria-invalid=${String(Boolean(fault))} title=${fault?.message ?? (item ? column.text(item) : "")}
        placeholder=${item ? usual : column.key === "name" ? freeName(items, list) : ""}
        onFocus=${({ target }) => enter(place, target)} onInput=${({ target }) => (edited.current = target)} onDblClick=${({ target }) => edit(target)} onChange=${({ target }) => write(place, target.value)}
        onMouseDown=${(event) => press(event, place)}
        onPaste=${(event) => paste(event, place)} onCopy=${copy} onCut=${copy} onKeyDown=${(event) => key(event, place)} />
      ${item && block && row === block.bottom && at === block.right && html`<${Handle} fill=${fill} />`}
    </td>`;
  };
  /**
   * @param {PageEvent} event
   * @param {number} row
   * @returns {void}
   */
  const select = (event, row) => {
    if (event.target.matches("input, button")) return;
    if (event.shiftKey || event.ctrlKey) editor.selection.toggle({ kind, id: row });
    else editor.select([{ kind, id: row }]);
    editor.changed();
  };
  /**
   * The title of a column, with the unit of its numbers where the document has units.
   * @param {Column} column
   * @returns {string}
   */
  const headOf = (column) => {
    const unit = unitOf(column, store.document.units ?? {});
    return unit ? `${column.words(words)[0]} [${unit}]` : column.words(words)[0];
  };
  return html`
    <div class="sheet" ref=${sheet}><table class=${kind === "robot" ? "robots" : "robots jobs"}>
      <thead><tr>${columns.map(
        (column) => html`
        <th scope="col" class=${column.key} aria-sort=${sorted.key === column.key ? (sorted.isDown ? "descending" : "ascending") : "none"}>
          <button type="button" title=${column.words(words)[1]} onClick=${() => sort(column)}>${headOf(column)}</button></th>`,
      )}<th class="do"><span class="unseen">${words.remove}</span></th></tr></thead>
      <tbody>${rows.slice(0, most).map(
        ({ item, row }) => html`
        <tr key=${row} data-row=${row} aria-selected=${String(editor.selection.has({ kind, id: row }))} onClick=${(event) => select(event, row)} style=${{ "--robot": colours.get(row) ?? "transparent" }}>
          ${columns.map((column, at) => cell(item, row, column, at))}
          <td class="do"><button type="button" class="quiet" tabindex="-1" aria-label=${`${words.remove} ${item.name}`} title=${words.remove} onClick=${() => change((document) => removeRows(document, list, [row]))}>✕</button></td>
        </tr>`,
      )}
      ${!wanted && html`<tr key="new" class="new">${columns.map((column, at) => cell(null, items.length, column, at))}<td></td></tr>`}
      </tbody>
    </table></div>
    ${
      faults.size > 0 &&
      html`<div role="alert"><ul class="faults">${[...faults.values()]
        .flat()
        .slice(0, MOST_FAULTS)
        .map(
          (fault) =>
            html`<li><button type="button" onClick=${() => studio.goTo(fault)}><b>${nameOf(fault)}</b> <span lang="en">${fault.message}</span></button></li>`,
        )}</ul></div>`
    }
    ${rows.length > most && html`<button type="button" class="framed" onClick=${() => setMost(most + MOST_ROWS)}>${words.moreRows({ count: rows.length - most })}</button>`}`;
}

/** @type {Record<string, [number, number]>} */
const ARROWS = { ArrowDown: [1, 0], ArrowUp: [-1, 0], ArrowRight: [0, 1], ArrowLeft: [0, -1] };

/**
 * @param {number} value
 * @param {number} most
 * @returns {number}
 */
const clamped = (value, most) => Math.min(Math.max(value, 0), most);

/**
 * @param {PageEvent} event
 * @returns {unknown}
 */
const isPlainEnter = ({ key, shiftKey, target }) => key === "Enter" && !shiftKey && target.value;

/**
 * Where a key leads to: rows and columns; sideways only from the end of what is written.
 * @param {PageEvent} event
 * @returns {[number, number] | undefined | false}
 */
function stepFrom({ key, shiftKey, target }) {
  if (key === "Enter") return [shiftKey ? -1 : 1, 0];
  const step = ARROWS[key];
  if (!step || !step[1]) return step;
  const { value } = target;
  const [selectionStart, selectionEnd] = [target.selectionStart ?? 0, target.selectionEnd ?? 0];
  if (selectionStart !== selectionEnd)
    return selectionEnd - selectionStart === value.length && step;
  return selectionEnd === (step[1] > 0 ? value.length : 0) && step;
}

/**
 * @param {DocumentFault[]} faults
 * @param {string} list
 * @returns {Map<number, DocumentFault[]>}
 */
function faultsByRow(faults, list) {
  const found = new Map();
  for (const fault of faults) {
    const row = itemOf(fault, list);
    if (row < 0) continue;
    if (!found.has(row)) found.set(row, []);
    found.get(row).push(fault);
  }
  return found;
}

/**
 * The corner of a block: dragged down, it fills the rows that it passes.
 * @param {{fill: (row: number) => void}} props
 */
function Handle({ fill }) {
  /**
   * @param {PageEvent} event
   * @returns {void}
   */
  const drag = (event) => {
    event.preventDefault();
    const handle = event.target;
    handle.setPointerCapture(event.pointerId);
    /**
     * @param {{clientX: number, clientY: number}} at
     * @returns {number}
     */
    const rowAt = ({ clientX, clientY }) =>
      Number(
        document
          .elementFromPoint(clientX, clientY)
          ?.closest("tr[data-row]")
          ?.getAttribute("data-row") ?? -1,
      );
    let row = -1;
    handle.onpointermove = (move) => (row = Math.max(rowAt(move), -1));
    handle.onpointerup = () => {
      handle.onpointermove = handle.onpointerup = null;
      if (row >= 0) fill(row);
    };
  };
  return html`<span class="handle" title=${words.fillDown} onPointerDown=${drag}></span>`;
}
