import { fromDifferences, lastAtMost, nearest } from "../common/arrays.js";
import { figure, texts } from "../language/language.js";
import { decimal, fraction } from "../language/quantities.js";

/** @import { BackgroundData, CloseData, MapData, NetworkData } from "../payload.d.ts" */

const PLACES = 3; // decimals of the middle of a cell

/** @typedef {readonly [number, number]} Lane Tail and head. */
/** @typedef {{ points: [number, number][], shares: number[] }} Curve A line, and the share of its length at which each point is. */
/** @typedef {{ name: string, vertices: number[], edges: [number, number][] }} Zone */

/**
 * The graph that robots drive on and what is marked on it, as map_data.py wrote it. It is laid out for
 * drawing: x to the right, y down, one unit a cell. `lengthUnit` is the unit of its lengths, or null.
 */
export class Roadmap {
  x = new Float64Array(0);
  y = new Float64Array(0);

  // of a grid
  cells = new Int32Array(0); // the cell of each vertex, row by row
  vertexAt = new Int32Array(0); // the vertex of each cell, or -1

  // of vertices and lanes
  /** @type {string[] | null} */
  names = null;
  tails = new Int32Array(0);
  heads = new Int32Array(0);
  /** @type {number[]} */
  lengths = [];
  /** @type {number[] | null} */
  sides = null; // of the square cell round each vertex, where the map is cut into squares
  /** @type {{ oneWay: Lane[], bothWays: Lane[] }} */
  lanes = { oneWay: [], bothWays: [] };
  /** @type {Map<number, Curve>} */
  curves = new Map();
  /** @type {Map<number, string>} */
  laneNames = new Map(); // of split lanes, at their middle joints; empty at the others
  /** @type {{ tail: number, head: number, limit: string }[]} */
  limits = [];
  /** @type {string | null} */
  usualLimit = null; // of most lanes
  /** @type {Required<CloseData> | null} */
  close = null; // nearer than robots need
  /** @type {number[]} */
  lonely = []; // vertices without a lane

  /**
   * @param {MapData} raw
   * @param {string | null} [lengthUnit]
   */
  constructor(raw, lengthUnit = null) {
    this.lengthUnit = lengthUnit;
    this.width = raw.width;
    this.height = raw.height;
    this.rows = "rows" in raw ? raw.rows : null;
    this.frame = raw.frame; // where (0, 0) of the drawing is on the site, and whether y grows upwards there
    this.unit = raw.frame.unit; // length units in a unit of the drawing
    /** @type {(BackgroundData & { image?: HTMLImageElement | ImageBitmap | null }) | null} */
    this.background = raw.background ?? null;
    this.obstacles = (("rows" in raw && raw.obstacles) || []).map(
      ([name, left, top, width, height]) => ({
        name,
        left,
        top,
        width,
        height,
      }),
    );
    /** @type {Map<number, string[]>} */
    this.stations = new Map(); // names of the stations at a vertex
    for (const [name, at] of raw.stations ?? [])
      this.stations.set(at, [...(this.stations.get(at) ?? []), name]);
    this.parking = new Set(raw.parking);
    this.charging = new Set(raw.charging);
    this.passed = new Set(raw.passed); // vertices that robots only drive through
    /** @type {Zone[]} */
    this.zones = (raw.zones ?? []).map(([name, vertices, edges]) => ({ name, vertices, edges }));
    if ("rows" in raw) this.#readGrid(raw.rows);
    else this.#readNetwork(raw);
    this.size = this.x.length;
  }

  /** Whether vertices are cells: those of a grid, or squares of a quadtree. */
  get hasCells() {
    return Boolean(this.rows ?? this.sides);
  }

  /** Whether a cell is called by where it is: people know metres of a floor, not numbers of its cells. */
  get isMeasured() {
    return this.hasCells && Boolean(this.lengthUnit);
  }

  /**
   * The name of a vertex in files, commands and addresses.
   *
   * @param {number} vertex
   */
  name(vertex) {
    return this.names ? this.names[vertex] : `N${this.cells[vertex]}`;
  }

  /**
   * Where a vertex is, as `Site.name` of the library writes it: the middle of a cell, or a name.
   *
   * @param {number} vertex
   */
  where(vertex) {
    if (!this.isMeasured) return this.name(vertex);
    const middle = this.toSite(this.x[vertex], this.y[vertex]);
    const [x, y] = middle.map((at) => figure(decimal(fraction(Number(at.toFixed(5))), PLACES)));
    return `(${texts.pair({ x, y })})`;
  }

  /**
   * What a vertex is called on the map: where it is, and the stations there; these alone for a cell.
   *
   * @param {number} vertex
   */
  label(vertex) {
    const stations = this.stations.get(vertex) ?? [];
    const name = this.where(vertex);
    if (this.isMeasured && stations.length) return stations.join(" · ");
    return [name, ...stations.filter((station) => station !== name)].join(" · ");
  }

  /**
   * What a vertex is for: "station Press, parking"; empty for a vertex to pass.
   *
   * @param {number} vertex
   */
  uses(vertex) {
    return [
      ...(this.stations.get(vertex) ?? []).map((name) =>
        name === this.name(vertex) ? texts.station : texts.stationNamed({ name }),
      ),
      ...(this.parking.has(vertex) ? [texts.parking] : []),
      ...(this.charging.has(vertex) ? [texts.charging] : []),
      ...(this.passed.has(vertex) ? [texts.passed] : []),
    ].join(", ");
  }

  /**
   * The vertex of a name, or -1.
   *
   * @param {string | null} name
   */
  vertexNamed(name) {
    if (name === null) return -1;
    if (this.names) return this.names.indexOf(name);
    return /^N\d+$/.test(name) ? this.cells.indexOf(Number(name.slice(1))) : -1;
  }

  /**
   * Where a point of the drawing is in the site's frame [length unit].
   *
   * @param {number} x
   * @param {number} y
   * @returns {[number, number]}
   */
  toSite(x, y) {
    const { frame, unit } = this;
    const [u, v, yaw] = [x * unit, (frame.yUp ? -y : y) * unit, frame.yaw ?? 0];
    const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
    return [frame.x + cos * u - sin * v, frame.y + sin * u + cos * v];
  }

  /**
   * Where a point of the site [length unit] is in the drawing.
   *
   * @param {number} siteX
   * @param {number} siteY
   * @returns {[number, number]}
   */
  toDrawing(siteX, siteY) {
    const { frame, unit } = this;
    const [right, up, yaw] = [siteX - frame.x, siteY - frame.y, frame.yaw ?? 0];
    const [cos, sin] = [Math.cos(yaw), Math.sin(yaw)];
    const [u, v] = [cos * right + sin * up, cos * up - sin * right];
    return [u / unit, (frame.yUp ? -v : v) / unit];
  }

  /**
   * The named obstacle at a point of the drawing, or undefined.
   *
   * @param {number} x
   * @param {number} y
   */
  obstacleAt(x, y) {
    return this.obstacles.find(
      ({ left, top, width, height }) =>
        x >= left && x <= left + width && y >= top && y <= top + height,
    );
  }

  /**
   * The vertex within half a unit of a point, or whose cell holds it, or -1.
   *
   * @param {number} x
   * @param {number} y
   */
  near(x, y) {
    if (this.sides)
      return this.sides.findIndex(
        (side, vertex) =>
          2 * Math.max(Math.abs(x - this.x[vertex]), Math.abs(y - this.y[vertex])) <= side,
      );
    if (!this.rows) return nearest(this.x, this.y, x, y, 0.5);
    const [column, row] = [Math.round(x), Math.round(y)];
    if (row < 0 || row >= this.height || column < 0 || column >= this.width) return -1;
    return this.vertexAt[row * this.width + column];
  }

  /**
   * @param {number} vertex
   * @returns {[number, number]}
   */
  #point(vertex) {
    return [this.x[vertex], this.y[vertex]];
  }

  /**
   * The curve of a lane, from tail to head or the other way round; undefined for a straight lane.
   *
   * @param {number} tail
   * @param {number} head
   */
  curve(tail, head) {
    return this.curves.get(tail * this.size + head);
  }

  /**
   * The vertices that can be driven to from a vertex.
   *
   * @param {number} vertex
   */
  next(vertex) {
    this.#next ??= this.rows ? this.#besideEach() : this.#headsOfEach();
    return this.#next[vertex];
  }

  /**
   * How long the way between two neighbours is [length unit].
   *
   * @param {number} tail
   * @param {number} head
   */
  distance(tail, head) {
    if (this.rows) return this.unit;
    this.#lengths ??= new Map(
      Array.from(this.tails, (from, edge) => [
        from * this.size + this.heads[edge],
        this.lengths[edge],
      ]),
    );
    const found = this.#lengths.get(tail * this.size + head);
    return found ?? this.#lengths.get(head * this.size + tail) ?? NaN;
  }

  /** @type {number[][] | null} */
  #next = null;
  /** @type {Map<number, number> | null} */
  #lengths = null;

  #besideEach() {
    return Array.from({ length: this.size }, (_, vertex) => {
      const [x, y] = [this.x[vertex], this.y[vertex]];
      return [
        [x + 1, y],
        [x, y + 1],
        [x - 1, y],
        [x, y - 1],
      ]
        .map(([atX, atY]) => this.near(atX, atY))
        .filter((it) => it >= 0);
    });
  }

  #headsOfEach() {
    /** @type {number[][]} */
    const heads = Array.from({ length: this.size }, () => []);
    this.tails.forEach((tail, edge) => heads[tail].push(this.heads[edge]));
    return heads;
  }

  /** @param {string[]} rows */
  #readGrid(rows) {
    const text = rows.join("");
    this.vertexAt = new Int32Array(text.length).fill(-1);
    /** @type {number[]} */
    const cells = [];
    for (let cell = 0; cell < text.length; cell++) {
      if (text[cell] === ".") this.vertexAt[cell] = cells.push(cell) - 1;
    }
    this.cells = Int32Array.from(cells);
    this.x = Float64Array.from(cells, (cell) => cell % this.width);
    this.y = Float64Array.from(cells, (cell) => Math.floor(cell / this.width));
  }

  /** @param {NetworkData} raw */
  #readNetwork(raw) {
    this.names = raw.names;
    for (const joints of raw.joints ?? []) {
      for (const vertex of joints) this.laneNames.set(vertex, "");
      const middle = joints[joints.length >> 1];
      this.laneNames.set(middle, raw.names[middle].replace(/\/\d+$/, ""));
    }
    this.x = Float64Array.from(raw.names, (_, vertex) => raw.points[2 * vertex]);
    this.y = Float64Array.from(raw.names, (_, vertex) => raw.points[2 * vertex + 1]);
    this.tails = fromDifferences(raw.tails, Int32Array);
    this.heads = fromDifferences(raw.heads, Int32Array);
    this.lengths = raw.lengths;
    this.sides = raw.sides ?? null;
    this.lanes = this.#sortLanes();
    this.curves = new Map(
      (raw.curves ?? []).map(([tail, head, ...flat]) => {
        /** @type {[number, number][]} */
        const between = Array.from({ length: flat.length / 2 }, (_, i) => [
          flat[2 * i],
          flat[2 * i + 1],
        ]);
        return [
          tail * raw.names.length + head,
          measured([this.#point(tail), ...between, this.#point(head)]),
        ];
      }),
    );
    this.limits = this.#limitedLanes(raw.limits ?? []);
    this.usualLimit =
      (raw.limits ?? []).find(([, edges]) => 2 * edges.length > this.tails.length)?.[0] ?? null;
    this.close = { crossings: [], beside: [], vertices: [], ...raw.close };
    const joined = new Set([...this.tails, ...this.heads]);
    this.lonely = Array.from(raw.names.keys()).filter((vertex) => !joined.has(vertex));
  }

  /**
   * Lanes with a speed limit, both directions as one where they have the same: { tail, head, limit }.
   *
   * @param {[string, number[]][]} groups
   */
  #limitedLanes(groups) {
    const lanes = new Map();
    for (const [limit, edges] of groups) {
      for (const edge of edges) {
        const [tail, head] = [this.tails[edge], this.heads[edge]];
        const key = `${Math.min(tail, head)} ${Math.max(tail, head)} ${limit}`;
        if (!lanes.has(key)) lanes.set(key, { tail, head, limit });
      }
    }
    return [...lanes.values()];
  }

  /** Pairs of vertices with a lane between them: for one way, and for both. */
  #sortLanes() {
    const { tails, heads } = this;
    const size = this.x.length;
    const edges = new Set(Array.from(tails, (tail, edge) => tail * size + heads[edge]));
    /** @type {{ oneWay: Lane[], bothWays: Lane[] }} */
    const lanes = { oneWay: [], bothWays: [] };
    tails.forEach((tail, edge) => {
      const head = heads[edge];
      if (!edges.has(head * size + tail)) lanes.oneWay.push([tail, head]);
      else if (tail < head) lanes.bothWays.push([tail, head]);
    });
    return lanes;
  }
}

/**
 * Points of a line with the share of its length at which each is.
 *
 * @param {[number, number][]} points
 */
function measured(points) {
  const along = [0];
  for (let i = 1; i < points.length; i++) {
    along.push(
      along[i - 1] + Math.hypot(points[i][0] - points[i - 1][0], points[i][1] - points[i - 1][1]),
    );
  }
  return { points, shares: along.map((length) => length / along[along.length - 1]) };
}

/**
 * Where a share of a measured line is over: x, y and the direction there [rad].
 *
 * @param {Curve} options
 * @param {number} share
 */
export function pointAlong({ points, shares }, share) {
  const piece = Math.min(lastAtMost(shares, share), points.length - 2);
  const [[x, y], [toX, toY]] = [points[piece], points[piece + 1]];
  const part = (share - shares[piece]) / (shares[piece + 1] - shares[piece] || 1);
  return [x + (toX - x) * part, y + (toY - y) * part, Math.atan2(toY - y, toX - x)];
}
