/** Something others can listen to. */
export class Observable {
  #listeners = {};

  /** Call `listener` at each `event`. */
  on(event, listener) {
    (this.#listeners[event] ??= []).push(listener);
  }

  /** Call all listeners of an event. */
  tell(event) {
    for (const listener of this.#listeners[event] ?? []) listener();
  }
}
