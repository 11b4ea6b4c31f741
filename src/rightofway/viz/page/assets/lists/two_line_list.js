import { element } from "../common/dom.js";
import { connectFind, matches } from "./find.js";
import { VirtualList } from "./virtual_list.js";

/** @import { Choice } from "../player/choice.js" */
/** @import { Clock } from "../player/clock.js" */
/** @import { Root } from "../common/root.js" */

/** @typedef {{ head: string, detail: string, isAlarm?: boolean, isChosen: () => boolean, choose: () => void }} TwoLines An item of a list. */

/** A list with a search field, of items with a head and a detail. */
export class TwoLineList {
  /**
   * @param {Root} root
   * @param {string} part what its items are: `find-…` is its field, `…-list` its box
   * @param {Choice} choice
   * @param {TwoLines[]} items
   * @param {{ none: string, isLong: boolean }} options the text in its place, and whether items may fill more lines
   */
  constructor(root, part, choice, items, { none, isLong }) {
    this.items = items;
    this.find = root.part(`find-${part}`, HTMLInputElement);
    this.list = new VirtualList(root.part(`${part}-list`), {
      rowHeight: isLong ? 72 : 52,
      className: isLong ? "two long" : "two",
      none,
      fill: fillTwoLines,
      choose: (item) => item.choose(),
    });
    connectFind(this.find, this.list, () => this.#select());
    choice.on("choice", () =>
      this.list.setChosen(this.items.find((item) => item.isChosen()) ?? null),
    );
    this.#select();
  }

  refresh() {
    this.list.refresh();
  }

  /** @param {TwoLines[]} items */
  setItems(items) {
    this.items = items;
    this.#select();
  }

  #select() {
    this.list.setItems(
      this.items.filter(({ head, detail }) => matches(`${head} ${detail}`, this.find.value)),
    );
  }
}

/**
 * Choose something that happens at a moment, and go there.
 *
 * @param {Pick<Clock, "pause" | "seek">} clock
 * @param {number} tick
 * @param {() => void} choose
 */
export function chooseAt(clock, tick, choose) {
  clock.pause();
  clock.seek(tick);
  choose();
}

/**
 * Write an item with a head and a detail into a row.
 *
 * @param {HTMLElement & { filled?: TwoLines }} row
 * @param {TwoLines} item
 */
function fillTwoLines(row, item) {
  if (row.filled === item) return;
  row.filled = item;
  row.title = `${item.head}\n${item.detail}`;
  const lines = [item.head, item.detail].map((text) =>
    element("span", { className: "text name" }, text),
  );
  lines[0].classList.toggle("wrong", Boolean(item.isAlarm));
  row.replaceChildren(...lines);
}
