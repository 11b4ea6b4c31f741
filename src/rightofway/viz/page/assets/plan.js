"use strict";

/** Undo first differences: [3, 1, 2] is [3, 4, 6]. */
function fromDifferences(differences, Numbers) {
  const numbers = new Numbers(differences.length);
  let sum = 0;
  for (let i = 0; i < numbers.length; i++) numbers[i] = sum += differences[i];
  return numbers;
}

/** The graph that robots drive on, laid out for drawing: x to the right, y down, one unit a cell. */
class Roadmap {
  constructor(raw) {
    this.width = raw.width;
    this.height = raw.height;
    this.rows = raw.rows ?? null;
    this.frame = raw.frame; // where (0, 0) of the drawing is on the site, and whether y grows upwards there
    this.unit = raw.frame.unit; // length units in a unit of the drawing
    this.background = raw.background ?? null;
    this.obstacles = (raw.obstacles ?? []).map(([name, left, top, width, height]) => ({ name, left, top, width, height }));
    if (this.rows) this.#readGrid();
    else this.#readNetwork(raw);
    this.size = this.x.length;
  }

  /** Whether vertices are cells: those of a grid, or squares of a quadtree. */
  get hasCells() {
    return Boolean(this.rows ?? this.sides);
  }

  name(vertex) {
    return this.names ? this.names[vertex] : `N${this.cells[vertex]}`;
  }

  /** The vertex of a name, or -1. */
  vertexNamed(name) {
    if (this.names) return this.names.indexOf(name);
    return /^N\d+$/.test(name) ? this.cells.indexOf(Number(name.slice(1))) : -1;
  }

  /** Where a point of the drawing is in the site's frame [length unit]. */
  toSite(x, y) {
    const { frame, unit } = this;
    const [u, v, yaw] = [x * unit, (frame.yUp ? -y : y) * unit, frame.yaw ?? 0];
    const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
    return [frame.x + cos * u - sin * v, frame.y + sin * u + cos * v];
  }

  /** The named obstacle at a point of the drawing, or undefined. */
  obstacleAt(x, y) {
    return this.obstacles.find(({ left, top, width, height }) => x >= left && x <= left + width && y >= top && y <= top + height);
  }

  /** The vertex within half a unit of a point, or whose cell holds it, or -1. */
  near(x, y) {
    if (this.sides) return this.sides.findIndex((side, vertex) => 2 * Math.max(Math.abs(x - this.x[vertex]), Math.abs(y - this.y[vertex])) <= side);
    if (!this.rows) return nearest(this.x, this.y, x, y, 0.5);
    const [column, row] = [Math.round(x), Math.round(y)];
    if (row < 0 || row >= this.height || column < 0 || column >= this.width) return -1;
    return this.vertexAt[row * this.width + column];
  }

  /** The vertices that can be driven to from a vertex. */
  next(vertex) {
    this.#next ??= this.rows ? this.#besideEach() : this.#headsOfEach();
    return this.#next[vertex];
  }

  /** How long the way between two neighbours is [length unit]. */
  distance(tail, head) {
    if (this.rows) return this.unit;
    this.#lengths ??= new Map(Array.from(this.tails, (from, edge) => [from * this.size + this.heads[edge], this.lengths[edge]]));
    return this.#lengths.get(tail * this.size + head) ?? this.#lengths.get(head * this.size + tail);
  }

  #next = null;
  #lengths = null;

  #besideEach() {
    return Array.from({ length: this.size }, (_, vertex) => {
      const [x, y] = [this.x[vertex], this.y[vertex]];
      return [[x + 1, y], [x, y + 1], [x - 1, y], [x, y - 1]].map((cell) => this.near(...cell)).filter((it) => it >= 0);
    });
  }

  #headsOfEach() {
    const heads = Array.from({ length: this.size }, () => []);
    this.tails.forEach((tail, edge) => heads[tail].push(this.heads[edge]));
    return heads;
  }

  #readGrid() {
    const text = this.rows.join("");
    this.vertexAt = new Int32Array(text.length).fill(-1);
    const cells = [];
    for (let cell = 0; cell < text.length; cell++) {
      if (text[cell] === ".") this.vertexAt[cell] = cells.push(cell) - 1;
    }
    this.cells = Int32Array.from(cells);
    this.x = Float32Array.from(cells, (cell) => cell % this.width);
    this.y = Float32Array.from(cells, (cell) => Math.floor(cell / this.width));
  }

  #readNetwork(raw) {
    this.names = raw.names;
    this.x = Float32Array.from(raw.names, (_, vertex) => raw.points[2 * vertex]);
    this.y = Float32Array.from(raw.names, (_, vertex) => raw.points[2 * vertex + 1]);
    this.tails = fromDifferences(raw.tails, Int32Array);
    this.heads = fromDifferences(raw.heads, Int32Array);
    this.lengths = raw.lengths;
    this.sides = raw.sides ?? null; // of the square cell round each vertex, where the map is cut into squares
    this.lanes = this.#sortLanes();
    const joined = new Set([...this.tails, ...this.heads]);
    this.lonely = Array.from(raw.names.keys()).filter((vertex) => !joined.has(vertex)); // vertices without a lane
  }

  /** Pairs of vertices with a lane between them: for one way, and for both. */
  #sortLanes() {
    const { tails, heads, names } = this;
    const size = names.length;
    const edges = new Set(Array.from(tails, (tail, edge) => tail * size + heads[edge]));
    const lanes = { oneWay: [], bothWays: [] };
    tails.forEach((tail, edge) => {
      const head = heads[edge];
      if (!edges.has(head * size + tail)) lanes.oneWay.push([tail, head]);
      else if (tail < head) lanes.bothWays.push([tail, head]);
    });
    return lanes;
  }
}

/** The index of the point nearest to (x, y) and within `reach`, or -1. */
function nearest(xs, ys, x, y, reach) {
  let best = -1;
  let least = reach * reach;
  for (let i = 0; i < xs.length; i++) {
    const distance = (xs[i] - x) ** 2 + (ys[i] - y) ** 2;
    if (distance <= least) [best, least] = [i, distance];
  }
  return best;
}

/** A robot and what the plan has it do. Times are ticks. */
class Robot {
  constructor(raw, index) {
    this.index = index;
    this.name = raw.name;
    this.colour = raw.colour;
    this.speed = raw.speed;
    this.vertices = fromDifferences(raw.vertices, Int32Array);
    this.enter = fromDifferences(raw.enter, Float64Array);
    this.drive = typeof raw.drive === "number"
      ? new Float64Array(this.vertices.length).fill(raw.drive)
      : Float64Array.from(raw.drive);
    this.stages = raw.stages.map(([vertex, work, turn, visit]) => ({ vertex, work, turn, visit }));
    this.turns = new Map(raw.turns); // on the spot between two edges, by visit [ticks]
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

/** The index of the last of these increasing numbers that is at most `limit`; 0 if none is. */
function lastAtMost(numbers, limit) {
  let [low, high] = [0, numbers.length - 1];
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (numbers[middle] <= limit) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** All that the page knows, as payload.py wrote it. */
class Plan {
  constructor(raw) {
    this.tick = { numerator: raw.tick[0], denominator: raw.tick[1] };
    this.quantities = new Quantities(raw.units, raw.tick);
    this.end = Math.max(raw.end, raw.floor?.end ?? 0);
    this.headway = raw.headway;
    this.booksAhead = raw.booksAhead;
    this.roadmap = new Roadmap(raw.map);
    this.line = raw.line.map(([vertex, at]) => ({ vertex, at })); // of a small fleet: its places in one line
    this.planned = raw.robots.map((robot, index) => new Robot(robot, index));
    giveLosses(this.planned, raw.losses);
    this.happened = raw.floor ? onTheFloor(raw, this.planned) : null;
    this.robots = this.happened ?? this.planned; // those that are shown
    this.steady = raw.steady ? new Steady(raw, this.planned) : null;
    this.title = raw.title;
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

  /** When a visit begins to book its vertex, and when it stops. */
  booking(robot, visit) {
    const approach = this.booksAhead && visit > 0 ? robot.drive[visit] : 0;
    return [robot.enter[visit] - approach, robot.leave(visit) + this.headway];
  }
}
