/** Something others can listen to. */
export class Observable {
  /** @type {Record<string, (() => void)[]>} */
  #listeners = {};

  /**
   * Call `listener` at each `event`, until the function that is returned is called.
   *
   * @param {string} event
   * @param {() => void} listener
   * @returns {() => void}
   */
  on(event, listener) {
    (this.#listeners[event] ??= []).push(listener);
    return () => {
      this.#listeners[event] = this.#listeners[event].filter((other) => other !== listener);
    };
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
