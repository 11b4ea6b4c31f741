import { fromDifferences } from "../common/arrays.js";
import { DONE, WAIT, phasesOf } from "./phases.js";

/** @import { LossRow, RobotData } from "../payload.d.ts" */

/** @typedef {{ vertex: number, work: number, turn: number, visit: number }} Stage */
/** @typedef {RobotData & { still?: [number, number][], ending?: number }} Trip What a robot is made of; on the floor also when it stands still, and how it ends. */

/** A robot and what the plan has it do. Times are ticks. */
export class Robot {
  /**
   * @param {Trip} raw
   * @param {number} index
   */
  constructor(raw, index) {
    this.index = index;
    this.name = raw.name;
    this.colour = raw.colour;
    this.speed = raw.speed;
    this.radius = raw.radius ?? 0; // [length unit]; a point has none
    this.vertices = fromDifferences(raw.vertices, Int32Array);
    this.enter = fromDifferences(raw.enter, Float64Array);
    this.drive =
      typeof raw.drive === "number"
        ? new Float64Array(this.vertices.length).fill(raw.drive)
        : Float64Array.from(raw.drive);
    /** @type {Stage[]} */
    this.stages = raw.stages.map(([vertex, work, turn, visit]) => ({ vertex, work, turn, visit }));
    this.begins = raw.begins ?? []; // of the work of each stage, in a plan with jobs
    this.charges = new Set(raw.charges); // the stages at which it charges
    this.turns = new Map(raw.turns); // on the spot between two edges, by visit [ticks]
    this.completion = raw.completion;
    this.alone = raw.alone;
    this.lost = { detours: raw.lost[0], makingRoom: raw.lost[1], waiting: raw.lost[2] };
    /** @type {Loss[]} */
    this.losses = []; // by tick
    this.still = raw.still ?? []; // from when to when it stood still by itself, on the floor
    this.ending = raw.ending ?? (raw.stands ? WAIT : DONE); // what it does for ever after its last visit
    this.idles = raw.idles ?? false; // where it stays at home
    this.phases = phasesOf(this);
  }

  /** The vertices of its whole way, those that it has not come to as well. */
  get way() {
    return this.vertices;
  }

  /**
   * The first and the last visit of the route that is shown during a visit. A robot that gets jobs
   * all the time drives its way from the last stop to the one after the next; others all.
   *
   * @param {number} visit
   */
  span(visit) {
    if (!this.idles) return [0, this.vertices.length - 1];
    const next = this.stages.findIndex((stage) => stage.visit > visit);
    const [before, after] = next < 0 ? [this.stages.length - 1, -1] : [next - 1, next + 1];
    return [this.stages[before]?.visit ?? 0, this.stages[after]?.visit ?? this.vertices.length - 1];
  }

  /** Whether it is driven now, so that it is not known how it goes on. */
  get isDriven() {
    return false;
  }

  get home() {
    return this.vertices[0];
  }

  /** When it broke down. */
  get broken() {
    return this.still.find(([, to]) => to === Infinity)?.[0] ?? Infinity;
  }

  /**
   * Ticks that it stands still, from a tick on, until it has used a number of ticks.
   *
   * @param {number} begin
   * @param {number} ticks
   */
  stillIn(begin, ticks) {
    let lost = 0;
    for (const [from, to] of this.still) {
      if (to > begin && from < begin + ticks + lost) lost += to - Math.max(from, begin);
    }
    return lost;
  }

  /** Ticks lost to the others. */
  get delay() {
    return this.completion - this.alone;
  }

  /**
   * When a visit ends; the last one never does.
   *
   * @param {number} visit
   */
  leave(visit) {
    return visit + 1 < this.enter.length ? this.enter[visit + 1] : Infinity;
  }
}

/** How a robot loses time: it waits once, or several times behind one robot, or leaves a place to others for a while. */
export const FOLLOWS = 1;
const MAKES_ROOM = 2;

/** One cause of lost time, as `Loss` of the model: the robot that loses, the robot that gains or null, where, when, and how much. */
export class Loss {
  /** @param {LossRow} row */
  constructor([kind, robot, forRobot, vertex, until, towards, freed, tick, end, ticks, text]) {
    this.kind = kind;
    this.robot = robot;
    this.forRobot = forRobot;
    this.vertex = vertex;
    this.until = until;
    this.towards = towards;
    this.freed = freed;
    this.tick = tick;
    this.end = end;
    this.ticks = ticks;
    this.text = text; // in the phrases of the plan
  }

  /** The places that a sentence about it names. */
  get places() {
    const other = this.kind === FOLLOWS ? this.until : this.freed;
    return other !== null && other >= 0 && this.kind !== MAKES_ROOM
      ? [this.vertex, other]
      : [this.vertex];
  }
}

/**
 * @param {Robot[]} robots
 * @param {LossRow[]} rows
 */
export function giveLosses(robots, rows) {
  for (const loss of rows.map((row) => new Loss(row))) robots[loss.robot].losses.push(loss);
}
