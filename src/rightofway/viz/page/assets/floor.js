"use strict";

/** The robots as they drove on the floor: the same visits at other ticks, and some of them never. */
function onTheFloor(raw, planned) {
  const robots = raw.floor.robots.map((run, index) => new FloorRobot(raw.robots[index], run, planned[index]));
  giveWaits(robots, raw.floor.waits);
  return robots;
}

/** A robot and what became of its part of the plan. */
class FloorRobot extends Robot {
  constructor(raw, run, planned) {
    super(floorTrip(raw, run), planned.index);
    this.planned = planned;
    this.delayInAll = this.ending === DONE ? this.completion - planned.completion : Infinity;
    this.plannedWait = waitedByVisit(planned);
  }

  /** How much later than planned it is, at a tick and in a visit; negative where it is early. */
  lateness(tick, visit) {
    const overdue = tick - this.planned.leave(visit);
    return Math.max(this.enter[visit] - this.planned.enter[visit], overdue);
  }

  /** When it begins to wait longer than planned, in a phase that is a wait. */
  unplannedFrom(phase) {
    return this.phases.begin[phase] + this.plannedWait[this.phases.visit[phase]];
  }
}

function floorTrip(raw, run) {
  const reached = run.enter.length;
  const whole = reached === raw.vertices.length;
  const held = new Float64Array(reached);
  for (const [visit, ticks] of run.held) held[visit] = ticks;
  return {
    ...raw,
    vertices: raw.vertices.slice(0, reached),
    enter: run.enter,
    stages: raw.stages.map(([vertex, work, turn, visit]) => [vertex, work, turn, visit < reached ? visit : -1]),
    drive: typeof raw.drive === "number" ? raw.drive : raw.drive.slice(0, reached),
    held,
    completion: run.completion,
    ending: whole ? DONE : run.broken === null ? WAIT : BROKEN,
    broken: whole ? null : run.broken,
  };
}

/** How long a robot waits in each visit. */
function waitedByVisit({ phases, vertices }) {
  const waited = new Float64Array(vertices.length);
  phases.activity.forEach((activity, i) => {
    if (activity === WAIT) waited[phases.visit[i]] += phases.end(i) - phases.begin[i];
  });
  return waited;
}
