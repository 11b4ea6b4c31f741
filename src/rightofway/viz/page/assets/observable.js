/** Something others can listen to. */
export class Observable {
  #listeners = {};

  /** Call `listener` whenever `event` is told. */
  on(event, listener) {
    (this.#listeners[event] ??= []).push(listener);
  }

  /** Tell everybody who listens. */
  tell(event) {
    for (const listener of this.#listeners[event] ?? []) listener();
  }
}
