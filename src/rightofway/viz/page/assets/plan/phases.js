/** @import { Robot } from "./robot.js" */

/** @typedef {{ begin: number[], activity: number[], visit: number[] }} Pushed */
/** @typedef {ReturnType<typeof phasesOf>} Phases */

/** What a robot does. */
export const DRIVE = 0;
export const WAIT = 1;
export const WORK = 2;
export const TURN = 3;
export const DONE = 4;
export const HELD = 5; // up, by itself: on the floor only
export const BROKEN = 6;
export const CHARGE = 7; // in a plan with jobs

/**
 * What a robot does when, one entry for each change: `begin[i]` to `begin[i + 1]`, during `visit[i]`.
 *
 * A robot stays at u for the edge's ticks and then, at one instant, is at w. For the eye it drives
 * along the edge during those ticks: a visit is work, turning, waiting, and at last the drive. On the
 * floor a robot may stand still by itself; one that does so while it drives is shown to do so before.
 *
 * @param {Robot} robot
 */
export function phasesOf(robot) {
  /** @type {Pushed} */
  const phases = { begin: [], activity: [], visit: [] };
  const last = robot.vertices.length - 1;
  let stage = 0;
  for (let visit = 0; visit <= last; visit++) {
    const leave = robot.leave(visit);
    const go =
      visit < last ? Math.max(leave - robot.drive[visit + 1], robot.enter[visit]) : robot.broken;
    let now = robot.enter[visit];
    /**
     * @param {number} ticks
     * @param {number} activity
     */
    const add = (ticks, activity) => {
      const end = Math.min(now + ticks + robot.stillIn(now, ticks), go);
      if (end > now) pushStill(phases, now, end, activity, visit, robot);
      now = end;
    };
    for (; stage < robot.stages.length && robot.stages[stage].visit <= visit; stage++) {
      if (robot.stages[stage].visit < visit) continue;
      const idle = (robot.begins[stage] ?? 0) - now;
      if (idle > 0) add(idle, WAIT);
      add(robot.stages[stage].work, robot.charges.has(stage) ? CHARGE : WORK);
      if (visit < last || robot.ending !== DONE) add(robot.stages[stage].turn, TURN);
    }
    if (visit < last) add(robot.turns.get(visit) ?? 0, TURN);
    if (visit === last) pushEnd(phases, now, robot);
    else {
      if (go > now) {
        const isIdle = robot.idles && robot.vertices[visit] === robot.home;
        pushStill(phases, now, go, isIdle ? DONE : WAIT, visit, robot);
      }
      if (leave > go) push(phases, go, DRIVE, visit);
    }
  }
  return {
    begin: Float64Array.from(phases.begin),
    activity: Uint8Array.from(phases.activity),
    visit: Int32Array.from(phases.visit),
    /** @param {number} i */
    end(i) {
      return i + 1 < this.begin.length ? this.begin[i + 1] : Infinity;
    },
  };
}

/**
 * An activity, but where the robot stands still by itself.
 *
 * @param {Pushed} phases
 * @param {number} begin
 * @param {number} end
 * @param {number} activity
 * @param {number} visit
 * @param {Robot} options
 */
function pushStill(phases, begin, end, activity, visit, { still }) {
  let now = begin;
  for (const [from, to] of still) {
    if (to <= now || from >= end) continue;
    if (from > now) push(phases, now, activity, visit);
    push(phases, Math.max(from, now), HELD, visit);
    now = Math.min(to, end);
  }
  if (now < end) push(phases, now, activity, visit);
}

/**
 * How it ends: with everything done, broken down, or waiting for ever behind a robot that is.
 *
 * @param {Pushed} phases
 * @param {number} now
 * @param {Robot} options
 */
function pushEnd(phases, now, { ending, broken, vertices }) {
  const visit = vertices.length - 1;
  if (ending !== BROKEN) push(phases, now, ending, visit);
  else {
    if (now < broken) push(phases, now, WAIT, visit);
    push(phases, Math.max(broken, now), BROKEN, visit);
  }
}

/**
 * @param {Pushed} phases
 * @param {number} begin
 * @param {number} activity
 * @param {number} visit
 */
function push(phases, begin, activity, visit) {
  phases.begin.push(begin);
  phases.activity.push(activity);
  phases.visit.push(visit);
}
