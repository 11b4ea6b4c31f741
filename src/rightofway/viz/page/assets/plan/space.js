import { FleetMemo } from "./fleet_memo.js";
import { DRIVE } from "./phases.js";

/** @import { Motion } from "./motion.js" */
/** @import { Site } from "./site.js" */
/** @import { Roadmap } from "./roadmap.js" */
/** @import { Robot } from "./robot.js" */
/** @import { Phases } from "./phases.js" */

const MOST_ENCOUNTERS = 5; // of a robot, in its card
const MOST_COMPARED = 60; // robots; comparing all of more takes too long

/** @typedef {{ distance: number, tick: number }} Approach How near two robots come [length unit], and when. */
/** @typedef {Approach & { other: Robot, room: number }} Encounter */
/** @typedef {{ phases: Phases, vertices: Int32Array, at: number }} Run */
/** @typedef {{ vertices: number[], edges: [number, number][], zones: Set<number> }} Held */

/** What robots book at the moment shown, which zones they hold, and how near they come to each other. */
export class Space {
  /** @type {FleetMemo<Map<number, Encounter[]>>} */
  #encounters;

  /**
   * @param {Site} plan
   * @param {Motion} motion
   */
  constructor(plan, motion) {
    this.plan = plan;
    this.motion = motion;
    this.#encounters = new FleetMemo(motion.fleet, () => new Map());
    const { zones, size } = plan.roadmap;
    /** @type {Map<string | number, number[]>} */
    this.zonesOf = new Map(); // numbers of the zones of a vertex, and of a lane by tail * size + head
    zones.forEach(({ vertices, edges }, zone) => {
      for (const key of [
        ...vertices.map(String),
        ...edges.map(([tail, head]) => tail * size + head),
      ]) {
        this.zonesOf.set(key, [...(this.zonesOf.get(key) ?? []), zone]);
      }
    });
  }

  /**
   * The vertices, lanes and zones that a robot books now.
   *
   * @param {Robot} robot
   */
  heldBy(robot) {
    const { plan, motion } = this;
    const tick = motion.ticks[robot.index];
    let visit = robot.phases.visit[motion.phase[robot.index]];
    /** @type {Held} */
    const held = { vertices: [robot.vertices[visit]], edges: [], zones: new Set() };
    /** @param {number} to */
    const drive = (to) => held.edges.push([robot.vertices[to - 1], robot.vertices[to]]);
    this.#addZones(String(robot.vertices[visit]), held.zones);
    if (tick >= robot.leave(visit) - (robot.drive[visit + 1] ?? 0)) {
      drive(visit + 1);
      if (plan.booksAhead) {
        held.vertices.push(robot.vertices[visit + 1]);
        this.#addZones(String(robot.vertices[visit + 1]), held.zones);
      }
    }
    for (; visit > 0 && tick < robot.enter[visit] + plan.headway; visit--) {
      drive(visit);
      held.vertices.push(robot.vertices[visit - 1]);
      this.#addZones(String(robot.vertices[visit - 1]), held.zones);
    }
    for (const [tail, head] of held.edges)
      this.#addZones(tail * plan.roadmap.size + head, held.zones);
    return held;
  }

  /**
   * @param {string | number} key
   * @param {Set<number>} zones
   */
  #addZones(key, zones) {
    for (const zone of this.zonesOf.get(key) ?? []) zones.add(zone);
  }

  /** The robot that holds each zone now, by its number. */
  get zoneHolders() {
    /** @type {Map<number, Robot>} */
    const holders = new Map();
    if (!this.zonesOf.size) return holders;
    for (const robot of this.motion.fleet.robots)
      for (const zone of this.heldBy(robot).zones) holders.set(zone, robot);
    return holders;
  }

  /**
   * The robot that is nearest to another now, as an encounter; null where none needs room.
   *
   * @param {Robot} robot
   */
  nearestTo(robot) {
    /** @type {Omit<Encounter, "tick"> | null} */
    let best = null;
    for (const other of this.motion.fleet.robots) {
      const room = this.plan.room(robot, other);
      if (other === robot || !room) continue;
      const encounter = { other, room, distance: this.#distance(robot.index, other.index) };
      if (!best || encounter.distance - room < best.distance - best.room) best = encounter;
    }
    return best;
  }

  /**
   * @param {number} one
   * @param {number} other
   */
  #distance(one, other) {
    const { x, y } = this.motion;
    return Math.hypot(x[one] - x[other], y[one] - y[other]) * this.plan.roadmap.unit;
  }

  /** The closest approach of the whole fleet, with its two robots; null for points and for large fleets. */
  get closest() {
    const { robots } = this.motion.fleet;
    if (!this.plan.largestRadius || robots.length > MOST_COMPARED) return null;
    const [first] = robots
      .flatMap((robot) =>
        this.encounters(robot)
          .slice(0, 1)
          .map((encounter) => ({ robot, ...encounter })),
      )
      .sort((one, other) => one.distance - one.room - (other.distance - other.room));
    return first ?? null;
  }

  /**
   * The closest approaches of a robot in the whole plan, the one with least room to spare first.
   *
   * @param {Robot} robot
   */
  encounters(robot) {
    const known = this.#encounters.value;
    const found = known.get(robot.index) ?? this.#findEncounters(robot);
    known.set(robot.index, found);
    return found;
  }

  /** @param {Robot} robot */
  #findEncounters(robot) {
    const { roadmap } = this.plan;
    return this.motion.fleet.robots
      .filter((other) => other !== robot && this.plan.room(robot, other))
      .map((other) => ({
        other,
        room: this.plan.room(robot, other),
        ...closestApproach(robot, other, roadmap),
      }))
      .sort((one, other) => one.distance - one.room - (other.distance - other.room))
      .slice(0, MOST_ENCOUNTERS);
  }
}

/**
 * The least distance of two robots [length unit], and the first tick at which they are that near.
 *
 * @param {Robot} one
 * @param {Robot} other
 * @param {Roadmap} roadmap
 */
function closestApproach(one, other, roadmap) {
  const runs = [one, other].map(({ phases, vertices }) => ({ phases, vertices, at: 0 }));
  let best = { distance: Infinity, tick: 0 };
  for (let now = 0; now < Infinity;) {
    const end = Math.min(...runs.map(({ phases, at }) => phases.end(at)));
    const [[ax, ay], [bx, by]] = runs.map((run) => whereAt(run, now, roadmap));
    const [right, down] = [bx - ax, by - ay];
    if (end < Infinity) {
      const [[cx, cy], [dx, dy]] = runs.map((run) => whereAt(run, end, roadmap));
      const [u, v] = [dx - cx - right, dy - cy - down];
      const square = u * u + v * v;
      const share = square ? Math.min(Math.max(-(right * u + down * v) / square, 0), 1) : 0;
      best = nearer(
        best,
        Math.hypot(right + u * share, down + v * share),
        now + (end - now) * share,
      );
    } else best = nearer(best, Math.hypot(right, down), now);
    for (const run of runs) if (run.phases.end(run.at) === end) run.at++;
    now = end;
  }
  return { distance: best.distance * roadmap.unit, tick: best.tick };
}

/**
 * @param {Approach} best
 * @param {number} distance
 * @param {number} tick
 */
function nearer(best, distance, tick) {
  return distance < best.distance - 1e-9 ? { distance, tick } : best;
}

/**
 * Where a robot is at a tick of one of its phases.
 *
 * @param {Run} options
 * @param {number} tick
 * @param {Roadmap} other
 */
function whereAt({ phases, vertices, at }, tick, { x, y }) {
  const here = vertices[phases.visit[at]];
  if (phases.activity[at] !== DRIVE) return [x[here], y[here]];
  const there = vertices[phases.visit[at] + 1];
  const share = (tick - phases.begin[at]) / (phases.end(at) - phases.begin[at]);
  return [x[here] + (x[there] - x[here]) * share, y[here] + (y[there] - y[here]) * share];
}
