/** What is selected on the map: robots, obstacles, vertices and lanes of the document. */

/** @import { Ids, Item } from "../types.js" */

export class Selection {
  /** @type {Map<string, Item>} */
  #items = new Map();

  /**
   * @param {Item} item
   * @returns {string}
   */
  static key = ({ kind, id }) => `${kind} ${id}`;

  get items() {
    return [...this.#items.values()];
  }

  /**
   * The ids of one kind.
   * @template {keyof Ids} Kind
   * @param {Kind} kind
   * @returns {Ids[Kind][]}
   */
  of(kind) {
    const ids = this.items.filter((item) => item.kind === kind).map(({ id }) => id);
    return /** @type {Ids[Kind][]} */ (ids);
  }

  get size() {
    return this.#items.size;
  }

  /**
   * @param {Item} item
   * @returns {boolean}
   */
  has(item) {
    return this.#items.has(Selection.key(item));
  }

  /**
   * @param {Item[]} items
   * @returns {void}
   */
  set(items) {
    this.#items = new Map(items.map((item) => [Selection.key(item), item]));
  }

  /**
   * @param {Item} item
   * @returns {void}
   */
  toggle(item) {
    if (!this.#items.delete(Selection.key(item))) this.#items.set(Selection.key(item), item);
  }

  clear() {
    this.#items.clear();
  }
}
