/** Work on what is the latest: while one round goes on, any number of requests make one more. */
export class Latest {
  /** @type {Promise<void> | null} */
  #running = null;
  #again = false;

  /** @param {() => unknown} work */
  constructor(work) {
    this.work = work;
  }

  ask() {
    if (this.#running) this.#again = true;
    else this.#running = this.#run();
  }

  async idle() {
    while (this.#running) await this.#running;
  }

  async #run() {
    do {
      this.#again = false;
      await this.work();
    } while (this.#again);
    this.#running = null;
  }
}
