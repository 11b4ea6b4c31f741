import { lastAtMost, lastOf } from "../common/arrays.js";
import { BROKEN, DONE, HELD, WAIT } from "./phases.js";
import { Robot, giveLosses } from "./robot.js";

/** @import { DrivenData, FloorData, Payload, RobotData } from "../payload.d.ts" */
/** @import { Loss, Trip } from "./robot.js" */

/**
 * The robots as they drove on the floor: the same visits at other ticks, and some of them never.
 *
 * @param {Pick<Payload, "robots">} raw
 * @param {FloorData} floor
 * @param {Robot[]} planned
 */
export function onTheFloor(raw, floor, planned) {
  const robots = floor.robots.map(
    (run, index) => new FloorRobot(raw.robots[index], run, planned[index]),
  );
  giveLosses(robots, floor.losses);
  return robots;
}

/** A robot and what became of its part of the plan. */
export class FloorRobot extends Robot {
  /**
   * @param {RobotData} raw
   * @param {DrivenData} run
   * @param {Robot} planned
   */
  constructor(raw, run, planned) {
    super(floorTrip(raw, run), planned.index);
    this.planned = planned;
    const other = this.vertices.findIndex((vertex, visit) => vertex !== planned.vertices[visit]);
    this.asPlanned = other < 0 ? this.vertices.length : other; // visits before it goes another way
    this.delayInAll = this.ending === DONE ? this.completion - planned.completion : Infinity;
    this.plannedWait = waitedByVisit(planned);
  }

  /**
   * How much later than planned it is, at a tick and in a visit; null where it goes another way.
   *
   * @param {number} tick
   * @param {number} visit
   */
  lateness(tick, visit) {
    if (this.ending === DONE && visit === this.vertices.length - 1) return this.delayInAll;
    if (visit >= this.asPlanned) return null;
    const overdue = tick - this.planned.leave(visit);
    return Math.max(this.enter[visit] - this.planned.enter[visit], overdue);
  }

  /** Ticks that it stood still by itself. */
  get held() {
    const { phases } = this;
    return phases.begin.reduce(
      (sum, begin, i) => sum + (phases.activity[i] === HELD ? phases.end(i) - begin : 0),
      0,
    );
  }

  /**
   * How much longer the waits of a loss were than planned.
   *
   * @param {Loss} loss
   */
  unplanned(loss) {
    const [first, last] = [
      lastAtMost(this.enter, loss.tick),
      lastAtMost(this.enter, loss.end - 0.5),
    ];
    if (last >= this.asPlanned) return 0;
    return this.plannedWait
      .slice(first, last + 1)
      .reduce((rest, planned) => rest - planned, loss.ticks);
  }

  /**
   * The robot that stands for ever where this one has to go next, or null.
   *
   * @param {readonly Robot[]} robots
   */
  stuckBehind(robots) {
    const next = this.planned.vertices[this.vertices.length];
    return robots.find((robot) => robot !== this && lastOf(robot.vertices) === next) ?? null;
  }

  /**
   * When it begins to wait longer than planned, in a phase that is a wait.
   *
   * @param {number} phase
   */
  unplannedFrom(phase) {
    const visit = this.phases.visit[phase];
    return visit < this.asPlanned ? this.phases.begin[phase] + this.plannedWait[visit] : Infinity;
  }
}

/**
 * @param {RobotData} raw
 * @param {DrivenData} run
 * @returns {Trip}
 */
function floorTrip(raw, run) {
  /** @type {[number, number][]} */
  const still = run.still.map(([begin, ticks]) => [
    begin,
    ticks === null ? Infinity : begin + ticks,
  ]);
  const isBroken = still.some(([, to]) => to === Infinity);
  const ending = run.completion !== null ? DONE : isBroken ? BROKEN : WAIT;
  return {
    ...raw,
    begins: [], // by plan: what it does there has other times
    vertices: raw.vertices.slice(0, run.enter.length),
    ...run,
    completion: run.completion ?? Infinity,
    still,
    ending,
  };
}

/**
 * How long a robot waits in each visit.
 *
 * @param {Robot} options
 */
function waitedByVisit({ phases, vertices }) {
  const waited = new Float64Array(vertices.length);
  phases.activity.forEach((activity, i) => {
    if (activity === WAIT) waited[phases.visit[i]] += phases.end(i) - phases.begin[i];
  });
  return waited;
}
