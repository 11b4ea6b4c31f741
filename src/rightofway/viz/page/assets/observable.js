/** Something others can listen to. */
export class Observable {
  /** @type {Record<string, (() => void)[]>} */
  #listeners = {};

  /**
   * Call `listener` at each `event`.
   *
   * @param {string} event
   * @param {() => void} listener
   */
  on(event, listener) {
    (this.#listeners[event] ??= []).push(listener);
  }

  /**
   * Call all listeners of an event.
   *
   * @param {string} event
   */
  tell(event) {
    for (const listener of this.#listeners[event] ?? []) listener();
  }
}
