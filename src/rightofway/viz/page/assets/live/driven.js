import { lastAtMost, lastOf, toDifferences } from "../common/arrays.js";
import { FloorRobot } from "../plan/floor.js";
import { DONE } from "../plan/phases.js";

/** @import { DrivenData, DrivenFrame, DrivenRow, EndsData, PhraseData, RobotData, StageRow } from "../payload.d.ts" */
/** @import { Robot, Stage } from "../plan/robot.js" */

/** @typedef {{ others: number[], text: PhraseData }} Wait For whom a robot waits, and why. */
/** @typedef {{ kind: string, robot: number, from: number, to: number, text: PhraseData, person?: string }} Alarm Trouble from when to when, and who has seen it. */
/** @typedef {{ tick: number, robot: number, kind: string, text: PhraseData }} Told A sentence of the story. */

const NEAR = 0.9; // the share of a lane after which a robot that is late is shown to stand

/**
 * Values that change in time.
 *
 * @template V
 */
class Course {
  constructor() {
    /** @type {number[]} */
    this.ticks = [];
    /** @type {V[]} */
    this.values = [];
  }

  /**
   * @param {number} tick
   * @param {V} value
   */
  add(tick, value) {
    this.ticks.push(tick);
    this.values.push(value);
  }

  /**
   * The value at a tick, and since when; null before the first one.
   *
   * @param {number} tick
   */
  at(tick) {
    if (!this.ticks.length || tick < this.ticks[0]) return null;
    const index = lastAtMost(this.ticks, tick);
    return { since: this.ticks[index], value: this.values[index] };
  }
}

/** All that is known of a robot that is driven. */
class DrivenLog {
  /**
   * @param {RobotData} raw
   * @param {Robot} planned
   * @param {() => number} present the moment at which it is now
   */
  constructor(raw, planned, present) {
    this.raw = raw;
    this.planned = planned;
    this.present = present;
    this.first = -1; // the number of the first visit that is known
    /** @type {number[]} */
    this.route = []; // the vertices of all visits, by number; empty before the first one
    /** @type {{ tick: number, visit: number, before: number[] }[]} */
    this.changes = []; // of the route: when, from which visit on, what was there
    /** @type {number[]} */
    this.enter = []; // of visits from the first one on
    /** @type {number[]} */
    this.drive = []; // how long it drove into each
    /** @type {Map<number, number>} */
    this.done = new Map(); // when the work of a visit was done
    /** @type {Course<number>} */
    this.released = new Course();
    /** @type {Course<Wait | null>} */
    this.waits = new Course();
    /** @type {Course<boolean>} */
    this.holds = new Course();
    /** @type {Course<boolean>} */
    this.off = new Course(); // whether it is off the floor
    /** @type {Course<PhraseData>} */
    this.tasks = new Course(); // what it does for a job
    /** @type {Course<number>} */
    this.charges = new Course(); // percents
    this.isStale = true; // whether another robot is to be made of it
    this.#usual = usualDrives(planned);
  }

  #usual;

  /** The number of the visit that it has arrived at. */
  get arrived() {
    return this.first + this.enter.length - 1;
  }

  /** @param {DrivenRow} row */
  take(row) {
    const tick = row[0];
    this.isStale = true;
    switch (row[2]) {
      case "route":
        this.#setRoute(tick, row[3], row[4]);
        break;
      case "arrived":
        this.#arrive(tick, row[3]);
        break;
      case "released":
        this.released.add(tick, row[3]);
        break;
      case "done":
        if (!this.done.has(row[3])) this.done.set(row[3], tick);
        break;
      case "hold":
        this.holds.add(tick, row[3]);
        break;
      case "off":
        this.off.add(tick, row[3]);
        break;
      case "task":
        this.tasks.add(tick, row[3]);
        break;
      case "charge":
        this.charges.add(tick, row[3]);
        break;
      case "says":
        if (row[3] === "wait") this.waits.add(tick, { others: row[5], text: row[4] });
        else if (row[3] === "drive" || row[3] === "end") this.waits.add(tick, null);
    }
  }

  /**
   * @param {number} tick
   * @param {number} visit
   * @param {number[]} vertices
   */
  #setRoute(tick, visit, vertices) {
    if (visit < this.route.length)
      this.changes.push({ tick, visit, before: this.route.slice(visit) });
    this.route.length = Math.min(this.route.length, visit);
    while (this.route.length < visit) this.route.push(vertices[0]); // of long ago
    this.route.push(...vertices);
  }

  /**
   * @param {number} tick
   * @param {number} visit
   */
  #arrive(tick, visit) {
    if (this.first < 0) this.first = visit;
    while (this.arrived < visit) {
      const begin = this.enter.length ? Math.min(this.#begin(this.arrived + 1), tick) : tick;
      this.drive.push(tick - begin);
      this.enter.push(tick);
    }
  }

  /**
   * When it could begin to drive into a visit: it was at the one before, had done its work, and was let go.
   *
   * @param {number} visit
   */
  #begin(visit) {
    const index = this.released.values.findLastIndex((end) => end < visit) + 1;
    const release = this.released.ticks[index] ?? Infinity;
    return Math.max(lastOf(this.enter), this.done.get(visit - 1) ?? 0, release);
  }

  /**
   * The visits at a tick: which it has arrived at, up to which it may drive.
   *
   * @param {number} tick
   */
  held(tick) {
    const arrived = this.first + lastAtMost(this.enter, tick);
    return { arrived, released: Math.max(this.released.at(tick)?.value ?? arrived, arrived) };
  }

  /**
   * Its route as it was at a tick.
   *
   * @param {number} tick
   */
  routeAt(tick) {
    let { route } = this;
    for (const change of this.changes.filter((made) => made.tick > tick).reverse())
      route = [...route.slice(0, change.visit), ...change.before];
    return route;
  }

  /**
   * The robot as it has driven until now: what a map and a diagram show.
   *
   * @param {number} now
   * @returns {DrivenRobot}
   */
  robot(now) {
    const { arrived, first } = this;
    const enter = [...this.enter];
    const drive = [...this.drive];
    const vertices = this.route.slice(first, arrived + 1);
    const next = arrived + 1;
    const begin = this.#begin(next);
    if (
      next < this.route.length &&
      begin <= now &&
      !this.off.at(now)?.value &&
      lastOf(this.released.values) >= next
    ) {
      const usual = this.#usual(this.route[arrived], this.route[next]);
      const end = now > begin + NEAR * usual ? begin + (now - begin) / NEAR : begin + usual;
      vertices.push(this.route[next]);
      drive.push(end - begin);
      enter.push(end);
    } else this.isStale = false; // what stands stays as it is until more is known
    const isDone = next === this.route.length && this.#isIdle(arrived);
    const run = {
      stages: this.#stages(now),
      vertices: toDifferences(vertices),
      enter: toDifferences(enter),
      drive,
      still: /** @type {[number, number | null][]} */ ([]),
      completion: isDone ? Math.max(this.done.get(arrived) ?? 0, lastOf(this.enter)) : null,
    };
    return new DrivenRobot(this.raw, run, this.planned, this.present);
  }

  /**
   * Whether nothing is to be done in a visit any more.
   *
   * @param {number} visit
   */
  #isIdle(visit) {
    return this.done.has(visit) || !this.#stage(visit)?.work;
  }

  /**
   * The planned stage of a visit, where the route is still as planned.
   *
   * @param {number} visit
   */
  #stage(visit) {
    return this.planned.stages.find(
      (stage) => stage.visit === visit && stage.vertex === this.route[visit],
    );
  }

  /**
   * A stage that took some ticks: turning takes as long as planned, work the rest of the time.
   *
   * @param {Stage | undefined} stage
   * @param {number} visit
   * @param {number} ticks
   * @returns {StageRow}
   */
  #worked(stage, visit, ticks) {
    const turn = Math.min(stage?.turn ?? 0, ticks);
    return [this.route[visit], ticks - turn, turn, visit - this.first];
  }

  /**
   * What it has worked, and until now; stages that it has not come to have no visit.
   *
   * @param {number} now
   * @returns {StageRow[]}
   */
  #stages(now) {
    const { arrived, first } = this;
    /** @type {StageRow[]} */
    const worked = [];
    for (const [visit, tick] of [...this.done].sort(([one], [other]) => one - other)) {
      const index = visit - first;
      if (index >= 0 && index < this.enter.length)
        worked.push(this.#worked(this.#stage(visit), visit, tick - this.enter[index]));
    }
    const stage = this.#stage(arrived);
    if (stage && !this.done.has(arrived)) {
      const planned = stage.work + stage.turn;
      const ticks = stage.work ? Math.max(planned, now - lastOf(this.enter)) : 0;
      worked.push(this.#worked(stage, arrived, ticks));
      if (ticks) this.isStale = true;
    }
    const later = this.planned.stages.filter(({ visit }) => visit > arrived);
    return [
      ...worked,
      ...later.map(({ vertex, work, turn }) => /** @type {StageRow} */ ([vertex, work, turn, -1])),
    ];
  }
}

/** A robot as it drives: what it does last lasts until now, and where it will be is not known. */
class DrivenRobot extends FloorRobot {
  /**
   * @param {RobotData} raw
   * @param {DrivenData} run
   * @param {Robot} planned
   * @param {() => number} present
   */
  constructor(raw, run, planned, present) {
    super(raw, run, planned);
    const { begin } = this.phases;
    const isDone = this.ending === DONE;
    this.phases.end = (i) => {
      if (i + 1 < begin.length) return begin[i + 1];
      return isDone ? Infinity : Math.max(present(), begin[i]);
    };
  }

  get isDriven() {
    return true;
  }

  /**
   * How much later than planned it is. On another way than planned it is measured at the stops that it has
   * made, which the plan has in the same order, and is at least what has passed since the next one was due.
   *
   * @param {number} tick
   * @param {number} visit
   */
  lateness(tick, visit) {
    const asPlanned = super.lateness(tick, visit);
    if (asPlanned !== null) return asPlanned;
    const { enter, planned, stages } = this;
    const made = stages.filter((stage) => stage.visit >= 0 && enter[stage.visit] <= tick);
    if (made.length > planned.stages.length) return null; // the plan does not have its work
    const on = Math.max(this.asPlanned - 1, 0); // the last visit that is in the plan
    const last = made.at(-1)?.visit ?? -1;
    const counterpart = last > on ? planned.stages[made.length - 1].visit : on;
    const known = enter[Math.max(last, on)] - planned.enter[counterpart];
    const next = planned.stages[made.length];
    const due = next ? planned.enter[next.visit] : planned.completion;
    return Math.max(known, tick - due);
  }

  get way() {
    return this.asPlanned < this.vertices.length ? this.vertices : this.planned.vertices;
  }
}

/**
 * How long a robot drives along a lane by plan; as long as along an average one where the plan has none.
 *
 * @param {Robot} planned
 */
function usualDrives({ vertices, drive }) {
  /** @type {Map<string, number>} */
  const known = new Map();
  let sum = 0;
  for (let visit = 1; visit < vertices.length; visit++) {
    known.set(`${vertices[visit - 1]} ${vertices[visit]}`, drive[visit]);
    sum += drive[visit];
  }
  const mean = vertices.length > 1 ? sum / (vertices.length - 1) : 1;
  return (/** @type {number} */ tail, /** @type {number} */ head) =>
    known.get(`${tail} ${head}`) ?? known.get(`${head} ${tail}`) ?? mean;
}

/** A fleet that is driven: one more source of robots, made of the frames of a feed. */
export class Driven {
  /**
   * @param {RobotData[]} raw
   * @param {Robot[]} planned
   */
  constructor(raw, planned) {
    this.raw = raw;
    this.planned = planned;
    this.now = 0;
    this.runs = false;
    this.logs = this.#freshLogs();
    /** @type {Alarm[]} */
    this.alarms = [];
    /** @type {Told[]} */
    this.story = [];
    /** @type {EndsData | null} */
    this.ends = null; // planned and actual, as measured last
    /** @type {DrivenRobot[]} */
    this.robots = [];
  }

  #freshLogs() {
    return this.raw.map(
      (robot, index) => new DrivenLog(robot, this.planned[index], () => this.now),
    );
  }

  /** @param {DrivenFrame} frame */
  take(frame) {
    if (frame.begins) [this.logs, this.alarms, this.story] = [this.#freshLogs(), [], []];
    this.now = frame.begins ? frame.now : Math.max(this.now, frame.now);
    this.runs = frame.runs;
    if (frame.ends !== undefined) this.ends = frame.ends;
    for (const row of frame.rows) this.#take(row);
    this.robots = this.logs.map((log, index) => {
      if (log.first < 0) log.take([0, index, "arrived", 0]);
      if (!log.route.length)
        log.take([0, index, "route", 0, Array.from(this.planned[index].vertices)]);
      return log.isStale || !this.robots[index] ? log.robot(this.now) : this.robots[index];
    });
  }

  /** @param {DrivenRow} row */
  #take(row) {
    const [tick, robot, kind] = row;
    if (row[2] === "says") this.story.push({ tick, robot, kind: row[3], text: row[4] });
    if (row[2] === "alarm") this.#alarm(tick, robot, row[3], row[4]);
    else if (row[2] === "seen") this.#see(robot, row[3], row[4]);
    else if (robot >= 0 && kind !== "alarm") this.logs[robot].take(row);
  }

  /**
   * @param {number} tick
   * @param {number} robot
   * @param {string} kind
   * @param {PhraseData | null} text
   */
  #alarm(tick, robot, kind, text) {
    const open = this.#findOpen(robot, kind);
    if (text === null && open) open.to = tick;
    else if (text !== null && !open)
      this.alarms.push({ kind, robot, from: tick, to: Infinity, text });
  }

  /**
   * @param {number} robot
   * @param {string} kind
   */
  #findOpen(robot, kind) {
    return this.alarms.findLast(
      (alarm) => alarm.robot === robot && alarm.kind === kind && alarm.to === Infinity,
    );
  }

  /**
   * @param {number} robot
   * @param {string} kind
   * @param {string} person
   */
  #see(robot, kind, person) {
    const open = this.#findOpen(robot, kind);
    if (open) open.person = person;
  }

  /**
   * The trouble that there is at a tick; at Infinity, all that has not ended.
   *
   * @param {number} tick
   */
  alarmsAt(tick) {
    return this.alarms.filter(({ from, to }) => from <= tick && (tick < to || to === Infinity));
  }

  /**
   * What a robot does for a job at a tick, and its state of charge; empty where that is not known.
   *
   * @param {number} robot
   * @param {number} tick
   */
  workAt(robot, tick) {
    const { tasks, charges } = this.logs[robot];
    return { task: tasks.at(tick)?.value || "", percent: charges.at(tick)?.value ?? null };
  }

  /**
   * For whom a robot waits at a tick, and since when; null where it does not.
   *
   * @param {number} robot
   * @param {number} tick
   */
  waitAt(robot, tick) {
    const found = this.logs[robot].waits.at(tick);
    return found?.value ? { since: found.since, ...found.value } : null;
  }

  /**
   * The robots on which others wait and which wait for no robot, and all that wait for each, directly or for one another;
   * those with the longest waits in total come first.
   *
   * @param {number} tick
   * @returns {{ robot: number, victims: number[], since: number, waited: number }[]}
   */
  holdUpsAt(tick) {
    const waits = this.logs.map((_, robot) => this.waitAt(robot, tick));
    /** @type {Map<number, Set<number>>} */
    const victims = new Map();
    waits.forEach((wait, robot) => {
      const reached = new Set(wait?.others);
      for (const other of reached) waits[other]?.others.forEach((next) => reached.add(next));
      for (const other of reached)
        if (!waits[other]?.others.length)
          victims.set(other, (victims.get(other) ?? new Set()).add(robot));
    });
    return Array.from(victims, ([robot, held]) => {
      const begins = Array.from(held, (victim) => waits[victim]?.since ?? tick);
      const waited = begins.reduce((sum, begin) => sum + tick - begin, 0);
      return { robot, victims: Array.from(held), since: Math.min(...begins), waited };
    }).sort((one, other) => other.waited - one.waited || one.robot - other.robot);
  }

  /**
   * Whether a person holds a robot at a tick.
   *
   * @param {number} robot
   * @param {number} tick
   */
  isHeld(robot, tick) {
    return this.logs[robot].holds.at(tick)?.value ?? false;
  }

  /**
   * Whether a robot is off the floor at a tick.
   *
   * @param {number} robot
   * @param {number} tick
   */
  isOff(robot, tick) {
    return this.logs[robot].off.at(tick)?.value ?? false;
  }

  /**
   * The vertices that a robot holds at a tick (its base), and those that are only planned (the horizon).
   *
   * @param {number} robot
   * @param {number} tick
   */
  way(robot, tick) {
    const log = this.logs[robot];
    if (this.isOff(robot, tick)) return { base: [], horizon: [] };
    const { arrived, released } = log.held(tick);
    const route = log.routeAt(tick);
    return { base: route.slice(arrived, released + 1), horizon: route.slice(released) };
  }
}
