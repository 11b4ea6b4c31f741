/** @import { Clock } from "./clock.js" */

const LONGEST = 100; // ms that time runs between two frames at most

/** Paints while a clock runs; at other times a frame for each request, however many there are before it. */
export class FrameLoop {
  #asked = false;
  #last = 0; // when the last frame was painted while time ran [ms]

  /**
   * @param {Clock} clock
   * @param {(paint: (now: number) => void) => void} request asks the browser for a frame
   * @param {() => boolean | void} draw false where nothing is in sight: then the loop rests until `ask`
   */
  constructor(clock, request, draw) {
    this.clock = clock;
    this.request = request;
    this.draw = draw;
  }

  /** Have a frame painted soon; while nothing changes, none is. */
  ask() {
    if (this.#asked) return;
    this.#asked = true;
    this.request((now) => this.paint(now));
  }

  /** @param {number} now [ms] */
  paint(now) {
    const { clock } = this;
    this.#asked = false;
    if (clock.playing) clock.advance(this.#last ? Math.min(now - this.#last, LONGEST) / 1000 : 0);
    this.#last = clock.playing ? now : 0;
    if (this.draw() !== false && clock.playing) this.ask();
  }
}
