import { element } from "./dom.js";

const SPARE_ROWS = 4;

/**
 * A list of any length that has elements for the rows in sight only.
 *
 * `fill(row, item)` writes an item into a row, `choose(item)` is called for the one that was picked.
 */
export class VirtualList {
  #rows = [];
  #first = 0;

  constructor(box, { rowHeight, className = "", none, fill, choose }) {
    Object.assign(this, { box, className, fill, choose });
    this.rowHeight = matchMedia("(pointer: coarse)").matches ? Math.max(rowHeight, 44) : rowHeight;
    this.items = [];
    this.chosen = null;
    this.space = element("div", { className: "rows" });
    this.none = element("p", { className: "none" }, none);
    box.append(this.space, this.none);
    box.addEventListener("scroll", () => this.refresh(), { passive: true });
    box.addEventListener("keydown", (event) => this.#key(event));
    new ResizeObserver(() => this.refresh()).observe(box);
  }

  setItems(items) {
    this.items = items;
    this.space.style.height = `${items.length * this.rowHeight}px`;
    this.none.hidden = items.length > 0;
    this.refresh();
  }

  /** Mark an item as chosen and bring it into sight. */
  setChosen(item) {
    this.chosen = item;
    const index = this.items.indexOf(item);
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
    const row = element("div", { className: `row ${this.className}`, role: "option" });
    row.setAttribute("role", "option");
    row.addEventListener("click", () => this.choose(row.item));
    this.space.append(row);
    return row;
  }

  #place(row, index) {
    const item = this.items[index];
    row.hidden = item === undefined;
    if (row.hidden) return;
    row.item = item;
    row.id = `${this.box.id}-${index}`;
    row.style.height = `${this.rowHeight}px`;
    row.style.transform = `translateY(${index * this.rowHeight}px)`;
    row.setAttribute("aria-selected", item === this.chosen);
    row.setAttribute("aria-posinset", index + 1);
    row.setAttribute("aria-setsize", this.items.length);
    this.fill(row, item);
  }

  #describe() {
    const index = this.items.indexOf(this.chosen);
    if (index >= 0) this.box.setAttribute("aria-activedescendant", `${this.box.id}-${index}`);
    else this.box.removeAttribute("aria-activedescendant");
  }

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

  /** Choose the item before (-1) or after (1) the one that is chosen. */
  step(by) {
    const target = Math.min(
      Math.max(this.items.indexOf(this.chosen) + by, 0),
      this.items.length - 1,
    );
    if (target >= 0) this.choose(this.items[target]);
  }

  #key(event) {
    if (event.key === "ArrowDown" || event.key === "ArrowUp")
      this.step(event.key === "ArrowDown" ? 1 : -1);
    else if (event.key === "Home") this.chooseFirst();
    else if (event.key === "End" && this.items.length) this.choose(this.items.at(-1));
    else return;
    event.preventDefault();
    event.stopPropagation();
  }
}
