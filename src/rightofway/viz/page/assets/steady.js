import { lastAtMost } from "./arrays.js";

/** The groups of robots that repeat themselves, each from its own start and with its own period. */
export class Steady {
  constructor(raw, robots) {
    this.groups = raw.steady.map((group) => new Group(group, robots));
    this.groupOf = robots.map(({ index }) => this.groups.find((group) => group.has(index)) ?? null);
    this.largest = this.groups.reduce((most, group) =>
      group.robots.length > most.robots.length ? group : most,
    );
    this.lapEnds = robots.map((robot) => lapEnds(robot, raw.laps[robot.index]));
  }

  /** The group of a robot; without one, the largest. */
  group(robot) {
    return (robot && this.groupOf[robot.index]) ?? this.largest;
  }

  /** Where in the plan a robot is that has gone on repeating itself until a tick. */
  tickOf(index, tick) {
    return this.groupOf[index]?.wrapped(tick) ?? tick;
  }

  /** How many laps a robot has made by a tick of the plan. */
  laps(index, tick) {
    return countAtMost(this.lapEnds[index], tick);
  }

  /** How many laps a robot that repeats itself makes in a period. */
  lapsInPeriod(index) {
    const { start, period } = this.groupOf[index];
    return this.laps(index, start + period) - this.laps(index, start);
  }

  /** How many laps a robot has made if it goes on repeating itself until a tick. */
  lapsForEver(index, tick) {
    const within = this.tickOf(index, tick);
    if (within === tick) return this.laps(index, tick);
    const periods = Math.round((tick - within) / this.groupOf[index].period);
    return this.laps(index, within) + periods * this.lapsInPeriod(index);
  }
}

/** Robots that repeat themselves together. */
class Group {
  constructor(raw, robots) {
    Object.assign(this, raw);
    this.members = new Set(raw.robots);
    this.light(null, robots);
  }

  /** Light another circle of visits than the critical one; null for that one. */
  light(visits, robots) {
    this.isCritical = visits === null;
    this.circuit = circuitOf({ critical: visits ?? this.critical, period: this.period }, robots);
    this.turn = Math.ceil((this.circuit.at(-1)?.next ?? 0) / this.period) * this.period; // whole periods, once round at least
  }

  has(index) {
    return this.members.has(index);
  }

  /** Whether the plan holds a whole period. */
  get whole() {
    return this.until >= this.start + this.period;
  }

  /** The tick of the first period at which everything is as it is at this one. */
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
 */
function circuitOf({ critical, period }, robots) {
  const steps = critical.map(([index, visit], i) => {
    const robot = robots[index];
    const goesOn = critical[(i + 1) % critical.length][0] === index;
    const ticks = goesOn ? Math.min(robot.leave(visit) - robot.enter[visit], period) : 0;
    return { robot, visit, vertex: robot.vertices[visit], begin: robot.enter[visit], ticks };
  });
  const notBefore = (tick, now) => tick + Math.max(Math.ceil((now - tick) / period), 0) * period;
  steps.forEach((step, i) => i && (step.begin = notBefore(step.begin, steps[i - 1].begin)));
  steps.forEach(
    (step, i) => (step.next = steps[i + 1]?.begin ?? notBefore(steps[0].begin, step.begin)),
  );
  return steps;
}

/** When each lap of a robot ends. */
function lapEnds(robot, laps) {
  const perLap = robot.stages.length / laps;
  const lasts = robot.stages.filter(
    (stage, index) => (index + 1) % perLap === 0 && stage.visit >= 0,
  );
  return lasts.map(({ visit }) => robot.enter[visit]);
}

/** How many of these increasing numbers are at most `limit`. */
function countAtMost(numbers, limit) {
  return numbers.length && numbers[0] <= limit ? lastAtMost(numbers, limit) + 1 : 0;
}
