/** What is where on the map, by the document: robots' homes and stops, obstacles, vertices, lanes. */

import { jobsOf, stopsOfJob } from "../jobs/jobs.js";
import { robotsOf, stopsOf } from "../robots/fleet.js";
import { nearest } from "../../../viz/page/assets/common/arrays.js";
import { GridGround, cellsOfBox } from "./ground.js";
import {
  bezierAt,
  controlsOf,
  endsOf,
  isNetwork,
  lanesOf,
  positionOf,
  roadmapOf,
} from "./network.js";
import { numberOf, toDrawing, vertexOf } from "./places.js";
/** @import { Roadmap } from "../../../viz/page/assets/plan/roadmap.js" */
/** @import { Cell, Item, JobHit, LaneData, LaneLine, Numeral, Point, Rect, RobotHit, ScenarioDocument } from "../types.js" */

const REACH = 12; // pixels round a point that is small

export class Hits {
  /**
   * @param {ScenarioDocument} document
   * @param {Roadmap} roadmap
   */
  constructor(document, roadmap) {
    this.document = document;
    this.roadmap = roadmap;
    this.ground = document.map.grid ? new GridGround(roadmap) : null; // whose blocked cells are things of their own
    /** @type {RobotHit[]} */
    this.robots = (robotsOf(document) ?? []).map((robot, index) => ({
      index,
      robot,
      home: vertexOf(robot.home, roadmap),
      stops: stopsOf(robot).map(({ at }) => vertexOf(at, roadmap)),
    }));
    /** @type {JobHit[]} */
    this.jobs = (jobsOf(document) ?? []).map((job, index) => ({
      index,
      job,
      stops: stopsOfJob(job).map(({ at }) => vertexOf(at, roadmap)),
    }));
    this.obstacles = (document.map.floor?.obstacles ?? []).map(({ rect }) => boxOf(rect, roadmap));
    this.lanes = isNetwork(document)
      ? lanesOf(document).map((lane) => lineOf(lane, document, roadmap))
      : [];
  }

  /**
   * @param {number} x
   * @param {number} y
   * @param {number} scale
   * @returns {number}
   */
  vertexAt(x, y, scale) {
    const { roadmap } = this;
    return roadmap.hasCells
      ? roadmap.near(x, y)
      : nearest(roadmap.x, roadmap.y, x, y, Math.max(0.3, REACH / scale));
  }

  /**
   * What is at a point: the robot or stop, the vertex, the lane, the obstacle, in this order; or null.
   * @param {{x: number, y: number}} point
   * @param {number} scale
   * @returns {Item | null}
   */
  at({ x, y }, scale) {
    const vertex = this.vertexAt(x, y, scale);
    if (vertex >= 0) {
      const standing = this.robots.find(({ home }) => home === vertex);
      if (standing) return { kind: "robot", id: standing.index };
      const going = this.robots.find(({ stops }) => stops.includes(vertex));
      if (going) return { kind: "stop", id: `${going.index}/${going.stops.indexOf(vertex)}` };
      const wanted = this.jobs.find(({ stops }) => stops.includes(vertex));
      if (wanted) return { kind: "job", id: wanted.index };
      if (this.isWritten(vertex)) return { kind: "vertex", id: this.roadmap.name(vertex) };
    }
    const lane = this.laneAt({ x, y }, scale);
    if (lane) return { kind: "lane", id: lane.index };
    const obstacle = this.obstacles.findLastIndex(
      ([left, top, width, height]) =>
        x >= left && y >= top && x <= left + width && y <= top + height,
    );
    if (obstacle >= 0) return { kind: "obstacle", id: obstacle };
    const { ground } = this;
    const cell = ground?.cellAt(x, y);
    return cell && ground?.holds(cell) && ground.isBlocked(this.document, cell)
      ? { kind: "cell", id: cell.join() }
      : null;
  }

  /**
   * The lane at a point: its index, and where on it that is, as a share of the curve; or null.
   * @param {{x: number, y: number}} point
   * @param {number} scale
   * @returns {{index: number, share: number, x: number, y: number} | null}
   */
  laneAt({ x, y }, scale) {
    const near = this.lanes.map(({ points }) => distanceTo(points, x, y));
    const index = near.findIndex(({ least }) => least < REACH / scale);
    if (index < 0) return null;
    const { share, at } = near[index];
    return { index, share, x: at[0], y: at[1] };
  }

  /**
   * All that lies in a rectangle of the drawing.
   * @param {Rect} box
   * @returns {Item[]}
   */
  inside([left, top, right, bottom]) {
    const { x, y } = this.roadmap;
    /**
     * @param {number} vertex
     * @returns {boolean}
     */
    const isIn = (vertex) =>
      vertex >= 0 &&
      x[vertex] >= left &&
      x[vertex] <= right &&
      y[vertex] >= top &&
      y[vertex] <= bottom;
    /** @type {Item[]} */
    const found = [];
    for (const { index, home } of this.robots)
      if (isIn(home)) found.push({ kind: "robot", id: index });
    if (isNetwork(this.document))
      for (const vertex of x.keys())
        if (isIn(vertex) && this.isWritten(vertex))
          found.push({ kind: "vertex", id: this.roadmap.name(vertex) });
    this.lanes.forEach(({ ends }, id) => ends.every(isIn) && found.push({ kind: "lane", id }));
    this.obstacles.forEach(([l, t, w, h], id) => {
      if (l >= left && t >= top && l + w <= right && t + h <= bottom)
        found.push({ kind: "obstacle", id });
    });
    return [...found, ...this.#blockedIn(left, top, right, bottom)];
  }

  /**
   * The blocked cells of a grid whose middle lies in a rectangle.
   * @param {number} left
   * @param {number} top
   * @param {number} right
   * @param {number} bottom
   * @returns {Item[]}
   */
  #blockedIn(left, top, right, bottom) {
    if (!this.ground) return [];
    /** @type {Cell} */
    const from = [Math.max(Math.ceil(left), 0), Math.max(Math.ceil(top), 0)];
    /** @type {Cell} */
    const to = [
      Math.min(Math.floor(right), this.ground.columns - 1),
      Math.min(Math.floor(bottom), this.ground.rows - 1),
    ];
    if (from[0] > to[0] || from[1] > to[1]) return [];
    const blocked = this.ground.blockedOf(this.document, cellsOfBox(from, to));
    return blocked.map((cell) => /** @type {Item} */ ({ kind: "cell", id: cell.join() }));
  }

  /**
   * The vertex of what is selected, or -1.
   * @param {Item} item
   * @returns {number}
   */
  vertexOf({ kind, id }) {
    if (kind === "robot") return this.robots[id]?.home ?? -1;
    if (kind === "job") return this.jobs[id]?.stops[0] ?? -1;
    if (kind === "vertex") return this.roadmap.vertexNamed(id);
    if (kind !== "stop") return -1;
    const [robot, stop] = id.split("/").map(Number);
    return this.robots[robot]?.stops[stop] ?? -1;
  }

  /**
   * @param {number} vertex
   * @returns {(string | undefined)[]}
   */
  namesAt(vertex) {
    return this.robots
      .filter(({ home, stops }) => home === vertex || stops.includes(vertex))
      .map(({ robot }) => robot.name)
      .concat(this.jobs.filter(({ stops }) => stops.includes(vertex)).map(({ job }) => job.name));
  }

  /**
   * Whether a vertex is one of the document; those between pieces of a lane are not.
   * @param {number} vertex
   * @returns {boolean}
   */
  isWritten(vertex) {
    const { document, roadmap } = this;
    return isNetwork(document) && roadmap.name(vertex) in roadmapOf(document).vertices;
  }
}

const CURVE_PIECES = 24;

/**
 * A lane as it is drawn: its ends, and the points of the line between them, all in the drawing.
 * @param {LaneData} lane
 * @param {ScenarioDocument} document
 * @param {Roadmap} roadmap
 * @returns {LaneLine}
 */
function lineOf(lane, document, roadmap) {
  const names = endsOf(lane);
  const [tail, head] = names.map((name) => roadmapOf(document).vertices[name]);
  const ends = names.map((name) => roadmap.vertexNamed(name));
  if (!tail || !head) return { ends, points: [] };
  const controls = [positionOf(tail), ...controlsOf(lane), positionOf(head)].map((at) =>
    toDrawing(roadmap, ...at),
  );
  const pieces = controls.length > 2 ? CURVE_PIECES : 1;
  const points = Array.from({ length: pieces + 1 }, (_, i) => bezierAt(controls, i / pieces));
  return { ends, points };
}

/**
 * How far a point is from a line of several pieces, and which point of it is nearest.
 * @param {Point[]} points
 * @param {number} px
 * @param {number} py
 * @returns {{least: number, share: number, at: Point}}
 */
function distanceTo(points, px, py) {
  /** @type {{least: number, share: number, at: Point}} */
  let found = { least: Infinity, share: 0, at: [NaN, NaN] };
  for (let i = 1; i < points.length; i++) {
    const [[x, y], [toX, toY]] = [points[i - 1], points[i]];
    const [right, down] = [toX - x, toY - y];
    const along = ((px - x) * right + (py - y) * down) / (right * right + down * down || 1);
    const share = Math.min(Math.max(along, 0), 1);
    /** @type {Point} */
    const at = [x + right * share, y + down * share];
    const least = Math.hypot(px - at[0], py - at[1]);
    if (least < found.least) found = { least, share: (i - 1 + share) / (points.length - 1), at };
  }
  return found;
}

/**
 * A rectangle of a floor, in the drawing: left, top, width, height.
 * @param {Numeral[]} rect
 * @param {Roadmap} roadmap
 * @returns {Rect}
 */
function boxOf(rect, roadmap) {
  const [x, y, width, height] = rect.map((length) => numberOf(length));
  const [one, other] = [toDrawing(roadmap, x, y), toDrawing(roadmap, x + width, y + height)];
  return [
    Math.min(one[0], other[0]),
    Math.min(one[1], other[1]),
    Math.abs(one[0] - other[0]),
    Math.abs(one[1] - other[1]),
  ];
}
