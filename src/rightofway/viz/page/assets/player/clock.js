import { lastAtMost } from "../common/arrays.js";
import { FleetMemo } from "../plan/fleet_memo.js";
import { Observable } from "../common/observable.js";

/** @import { Fleet } from "../plan/motion.js" */
/** @import { Site } from "../plan/site.js" */
/** @import { Robot } from "../plan/robot.js" */

/** @typedef {{ from: number, to: number }} Stretch Of time, in ticks. */
/**
 * The moment that a view shows: of a clock, of one that follows another, of a map that stands still.
 *
 * @typedef {object} Moments
 * @property {number} tick
 * @property {boolean} playing
 * @property {Stretch | null} loop
 * @property {() => void} pause
 * @property {(tick: number) => void} seek
 */

/** How many time units pass in a second. */
export const RATES = [1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16, 32, 64, 128, 256, 512, 1024];

/** A whole plan, or two periods, play in about this long [s], unless the user changes the speed. */
const PLEASANT_SECONDS = 24;

/** How fast a clock catches up with the moment that it follows [1/s]. */
const CATCH_UP = 4;

/** How near it has to come to be there [ticks]. */
const CLOSE = 0.02;

/**
 * The moment shown. Events: `tick` when it changes, `playing` when it starts, stops, or changes pace,
 * `loop` when it begins or ends to play a stretch of time again and again, `end` when time ends later.
 */
export class Clock extends Observable {
  /**
   * @param {Site} plan
   * @param {Fleet} [fleet] the robots that are shown
   */
  constructor(plan, fleet = plan) {
    super();
    this.end = plan.end;
    this.tick = 0;
    this.playing = false;
    this.ticksPerUnit = plan.tick.denominator / plan.tick.numerator;
    const shown =
      plan.steady && !plan.happened ? Math.min(2 * plan.steady.largest.period, this.end) : this.end;
    const pace = shown / this.ticksPerUnit / PLEASANT_SECONDS;
    this.rate = RATES.findLast((rate) => rate < 1.5 * pace) ?? RATES[0];
    /** @type {Stretch | null} */
    this.loop = null;
    this.turns = 0; // how often it has gone back since it loops
    /** @type {(() => number) | null} */
    this.live = null; // the moment at which it is now, of a fleet that is driven
    this.following = false; // whether that moment is shown
    this.#events = new FleetMemo(fleet, () => eventsOf(fleet));
  }

  #events;

  /** The moment, as a whole number of ticks. */
  get wholeTick() {
    return Math.floor(this.tick + 1e-9);
  }

  /** The moment if time had gone on instead of back. */
  get running() {
    return this.loop ? this.tick + this.turns * (this.loop.to - this.loop.from) : this.tick;
  }

  /**
   * Show a moment; one after the loop ends it.
   *
   * @param {number} tick
   */
  seek(tick) {
    this.following = false;
    if (this.loop && tick > this.loop.to) this.setLoop(null);
    this.turns = 0;
    this.#go(tick);
  }

  /** @param {number} tick */
  #go(tick) {
    this.tick = Math.min(Math.max(tick, 0), this.end);
    this.tell("tick");
  }

  /**
   * Play from `from` to `to` again and again; null to go on. What comes before `from` is played once.
   *
   * @param {Stretch | null} loop
   */
  setLoop(loop) {
    const { running } = this;
    this.loop = loop;
    this.turns = 0;
    this.#go(loop ? this.#wrapped(running) : this.tick);
    this.tell("loop");
  }

  /**
   * The moment of the loop that is like this one.
   *
   * @param {number} tick
   */
  #wrapped(tick) {
    const { from, to } = /** @type {Stretch} */ (this.loop);
    const turns = Math.max(Math.floor((tick - from) / (to - from)), 0);
    this.turns += turns;
    return tick - turns * (to - from);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.tick >= this.end) this.seek(0);
    this.playing = true;
    this.tell("playing");
  }

  /** Show the moment at which it is now, as long as nobody looks at another one. */
  follow() {
    if (!this.live) return;
    this.following = this.playing = true;
    this.tell("playing");
  }

  /**
   * Have time end later.
   *
   * @param {number} end
   */
  lengthen(end) {
    this.end = end;
    this.tell("end");
  }

  pause() {
    this.playing = this.following = false;
    this.tell("playing");
  }

  /** @param {number} rate */
  setRate(rate) {
    this.rate = rate;
    this.tell("playing");
  }

  /**
   * Take the next slower (-1) or faster (1) rate.
   *
   * @param {number} by
   */
  changeRate(by) {
    const index = RATES.indexOf(this.rate) + by;
    if (RATES[index]) this.setRate(RATES[index]);
  }

  /**
   * Let time run on.
   *
   * @param {number} seconds
   */
  advance(seconds) {
    if (this.following && this.live) {
      const behind = this.live() - this.tick; // caught up with smoothly: frames come some times a second
      const share = Math.abs(behind) < CLOSE ? 1 : 1 - Math.exp(-CATCH_UP * seconds);
      this.#go(this.tick + behind * share);
      return;
    }
    const tick = this.tick + seconds * this.rate * this.ticksPerUnit;
    if (this.live && tick >= this.live()) {
      this.#go(this.live());
      this.follow();
      return;
    }
    this.#go(this.loop ? this.#wrapped(tick) : tick);
    if (this.tick >= this.end && !this.loop) this.pause();
  }

  /**
   * Go one whole tick back (-1) or on (1).
   *
   * @param {number} by
   */
  step(by) {
    this.pause();
    const tick = by < 0 ? Math.ceil(this.tick - 1e-9) - 1 : this.wholeTick + 1;
    this.#go(this.loop ? this.#wrapped(tick) : tick);
  }

  /**
   * Go to the last (-1) or next (1) instant at which `robot`, or any robot for null, does something new.
   *
   * @param {number} by
   * @param {Robot | null} robot
   */
  stepEvent(by, robot) {
    this.pause();
    const events = robot ? robot.phases.begin : this.#events.value;
    const index = lastAtMost(events, by < 0 ? this.tick - 1e-9 : this.tick + 1e-9);
    this.seek(by < 0 ? events[index] : (events[index + 1] ?? this.end));
  }
}

/** The clock of another plan: the same moment in ticks of its own, `ratio` of which are one of the other clock. */
export class Follower extends Observable {
  /**
   * @param {Clock} clock
   * @param {number} ratio
   */
  constructor(clock, ratio) {
    super();
    this.clock = clock;
    this.ratio = ratio;
    this.loop = null;
    for (const event of ["tick", "playing"]) clock.on(event, () => this.tell(event));
  }

  get tick() {
    return this.clock.tick * this.ratio;
  }

  get playing() {
    return this.clock.playing;
  }

  pause() {
    this.clock.pause();
  }

  /** @param {number} tick */
  seek(tick) {
    this.clock.seek(tick / this.ratio);
  }
}

/**
 * All instants at which a robot does something new, in order.
 *
 * @param {Fleet} fleet
 */
function eventsOf({ robots }) {
  const begins = new Set();
  for (const robot of robots) for (const begin of robot.phases.begin) begins.add(begin);
  return Float64Array.from(begins).sort();
}
