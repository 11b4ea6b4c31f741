import { lastAtMost } from "../common/arrays.js";

/** @import { SteadyData } from "../payload.d.ts" */
/** @import { Robot } from "./robot.js" */

/**
 * A visit of a circuit.
 *
 * @typedef {object} Step
 * @property {Robot} robot
 * @property {number} visit
 * @property {number} vertex
 * @property {number} begin
 * @property {number} next
 * @property {number} ticks
 */

/** The groups of robots that repeat themselves, each from its own start and with its own period. */
export class Steady {
  /**
   * @param {SteadyData[]} groups
   * @param {number[]} laps of each robot
   * @param {readonly Robot[]} robots
   */
  constructor(groups, laps, robots) {
    this.groups = groups.map((group) => new Group(group, robots));
    this.groupOf = robots.map(({ index }) => this.groups.find((group) => group.has(index)) ?? null);
    this.largest = this.groups.reduce((most, group) =>
      group.robots.length > most.robots.length ? group : most,
    );
    this.lapEnds = robots.map((robot) => lapEnds(robot, laps[robot.index]));
  }

  /**
   * The group of a robot; without one, the largest.
   *
   * @param {Robot | null} robot
   */
  group(robot) {
    return (robot && this.groupOf[robot.index]) ?? this.largest;
  }

  /**
   * Where in the plan a robot is that has gone on repeating itself until a tick.
   *
   * @param {number} index
   * @param {number} tick
   */
  tickOf(index, tick) {
    return this.groupOf[index]?.wrapped(tick) ?? tick;
  }

  /**
   * How many laps a robot has made by a tick of the plan.
   *
   * @param {number} index
   * @param {number} tick
   */
  laps(index, tick) {
    return countAtMost(this.lapEnds[index], tick);
  }

  /**
   * The group of a robot that repeats itself.
   *
   * @param {number} index
   */
  #groupAt(index) {
    const group = this.groupOf[index];
    if (!group)
      throw new Error(`steady: robot ${index} does not repeat itself (ask groupOf first)`);
    return group;
  }

  /**
   * How many laps a robot that repeats itself makes in a period.
   *
   * @param {number} index
   */
  lapsInPeriod(index) {
    const { start, period } = this.#groupAt(index);
    return this.laps(index, start + period) - this.laps(index, start);
  }

  /**
   * How many laps a robot has made if it goes on repeating itself until a tick.
   *
   * @param {number} index
   * @param {number} tick
   */
  lapsForEver(index, tick) {
    const within = this.tickOf(index, tick);
    if (within === tick) return this.laps(index, tick);
    const periods = Math.round((tick - within) / this.#groupAt(index).period);
    return this.laps(index, within) + periods * this.lapsInPeriod(index);
  }
}

/** Robots that repeat themselves together. */
export class Group {
  isCritical = true;
  /** @type {Step[]} */
  circuit = [];
  turn = 0; // ticks that the circuit takes once round: whole periods

  /**
   * @param {SteadyData} raw
   * @param {readonly Robot[]} robots
   */
  constructor(raw, robots) {
    this.robots = raw.robots;
    this.start = raw.start;
    this.period = raw.period;
    this.until = raw.until;
    this.critical = raw.critical;
    this.bottleneck = raw.bottleneck ?? [];
    this.members = new Set(raw.robots);
    this.light(null, robots);
  }

  /**
   * Light another circle of visits than the critical one; null for that one.
   *
   * @param {[number, number][] | null} visits
   * @param {readonly Robot[]} robots
   */
  light(visits, robots) {
    this.isCritical = visits === null;
    this.circuit = circuitOf({ critical: visits ?? this.critical, period: this.period }, robots);
    this.turn = Math.ceil((this.circuit.at(-1)?.next ?? 0) / this.period) * this.period;
  }

  /** @param {number} index */
  has(index) {
    return this.members.has(index);
  }

  /** Whether the plan holds a whole period. */
  get whole() {
    return this.until >= this.start + this.period;
  }

  /**
   * The tick of the first period at which everything is as it is at this one.
   *
   * @param {number} tick
   */
  wrapped(tick) {
    if (!this.whole || tick < this.start + this.period) return tick;
    return this.start + ((tick - this.start) % this.period);
  }

  /** Where periods begin, and where the last one ends. */
  get borders() {
    const borders = [];
    for (let tick = this.start; tick <= this.until; tick += this.period) borders.push(tick);
    return borders;
  }
}

/**
 * The critical visits in the order of their circle: when each begins, if none begins before the last
 * one, and when the `next` one begins. Once round is a whole number of periods. Where another robot
 * comes next, that waits for this visit to begin only: it lasts no `ticks` on the circle.
 *
 * @param {Pick<SteadyData, "critical" | "period">} options
 * @param {readonly Robot[]} robots
 */
function circuitOf({ critical, period }, robots) {
  const steps = critical.map(([index, visit], i) => {
    const robot = robots[index];
    const goesOn = critical[(i + 1) % critical.length][0] === index;
    const ticks = goesOn ? Math.min(robot.leave(visit) - robot.enter[visit], period) : 0;
    const begin = robot.enter[visit];
    return { robot, visit, vertex: robot.vertices[visit], begin, next: begin, ticks };
  });
  /**
   * @param {number} tick
   * @param {number} now
   */
  const notBefore = (tick, now) => tick + Math.max(Math.ceil((now - tick) / period), 0) * period;
  steps.forEach((step, i) => i && (step.begin = notBefore(step.begin, steps[i - 1].begin)));
  steps.forEach(
    (step, i) => (step.next = steps[i + 1]?.begin ?? notBefore(steps[0].begin, step.begin)),
  );
  return steps;
}

/**
 * When each lap of a robot ends.
 *
 * @param {Robot} robot
 * @param {number} laps
 */
function lapEnds(robot, laps) {
  const perLap = robot.stages.length / laps;
  const lasts = robot.stages.filter(
    (stage, index) => (index + 1) % perLap === 0 && stage.visit >= 0,
  );
  return lasts.map(({ visit }) => robot.enter[visit]);
}

/**
 * How many of these increasing numbers are at most `limit`.
 *
 * @param {number[]} numbers
 * @param {number} limit
 */
function countAtMost(numbers, limit) {
  return numbers.length && numbers[0] <= limit ? lastAtMost(numbers, limit) + 1 : 0;
}
