"use strict";

/** A robot and what the plan has it do. Times are ticks. */
class Robot {
  constructor(raw, index) {
    this.index = index;
    this.name = raw.name;
    this.colour = raw.colour;
    this.speed = raw.speed;
    this.radius = raw.radius ?? 0; // [length unit]; a point has none
    this.vertices = fromDifferences(raw.vertices, Int32Array);
    this.enter = fromDifferences(raw.enter, Float64Array);
    this.drive = typeof raw.drive === "number"
      ? new Float64Array(this.vertices.length).fill(raw.drive)
      : Float64Array.from(raw.drive);
    this.stages = raw.stages.map(([vertex, work, turn, visit]) => ({ vertex, work, turn, visit }));
    this.completion = raw.completion;
    this.alone = raw.alone;
    this.lost = { detours: raw.lost[0], makingRoom: raw.lost[1], waiting: raw.lost[2] };
    this.losses = []; // by tick
    this.still = raw.still ?? []; // from when to when it stood still by itself, on the floor
    this.ending = raw.ending ?? (raw.stands ? WAIT : DONE); // what it does for ever after its last visit
    this.phases = phasesOf(this);
  }

  get home() {
    return this.vertices[0];
  }

  /** When it broke down. */
  get broken() {
    return this.still.find(([, to]) => to === Infinity)?.[0] ?? Infinity;
  }

  /** Ticks it stands still before so many ticks have been of use, from a tick on. */
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

  /** When a visit ends; the last one never does. */
  leave(visit) {
    return visit + 1 < this.enter.length ? this.enter[visit + 1] : Infinity;
  }
}

/** How a robot loses time: it waits once, or several times behind one robot, or leaves a place to others for a while. */
const WAITS = 0;
const FOLLOWS = 1;
const MAKES_ROOM = 2;

/** One cause of lost time, as `Loss` of the model: who loses, to which robot or null, where, when, and how much. */
class Loss {
  constructor([kind, robot, forRobot, vertex, until, towards, freed, tick, end, ticks]) {
    Object.assign(this, { kind, robot, forRobot, vertex, until, towards, freed, tick, end, ticks });
  }
}

function giveLosses(robots, rows) {
  for (const loss of rows.map((row) => new Loss(row))) robots[loss.robot].losses.push(loss);
}

/** What a map shows of a scenario without a plan: the roadmap, and the robots at their homes. */
class Site {
  constructor(raw) {
    this.tick = { numerator: raw.tick[0], denominator: raw.tick[1] };
    this.quantities = new Quantities(raw.units, raw.tick);
    this.title = raw.title;
    this.roadmap = new Roadmap(raw.map);
    this.planned = raw.robots.map((robot, index) => new Robot(robot, index));
    this.robots = this.planned; // those that are shown
    this.clearance = raw.clearance ?? 0; // [length unit]
    this.largestRadius = this.planned.reduce((most, { radius }) => Math.max(most, radius), 0);
    this.faults = [];
    this.decisions = [];
    this.happened = null;
    this.steady = null;
    this.end = 0;
  }

  /** Whether nothing moves. */
  get isStill() {
    return this.end === 0;
  }

  /** The distance that two robots need [length unit]; 0 for two points. */
  room(one, other) {
    const radii = one.radius + other.radius;
    return radii && radii + this.clearance;
  }

  /** The places that robots go to, homes apart, each with its robots. */
  get stops() {
    return (this.#stops ??= this.#findStops());
  }

  #stops = null;

  #findStops() {
    const stops = new Map();
    for (const robot of this.planned) {
      for (const vertex of new Set(robot.stages.map((stage) => stage.vertex))) {
        if (vertex === robot.home) continue;
        if (!stops.has(vertex)) stops.set(vertex, []);
        stops.get(vertex).push(robot);
      }
    }
    return stops;
  }

  /** Whether all trips lead home again. */
  get endsAtHome() {
    return this.planned.every(({ stages, home }) => stages.at(-1).vertex === home);
  }
}

/** All that the page knows of a plan, as payload.py wrote it. */
class Plan extends Site {
  constructor(raw) {
    super(raw);
    this.end = Math.max(raw.end, raw.floor?.end ?? 0);
    this.headway = raw.headway;
    this.booksAhead = raw.booksAhead;
    this.line = raw.line.map(([vertex, at]) => ({ vertex, at })); // of a small fleet: its places in one line
    giveLosses(this.planned, raw.losses);
    this.happened = raw.floor ? onTheFloor(raw, this.planned) : null;
    this.robots = this.happened ?? this.planned;
    this.steady = raw.steady ? new Steady(raw, this.planned) : null;
    this.faults = raw.faults.listed;
    this.faultCount = raw.faults.count;
    this.faultKinds = raw.faults.kinds; // how many of each kind
    this.noPlan = raw.noPlan ?? false; // all robots stay at home, and the faults say why
    this.other = raw.other ? new Plan({ ...raw.other, map: raw.map }) : null; // to compare with
    this.end = Math.max(this.end, this.other?.end ?? 0);
    this.planner = raw.planner;
    this.decisions = raw.decisions;
    this.reroutes = raw.reroutes;
    this.metrics = raw.metrics;
  }

  /** Whether there is more to see of bookings than places that one robot each stays at. */
  get hasSpace() {
    return this.largestRadius > 0 || this.roadmap.zones.length > 0;
  }

  /** When a visit begins to book its vertex, and when it stops. */
  booking(robot, visit) {
    const approach = this.booksAhead && visit > 0 ? robot.drive[visit] : 0;
    return [robot.enter[visit] - approach, robot.leave(visit) + this.headway];
  }
}
