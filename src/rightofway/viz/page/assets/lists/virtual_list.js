import { lastOf } from "../common/arrays.js";
import { element } from "../common/dom.js";

const SPARE_ROWS = 4;

/**
 * The element of a row, and what was written into it.
 *
 * @template I
 * @typedef {HTMLElement & { item?: I, filled?: I }} ListRow
 */

/**
 * A list of any length that has elements for the rows in sight only.
 *
 * `fill(row, item)` writes an item into a row, `choose(item)` is called for the one that was picked.
 *
 * @template I
 */
export class VirtualList {
  /** @type {ListRow<I>[]} */
  #rows = [];
  #first = 0;

  /**
   * @param {HTMLElement} box
   * @param {{ rowHeight: number, className?: string, none: string, fill: (row: ListRow<I>, item: I) => void, choose: (item: I) => void }} options
   */
  constructor(box, { rowHeight, className = "", none, fill, choose }) {
    this.box = box;
    this.className = className;
    this.fill = fill;
    this.choose = choose;
    this.rowHeight = matchMedia("(pointer: coarse)").matches ? Math.max(rowHeight, 44) : rowHeight;
    /** @type {I[]} */
    this.items = [];
    /** @type {I | null} */
    this.chosen = null;
    this.space = element("div", { className: "rows" });
    this.none = element("p", { className: "none" }, none);
    box.append(this.space, this.none);
    box.addEventListener("scroll", () => this.refresh(), { passive: true });
    box.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.refresh()).observe(box);
  }

  /** @param {I[]} items */
  setItems(items) {
    this.items = items;
    this.space.style.height = `${items.length * this.rowHeight}px`;
    this.none.hidden = items.length > 0;
    this.refresh();
  }

  /**
   * Mark an item as chosen and bring it into sight.
   *
   * @param {I | null} item
   */
  setChosen(item) {
    this.chosen = item;
    const index = this.#chosenIndex;
    if (index >= 0) this.#reveal(index);
    this.refresh();
  }

  /** Write the rows in sight again. */
  refresh() {
    const { scrollTop, clientHeight } = this.box;
    if (!clientHeight) return;
    this.#first = Math.max(Math.floor(scrollTop / this.rowHeight) - SPARE_ROWS, 0);
    const count = Math.ceil(clientHeight / this.rowHeight) + 2 * SPARE_ROWS;
    while (this.#rows.length < count) this.#rows.push(this.#makeRow());
    this.#rows.forEach((row, offset) => this.#place(row, this.#first + offset));
    this.#describe();
  }

  #makeRow() {
    /** @type {ListRow<I>} */
    const row = element("div", { className: `row ${this.className}`, role: "option" });
    row.setAttribute("role", "option");
    row.addEventListener("click", () => row.item !== undefined && this.choose(row.item));
    this.space.append(row);
    return row;
  }

  /**
   * @param {ListRow<I>} row
   * @param {number} index
   */
  #place(row, index) {
    const item = this.items[index];
    row.hidden = item === undefined;
    if (row.hidden) return;
    row.item = item;
    row.id = `${this.box.id}-${index}`;
    row.style.height = `${this.rowHeight}px`;
    row.style.transform = `translateY(${index * this.rowHeight}px)`;
    row.setAttribute("aria-selected", String(item === this.chosen));
    row.setAttribute("aria-posinset", String(index + 1));
    row.setAttribute("aria-setsize", String(this.items.length));
    this.fill(row, item);
  }

  get #chosenIndex() {
    return this.chosen === null ? -1 : this.items.indexOf(this.chosen);
  }

  #describe() {
    const index = this.#chosenIndex;
    if (index >= 0) this.box.setAttribute("aria-activedescendant", `${this.box.id}-${index}`);
    else this.box.removeAttribute("aria-activedescendant");
  }

  /** @param {number} index */
  #reveal(index) {
    const [top, bottom] = [index * this.rowHeight, (index + 1) * this.rowHeight];
    if (top < this.box.scrollTop) this.box.scrollTop = top;
    else if (bottom > this.box.scrollTop + this.box.clientHeight)
      this.box.scrollTop = bottom - this.box.clientHeight;
  }

  /** Choose the first item, if there is one. */
  chooseFirst() {
    if (this.items.length) this.choose(this.items[0]);
  }

  /**
   * Choose the item before (-1) or after (1) the one that is chosen.
   *
   * @param {number} by
   */
  step(by) {
    const target = Math.min(Math.max(this.#chosenIndex + by, 0), this.items.length - 1);
    if (target >= 0) this.choose(this.items[target]);
  }

  /** @param {KeyboardEvent} event */
  #key(event) {
    if (event.key === "ArrowDown" || event.key === "ArrowUp")
      this.step(event.key === "ArrowDown" ? 1 : -1);
    else if (event.key === "Home") this.chooseFirst();
    else if (event.key === "End" && this.items.length) this.choose(lastOf(this.items));
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
