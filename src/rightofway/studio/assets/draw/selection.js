/** What is selected on the map: robots, obstacles, vertices and lanes of the document. */

export class Selection {
  #items = new Map();

  static key = ({ kind, id }) => `${kind} ${id}`;

  get items() {
    return [...this.#items.values()];
  }

  /** The ids of one kind. */
  of(kind) {
    return this.items.filter((item) => item.kind === kind).map(({ id }) => id);
  }

  get size() {
    return this.#items.size;
  }

  has(item) {
    return this.#items.has(Selection.key(item));
  }

  set(items) {
    this.#items = new Map(items.map((item) => [Selection.key(item), item]));
  }

  toggle(item) {
    if (!this.#items.delete(Selection.key(item))) this.#items.set(Selection.key(item), item);
  }

  clear() {
    this.#items.clear();
  }
}
